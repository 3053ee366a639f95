"""Plots as SVG text: all configurations on one axis, each in its fixed colour, in engineers' units.

matplotlib is imported when the first plot is drawn. The same input gives the same bytes.
"""

from __future__ import annotations

import io
import itertools
import re
import warnings
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from susp_mj.files import write_text
from susp_mj.names import QUANTITIES, channel_name

from .colours import COLOURS
from .display import shown
from .frequency import amplification
from .ride import CONTACT_LOST, INPUTS

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from .compare import Characteristic, Comparison, Configuration

TIME_QUANTITIES = (
    "body_acceleration",
    "body_displacement",
    "pitch_angle",
    "roll_angle",
    "seat_acceleration",
    "suspension_deflection",
    "suspension_speed",
    "wheel_load",
    "road_height",
    "lateral_acceleration",
    "longitudinal_acceleration",
    "rig_moment",
)
ELEMENT_FORCES = ("spring_force", "stop_force", "damper_force", "bar_force", "friction_force")
SWEEP_QUANTITIES = ("body_displacement", "body_acceleration", "pitch_angle", "roll_angle", "suspension_deflection", "wheel_load")
STATIONS = {
    "fl": "front left",
    "fr": "front right",
    "rl": "rear left",
    "rr": "rear right",
    "l": "left",
    "r": "right",
    "front": "front axle",
    "rear": "rear axle",
}
"""Stations as a reader calls them."""

INK, MUTED, GRID, PAPER = "#24292f", "#6b7480", "#dfe3e8", "#ffffff"
_LIGHT = {"ink": INK, "muted": MUTED, "grid": GRID, "paper": PAPER}
_DARK = {"ink": "#dfe4ea", "muted": "#8d96a1", "grid": "#333a43", "paper": "#1b2026"}
FONTS = "'Helvetica Neue', Helvetica, Arial, 'Liberation Sans', 'DejaVu Sans', sans-serif"
LINE_STYLES = ("-", "--", ":")
"""The colours repeat after eight configurations, then the line style changes."""

_POINTS = 1000
"""A line with more than twice as many samples is drawn by its extremes in as many bins."""
_LEAST_FREQUENCY_SPAN = 0.6
"""The natural frequency axis covers at least this [Hz]: a constant one shall look constant."""
_PANEL = (4.05, 2.15)
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


def draw(comparison: Comparison) -> dict[str, str]:
    """Every plot of a comparison as SVG text, by name: amplification of sweeps, then time, then characteristics."""
    sets = {each.name: each.characteristics for each in comparison.configurations}
    return {**amplification_plots(comparison), **time_plots(comparison), **characteristic_plots(sets)}


def save_plots(comparison: Comparison, folder: str | Path, plots: Mapping[str, str] | None = None) -> list[Path]:
    """Write every plot as ``<name>.svg``.

    Args:
        plots: what `draw` returned, if it was drawn before.

    Raises:
        InputError: the folder cannot be written.
    """
    drawn = draw(comparison) if plots is None else plots
    return [write_text(Path(folder) / f"{name}.svg", svg) for name, svg in drawn.items()]


def time_plots(comparison: Comparison) -> dict[str, str]:
    """One plot over time for each quantity that was recorded; several stations become panels."""
    configurations = comparison.configurations
    plots: dict[str, str] = {}
    for quantity in TIME_QUANTITIES:
        stations = _stations(configurations, quantity)
        if stations and not (quantity in INPUTS and _stands_still(configurations, quantity)):
            plots[quantity] = _drawn(_time_figure, configurations, [(quantity, station) for station in stations])
    forces = [(quantity, station) for quantity in ELEMENT_FORCES for station in _acting(configurations, quantity)]
    if forces:
        plots["element_forces"] = _drawn(_time_figure, configurations, forces)
    return plots


def _stands_still(configurations: Sequence[Configuration], quantity: str) -> bool:
    """Whether an input is not used in any configuration."""
    return all(np.ptp(values) < 1e-12 for each in configurations for values in each.run.stations(quantity).values())


def _acting(configurations: Sequence[Configuration], quantity: str) -> list[str]:
    """Stations of an element force, if it is ever more than zero; friction of several wheels is left out."""
    stations = _stations(configurations, quantity)
    if quantity == "friction_force" and len(stations) > 1:
        return []
    return stations if any(np.any(values) for each in configurations for values in each.run.stations(quantity).values()) else []


