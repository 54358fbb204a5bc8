"""The browser that prints the report."""

import shutil
import subprocess
import tempfile

NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome")
TIMEOUT = 120  # seconds


def find():
    """Path of a browser that can print, None if there is none."""
    return next(filter(None, map(shutil.which, NAMES)), None)


def command(browser, profile):
    """The command that starts a browser without a window.

    Without a sandbox, which containers often cannot give; the page is ours and loads nothing.
    """
    return [browser, "--headless", "--no-sandbox", "--disable-gpu", f"--user-data-dir={profile}"]


def print_pdf(page, pdf):
    """Print a page into a PDF file.

    Parameters
    ----------
    page, pdf : Path

    Raises
    ------
    RuntimeError
        If there is no browser, or no file came out of it.
    """
    browser = find()
    if browser is None:
        raise RuntimeError(f"no browser; looked for {', '.join(NAMES)}")
    with tempfile.TemporaryDirectory() as profile:
        line = command(browser, profile)
        line += ["--no-pdf-header-footer", f"--print-to-pdf={pdf.resolve()}"]
        line += [page.resolve().as_uri()]
        try:
            subprocess.run(line, capture_output=True, text=True, timeout=TIMEOUT, check=True)
        except (OSError, subprocess.SubprocessError) as error:
            raise RuntimeError(f"{browser}: {error}") from error
    if not pdf.exists():
        raise RuntimeError(f"{browser}: printed nothing")
