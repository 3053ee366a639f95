"""Figures in the house style: panels with a legend, lines in the colours of configurations, SVG text.

matplotlib is imported when the first figure is drawn. The same input gives the same bytes.
"""

from __future__ import annotations

import io
import re
import warnings
from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from ..colours import COLOURS, GRID, INK, LIFTED, MUTED, PAPER

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

FONTS = "'Helvetica Neue', Helvetica, Arial, 'Liberation Sans', 'DejaVu Sans', sans-serif"
LINE_STYLES = ("-", "--", ":")
"""The colours repeat after eight configurations, then the line style changes."""

LINE_WIDTH = 1.5
"""Of a configuration's line [points]."""
_POINTS = 1000
"""A line with more than twice as many samples is drawn by its extremes in as many bins."""
PANEL = (4.05, 2.15)
"""Width and height of a panel [inches]."""
_LEFT, _RIGHT, _BOTTOM, _GAP, _ROW_GAP = 0.66, 0.12, 0.46, 0.7, 0.5
_LEGEND_ROW = 0.17
_STYLE: Any = {
    "font.family": "DejaVu Sans",
    "font.size": 8.5,
    "axes.edgecolor": MUTED,
    "axes.labelcolor": INK,
    "axes.linewidth": 0.7,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "axes.axisbelow": True,
    "axes.titlesize": 8.5,
    "axes.titlecolor": MUTED,
    "axes.titlelocation": "left",
    "axes.xmargin": 0.0,
    "axes.ymargin": 0.07,
    "axes.unicode_minus": True,
    "grid.color": GRID,
    "grid.linewidth": 0.6,
    "text.color": INK,
    "text.parse_math": False,
    "xtick.color": MUTED,
    "ytick.color": MUTED,
    "xtick.labelcolor": INK,
    "ytick.labelcolor": INK,
    "xtick.major.width": 0.7,
    "ytick.major.width": 0.7,
    "xtick.minor.size": 0,
    "ytick.minor.size": 0,
    "lines.solid_capstyle": "round",
    "lines.solid_joinstyle": "round",
    "path.simplify_threshold": 0.15,
    "figure.facecolor": PAPER,
    "axes.facecolor": "none",
    "svg.fonttype": "none",
    "svg.hashsalt": "susp_mj",
}


def colour(order: int) -> str:
    """Fixed colour of the configuration at a place in the order of its case."""
    return COLOURS[order % len(COLOURS)]


def draw_svg(make: Callable[..., Figure], *arguments: Any) -> str:
    """SVG text of the figure that `make` draws, in the house style."""
    import matplotlib as mpl
    from matplotlib.backends.backend_svg import FigureCanvasSVG

    buffer = io.StringIO()
    with mpl.rc_context(_STYLE), warnings.catch_warnings():
        warnings.filterwarnings("ignore", message="Glyph .* missing from")  # the browser's fonts may have it
        FigureCanvasSVG(make(*arguments)).print_svg(buffer, metadata={"Date": None, "Creator": "susp_mj"})
    svg = re.sub(r'(style="[^"]*font-family: )[^;"]*', rf"\g<1>{FONTS}", buffer.getvalue())
    return "\n".join(line.rstrip() for line in svg.splitlines()) + "\n"