def characteristic_plots(sets: Mapping[str, Sequence[Characteristic]]) -> dict[str, str]:
    """Spring force and rate over the travel, natural frequency over the load, damper force over speed.

    Where a motion ratio is known, also the forces of spring and damper themselves over their own travel and speed.

    Args:
        sets: characteristics by configuration; those with the same title share a panel.
    """
    titles = list(dict.fromkeys(each.title for characteristics in sets.values() for each in characteristics))
    if not titles:
        return {}
    plots = {name: _drawn(_characteristic_figure, sets, titles, draw_one) for name, draw_one in _CHARACTERISTICS.items()}
    for name, (part, draw_one) in _COMPONENTS.items():
        known = {key: [each for each in characteristics if getattr(each, part)] for key, characteristics in sets.items()}
        there = [title for title in titles if any(each.title == title for each in itertools.chain(*known.values()))]
        if there:
            plots[name] = _drawn(_characteristic_figure, known, there, draw_one)
    return plots


def amplification_plots(comparison: Comparison) -> dict[str, str]:
    """Amplification over frequency for each quantity; empty unless the manoeuvre was a sine sweep."""
    configurations = comparison.configurations
    if not any("excitation_phase" in each.run for each in configurations):
        return {}
    return {
        f"{quantity}_amplification": _drawn(_amplification_figure, configurations, quantity, stations)
        for quantity in SWEEP_QUANTITIES
        if (stations := _responding(configurations, quantity))
    }


def _responding(configurations: Sequence[Configuration], quantity: str) -> list[str]:
    """Stations that a sweep moves at all: a symmetric one does not roll the car."""
    values = [run_values for each in configurations for run_values in each.run.stations(quantity).values()]
    moves = any(np.ptp(each) > 1e-9 * max(1.0, np.abs(each).max()) for each in values)
    return _stations(configurations, quantity) if moves else []


def for_page(svg: str) -> str:
    """The same plot for a page with a light and a dark scheme: the colours become variables that follow the scheme."""
    light = {**_LIGHT, **{f"c{i}": each for i, each in enumerate(COLOURS)}}
    dark = {**_DARK, **{f"c{i}": on_dark(each) for i, each in enumerate(COLOURS)}}
    names = {value: name for name, value in light.items()}
    svg = re.sub(f"((?:fill|stroke): )({'|'.join(names)})", lambda found: f"{found[1]}var(--{names[found[2]]})", svg)
    rules = [":root{" + ";".join(f"--{name}:{value}" for name, value in scheme.items()) + "}" for scheme in (light, dark)]
    style = f"<style>{rules[0]}@media (prefers-color-scheme:dark){{{rules[1]}}}</style>"
    return re.sub(r"(<svg[^>]*>)", lambda found: found[1] + style, svg, count=1)


def on_dark(colour: str) -> str:
    """A line colour made lighter for a dark ground."""
    parts = [int(colour[i : i + 2], 16) for i in (1, 3, 5)]
    return "#" + "".join(f"{round(part + 0.42 * (255 - part)):02x}" for part in parts)


def _drawn(make: Callable[..., Figure], *arguments: Any) -> str:
    """SVG text of the figure that `make` draws, in the house style."""
    import matplotlib as mpl
    from matplotlib.backends.backend_svg import FigureCanvasSVG

    buffer = io.StringIO()
    with mpl.rc_context(_STYLE), warnings.catch_warnings():
        warnings.filterwarnings("ignore", message="Glyph .* missing from")  # the browser's fonts may have it
        FigureCanvasSVG(make(*arguments)).print_svg(buffer, metadata={"Date": None, "Creator": "susp_mj"})
    svg = re.sub(r'(style="[^"]*font-family: )[^;"]*', rf"\g<1>{FONTS}", buffer.getvalue())
    return "\n".join(line.rstrip() for line in svg.splitlines()) + "\n"


