"""The report of a validation: one HTML page and, where a browser is at hand, a PDF of it.

``python -m validation.report DIR`` draws it again from the JSON files of a folder.
"""

import argparse
import json
import re
import sys
from pathlib import Path

import markdown
from markupsafe import Markup

from mpslab.analysis.page import templates
from mpslab.core.files import replacing
from validation import browser, figures, words
from validation.judge import MISSED, OPEN

BAD_INPUT = 2
INSTALL = "python -m pip install -e '.[validation]'"
REPEAT = {"quick": "python -m validation", "full": "python -m validation --full"}


def write(results, out):
    """Write ``report.html`` and ``report.pdf``.

    Without a browser, or if it fails, there is no PDF, and a line on stderr says why.

    Parameters
    ----------
    results : list of dict
        What the cases found, in the order of the report (the schema: ``validation/README.md``).
    out : str or Path
        The folder, which holds the pictures that the results name.

    Returns
    -------
    list of Path
        The files written.
    """
    page, pdf = Path(out) / "report.html", Path(out) / "report.pdf"
    with replacing(page) as draft:
        draft.write_text(render(results, Path(out)), encoding="utf-8")
    pdf.unlink(missing_ok=True)
    try:
        browser.print_pdf(page, pdf)
    except RuntimeError as error:
        print(f"validation: no PDF: {error}", file=sys.stderr)
        return [page]
    return [page, pdf]


def read(folder):
    """Results from the JSON files of a folder.

    They stand by their ``order``, where they have one, and then by date.

    Raises
    ------
    ValueError
        If there are none, or a file does not hold a result.
    """
    results = [_read(path) for path in sorted(Path(folder).glob("*.json"))]
    if not results:
        raise ValueError(f"'{folder}': holds no JSON file; allowed: the results of a validation")
    return sorted(results, key=lambda r: (r.get("order", 0), r["provenance"]["date"]))


def _read(path):
    try:
        result = json.loads(path.read_text(encoding="utf-8"))
        result["case"], result["provenance"]["date"]
        [metric["verdict"] for metric in result["metrics"]]
    except (ValueError, KeyError, TypeError) as error:
        raise ValueError(f"'{path}': is not the result of a case ({error!r})") from error
    return result


def render(results, folder):
    """The page as text, all figures within.

    Parameters
    ----------
    results : list of dict
    folder : Path
        Where the pictures lie.

    Returns
    -------
    str
    """
    environment = templates(Path(__file__).parent)
    environment.filters |= {
        "number": words.number,
        "band": words.band,
        "measured": words.measured,
        "seeds": words.drawn,
        "duration": words.duration,
        "date": words.date,
        "commit": words.commit,
        "prose": prose,
        "failures": failures,
        "drawn": figures.draw,
        "converging": figures.draw_convergence,
        "data_url": figures.data_url,
    }
    environment.tests |= {"missed": missed, "undecided": undecided}
    metrics = [metric for result in results for metric in result["metrics"]]
    return environment.get_template("report.html.j2").render(
        results=results,
        total=len(metrics),
        misses=[(r, m) for r in results for m in r["metrics"] if missed(m)],
        undecided=[(r, m) for r in results for m in r["metrics"] if undecided(m)],
        picture=lambda name: _picture(folder / name),
        origin=_origin(results),
        repeat=_repeat(results[-1]),
    )


def missed(metric):
    """Whether a metric lies outside its band, or has no value at all."""
    return metric["value"] is None or metric["verdict"] == MISSED


def undecided(metric):
    """Whether an edge of its band is within two standard errors of a metric."""
    return metric["value"] is not None and metric["verdict"] == OPEN


def failures(result):
    """Why a case has no value: a text for each run that did not finish."""
    return [
        f"run {run['name']} {run['outcome']}: {run['reason'] or 'no reason given'}"
        for run in result["runs"]
        if run["outcome"] != "finished"
    ]


def prose(text):
    """Markdown as HTML, its title left out and its headings two levels down."""
    html = markdown.markdown(re.sub(r"\A\s*# .*\n", "", text), extensions=["extra"])
    return Markup(re.sub(r"(</?h)([1-4])>", lambda tag: f"{tag[1]}{int(tag[2]) + 2}>", html))


def _picture(path):
    """A PNG file as a data URL, None if it is not there."""
    return figures.picture_url(path.read_bytes()) if path.exists() else None


def _origin(results):
    """What the results were made with: different ones, each once, in the order of the cases."""
    made = [result["provenance"] for result in results]
    days = sorted(entry["date"] for entry in made)
    return {
        "suites": _once(result["suite"] for result in results),
        "commits": _once(entry["commit"] or "unknown" for entry in made),
        "machines": _once(_machine(entry["machine"]) for entry in made),
        "versions": _once(_versions(entry["versions"]) for entry in made),
        "first": days[0],
        "last": days[-1],
        "seconds": sum(entry["seconds"] for entry in made),
    }


def _once(items):
    return list(dict.fromkeys(items))


def _machine(machine):
    return f"{machine['cpu']}, {machine['cores']} cores, {machine['platform']}"


def _versions(versions):
    return ", ".join(f"{name} {version}" for name, version in versions.items() if version)


def _repeat(result):
    """Commands that make such a result again."""
    commit, _, dirty = (result["provenance"]["commit"] or "").partition("-")
    checkout = f"git checkout {commit}" + "  # and changes that it does not hold" * bool(dirty)
    lines = [checkout] if commit else []
    return "\n".join([*lines, INSTALL, REPEAT[result["suite"]]])


def main(arguments=None):
    """Draw the report of a folder again; returns the exit status."""
    parser = argparse.ArgumentParser(
        prog="python -m validation.report",
        description="Draw the report again from the JSON files of a folder; nothing is run.",
    )
    parser.add_argument("folder", type=Path, metavar="DIR", help="the results of a validation")
    folder = parser.parse_args(arguments).folder
    try:
        results = read(folder)
    except ValueError as error:
        print(f"validation: {error}", file=sys.stderr)
        return BAD_INPUT
    for path in write(results, folder):
        print(f"Report: {path}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