def make_panels(
    names: Sequence[str],
    titles: Sequence[str],
    *,
    share_y: bool = False,
    size: tuple[float, float] = PANEL,
    orders: Sequence[int] | None = None,
) -> tuple[Figure, list[Axes]]:
    """A figure with a legend on top and panels below, two in a row, or three that share the width of two.

    Args:
        names: of the configurations, for the legend.
        titles: of the panels; an only panel needs none.
        size: width and height of a panel [inches].
        orders: places of the names in the order of colours; without them as they stand.
    """
    from matplotlib.figure import Figure
    from matplotlib.lines import Line2D
    from matplotlib.ticker import MaxNLocator

    count = len(titles)
    columns = count if count <= 3 else 2
    rows = -(-count // columns)
    panel_width, panel_height = size
    if columns == 3:
        panel_width = (2 * panel_width - _GAP) / 3 - 0.02
    width = _LEFT + columns * panel_width + (columns - 1) * _GAP + _RIGHT
    labels = [short_label(name) for name in names]
    across = max(1, int((width - _LEFT) / (0.42 + 0.062 * max(map(len, labels)))))
    title = 0.2 if count > 1 and any(titles) else 0.0
    top = 0.16 + _LEGEND_ROW * -(-len(names) // across) + title
    height = top + rows * panel_height + (rows - 1) * (_ROW_GAP + title) + _BOTTOM

    figure = Figure(figsize=(width, height))
    axes: list[Axes] = []
    for i in range(count):
        left = _LEFT + (i % columns) * (panel_width + _GAP)
        bottom = height - top - panel_height - (i // columns) * (panel_height + _ROW_GAP + title)
        box = (left / width, bottom / height, panel_width / width, panel_height / height)
        axes.append(figure.add_axes(box, sharey=axes[0] if share_y and axes else None))
        if (
            not share_y or i == 0
        ):  # no steps of 2.5, whose numbers are so long that they push the axis' name out of the picture
            axes[-1].yaxis.set_major_locator(MaxNLocator(nbins=8, steps=[1, 2, 5, 10]))
        if count > 1:
            axes[-1].set_title(short_label(titles[i]) if titles[i] else "")
    handles = [
        Line2D([], [], color=colour(order), linestyle=line_style(order), linewidth=2.0)
        for order in (range(len(names)) if orders is None else orders)
    ]
    legend = figure.legend(
        handles,
        [" "] * len(names),  # replaced below: the legend would drop a name that starts with an underscore
        loc="upper left",
        bbox_to_anchor=(_LEFT / width, 1 - 0.05 / height),
        ncols=across,
        frameon=False,
        borderpad=0,
        borderaxespad=0,
        handlelength=1.6,
        handletextpad=0.5,
        columnspacing=1.6,
        labelspacing=0.35,
    )
    for text, label in zip(legend.get_texts(), labels, strict=True):
        text.set_text(label)
    return figure, axes


def stop_lines(panel: Axes, rebound: float, compression: float, *, horizontal: bool, named: bool) -> None:
    """Both stops [mm] as dashed lines, with their names."""
    for place, name, outside in ((compression, "compression stop", "bottom"), (rebound, "rebound stop", "top")):
        if horizontal:
            stop_line(panel, place, name if named else "", outside)
        else:
            panel.axvline(place, color=MUTED, linewidth=0.9, linestyle=(0, (5, 3)))
    if horizontal:
        low, high = panel.get_ylim()
        margin = 0.1 * (compression - rebound)
        panel.set_ylim(min(low, rebound - margin), max(high, compression + margin))


def stop_line(panel: Axes, place: float, name: str, outside: str, end: str = "right") -> None:
    """A stop [mm] as a horizontal dashed line, its name above ("bottom") or below it ("top") at one end."""
    panel.axhline(place, color=MUTED, linewidth=0.9, linestyle=(0, (5, 3)))
    name_line(panel, place, name, MUTED, outside, end)


def limit_line(panel: Axes, place: float, name: str, *, horizontal: bool = True, end: str = "right") -> None:
    """A bound of what is asked; its name stands above one end of a horizontal line, and on top of another."""
    dashes: Any = (0, (4, 1.5, 1, 1.5))
    if horizontal:
        panel.axhline(place, color=LIFTED, linewidth=1.0, linestyle=dashes)
        name_line(panel, place, name, LIFTED, end=end)
        return
    panel.axvline(place, color=LIFTED, linewidth=1.0, linestyle=dashes)
    panel.annotate(
        name,
        (place, 1),
        xycoords=("data", "axes fraction"),
        xytext=(14, 3),
        textcoords="offset points",
        ha="right",
        fontsize=7.5,
        color=LIFTED,
    )


def name_line(panel: Axes, place: float, name: str, ink: str, outside: str = "bottom", end: str = "right") -> None:
    """Name of a horizontal line above ("bottom") or below it ("top"), at its left or right end."""
    panel.annotate(
        name,
        (1 if end == "right" else 0, place),
        xycoords=("axes fraction", "data"),
        xytext=(-2 if end == "right" else 4, 2 if outside == "bottom" else -2),
        textcoords="offset points",
        ha=end,
        va=outside,
        fontsize=7.5,
        color=ink,
    )


def zero_line(panel: Axes) -> None:
    """A thin line at zero, where the panel shows both signs."""
    low, high = panel.get_ylim()
    if low < 0 < high:
        panel.axhline(0, color=MUTED, linewidth=0.6, zorder=1.5)


def draw_line(panel: Axes, order: int, x: np.ndarray, y: np.ndarray, width: float = LINE_WIDTH) -> None:
    """One configuration's line; where it hides an equal one it is dashed, so that both are seen."""
    style: Any = line_style(order)
    hidden = sum(look_alike(line.get_xydata(), x, y) for line in panel.lines)
    if hidden:
        dash = 6 / 2 ** (min(hidden, 3) - 1)
        style = (0, (dash, 12 - dash))
    panel.plot(x, y, color=colour(order), linestyle=style, linewidth=width)


def look_alike(line: Any, x: np.ndarray, y: np.ndarray) -> bool:
    """Whether a line already drawn, (n, 2), lies where ``(x, y)`` would: within the width of a line."""
    if line.shape != (len(x), 2) or not np.array_equal(line[:, 0], x):
        return False
    difference, seen = np.abs(line[:, 1] - y), np.isfinite(y)
    return bool(difference[seen].max() <= 0.004 * np.ptp(y[seen]) or difference[seen].max() == 0)


def line_style(order: int) -> Any:
    """Line style of the configuration at a place in the order of its case."""
    return LINE_STYLES[order // len(COLOURS) % len(LINE_STYLES)]


def label_axes(panel: Axes, x: str, y: str) -> None:
    """Name both axes of a panel."""
    panel.set_xlabel(x)
    panel.set_ylabel(y)


def short_label(text: str) -> str:
    """A user's text as a plot can show it: one line, not too long, nothing that XML forbids."""
    plain = "".join(each if each.isprintable() else " " for each in text) or "–"
    return plain if len(plain) <= 48 else plain[:47] + "…"


def thinned(time: np.ndarray, values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """A line that looks the same with fewer points: the extremes of each bin, in their order."""
    size = len(values) // _POINTS
    if size < 2:
        return time, values
    whole = len(values) // size * size
    bins = values[:whole].reshape(-1, size)
    extremes = (
        np.sort(np.column_stack([bins.argmin(axis=1), bins.argmax(axis=1)]), axis=1)
        + np.arange(0, whole, size)[:, None]
    )
    keep = np.unique(np.concatenate([[0], extremes.ravel(), [len(values) - 1]]))
    return time[keep], values[keep]


def thinned_way(x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """A line through a plane with fewer points, evenly left out, both ends kept."""
    every = max(len(x) // 800, 1)
    keep = np.unique(np.append(np.arange(0, len(x), every), len(x) - 1))
    return x[keep], y[keep]


def spans(time: np.ndarray, where: np.ndarray) -> Iterator[tuple[float, float]]:
    """First and last time of every stretch in which `where` holds."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], where, [False]]).astype(int)))
    for begin, end in zip(edges[::2], edges[1::2], strict=True):
        yield float(time[begin]), float(time[end - 1])