def _panels(names: Sequence[str], titles: Sequence[str], *, share_y: bool = False) -> tuple[Figure, list[Axes]]:
    """A figure with a legend on top and panels below, two in a row, or three that share the width of two.

    Args:
        names: of the configurations, for the legend.
        titles: of the panels; an only panel needs none.
    """
    from matplotlib.figure import Figure
    from matplotlib.lines import Line2D

    count = len(titles)
    columns = count if count <= 3 else 2
    rows = -(-count // columns)
    panel_width, panel_height = _PANEL
    if columns == 3:
        panel_width = (2 * panel_width - _GAP) / 3 - 0.02
    width = _LEFT + columns * panel_width + (columns - 1) * _GAP + _RIGHT
    labels = [_label(name) for name in names]
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
        if count > 1:
            axes[-1].set_title(_label(titles[i]) if titles[i] else "")
    handles = [Line2D([], [], color=colour(i), linestyle=_line_style(i), linewidth=2.0) for i in range(len(names))]
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


def _time_figure(configurations: Sequence[Configuration], panels: Sequence[tuple[str, str]]) -> Figure:
    """Time histories; `panels` are pairs of quantity and station."""
    same = len({quantity for quantity, _ in panels}) == 1
    figure, axes = _panels([each.name for each in configurations], [_station_name(station) for _, station in panels], share_y=same)
    for panel, (quantity, station) in zip(axes, panels, strict=True):
        how = shown(QUANTITIES[quantity][0])
        for order, each in enumerate(configurations):
            values = each.run.stations(quantity).get(station)
            if values is not None:
                _line(panel, order, *_thinned(each.run.time, values * how.factor))
        _label_axes(panel, "time [s]", _quantity_label(quantity))
        panel.set_xlim(0, max(float(each.run.time[-1]) for each in configurations))
        _mark_time(panel, configurations, quantity, station)
    return figure


def _mark_time(panel: Axes, configurations: Sequence[Configuration], quantity: str, station: str) -> None:
    """Zero line, stops and lost contact, where the quantity has them."""
    if quantity == "wheel_load":
        panel.axhline(0, color=INK, linewidth=0.9)
        for order, each in enumerate(configurations):
            load = each.run.stations(quantity).get(station)
            for begin, end in _spans(each.run.time, load <= CONTACT_LOST) if load is not None else ():
                panel.axvspan(begin, end, color=colour(order), alpha=0.25, linewidth=1)
    elif quantity == "suspension_deflection":
        stops = {tuple(travel[station]) for each in configurations if station in (travel := each.run.meta.get("travel", {}))}
        for order, (rebound, compression) in enumerate(sorted(stops)):
            _stop_lines(panel, rebound * 1e3, compression * 1e3, horizontal=True, named=order == 0)
    low, high = panel.get_ylim()
    if quantity != "wheel_load" and low < 0 < high:
        panel.axhline(0, color=MUTED, linewidth=0.6, zorder=1.5)


def _stop_lines(panel: Axes, rebound: float, compression: float, *, horizontal: bool, named: bool) -> None:
    """Both stops [mm] as dashed lines, with their names."""
    for place, name, outside in ((compression, "compression stop", "bottom"), (rebound, "rebound stop", "top")):
        if horizontal:
            panel.axhline(place, color=MUTED, linewidth=0.9, linestyle=(0, (5, 3)))
            if named:
                panel.annotate(
                    name,
                    (1, place),
                    xycoords=("axes fraction", "data"),
                    xytext=(-2, 2 if outside == "bottom" else -2),
                    textcoords="offset points",
                    ha="right",
                    va=outside,
                    fontsize=7.5,
                    color=MUTED,
                )
        else:
            panel.axvline(place, color=MUTED, linewidth=0.9, linestyle=(0, (5, 3)))
    if horizontal:
        low, high = panel.get_ylim()
        margin = 0.1 * (compression - rebound)
        panel.set_ylim(min(low, rebound - margin), max(high, compression + margin))


def _characteristic_figure(sets: Mapping[str, Sequence[Characteristic]], titles: Sequence[str], draw_one: Callable[..., None]) -> Figure:
    """One panel for each title, all sets in it."""
    figure, axes = _panels(list(sets), titles)
    for panel, title in zip(axes, titles, strict=True):
        stops: set[tuple[float, float]] = set()
        for order, characteristics in enumerate(sets.values()):
            for each in characteristics:
                if each.title == title:
                    draw_one(panel, order, each)
                    stops.add(each.stops)
        if draw_one in (_spring_force, _spring_rate):
            for rebound, compression in sorted(stops):
                _stop_lines(panel, rebound * 1e3, compression * 1e3, horizontal=False, named=False)
    return figure


def _spring_force(panel: Axes, order: int, each: Characteristic) -> None:
    rebound, compression = each.stops
    force = np.asarray(each.spring_force) * 1e-3
    inside = force[(each.deflection >= rebound) & (each.deflection <= compression)]
    margin = 0.15 * float(np.ptp(inside))
    low, high = panel.get_ylim() if panel.lines else (np.inf, -np.inf)
    _line(panel, order, each.deflection * 1e3, force)
    panel.plot([0], [each.preload * 1e-3], "o", color=colour(order), markersize=5, markeredgecolor=PAPER, markeredgewidth=0.8)
    panel.set_ylim(min(low, max(float(inside.min()) - margin, min(0.0, float(inside.min())))), max(high, float(inside.max()) + margin))
    panel.set_xlim(each.deflection[0] * 1e3, each.deflection[-1] * 1e3)
    _label_axes(panel, "suspension deflection [mm]", "spring force at the wheel [kN]")


def _spring_rate(panel: Axes, order: int, each: Characteristic) -> None:
    _line(panel, order, each.deflection * 1e3, each.spring_rate * 1e-3)
    panel.set_xlim(each.deflection[0] * 1e3, each.deflection[-1] * 1e3)
    panel.set_ylim(0, 1.08 * panel.dataLim.y1)
    _label_axes(panel, "suspension deflection [mm]", "spring rate at the wheel [kN/m]")


def _spring_frequency(panel: Axes, order: int, each: Characteristic) -> None:
    inside = np.isfinite(each.spring_frequency)
    load, frequency = np.asarray(each.spring_force)[inside] * 1e-3, np.asarray(each.spring_frequency)[inside]
    _line(panel, order, load, frequency)
    at_preload = float(np.interp(each.preload * 1e-3, load, frequency))
    panel.plot([each.preload * 1e-3], [at_preload], "o", color=colour(order), markersize=5, markeredgecolor=PAPER, markeredgewidth=0.8)
    low, high = panel.dataLim.intervaly
    margin = max(0.07 * (high - low), 0.5 * (_LEAST_FREQUENCY_SPAN - (high - low)))
    panel.set_ylim(max(low - margin, 0), high + margin)
    _label_axes(panel, "load carried by the spring [kN]", "natural frequency [Hz]")


def _damper_force(panel: Axes, order: int, each: Characteristic) -> None:
    _line(panel, order, each.speed, each.damper_force * 1e-3)
    if order == 0:
        panel.axhline(0, color=MUTED, linewidth=0.6, zorder=1.5)
        panel.axvline(0, color=MUTED, linewidth=0.6, zorder=1.5)
    _label_axes(panel, "speed, compression positive [m/s]", "damper force at the wheel [kN]")


def _component_spring(panel: Axes, order: int, each: Characteristic) -> None:
    spring = each.component_spring
    if spring is None:
        return
    travel, force = np.asarray(spring.travel) * 1e3, np.asarray(spring.force) * 1e-3
    _line(panel, order, travel, force)
    preload = [each.preload / spring.ratio * 1e-3]
    panel.plot([0], preload, "o", color=colour(order), markersize=5, markeredgecolor=PAPER, markeredgewidth=0.8)
    _label_axes(panel, "spring travel [mm]", "force of the spring itself [kN]")


def _component_damper(panel: Axes, order: int, each: Characteristic) -> None:
    damper = each.component_damper
    if damper is None:
        return
    _line(panel, order, np.asarray(damper.speed), np.asarray(damper.force) * 1e-3)
    panel.axhline(0, color=MUTED, linewidth=0.6, zorder=1.5)
    panel.axvline(0, color=MUTED, linewidth=0.6, zorder=1.5)
    _label_axes(panel, "damper speed, compression positive [m/s]", "force of the damper itself [kN]")


_CHARACTERISTICS: dict[str, Callable[..., None]] = {
    "spring_force_characteristic": _spring_force,
    "spring_rate_characteristic": _spring_rate,
    "natural_frequency_characteristic": _spring_frequency,
    "damper_force_characteristic": _damper_force,
}
_COMPONENTS: dict[str, tuple[str, Callable[..., None]]] = {
    "component_spring_force_characteristic": ("component_spring", _component_spring),
    "component_damper_force_characteristic": ("component_damper", _component_damper),
}


def _amplification_figure(configurations: Sequence[Configuration], quantity: str, stations: Sequence[str]) -> Figure:
    from matplotlib.ticker import FuncFormatter, LogLocator, NullLocator

    figure, axes = _panels([each.name for each in configurations], [_station_name(each) for each in stations], share_y=True)
    unit = QUANTITIES[quantity][0]
    shown_as = {"m": ("", 1.0), "m/s²": ("1/s²", 1.0), "N": ("kN/m", 1e-3), "rad": ("°/m", 180 / np.pi)}
    ratio_unit, factor = shown_as.get(unit, (f"({unit})/m", 1.0))
    label = quantity.replace("_", " ") + " / road height" + (f" [{ratio_unit}]" if ratio_unit else " [–]")
    for panel, station in zip(axes, stations, strict=True):
        for order, each in enumerate(configurations):
            name = channel_name(station, quantity)
            found = amplification(each.run, name, station) if name in each.run else None
            if found is not None:
                _line(panel, order, found.frequency, np.abs(found.ratio) * factor)
            if name in each.transfer:
                frequency, exact = each.transfer[name]
                panel.plot(frequency, np.abs(exact) * factor, color=colour(order), linestyle=":", linewidth=1.2)
        panel.set_xscale("log")
        panel.set_yscale("log")
        for axis in (panel.xaxis, panel.yaxis):
            decades = np.diff(np.log10(axis.get_view_interval()))[0]
            axis.set_major_locator(LogLocator(subs=(1, 2, 5) if decades < 3 else (1,)))
            axis.set_minor_locator(NullLocator())
            axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
        _label_axes(panel, "frequency [Hz]", label)
    return figure


def _line(panel: Axes, order: int, x: np.ndarray, y: np.ndarray) -> None:
    """One configuration's line; where it hides an equal one it is dashed, so that both are seen."""
    style: Any = _line_style(order)
    hidden = sum(_look_alike(line.get_xydata(), x, y) for line in panel.lines)
    if hidden:
        dash = 6 / 2 ** (min(hidden, 3) - 1)
        style = (0, (dash, 12 - dash))
    panel.plot(x, y, color=colour(order), linestyle=style, linewidth=1.5)


def _look_alike(line: Any, x: np.ndarray, y: np.ndarray) -> bool:
    """Whether a line already drawn, (n, 2), lies where ``(x, y)`` would: within the width of a line."""
    if line.shape != (len(x), 2) or not np.array_equal(line[:, 0], x):
        return False
    difference, seen = np.abs(line[:, 1] - y), np.isfinite(y)
    return bool(difference[seen].max() <= 0.004 * np.ptp(y[seen]) or difference[seen].max() == 0)


def _line_style(order: int) -> Any:
    return LINE_STYLES[order // len(COLOURS) % len(LINE_STYLES)]


def _label_axes(panel: Axes, x: str, y: str) -> None:
    panel.set_xlabel(x)
    panel.set_ylabel(y)


def _quantity_label(quantity: str) -> str:
    unit = shown(QUANTITIES[quantity][0]).unit
    return f"{quantity.replace('_', ' ')} [{unit}]"


def _label(text: str) -> str:
    """A user's text as a plot can show it: one line, not too long, nothing that XML forbids."""
    plain = "".join(each if each.isprintable() else " " for each in text) or "–"
    return plain if len(plain) <= 48 else plain[:47] + "…"


def _station_name(station: str) -> str:
    return STATIONS.get(station, station)


def _stations(configurations: Sequence[Configuration], quantity: str) -> list[str]:
    """Stations at which any configuration recorded the quantity."""
    return list(dict.fromkeys(station for each in configurations for station in each.run.stations(quantity)))


def _thinned(time: np.ndarray, values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """A line that looks the same with fewer points: the extremes of each bin, in their order."""
    size = len(values) // _POINTS
    if size < 2:
        return time, values
    whole = len(values) // size * size
    bins = values[:whole].reshape(-1, size)
    extremes = np.sort(np.column_stack([bins.argmin(axis=1), bins.argmax(axis=1)]), axis=1) + np.arange(0, whole, size)[:, None]
    keep = np.unique(np.concatenate([[0], extremes.ravel(), [len(values) - 1]]))
    return time[keep], values[keep]


def _spans(time: np.ndarray, where: np.ndarray) -> Iterator[tuple[float, float]]:
    """First and last time of every stretch in which `where` holds."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], where, [False]]).astype(int)))
    for begin, end in zip(edges[::2], edges[1::2], strict=True):
        yield float(time[begin]), float(time[end - 1])
