"""Plots of the characteristics of springs and dampers, at the wheel and at the components."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np

from ..colours import MUTED, PAPER
from .figure import colour, draw_line, draw_svg, label_axes, make_panels, stop_lines

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from ..characteristics import Characteristic

_LEAST_FREQUENCY_SPAN = 0.6
"""The natural frequency axis covers at least this [Hz]: a constant one shall look constant."""


def characteristic_plots(sets: Mapping[str, Sequence[Characteristic]]) -> dict[str, str]:
    """Spring force and rate over the travel, natural frequency over the load, damper force over speed.

    Where a motion ratio is known, also the forces of spring and damper themselves over their own travel and speed.

    Args:
        sets: characteristics by configuration; those with the same title share a panel.
    """
    titles = list(dict.fromkeys(each.title for characteristics in sets.values() for each in characteristics))
    if not titles:
        return {}
    plots = {
        name: draw_svg(_characteristic_figure, sets, titles, draw_one) for name, draw_one in _CHARACTERISTICS.items()
    }
    for name, (part, draw_one) in _COMPONENTS.items():
        known = {
            key: [each for each in characteristics if getattr(each, part)] for key, characteristics in sets.items()
        }
        there = [title for title in titles if any(each.title == title for each in itertools.chain(*known.values()))]
        if there:
            plots[name] = draw_svg(_characteristic_figure, known, there, draw_one)
    return plots


def _characteristic_figure(
    sets: Mapping[str, Sequence[Characteristic]], titles: Sequence[str], draw_one: Callable[..., None]
) -> Figure:
    """One panel for each title, all sets in it."""
    figure, axes = make_panels(list(sets), titles)
    for panel, title in zip(axes, titles, strict=True):
        stops: set[tuple[float, float]] = set()
        for order, characteristics in enumerate(sets.values()):
            for each in characteristics:
                if each.title == title:
                    draw_one(panel, order, each)
                    stops.add(each.stops)
        if draw_one in (_spring_force, _spring_rate):
            for rebound, compression in sorted(stops):
                stop_lines(panel, rebound * 1e3, compression * 1e3, horizontal=False, named=False)
    return figure


def _spring_force(panel: Axes, order: int, each: Characteristic) -> None:
    rebound, compression = each.stops
    force = np.asarray(each.spring_force) * 1e-3
    inside = force[(each.deflection >= rebound) & (each.deflection <= compression)]
    margin = 0.15 * float(np.ptp(inside))
    low, high = panel.get_ylim() if panel.lines else (np.inf, -np.inf)
    draw_line(panel, order, each.deflection * 1e3, force)
    panel.plot(
        [0], [each.preload * 1e-3], "o", color=colour(order), markersize=5, markeredgecolor=PAPER, markeredgewidth=0.8
    )
    panel.set_ylim(
        min(low, max(float(inside.min()) - margin, min(0.0, float(inside.min())))),
        max(high, float(inside.max()) + margin),
    )
    panel.set_xlim(each.deflection[0] * 1e3, each.deflection[-1] * 1e3)
    label_axes(panel, "suspension deflection [mm]", "spring force at the wheel [kN]")


def _spring_rate(panel: Axes, order: int, each: Characteristic) -> None:
    draw_line(panel, order, each.deflection * 1e3, each.spring_rate * 1e-3)
    panel.set_xlim(each.deflection[0] * 1e3, each.deflection[-1] * 1e3)
    panel.set_ylim(0, 1.08 * panel.dataLim.y1)
    label_axes(panel, "suspension deflection [mm]", "spring rate at the wheel [kN/m]")


def _spring_frequency(panel: Axes, order: int, each: Characteristic) -> None:
    inside = np.isfinite(each.spring_frequency)
    if not inside.any():
        return
    load, frequency = np.asarray(each.spring_force)[inside] * 1e-3, np.asarray(each.spring_frequency)[inside]
    draw_line(panel, order, load, frequency)
    at_preload = float(np.interp(each.preload * 1e-3, load, frequency))
    panel.plot(
        [each.preload * 1e-3],
        [at_preload],
        "o",
        color=colour(order),
        markersize=5,
        markeredgecolor=PAPER,
        markeredgewidth=0.8,
    )
    low, high = panel.dataLim.intervaly
    margin = max(0.07 * (high - low), 0.5 * (_LEAST_FREQUENCY_SPAN - (high - low)))
    panel.set_ylim(max(low - margin, 0), high + margin)
    label_axes(panel, "load carried by the spring [kN]", "natural frequency [Hz]")


def _damper_force(panel: Axes, order: int, each: Characteristic) -> None:
    draw_line(panel, order, each.speed, each.damper_force * 1e-3)
    if order == 0:
        panel.axhline(0, color=MUTED, linewidth=0.6, zorder=1.5)
        panel.axvline(0, color=MUTED, linewidth=0.6, zorder=1.5)
    label_axes(panel, "speed, compression positive [m/s]", "damper force at the wheel [kN]")


def _component_spring(panel: Axes, order: int, each: Characteristic) -> None:
    spring = each.component_spring
    if spring is None:
        return
    travel, force = np.asarray(spring.travel) * 1e3, np.asarray(spring.force) * 1e-3
    draw_line(panel, order, travel, force)
    preload = [each.preload / spring.ratio * 1e-3]
    panel.plot([0], preload, "o", color=colour(order), markersize=5, markeredgecolor=PAPER, markeredgewidth=0.8)
    label_axes(panel, "spring travel [mm]", "force of the spring itself [kN]")


def _component_damper(panel: Axes, order: int, each: Characteristic) -> None:
    damper = each.component_damper
    if damper is None:
        return
    draw_line(panel, order, np.asarray(damper.speed), np.asarray(damper.force) * 1e-3)
    panel.axhline(0, color=MUTED, linewidth=0.6, zorder=1.5)
    panel.axvline(0, color=MUTED, linewidth=0.6, zorder=1.5)
    label_axes(panel, "damper speed, compression positive [m/s]", "force of the damper itself [kN]")


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
