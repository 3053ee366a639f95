"""Plots over time: one for each quantity, and what a manoeuvre of a freely driving car shows together."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from susp_mj.names import QUANTITIES
from susp_mj.run import Run

from ..colours import INK, MUTED
from ..display import Shown, shown
from ..numbers.ride import CONTACT_LOST, INPUTS
from ..numbers.runs import character, drives, is_a, on_tyres
from ..numbers.turns import stations_of
from .channels import quantity_label, stands_still, station_name, stations_with
from .figure import colour, draw_line, draw_svg, label_axes, make_panels, spans, stop_lines, thinned, zero_line

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from ..compare import Comparison, Configuration

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
_QUIET = {"rad": 1e-4, "m": 1e-4, "m/s": 1e-3, "m/s²": 0.05}
"""Range [SI unit] of a quantity of a handling car below which it is not drawn over time."""
_SHOWN = {
    "speed": Shown("km/h", 3.6),
    "path_deviation": Shown("m"),
    "engine_speed": Shown("1/min", 30 / np.pi),
    "gear": Shown(""),
}
_STANDSTILL = 2.0  # m/s
_FROM_START = ("body_displacement", "yaw_angle")


def time_plots(comparison: Comparison) -> dict[str, str]:
    """One plot over time for each quantity that was recorded; several stations become panels."""
    configurations = comparison.configurations
    plots: dict[str, str] = {}
    together = shown_together(configurations)
    for quantity in TIME_QUANTITIES:
        stations = stations_with(configurations, quantity)
        if stations and quantity not in together and not _is_quiet(configurations, quantity):
            plots[quantity] = draw_svg(_time_figure, configurations, [(quantity, station) for station in stations])
    forces = [(quantity, station) for quantity in ELEMENT_FORCES for station in _acting(configurations, quantity)]
    if forces:
        plots["element_forces"] = draw_svg(_time_figure, configurations, forces)
    return plots


def _is_quiet(configurations: Sequence[Configuration], quantity: str) -> bool:
    """Whether a quantity is not worth a plot: an input that is not used, or anything that a handling car hardly
    moves."""
    if not all(on_tyres(each.run) for each in configurations):
        return quantity in INPUTS and stands_still(configurations, quantity)
    least = _QUIET.get(QUANTITIES[quantity][0], 0.0)
    return all(np.ptp(values) <= least for each in configurations for values in each.run.stations(quantity).values())


def _acting(configurations: Sequence[Configuration], quantity: str) -> list[str]:
    """Stations of an element force, if it is ever more than zero; friction of several wheels is left out."""
    stations = stations_with(configurations, quantity)
    if quantity == "friction_force" and len(stations) > 1:
        return []
    return (
        stations
        if any(np.any(values) for each in configurations for values in each.run.stations(quantity).values())
        else []
    )


def _time_figure(configurations: Sequence[Configuration], panels: Sequence[tuple[str, str]]) -> Figure:
    """Time histories; `panels` are pairs of quantity and station."""
    same = len({quantity for quantity, _ in panels}) == 1
    figure, axes = make_panels(
        [each.name for each in configurations], [station_name(station) for _, station in panels], share_y=same
    )
    for panel, (quantity, station) in zip(axes, panels, strict=True):
        how = shown(QUANTITIES[quantity][0])
        for order, each in enumerate(configurations):
            values = each.run.stations(quantity).get(station)
            if values is not None:
                draw_line(panel, order, *thinned(each.run.time, values * how.factor))
        label_axes(panel, "time [s]", quantity_label(quantity))
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


def shown_together(configurations: Sequence[Configuration]) -> tuple[str, ...]:
    """Quantities over time that one figure of the manoeuvre shows together, of those that move at all."""
    if not configurations or not all(drives(each.run) for each in configurations):
        return ()
    wanted = character(configurations[0].run).together
    return tuple(quantity for quantity in wanted if any(moves(each.run, quantity) for each in configurations))


def together_plots(configurations: Sequence[Configuration]) -> dict[str, str]:
    """What the manoeuvre shows together over time, as SVG text by name."""
    return {"over_time_handling": draw_svg(_together_figure, configurations)} if shown_together(configurations) else {}


def axle_load_plots(configurations: Sequence[Configuration]) -> dict[str, str]:
    """Load of each axle over time, as SVG text by name; empty for manoeuvres that do not move it fore and aft."""
    drawn = is_a(configurations[0].run, "braking", "acceleration")
    return {"axle_loads_handling": draw_svg(_axle_load_figure, configurations)} if drawn else {}


def moves(run: Run, quantity: str) -> bool:
    """Whether a run has a quantity that changes at all."""
    return quantity in run and bool(np.ptp(run[quantity]) > 1e-6)


def _together_figure(configurations: Sequence[Configuration]) -> Figure:
    """The quantities of the manoeuvre over time, one panel each."""
    quantities = shown_together(configurations)
    figure, panels = make_panels([each.name for each in configurations], ["" for _ in quantities])
    for panel, quantity in zip(panels, quantities, strict=True):
        for order, each in enumerate(configurations):
            if quantity in each.run:
                draw_line(panel, order, *together_line(each.run, quantity))
        zero_line(panel)
        panel.set_xlim(0, max(float(each.run.time[-1]) for each in configurations))
        label_axes(panel, "time [s]", together_label(quantity))
    return figure


def together_line(run: Run, quantity: str) -> tuple[np.ndarray, np.ndarray]:
    """Time [s] and values, in the unit shown, of a quantity that a manoeuvre shows together with others."""
    values = run[quantity] - (run[quantity][0] if quantity in _FROM_START else 0.0)
    if quantity.endswith("side_slip_angle"):  # has no meaning at a standstill
        values = np.where(run["speed"] > _STANDSTILL, values, 0.0)
    return thinned(run.time, values * together_unit(quantity).factor)


def together_unit(quantity: str) -> Shown:
    """How `together_line` shows a quantity."""
    return _SHOWN.get(quantity, shown(QUANTITIES[quantity][0]))


def together_label(quantity: str) -> str:
    """Quantity and unit shown, as the axis of `together_line` is named."""
    unit = together_unit(quantity).unit
    words = {"wind_y": "wind across", "body_displacement": "rise of the centre of gravity", "yaw_rate": "yaw velocity"}
    return words.get(quantity, quantity.replace("_", " ")) + (f" [{unit}]" if unit else "")


def _axle_load_figure(configurations: Sequence[Configuration]) -> Figure:
    """Sum of the wheel loads of each axle over time."""
    figure, panels = make_panels([each.name for each in configurations], ["front axle", "rear axle"], share_y=True)
    for panel, axle in zip(panels, ("front", "rear"), strict=True):
        for order, each in enumerate(configurations):
            load = sum(each.run[f"{station}_wheel_load"] for station in stations_of(axle)) * np.float64(1e-3)
            draw_line(panel, order, *thinned(each.run.time, np.asarray(load)))
        label_axes(panel, "time [s]", "axle load [kN]")
    return figure
