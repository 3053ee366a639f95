"""Plots of the way over the ground, with what stands or lies there, and of the accelerations."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from susp_mj.features import Circle, Cones, Course, Gust, Patch, features_in
from susp_mj.run import Run

from ..colours import INK, MUTED, PAPER
from ..numbers.course import corners, has_cones
from ..numbers.runs import facts, is_a
from .figure import colour, draw_line, draw_svg, label_axes, make_panels, thinned_way

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from ..compare import Configuration

_ACCELERATIONS = ("lateral_acceleration", "longitudinal_acceleration")
_WIDE = (8.8, 2.6)
_ROUND = (4.4, 4.4)


def course_plots(configurations: Sequence[Configuration]) -> dict[str, str]:
    """Way over the ground, as SVG text by name; empty for manoeuvres that say nothing by it."""
    drawn = is_a(configurations[0].run, "course")
    return {"course_handling": draw_svg(_ground_figure, configurations)} if drawn else {}


def acceleration_plots(configurations: Sequence[Configuration]) -> dict[str, str]:
    """Longitudinal over lateral acceleration, as SVG text by name; empty unless a car has both."""
    run = configurations[0].run
    drawn = is_a(run, "course") and not is_a(run, "tightened") and any(_has_both(each.run) for each in configurations)
    return {"accelerations_handling": draw_svg(_accelerations_figure, configurations)} if drawn else {}


def _ground_figure(configurations: Sequence[Configuration]) -> Figure:
    """Way of the centre of gravity over the ground, with what stands or lies there."""
    turns = is_a(configurations[0].run, "turn")
    figure, (panel,) = make_panels([each.name for each in configurations], [""], size=_ROUND if turns else _WIDE)
    _draw_features(panel, configurations[0].run)
    for order, each in enumerate(configurations):
        run = each.run
        slippery = any(isinstance(feature, Patch) for feature in features_in(run.meta))
        beside = corners(run).values() if has_cones(run) else _front_wheels(run) if slippery else ()
        for x, y in beside:
            panel.plot(*thinned_way(x, y), color=colour(order), linewidth=0.6, alpha=0.55)
        draw_line(panel, order, *thinned_way(run["position_x"], run["position_y"]))
    if turns:
        panel.set_aspect("equal", adjustable="datalim")
    else:
        low, high = panel.get_ylim()
        panel.set_ylim(min(low, -1.0), max(high, 1.0))
    label_axes(panel, "x [m]", "y, to the left [m]")
    return figure


def _front_wheels(run: Run) -> list[tuple[np.ndarray, np.ndarray]]:
    """Ways of both front wheels over the ground [m]."""
    track, ahead, yaw = facts(run).get("track_front"), facts(run).get("cg_x"), run["yaw_angle"]
    if track is None or ahead is None:
        return []
    x, y = run["position_x"] - ahead * np.cos(yaw), run["position_y"] - ahead * np.sin(yaw)
    return [(x - across * np.sin(yaw), y + across * np.cos(yaw)) for across in (track / 2, -track / 2)]


def _draw_features(panel: Axes, run: Run) -> None:
    """Cones, slippery ground, gusts and the driver's path."""
    for feature in features_in(run.meta):
        match feature:
            case Cones():
                x, y = np.array(feature.points).T
                panel.plot(x, y, "o", color=PAPER, markersize=4.5, markeredgecolor=INK, markeredgewidth=1.0)
            case Course():
                _draw_path(panel, np.array(feature.x), np.array(feature.y))
            case Circle():
                angle, radius = np.linspace(0.0, 2 * np.pi, 200), feature.radius
                _draw_path(panel, abs(radius) * np.sin(angle), radius * (1 - np.cos(angle)))
            case Patch():
                _box(panel, feature.x, feature.y, f"friction x {feature.friction:g}", run)
            case Gust():
                _box(panel, feature.x, None, f"wind {feature.wind:g} m/s", run)
            case _:
                pass  # the road's own shape


def _draw_path(panel: Axes, x: np.ndarray, y: np.ndarray) -> None:
    """The path that the driver is to follow, dashed."""
    panel.plot(x, y, color=MUTED, linewidth=0.9, linestyle=(0, (5, 3)))


def _box(panel: Axes, x: Sequence[float], y: Sequence[float] | None, words: str, run: Run) -> None:
    """A shaded part of the road with its name, as far as the car gets."""
    end = min(x[1], float(run["position_x"].max()))
    if y is None:
        panel.axvspan(x[0], end, color=MUTED, alpha=0.16, linewidth=0)
    else:
        low, high = (max(y[0], -4.0), min(y[1], 4.0))
        panel.fill_between([x[0], end], low, high, color=MUTED, alpha=0.16, linewidth=0)
    at = 0.96 if y is None or y[1] > 0 else 0.04
    panel.annotate(
        words,
        (x[0], at),
        xycoords=("data", "axes fraction"),
        xytext=(4, 0),
        textcoords="offset points",
        va="top" if at > 0.5 else "bottom",
        fontsize=7.5,
        color=MUTED,
    )


def _has_both(run: Run) -> bool:
    return min(np.ptp(run[name]) for name in _ACCELERATIONS) > 1.0


def _accelerations_figure(configurations: Sequence[Configuration]) -> Figure:
    """Longitudinal over lateral acceleration (g-g diagram)."""
    figure, (panel,) = make_panels([each.name for each in configurations], [""], size=_ROUND)
    for order, each in enumerate(configurations):
        draw_line(panel, order, *thinned_way(each.run["lateral_acceleration"], each.run["longitudinal_acceleration"]))
    for line in (panel.axhline, panel.axvline):
        line(0, color=MUTED, linewidth=0.6, zorder=1.5)
    panel.set_aspect("equal", adjustable="datalim")
    panel.margins(0.07)
    label_axes(panel, "lateral acceleration, to the left [m/s²]", "longitudinal acceleration [m/s²]")
    return figure
