"""Plots as SVG text: all configurations on one axis, each in its fixed colour, in engineers' units.

matplotlib is imported when the first plot is drawn. The same input gives the same bytes.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from susp_mj.files import write_text
from susp_mj.names import QUANTITIES, channel_name

from .colours import COLOURS, LIFTED
from .display import shown
from .figures import (
    GRID,
    INK,
    MUTED,
    PAPER,
    colour,
    draw_line,
    draw_svg,
    label_axes,
    make_panels,
    spans,
    stop_lines,
    thinned,
)
from .frequency import amplification
from .handling_plots import handling_plots, shown_together
from .ride import CONTACT_LOST, INPUTS
from .tyre_plots import tyre_plots

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
SWEEP_QUANTITIES = (
    "body_displacement",
    "body_acceleration",
    "pitch_angle",
    "roll_angle",
    "suspension_deflection",
    "wheel_load",
)
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

HANDLING = "handling"
"""The model that rolls on tyres with slip."""
_LIGHT = {"ink": INK, "muted": MUTED, "grid": GRID, "paper": PAPER, "lifted": LIFTED}
_DARK = {"ink": "#dfe4ea", "muted": "#8d96a1", "grid": "#333a43", "paper": "#1b2026", "lifted": "#ff6b70"}
_QUIET = {"rad": 1e-4, "m": 1e-4, "m/s": 1e-3, "m/s²": 0.05}
"""Range [SI unit] of a quantity of a handling car below which it is not drawn over time."""
_LEAST_FREQUENCY_SPAN = 0.6
"""The natural frequency axis covers at least this [Hz]: a constant one shall look constant."""


def draw(comparison: Comparison) -> dict[str, str]:
    """Every plot of a comparison as SVG text, by name: handling, amplification of sweeps, over time, characteristics.

    Those of the tyres with slip are drawn for the model that rolls on them.
    """
    sets = {each.name: each.characteristics for each in comparison.configurations}
    rolling = any(each.run.meta.get("model") == HANDLING for each in comparison.configurations)
    return {
        **handling_plots(comparison),
        **amplification_plots(comparison),
        **time_plots(comparison),
        **characteristic_plots(sets),
        **(tyre_plots(sets) if rolling else {}),
    }


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
    together = shown_together(configurations)
    for quantity in TIME_QUANTITIES:
        stations = _stations(configurations, quantity)
        if stations and quantity not in together and not _is_quiet(configurations, quantity):
            plots[quantity] = draw_svg(_time_figure, configurations, [(quantity, station) for station in stations])
    forces = [(quantity, station) for quantity in ELEMENT_FORCES for station in _acting(configurations, quantity)]
    if forces:
        plots["element_forces"] = draw_svg(_time_figure, configurations, forces)
    return plots


def _is_quiet(configurations: Sequence[Configuration], quantity: str) -> bool:
    """Whether a quantity is not worth a plot: an input that is not used, or anything that a handling car hardly
    moves."""
    if any(each.run.meta.get("model") != HANDLING for each in configurations):
        return quantity in INPUTS and _stands_still(configurations, quantity)
    least = _QUIET.get(QUANTITIES[quantity][0], 0.0)
    return all(np.ptp(values) <= least for each in configurations for values in each.run.stations(quantity).values())


def _stands_still(configurations: Sequence[Configuration], quantity: str) -> bool:
    """Whether an input is not used in any configuration."""
    return all(np.ptp(values) < 1e-12 for each in configurations for values in each.run.stations(quantity).values())


def _acting(configurations: Sequence[Configuration], quantity: str) -> list[str]:
    """Stations of an element force, if it is ever more than zero; friction of several wheels is left out."""
    stations = _stations(configurations, quantity)
    if quantity == "friction_force" and len(stations) > 1:
        return []
    return (
        stations
        if any(np.any(values) for each in configurations for values in each.run.stations(quantity).values())
        else []
    )


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


def amplification_plots(comparison: Comparison) -> dict[str, str]:
    """Amplification over frequency for each quantity; empty unless the manoeuvre was a sine sweep of the road."""
    configurations = comparison.configurations
    if not any("excitation_phase" in each.run and not _stands_still([each], "road_height") for each in configurations):
        return {}
    return {
        f"{quantity}_amplification": draw_svg(_amplification_figure, configurations, quantity, stations)
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
    rules = [
        ":root{" + ";".join(f"--{name}:{value}" for name, value in scheme.items()) + "}" for scheme in (light, dark)
    ]
    style = f"<style>{rules[0]}@media (prefers-color-scheme:dark){{{rules[1]}}}</style>"
    return re.sub(r"(<svg[^>]*>)", lambda found: found[1] + style, svg, count=1)


def on_dark(colour: str) -> str:
    """A line colour made lighter for a dark ground."""
    parts = [int(colour[i : i + 2], 16) for i in (1, 3, 5)]
    return "#" + "".join(f"{round(part + 0.42 * (255 - part)):02x}" for part in parts)


def _time_figure(configurations: Sequence[Configuration], panels: Sequence[tuple[str, str]]) -> Figure:
    """Time histories; `panels` are pairs of quantity and station."""
    same = len({quantity for quantity, _ in panels}) == 1
    figure, axes = make_panels(
        [each.name for each in configurations], [_station_name(station) for _, station in panels], share_y=same
    )
    for panel, (quantity, station) in zip(axes, panels, strict=True):
        how = shown(QUANTITIES[quantity][0])
        for order, each in enumerate(configurations):
            values = each.run.stations(quantity).get(station)
            if values is not None:
                draw_line(panel, order, *thinned(each.run.time, values * how.factor))
        label_axes(panel, "time [s]", _quantity_label(quantity))
        panel.set_xlim(0, max(float(each.run.time[-1]) for each in configurations))
        _mark_time(panel, configurations, quantity, station)
    return figure


def _mark_time(panel: Axes, configurations: Sequence[Configuration], quantity: str, station: str) -> None:
    """Zero line, stops and lost contact, where the quantity has them."""
    if quantity == "wheel_load":
        panel.axhline(0, color=INK, linewidth=0.9)
        for order, each in enumerate(configurations):
            load = each.run.stations(quantity).get(station)
            for begin, end in spans(each.run.time, load <= CONTACT_LOST) if load is not None else ():
                panel.axvspan(begin, end, color=colour(order), alpha=0.25, linewidth=1)
    elif quantity == "suspension_deflection":
        stops = {
            tuple(travel[station]) for each in configurations if station in (travel := each.run.meta.get("travel", {}))
        }
        for order, (rebound, compression) in enumerate(sorted(stops)):
            stop_lines(panel, rebound * 1e3, compression * 1e3, horizontal=True, named=order == 0)
    low, high = panel.get_ylim()
    if quantity != "wheel_load" and low < 0 < high:
        panel.axhline(0, color=MUTED, linewidth=0.6, zorder=1.5)


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


def _amplification_figure(configurations: Sequence[Configuration], quantity: str, stations: Sequence[str]) -> Figure:
    from matplotlib.ticker import FuncFormatter, LogLocator, NullLocator

    figure, axes = make_panels(
        [each.name for each in configurations], [_station_name(each) for each in stations], share_y=True
    )
    unit = QUANTITIES[quantity][0]
    shown_as = {"m": ("", 1.0), "m/s²": ("1/s²", 1.0), "N": ("kN/m", 1e-3), "rad": ("°/m", 180 / np.pi)}
    ratio_unit, factor = shown_as.get(unit, (f"({unit})/m", 1.0))
    label = quantity.replace("_", " ") + " / road height" + (f" [{ratio_unit}]" if ratio_unit else " [–]")
    for panel, station in zip(axes, stations, strict=True):
        for order, each in enumerate(configurations):
            name = channel_name(station, quantity)
            found = amplification(each.run, name, station) if name in each.run else None
            if found is not None:
                draw_line(panel, order, found.frequency, np.abs(found.ratio) * factor)
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
        label_axes(panel, "frequency [Hz]", label)
    return figure


def _quantity_label(quantity: str) -> str:
    unit = shown(QUANTITIES[quantity][0]).unit
    return f"{quantity.replace('_', ' ')} [{unit}]"


def _station_name(station: str) -> str:
    return STATIONS.get(station, station)


def _stations(configurations: Sequence[Configuration], quantity: str) -> list[str]:
    """Stations at which any configuration recorded the quantity."""
    return list(dict.fromkeys(station for each in configurations for station in each.run.stations(quantity)))
