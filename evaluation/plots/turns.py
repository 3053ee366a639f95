"""Plots of slowly tightened turns over lateral acceleration: roll, wheel lift, self-steering, wheel travel."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from susp_mj.names import CORNERS
from susp_mj.run import Run

from ..colours import INK, LIFTED, MUTED
from ..numbers.runs import facts, known
from ..numbers.turns import inner, tightening
from ..numbers.wheel_lift import lifts
from .channels import STATIONS
from .figure import colour, draw_line, draw_svg, label_axes, make_panels, stop_lines

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from ..compare import Configuration

ACCELERATION = "lateral acceleration [m/s²]"
"""Name of the axis."""


def turn_plots(configurations: Sequence[Configuration]) -> dict[str, str]:
    """Wheel lift, self-steering and wheel travel of slowly tightened turns, as SVG text by name."""
    figures = {
        "wheel_lift_handling": _lift_figure,
        "self_steering_handling": _self_steering_figure,
        "wheel_travel_handling": _travel_figure,
    }
    return {name: draw_svg(figure, configurations) for name, figure in figures.items()}


def _lift_figure(configurations: Sequence[Configuration]) -> Figure:
    """Roll and the loads of the inner wheels over lateral acceleration; a wheel that lifts is marked."""
    inside = inner(configurations[0].run)
    figure, (roll, *loads) = make_panels(
        [each.name for each in configurations],
        ["roll out of the turn", *(f"{STATIONS[each]}, inner wheel" for each in inside)],
    )
    for order, each in enumerate(configurations):
        run, turning = each.run, tightening(each.run)
        angle = turning.side * np.degrees(run["roll_angle"] - run["roll_angle"][0])
        draw_line(roll, order, *over_acceleration(turning.acceleration, turning.part(angle)))
        for panel, station in zip(loads, inner(run), strict=True):
            load = run[f"{station}_wheel_load"] * 1e-3
            draw_line(panel, order, *over_acceleration(turning.acceleration, turning.part(load)))
    lifted = mark_lifts(list(enumerate(each.run for each in configurations)), loads)
    label_axes(roll, ACCELERATION, "roll angle [°]")
    highest = max(panel.get_ylim()[1] for panel in loads)
    for panel in loads:
        panel.axhline(0, color=INK, linewidth=0.9)
        panel.set_ylim(-(0.14 + 0.06 * len(configurations) if lifted else 0.04) * highest, highest)
        label_axes(panel, ACCELERATION, "wheel load [kN]")
    from_zero(roll, *loads)
    return figure


def mark_lifts(runs: Sequence[tuple[int, Run]], panels: Sequence[Axes]) -> bool:
    """A ring where an inner wheel leaves the road on its line, with the lateral acceleration below it; whether any
    does.

    Args:
        runs: with the place of each in the order of colours.
        panels: of the inner front and rear wheel.
    """
    found = False
    for row, panel in enumerate(panels):
        height, right = 0, panel.dataLim.x1
        for order, run in runs:
            station, turning = inner(run)[row], tightening(run)
            for lift in lifts(run):
                if lift.station != station or lift.at >= len(turning.acceleration):
                    continue
                outside = lift.acceleration > 0.8 * right
                panel.plot(
                    [lift.acceleration],
                    [0],
                    "o",
                    color=colour(order),
                    markersize=7,
                    markeredgecolor=LIFTED,
                    markeredgewidth=1.6,
                )
                panel.annotate(
                    f"lifts at {lift.acceleration:.1f}",
                    (lift.acceleration, 0),
                    xytext=(6 if outside else 0, -8 - 9 * height),
                    textcoords="offset points",
                    ha="right" if outside else "center",
                    va="top",
                    fontsize=7.5,
                    color=colour(order),
                )
                height, found = height + 1, True
    return found


def _self_steering_figure(configurations: Sequence[Configuration]) -> Figure:
    """Steering wheel angle and side slip over lateral acceleration, beside the angle of slip-free geometry."""
    figure, (steering, slip) = make_panels(
        [each.name for each in configurations],
        ["steering wheel angle; dotted: without slip", "side slip at the rear axle"],
    )
    highest = 0.0
    for order, each in enumerate(configurations):
        run, turning = each.run, tightening(each.run)
        angle = turning.side * np.degrees(run["steering_wheel_angle"] - run["steering_wheel_angle"][0])
        highest = max(highest, float(turning.part(angle).max()))
        draw_line(steering, order, *over_acceleration(turning.acceleration, turning.part(angle)))
        if run in known("wheelbase", "steering_ratio"):
            speed = np.maximum(turning.part(run["speed"]), 0.1)
            wheelbase, ratio = facts(run)["wheelbase"], facts(run)["steering_ratio"]
            geometry = np.degrees(ratio * wheelbase * turning.acceleration / speed**2)
            steering.plot(
                *over_acceleration(turning.acceleration, geometry), color=colour(order), linestyle=":", linewidth=1.2
            )
        behind = turning.side * np.degrees(run["rear_side_slip_angle"])
        draw_line(slip, order, *over_acceleration(turning.acceleration, turning.part(behind)))
    if highest > 0.0:  # a car that spins slows down so much that the angle without slip leaves the picture
        steering.set_ylim(top=min(steering.get_ylim()[1], 1.5 * highest))
    label_axes(steering, ACCELERATION, "steering wheel angle [°]")
    label_axes(slip, ACCELERATION, "side slip angle [°]")
    from_zero(steering, slip)
    return figure


def _travel_figure(configurations: Sequence[Configuration]) -> Figure:
    """Wheel travel over lateral acceleration, with the stops."""
    inside = inner(configurations[0].run)
    titles = [f"{STATIONS[each]}, {'inner' if each in inside else 'outer'} wheel" for each in CORNERS]
    figure, panels = make_panels([each.name for each in configurations], titles, share_y=True)
    for panel, station in zip(panels, CORNERS, strict=True):
        for order, each in enumerate(configurations):
            turning = tightening(each.run)
            travel = turning.part(each.run[f"{station}_suspension_deflection"]) * 1e3
            draw_line(panel, order, *over_acceleration(turning.acceleration, travel))
        stops = {tuple(each.run.meta["travel"][station]) for each in configurations}
        for order, (rebound, compression) in enumerate(sorted(stops)):
            stop_lines(panel, rebound * 1e3, compression * 1e3, horizontal=True, named=order == 0)
        panel.axhline(0, color=MUTED, linewidth=0.6, zorder=1.5)
        label_axes(panel, ACCELERATION, "suspension deflection [mm]")
    from_zero(*panels)
    return figure


def over_acceleration(acceleration: np.ndarray, values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """A line over lateral acceleration with few points, at which the acceleration has got further than ever."""
    ahead = np.maximum.accumulate(acceleration)
    grid = np.linspace(0.0, float(ahead[-1]), 400)
    first = np.unique(np.searchsorted(ahead, grid).clip(0, len(values) - 1))
    return acceleration[first], values[first]


def from_zero(*panels: Axes) -> None:
    """Let the horizontal axes begin at zero."""
    for panel in panels:
        panel.set_xlim(0, 1.03 * panel.dataLim.x1)
