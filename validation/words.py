"""Numbers, bands and times as the report prints them."""

import math
from datetime import datetime

DIGITS = 4
ERROR_DIGITS = 2
SUPERSCRIPT = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
NARROW_SPACE = "\u202f"


def number(value, digits=DIGITS):
    """A number to some significant digits; whole numbers (int) in full; texts as they are."""
    if value is None:
        return "–"
    if isinstance(value, str | bool):
        return str(value)
    if isinstance(value, int):
        return _grouped(f"{value:,}")
    if not math.isfinite(value):
        return "not a number"
    text = f"{value:.{digits - 1}e}"
    mantissa, exponent = text.split("e")
    if value and not -4 <= int(exponent) < 6:
        mantissa = mantissa.rstrip("0").rstrip(".")
        return _minus(f"{mantissa} × 10{str(int(exponent)).translate(SUPERSCRIPT)}")
    decimals = max(digits - 1 - int(exponent), 0)
    text = f"{float(text):,.{decimals}f}"
    return _minus(_grouped(text.rstrip("0").rstrip(".") if decimals else text))


def _grouped(text):
    """Narrow spaces between thousands, from five digits on."""
    whole = text.partition(".")[0].lstrip("-")
    return text.replace(",", NARROW_SPACE if len(whole) > 5 else "")


def _minus(text):
    return text.replace("-", "−") if text.startswith("-") else text


def with_unit(text, unit):
    """A text and its unit, not to be torn apart."""
    return f"{text}\u00a0{unit}" if unit else text


def band(metric):
    """The band of a metric: "0.85 to 1.05 mm", "≥ 0.85", "≤ 0.05"."""
    low, high = metric["low"], metric["high"]
    if low is None and high is None:
        return "any"
    if low is None:
        text = f"≤ {number(high)}"
    elif high is None:
        text = f"≥ {number(low)}"
    elif low == high:
        text = f"= {number(low)}"
    else:
        text = f"{number(low)} to {number(high)}"
    return with_unit(text, metric["unit"])


def measured(metric):
    """The value of a metric, with as many digits as show on which side of the band it lies, and
    its standard error.
    """
    value, digits = metric["value"], DIGITS
    if value is None:
        return "no value"
    edges = [edge for edge in (metric["low"], metric["high"]) if edge is not None]
    while any(value != edge and number(value, digits) == number(edge, digits) for edge in edges):
        digits += 1
    error = f" ± {number(metric['error'], ERROR_DIGITS)}" if metric["error"] else ""
    return with_unit(number(value, digits) + error, metric["unit"])


def drawn(metric):
    """What the value of a metric is of several draws; nothing where there is one."""
    count = len(metric["draws"])
    return f"{'mean' if metric['error'] else 'worst'} of {count} seeds" if count > 1 else ""


def duration(seconds):
    """A time span: "31 s", "12.4 min", "3.2 h"."""
    if seconds is None:
        return "–"
    for unit, length in (("h", 3600.0), ("min", 60.0)):
        if seconds >= length:
            return f"{seconds / length:.1f}\u00a0{unit}"
    return f"{seconds:.3g}\u00a0s"


def date(text):
    """An ISO date and time in words: "25 November 2026, 10:00 UTC"."""
    moment = datetime.fromisoformat(text)
    return f"{moment.day} {moment:%B %Y, %H:%M} {moment.tzname() or ''}".strip()


def commit(text):
    """The first digits of a commit, and "-dirty" where it has that."""
    digits, dash, rest = text.partition("-")
    return digits[:10] + dash + rest
