"""Plots of a design cycle: characteristics of the candidates with the static points of all loads, and trade-offs."""

from __future__ import annotations

import textwrap
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from ..characteristics import Characteristic
from ..colours import MUTED, PAPER
from ..display import quantity_text, shown
from ..story import Story, TradeOff
from .candidates import Cast, Plot, with_curves
from .figure import colour, draw_svg, label_axes, name_line, short_label, stop_lines

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_MARKERS = "osD^vP*X"
_ALIKE = 0.01
"""Static forces of two loads that differ by less than this share of their size have one label."""
_MARGIN = 0.06
_SQUARE = (4.05, 2.9)
_NOTE: dict[str, Any] = {"fontsize": 7.5, "color": MUTED}

Static = Mapping[str, float]
"""Load -> static force on one wheel's spring [N]."""
DrawOne = Callable[["Axes", Cast, str, Characteristic, Static], None]


def characteristic_plots(story: Story, cast: Cast) -> Iterator[Plot]:
    """Force of springs and dampers at the wheel, and at the component where its motion ratio is known."""
    curves = {name: story.curves[name] for name in with_curves(story)}
    titles = list(dict.fromkeys(each.title for of_one in curves.values() for each in of_one))
    for title, note, part, draw_one in _CHARACTERISTICS:
        known = {
            name: [each for each in of_one if part is None or getattr(each, part) is not None]
            for name, of_one in curves.items()
        }
        known = {name: of_one for name, of_one in known.items() if of_one}
        there = [each for each in titles if any(each == one.title for of_one in known.values() for one in of_one)]
        if there:
            svg = draw_svg(_characteristic_figure, story, cast, known, there, draw_one)
            yield Plot(title, f"{note}; candidates {', '.join(known)}", svg)


def _characteristic_figure(
    story: Story,
    cast: Cast,
    curves: Mapping[str, Sequence[Characteristic]],
    titles: Sequence[str],
    draw_one: DrawOne,
) -> Figure:
    """One panel for each axle, all candidates in it."""
    figure, panels = cast.panels(list(curves), titles)
    for panel, title in zip(panels, titles, strict=True):
        static = {
            load: forces[axle] for load, forces in story.static.items() for axle in forces if title == f"{axle} axle"
        }
        for name in cast.kept_first(curves):
            for each in curves[name]:
                if each.title == title:
                    draw_one(panel, cast, name, each, static)
    return figure


def _spring(panel: Axes, cast: Cast, name: str, each: Characteristic, static: Static) -> None:
    """Force at the wheel over the travel, with a level for each load's static force."""
    deflection, force = np.asarray(each.deflection) * 1e3, np.asarray(each.spring_force) * 1e-3
    inside = np.isfinite(each.spring_rate)
    first = not panel.lines
    cast.line(panel, name, deflection, force)
    if first:
        stop_lines(panel, each.stops[0] * 1e3, each.stops[1] * 1e3, horizontal=False, named=False)
        panel.set_xlim(deflection[0], deflection[-1])
        label_axes(panel, "suspension deflection [mm]", "spring force at the wheel [kN]")
        for place, (loads, level) in enumerate(_levels(static)):
            panel.axhline(level * 1e-3, color=MUTED, linewidth=0.6, linestyle=":", zorder=1.5)
            name_line(
                panel, level * 1e-3, f"{loads} {quantity_text(level, 'N')}    ", MUTED, "bottom" if place else "top"
            )
    for place, level in enumerate(static.values()):
        at = float(np.interp(level * 1e-3, force[inside], deflection[inside]))
        _point(panel, cast, name, place, (at, level * 1e-3))
    shown_force = force[inside]
    low, high = (0.0, 0.0) if first else panel.get_ylim()
    panel.set_ylim(min(low, float(shown_force.min())), max(high, float(shown_force.max()) * (1 + _MARGIN)))


def _component_spring(panel: Axes, cast: Cast, name: str, each: Characteristic, static: Static) -> None:
    """Force of the spring itself over its own travel, with the static points of all loads."""
    spring = each.component_spring
    assert spring is not None
    travel, force = np.asarray(spring.travel) * 1e3, np.asarray(spring.force) * 1e-3
    at_wheel = np.asarray(each.spring_force)[np.isfinite(each.spring_rate)]
    first = not panel.lines
    cast.line(panel, name, travel, force)

    def at(level: float) -> tuple[float, float]:
        return float(np.interp(level, at_wheel, travel)), float(np.interp(level, at_wheel, force))

    for place, level in enumerate(static.values()):
        _point(panel, cast, name, place, at(level))
    for loads, level in _levels(static) if first else ():
        panel.annotate(loads, at(level), xytext=(-6, 6), textcoords="offset points", ha="right", **_NOTE)
    label_axes(panel, "spring travel [mm]", "force of the spring itself [kN]")


def _damper(panel: Axes, cast: Cast, name: str, each: Characteristic, static: Static) -> None:
    cast.line(panel, name, np.asarray(each.speed), np.asarray(each.damper_force) * 1e-3)
    _axes_through_zero(panel)
    label_axes(panel, "speed, compression positive [m/s]", "damper force at the wheel [kN]")


def _component_damper(panel: Axes, cast: Cast, name: str, each: Characteristic, static: Static) -> None:
    damper = each.component_damper
    assert damper is not None
    cast.line(panel, name, np.asarray(damper.speed), np.asarray(damper.force) * 1e-3)
    _axes_through_zero(panel)
    label_axes(panel, "damper speed, compression positive [m/s]", "force of the damper itself [kN]")


