"""A page with panels below a heading, laid out in inches.

matplotlib can find the places by itself, but it draws all text several times to do so, which takes
longer than the picture.
"""

from matplotlib.figure import Figure

WIDTH = 10.0  # of a page
EDGE = 0.12  # between the page's edge and what stands there
LINE = 0.225  # of the heading
TITLE = 0.33  # of a panel, above it
LABELS = 0.62  # below a panel: those of its ticks and the name of its axis
LEFT, RIGHT = 1.15, 0.2  # beside the panels; on the left for numbers such as -0.00075
BETWEEN = 0.22  # panels side by side


def make(rows, columns, height, text, below=0.0, right=RIGHT, **shared):
    """A page with panels.

    Parameters
    ----------
    rows, columns : int
    height : float or callable
        Of a panel, or what gives it for the width of a panel.
    text : str
        The heading.
    below : float
        Room for more, under the panels and their labels.
    right : float
        Room beside the panels, on their right.
    **shared
        ``sharex`` and ``sharey`` of `matplotlib.figure.Figure.subplots`.

    Returns
    -------
    figure : matplotlib Figure
    axes : (rows, columns) of matplotlib Axes
    """
    width = (WIDTH - LEFT - right - BETWEEN * (columns - 1)) / columns
    height = height(width) if callable(height) else height
    over = EDGE + LINE * (text.count("\n") + 1) + TITLE
    under = LABELS + below
    tall = over + rows * height + (rows - 1) * TITLE + under
    figure = Figure(figsize=(WIDTH, tall))
    axes = figure.subplots(
        rows, columns, squeeze=False, **shared,
        gridspec_kw={
            "left": LEFT / WIDTH, "right": 1.0 - right / WIDTH, "wspace": BETWEEN / width,
            "bottom": under / tall, "top": 1.0 - over / tall, "hspace": TITLE / height,
        },
    )  # fmt: skip
    figure.suptitle(text, y=1.0 - EDGE / tall, va="top")
    return figure, axes


def place(figure, left, bottom, width, height):
    """A place on the page, of inches, as matplotlib counts it: shares of the page."""
    wide, tall = figure.get_size_inches()
    return left / wide, bottom / tall, width / wide, height / tall