_CHARACTERISTICS: tuple[tuple[str, str, str | None, DrawOne], ...] = (
    (
        "Spring force at the wheel",
        "dashed lines are the stops, dotted ones the static force of each load, marked where a spring carries it",
        None,
        _spring,
    ),
    ("Damper force at the wheel", "hydraulic force, without mount and friction", None, _damper),
    (
        "Force of the spring itself",
        "over its own travel between the stops; marked where it carries each load",
        "component_spring",
        _component_spring,
    ),
    (
        "Force of the damper itself",
        "over its own speed, the wheel in the design position",
        "component_damper",
        _component_damper,
    ),
)


def _levels(static: Static) -> Iterator[tuple[str, float]]:
    """Static forces [N] with the names of their loads; loads of almost the same force share one."""
    levels: list[tuple[list[str], float]] = []
    for load, force in sorted(static.items(), key=lambda item: item[1]):
        if levels and force - levels[-1][1] <= _ALIKE * abs(force):
            levels[-1][0].append(load)
        else:
            levels.append(([load], force))
    for loads, force in levels:
        yield ", ".join(loads), force


def _point(panel: Axes, cast: Cast, name: str, place: int, at: tuple[float, float]) -> None:
    """A static point, the marker telling the load."""
    panel.plot(
        [at[0]],
        [at[1]],
        _MARKERS[place % len(_MARKERS)],
        color=colour(cast.order(name)),
        markersize=7.5 if name == cast.kept else 4.0,
        markeredgecolor=PAPER,
        markeredgewidth=0.8,
    )


def _axes_through_zero(panel: Axes) -> None:
    if len(panel.lines) == 1:
        panel.axhline(0, color=MUTED, linewidth=0.6, zorder=1.5)
        panel.axvline(0, color=MUTED, linewidth=0.6, zorder=1.5)


def trade_off_plots(story: Story, cast: Cast) -> Iterator[Plot]:
    """Responses of the kept candidate over the compression to rebound ratio, and the first two over each other."""
    known = [each for each in story.trade_offs if any(value is not None for value in each.values)]
    if not known or not cast.kept:
        return
    yield Plot(
        "Responses over the compression to rebound ratio",
        f"candidate {cast.kept} with other dampers; a ring marks its own ratio",
        draw_svg(_trade_off_figure, story, cast, known),
    )
    if len(known) > 1 and len(_pairs(known[0], known[1])) > 1:
        yield Plot(
            "The first two responses over each other",
            f"candidate {cast.kept}; the labels are compression to rebound, a ring marks its own ratio",
            draw_svg(_conflict_figure, story, cast, known[0], known[1]),
        )


def _own_ratios(story: Story) -> set[str]:
    """Ratio that every damper of the kept candidate has; empty if they differ."""
    values = {} if story.kept is None else story.kept.values
    own = {str(value) for name, (value, _) in values.items() if name.endswith("ratio")}
    return own if len(own) == 1 else set()


def _trade_off_figure(story: Story, cast: Cast, trade_offs: Sequence[TradeOff]) -> Figure:
    """One panel for each response."""
    figure, panels = cast.panels([cast.kept], [each.title for each in trade_offs])
    own, ink = _own_ratios(story), colour(cast.order(cast.kept))
    for panel, each in zip(panels, trade_offs, strict=True):
        how = shown(each.unit)
        values = [np.nan if value is None else value * how.factor for value in each.values]
        places = range(len(each.ratios))
        panel.plot(places, values, "o-", color=ink, linewidth=1.5, markersize=5)
        for place in places:
            if each.ratios[place] in own:
                _ring(panel, place, values[place], ink)
        panel.set_xticks(list(places), [short_label(ratio) for ratio in each.ratios])
        panel.set_xlim(-0.4, len(each.ratios) - 0.6)
        low, high = np.nanmin(values), np.nanmax(values)
        room = max(0.15 * (high - low), 0.05 * max(abs(low), abs(high)), 1e-9)
        panel.set_ylim(low - room, high + room)
        label_axes(panel, "compression : rebound", how.unit)
    return figure


def _conflict_figure(story: Story, cast: Cast, across: TradeOff, up: TradeOff) -> Figure:
    """One response over the other, a point for each ratio."""
    from matplotlib.ticker import MaxNLocator

    figure, (panel,) = cast.panels([cast.kept], [""], size=_SQUARE)
    own, ink = _own_ratios(story), colour(cast.order(cast.kept))
    points = _pairs(across, up)
    rising = (points[-1][1] - points[0][1]) * (points[-1][2] - points[0][2]) > 0
    panel.plot([x for _, x, _ in points], [y for _, _, y in points], "o-", color=ink, linewidth=1.5, markersize=5)
    for ratio, x, y in points:
        if ratio in own:
            _ring(panel, x, y, ink)
        panel.annotate(
            short_label(ratio), (x, y), xytext=(8, -10 if rising else 4), textcoords="offset points", fontsize=8
        )
    panel.margins(x=0.14, y=0.15)
    panel.xaxis.set_major_locator(MaxNLocator(nbins=4))
    label_axes(panel, _axis(across), _axis(up))
    return figure


def _pairs(across: TradeOff, up: TradeOff) -> list[tuple[str, float, float]]:
    """Ratios at which both responses have a value, with the two in the units shown."""
    if across.ratios != up.ratios:
        return []
    return [
        (ratio, x * shown(across.unit).factor, y * shown(up.unit).factor)
        for ratio, x, y in zip(across.ratios, across.values, up.values, strict=True)
        if x is not None and y is not None
    ]


def _axis(trade_off: TradeOff) -> str:
    return textwrap.fill(f"{short_label(trade_off.title)} [{shown(trade_off.unit).unit or '–'}]", 36)


def _ring(panel: Axes, x: float, y: float, ink: str) -> None:
    panel.plot([x], [y], "o", color="none", markeredgecolor=ink, markeredgewidth=1.4, markersize=11)
