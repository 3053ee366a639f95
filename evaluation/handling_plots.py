"""Plots of a car that drives freely: over lateral acceleration, over time, over frequency, over the ground, and of the
rig."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from susp_mj.names import QUANTITIES
from susp_mj.run import Run

from .colours import LIFTED
from .course import cones, corners
from .display import Shown, shown
from .figures import INK, MUTED, PAPER, colour, draw_line, draw_svg, label_axes, make_panels, stop_lines, thinned
from .handling import RIG, SLOWLY_TIGHTENED, drives, fact, inner, kind, stations_of, tightening
from .steering_frequency import Response, steering_response
from .wheel_lift import lifts

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from .compare import Comparison, Configuration

WORDS = {"fl": "front left", "fr": "front right", "rl": "rear left", "rr": "rear right"}
_TRANSIENT = (
    "steering_wheel_angle",
    "yaw_rate",
    "lateral_acceleration",
    "roll_angle",
    "pitch_angle",
    "body_displacement",
)
_COURSE = (
    "steering_wheel_angle",
    "yaw_rate",
    "lateral_acceleration",
    "side_slip_angle",
    "roll_angle",
    "path_deviation",
)
_PEDALS = ("speed", "longitudinal_acceleration", "pitch_angle", "body_displacement")
TOGETHER: dict[str, tuple[str, ...]] = {
    "ramp_steer": (
        "steering_wheel_angle",
        "speed",
        "yaw_rate",
        "lateral_acceleration",
        "roll_angle",
        "rear_side_slip_angle",
    ),
    "step_steer": _TRANSIENT,
    "sine_steer": _TRANSIENT,
    "swept_steer": ("steering_wheel_angle", "yaw_rate", "lateral_acceleration", "roll_angle"),
    "steady_circle": ("steering_wheel_angle", "speed", "lateral_acceleration", "path_deviation"),
    "lane_change": _COURSE,
    "crosswind": ("wind_y", "yaw_rate", "lateral_acceleration", "roll_angle", "steering_wheel_angle", "path_deviation"),
    "cross_slope": ("yaw_rate", "lateral_acceleration", "steering_wheel_angle", "path_deviation"),
    "acceleration": (*_PEDALS, "engine_speed", "gear"),
    "braking": _PEDALS,
    "braking_in_turn": (
        "speed",
        "longitudinal_acceleration",
        "yaw_rate",
        "lateral_acceleration",
        "rear_side_slip_angle",
        "roll_angle",
    ),
    "split_mu": (
        "speed",
        "longitudinal_acceleration",
        "yaw_rate",
        "yaw_angle",
        "steering_wheel_angle",
        "path_deviation",
    ),
}
"""Manoeuvre -> quantities that are drawn over time in one figure."""
STEERED = ("yaw_rate", "lateral_acceleration", "roll_angle", "side_slip_angle", "rear_side_slip_angle")
"""Quantities whose response to the steering wheel is drawn over frequency."""
GROUND = ("lane_change", "crosswind", "cross_slope", "split_mu", "braking_in_turn", "steady_circle")
"""Manoeuvres whose way over the ground is drawn."""
CIRCLE_OF_FORCES = ("lane_change", "braking_in_turn", "split_mu")
"""Manoeuvres whose longitudinal acceleration is drawn over the lateral one, if both are there."""
LOADED = ("acceleration", "braking", "braking_in_turn", "split_mu")
_SHOWN = {
    "speed": Shown("km/h", 3.6),
    "path_deviation": Shown("m"),
    "engine_speed": Shown("1/min", 30 / np.pi),
    "gear": Shown(""),
}
_STANDSTILL = 2.0  # m/s
_FROM_START = ("body_displacement", "yaw_angle")
_ACCELERATIONS = ("lateral_acceleration", "longitudinal_acceleration")
_WIDE = (8.8, 2.6)
_ROUND = (4.4, 4.4)


def handling_plots(comparison: Comparison) -> dict[str, str]:
    """Plots of runs of a car that drives freely or stands on the kinematics rig, as SVG text by name; empty for other
    models."""
    driven = [each for each in comparison.configurations if drives(each.run) or kind(each.run) == RIG]
    if len(driven) < len(comparison.configurations) or not driven:
        return {}
    manoeuvre = kind(driven[0].run)
    if manoeuvre == RIG:
        return {"kinematics_handling": draw_svg(_rig_figure, driven)} if _rig_panels(driven) else {}
    plots: dict[str, str] = {}
    if manoeuvre in SLOWLY_TIGHTENED:
        plots["wheel_lift_handling"] = draw_svg(_lift_figure, driven)
        plots["self_steering_handling"] = draw_svg(_self_steering_figure, driven)
        plots["wheel_travel_handling"] = draw_svg(_travel_figure, driven)
    if manoeuvre in GROUND:
        plots["course_handling"] = draw_svg(_ground_figure, driven)
    for quantity in STEERED:
        if any(steering_response(each.run, quantity) is not None for each in driven):
            plots[f"{quantity}_over_frequency_handling"] = draw_svg(_frequency_figure, driven, quantity)
    if shown_together(driven):
        plots["over_time_handling"] = draw_svg(_together_figure, driven)
    if manoeuvre in LOADED:
        plots["axle_loads_handling"] = draw_svg(_axle_load_figure, driven)
    if manoeuvre in CIRCLE_OF_FORCES and any(
        min(np.ptp(each.run[name]) for name in _ACCELERATIONS) > 1.0 for each in driven
    ):
        plots["accelerations_handling"] = draw_svg(_accelerations_figure, driven)
    return plots


def shown_together(configurations: Sequence[Configuration]) -> tuple[str, ...]:
    """Quantities over time that one figure of the manoeuvre shows together, of those that move at all."""
    if not configurations or not all(drives(each.run) for each in configurations):
        return ()
    wanted = TOGETHER.get(kind(configurations[0].run), ())
    return tuple(quantity for quantity in wanted if any(_moves(each.run, quantity) for each in configurations))


def _moves(run: Run, quantity: str) -> bool:
    return quantity in run and bool(np.ptp(run[quantity]) > 1e-6)


# ---- over lateral acceleration


def _lift_figure(configurations: Sequence[Configuration]) -> Figure:
    """Roll and the loads of the inner wheels over lateral acceleration; a wheel that lifts is marked."""
    inside = inner(configurations[0].run)
    figure, (roll, *loads) = make_panels(
        [each.name for each in configurations],
        ["roll out of the turn", *(f"{WORDS[each]}, inner wheel" for each in inside)],
    )
    for order, each in enumerate(configurations):
        run, turning = each.run, tightening(each.run)
        if turning is None:
            continue
        angle = turning.side * np.degrees(run["roll_angle"] - run["roll_angle"][0])
        draw_line(roll, order, *_over(turning.acceleration, turning.part(angle)))
        for panel, station in zip(loads, inner(run), strict=True):
            load = run[f"{station}_wheel_load"] * 1e-3
            draw_line(panel, order, *_over(turning.acceleration, turning.part(load)))
    lifted = _mark_lifts(configurations, loads)
    label_axes(roll, _ACCELERATION, "roll angle [°]")
    highest = max(panel.get_ylim()[1] for panel in loads)
    for panel in loads:
        panel.axhline(0, color=INK, linewidth=0.9)
        panel.set_ylim(-(0.14 + 0.06 * len(configurations) if lifted else 0.04) * highest, highest)
        label_axes(panel, _ACCELERATION, "wheel load [kN]")
    _from_zero(roll, *loads)
    return figure


def _mark_lifts(configurations: Sequence[Configuration], panels: Sequence[Axes]) -> bool:
    """A ring where an inner wheel leaves the road on its line, with the lateral acceleration below it; whether any
    does."""
    found = False
    for row, panel in enumerate(panels):
        height, right = 0, panel.dataLim.x1
        for order, each in enumerate(configurations):
            station, turning = inner(each.run)[row], tightening(each.run)
            last = 0 if turning is None else len(turning.acceleration)
            for lift in (lift for lift in lifts(each.run) if lift.station == station and lift.at < last):
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
        if turning is None:
            continue
        angle = turning.side * np.degrees(run["steering_wheel_angle"] - run["steering_wheel_angle"][0])
        highest = max(highest, float(turning.part(angle).max()))
        draw_line(steering, order, *_over(turning.acceleration, turning.part(angle)))
        if (wheelbase := fact(run, "wheelbase")) is not None and (ratio := fact(run, "steering_ratio")) is not None:
            speed = np.maximum(turning.part(run["speed"]), 0.1)
            geometry = np.degrees(ratio * wheelbase * turning.acceleration / speed**2)
            steering.plot(*_over(turning.acceleration, geometry), color=colour(order), linestyle=":", linewidth=1.2)
        behind = turning.side * np.degrees(run["rear_side_slip_angle"])
        draw_line(slip, order, *_over(turning.acceleration, turning.part(behind)))
    if highest > 0.0:  # a car that spins slows down so much that the angle without slip leaves the picture
        steering.set_ylim(top=min(steering.get_ylim()[1], 1.5 * highest))
    label_axes(steering, _ACCELERATION, "steering wheel angle [°]")
    label_axes(slip, _ACCELERATION, "side slip angle [°]")
    _from_zero(steering, slip)
    return figure


def _travel_figure(configurations: Sequence[Configuration]) -> Figure:
    """Wheel travel over lateral acceleration, with the stops."""
    inside = inner(configurations[0].run)
    titles = [f"{words}, {'inner' if station in inside else 'outer'} wheel" for station, words in WORDS.items()]
    figure, panels = make_panels([each.name for each in configurations], titles, share_y=True)
    for panel, station in zip(panels, WORDS, strict=True):
        for order, each in enumerate(configurations):
            turning = tightening(each.run)
            if turning is not None:
                travel = turning.part(each.run[f"{station}_suspension_deflection"]) * 1e3
                draw_line(panel, order, *_over(turning.acceleration, travel))
        stops = {tuple(each.run.meta["travel"][station]) for each in configurations}
        for order, (rebound, compression) in enumerate(sorted(stops)):
            stop_lines(panel, rebound * 1e3, compression * 1e3, horizontal=True, named=order == 0)
        panel.axhline(0, color=MUTED, linewidth=0.6, zorder=1.5)
        label_axes(panel, _ACCELERATION, "suspension deflection [mm]")
    _from_zero(*panels)
    return figure


_ACCELERATION = "lateral acceleration [m/s²]"


def _over(acceleration: np.ndarray, values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """A line over lateral acceleration with few points, at which the acceleration has got further than ever."""
    ahead = np.maximum.accumulate(acceleration)
    grid = np.linspace(0.0, float(ahead[-1]), 400)
    first = np.unique(np.searchsorted(ahead, grid).clip(0, len(values) - 1))
    return acceleration[first], values[first]


def _from_zero(*panels: Axes) -> None:
    for panel in panels:
        panel.set_xlim(0, 1.03 * panel.dataLim.x1)


# ---- over time


def _together_figure(configurations: Sequence[Configuration]) -> Figure:
    """The quantities of the manoeuvre over time, one panel each."""
    quantities = shown_together(configurations)
    figure, panels = make_panels([each.name for each in configurations], ["" for _ in quantities])
    for panel, quantity in zip(panels, quantities, strict=True):
        how = _SHOWN.get(quantity, shown(QUANTITIES[quantity][0]))
        for order, each in enumerate(configurations):
            if quantity in each.run:
                values = each.run[quantity] - (each.run[quantity][0] if quantity in _FROM_START else 0.0)
                if quantity.endswith("side_slip_angle"):  # has no meaning at a standstill
                    values = np.where(each.run["speed"] > _STANDSTILL, values, 0.0)
                draw_line(panel, order, *thinned(each.run.time, values * how.factor))
        _zero_line(panel)
        panel.set_xlim(0, max(float(each.run.time[-1]) for each in configurations))
        label_axes(panel, "time [s]", _named(quantity, how.unit))
    return figure


def _axle_load_figure(configurations: Sequence[Configuration]) -> Figure:
    """Sum of the wheel loads of each axle over time."""
    figure, panels = make_panels([each.name for each in configurations], ["front axle", "rear axle"], share_y=True)
    for panel, axle in zip(panels, ("front", "rear"), strict=True):
        for order, each in enumerate(configurations):
            load = sum(each.run[f"{station}_wheel_load"] for station in stations_of(axle)) * np.float64(1e-3)
            draw_line(panel, order, *thinned(each.run.time, np.asarray(load)))
        label_axes(panel, "time [s]", "axle load [kN]")
    return figure


# ---- over frequency


def _frequency_figure(configurations: Sequence[Configuration], quantity: str) -> Figure:
    """Gain, phase and coherence of a quantity over the frequency of the steering wheel."""
    from matplotlib.ticker import FuncFormatter, MultipleLocator, NullLocator

    unit, factor = {"rad/s": ("1/s", 1.0), "m/s²": ("m/s² per 100°", np.radians(100.0))}.get(
        QUANTITIES[quantity][0], ("°/°", 1.0)
    )
    figure, panels = make_panels([each.name for each in configurations], ["gain", "phase", "coherence"])
    for order, each in enumerate(configurations):
        found = steering_response(each.run, quantity)
        if found is not None:
            for panel, values in zip(panels, _curves(found, factor), strict=True):
                draw_line(panel, order, found.frequency, values)
    for panel, label in zip(panels, (f"gain [{unit}]", "phase [°]", "coherence"), strict=True):
        panel.set_xscale("log")
        panel.set_xticks([each for each in (0.2, 0.5, 1, 2, 5, 10) if panel.dataLim.x0 <= each <= panel.dataLim.x1])
        panel.xaxis.set_minor_locator(NullLocator())
        panel.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
        label_axes(panel, "frequency [Hz]", label)
    panels[0].set_ylim(0, 1.08 * panels[0].dataLim.y1)
    phases = float(np.ptp(panels[1].dataLim.intervaly))
    panels[1].yaxis.set_major_locator(MultipleLocator(15 if phases < 90 else 30 if phases < 200 else 90))
    panels[2].set_ylim(0, 1.04)
    return figure


def _curves(found: Response, factor: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    return found.gain * factor, np.degrees(found.phase), found.coherence


# ---- over the ground


def _ground_figure(configurations: Sequence[Configuration]) -> Figure:
    """Way of the centre of gravity over the ground, with what stands or lies there."""
    turns = kind(configurations[0].run) in ("steady_circle", "braking_in_turn")
    figure, (panel,) = make_panels([each.name for each in configurations], [""], size=_ROUND if turns else _WIDE)
    _draw_features(panel, configurations[0].run)
    for order, each in enumerate(configurations):
        run = each.run
        beside = (
            corners(run).values() if cones(run) is not None else _front_wheels(run) if kind(run) == "split_mu" else ()
        )
        for x, y in beside:
            panel.plot(*_way(x, y), color=colour(order), linewidth=0.6, alpha=0.55)
        draw_line(panel, order, *_way(run["position_x"], run["position_y"]))
    if turns:
        panel.set_aspect("equal", adjustable="datalim")
    else:
        low, high = panel.get_ylim()
        panel.set_ylim(min(low, -1.0), max(high, 1.0))
    label_axes(panel, "x [m]", "y, to the left [m]")
    return figure


def _front_wheels(run: Run) -> list[tuple[np.ndarray, np.ndarray]]:
    """Ways of both front wheels over the ground [m]."""
    track, ahead, yaw = fact(run, "track_front"), fact(run, "cg_x"), run["yaw_angle"]
    if track is None or ahead is None:
        return []
    x, y = run["position_x"] - ahead * np.cos(yaw), run["position_y"] - ahead * np.sin(yaw)
    return [(x - across * np.sin(yaw), y + across * np.cos(yaw)) for across in (track / 2, -track / 2)]


def _draw_features(panel: Axes, run: Run) -> None:
    """Cones, slippery ground, gusts and the driver's path."""
    for feature in run.meta.get("road", {}).get("features", ()):
        if feature["kind"] == "cones":
            x, y = np.array(feature["points"]).T
            panel.plot(x, y, "o", color=PAPER, markersize=4.5, markeredgecolor=INK, markeredgewidth=1.0)
        elif feature["kind"] == "path":
            panel.plot(*_path(feature), color=MUTED, linewidth=0.9, linestyle=(0, (5, 3)))
        elif feature["kind"] == "patch":
            _box(panel, feature["x"], feature["y"], f"friction x {feature['friction']:g}", run)
        elif feature["kind"] == "gust":
            _box(panel, feature["x"], None, f"wind {feature['wind']:g} m/s", run)


def _path(feature: Mapping[str, Any]) -> tuple[np.ndarray, np.ndarray]:
    """Places on the driver's path, a circle or a table."""
    if "radius" in feature:
        angle = np.linspace(0.0, 2 * np.pi, 200)
        return abs(feature["radius"]) * np.sin(angle), feature["radius"] * (1 - np.cos(angle))
    return np.asarray(feature["x"]), np.asarray(feature["y"])


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


def _way(x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    every = max(len(x) // 800, 1)
    keep = np.unique(np.append(np.arange(0, len(x), every), len(x) - 1))
    return x[keep], y[keep]


def _accelerations_figure(configurations: Sequence[Configuration]) -> Figure:
    """Longitudinal over lateral acceleration (g-g diagram)."""
    figure, (panel,) = make_panels([each.name for each in configurations], [""], size=_ROUND)
    for order, each in enumerate(configurations):
        draw_line(panel, order, *_way(each.run["lateral_acceleration"], each.run["longitudinal_acceleration"]))
    for line in (panel.axhline, panel.axvline):
        line(0, color=MUTED, linewidth=0.6, zorder=1.5)
    panel.set_aspect("equal", adjustable="datalim")
    panel.margins(0.07)
    label_axes(panel, "lateral acceleration, to the left [m/s²]", "longitudinal acceleration [m/s²]")
    return figure


# ---- on the rig

_Sampled = Callable[[Run, str], tuple[np.ndarray, np.ndarray]]


def _left(x: str, y: str, x_factor: float, y_factor: float) -> _Sampled:
    """A quantity of the left wheel over another one of it."""

    def sample(run: Run, axle: str) -> tuple[np.ndarray, np.ndarray]:
        station = stations_of(axle)[0]
        return run[f"{station}_{x}"] * x_factor, run[f"{station}_{y}"] * y_factor

    return sample


def _mean_over_body(x: str, y: str) -> _Sampled:
    """Mean of both wheels' angles over one of the body or the steering wheel, both in degrees."""

    def sample(run: Run, axle: str) -> tuple[np.ndarray, np.ndarray]:
        left, right = (run[f"{station}_{y}"] for station in stations_of(axle))
        return np.degrees(run[x]), np.degrees((left + right) / 2)

    return sample


def _roll_moment(run: Run, axle: str) -> tuple[np.ndarray, np.ndarray]:
    left, right = (run[f"{station}_wheel_load"] for station in stations_of(axle))
    return np.degrees(run["roll_angle"]), (right - left) * (fact(run, f"track_{axle}") or 1.0) / 2 * 1e-3


_DEGREE = 180 / np.pi
_TRAVEL = "wheel travel, compression positive [mm]"
RIG_CURVES: dict[str, tuple[tuple[str, str, _Sampled], ...]] = {
    "bump": (
        (_TRAVEL, "toe-in [°]", _left("suspension_deflection", "steer_angle", 1e3, -_DEGREE)),
        (_TRAVEL, "camber, top outwards [°]", _left("suspension_deflection", "inclination_angle", 1e3, _DEGREE)),
        (_TRAVEL, "patch moves outwards [mm]", _left("suspension_deflection", "contact_y", 1e3, 1e3)),
        (_TRAVEL, "patch moves forwards [mm]", _left("suspension_deflection", "contact_x", 1e3, 1e3)),
        (_TRAVEL, "wheel load [kN]", _left("suspension_deflection", "wheel_load", 1e3, 1e-3)),
    ),
    "roll": (
        ("roll angle [°]", "mean steer angle [°]", _mean_over_body("roll_angle", "steer_angle")),
        ("roll angle [°]", "mean camber to the road [°]", _mean_over_body("roll_angle", "camber_angle")),
        ("roll angle [°]", "roll moment [kN m]", _roll_moment),
    ),
    "steer": (
        ("steering wheel angle [°]", "mean steer angle [°]", _mean_over_body("steering_wheel_angle", "steer_angle")),
        (
            "steering wheel angle [°]",
            "mean camber to the road [°]",
            _mean_over_body("steering_wheel_angle", "camber_angle"),
        ),
    ),
    "lateral_force": (
        ("lateral force [kN]", "steer angle [°]", _left("lateral_force", "steer_angle", 1e-3, _DEGREE)),
        ("lateral force [kN]", "camber to the road [°]", _left("lateral_force", "camber_angle", 1e-3, _DEGREE)),
    ),
    "longitudinal_force": (
        ("longitudinal force [kN]", "toe-in [°]", _left("longitudinal_force", "steer_angle", 1e-3, -_DEGREE)),
    ),
    "aligning_moment": (
        ("aligning moment [N m]", "steer angle [°]", _left("aligning_moment", "steer_angle", 1.0, _DEGREE)),
    ),
}
"""Test of the rig -> curves: name of x, name of y, and how both are taken from a run and an axle."""


def _rig_panels(configurations: Sequence[Configuration]) -> list[tuple[str, tuple[str, str, _Sampled]]]:
    """Axle and curve of every panel: front and rear side by side; the rear axle does not steer."""
    test = str(configurations[0].run.meta["manoeuvre"].get("test", ""))
    axles = ("front",) if test == "steer" else ("front", "rear")
    return [(axle, curve) for curve in RIG_CURVES.get(test, ()) for axle in axles]


def _rig_figure(configurations: Sequence[Configuration]) -> Figure:
    """The curves of a test, left wheels or both wheels' mean."""
    chosen = _rig_panels(configurations)
    figure, panels = make_panels([each.name for each in configurations], [f"{axle} axle" for axle, _ in chosen])
    for panel, (axle, (x_name, y_name, sample)) in zip(panels, chosen, strict=True):
        for order, each in enumerate(configurations):
            draw_line(panel, order, *_way(*sample(each.run, axle)))
        for line in (panel.axhline, panel.axvline):
            line(0, color=MUTED, linewidth=0.6, zorder=1.5)
        if y_name == "wheel load [kN]":
            panel.set_ylim(bottom=min(0.0, panel.get_ylim()[0]))
        elif np.ptp(panel.dataLim.intervaly) < _LEAST_ANGLE:
            middle = float(np.mean(panel.dataLim.intervaly))
            panel.set_ylim(middle - _LEAST_ANGLE, middle + _LEAST_ANGLE)
        label_axes(panel, x_name, y_name)
    return figure


_LEAST_ANGLE = 0.02
"""A curve on the rig that moves less than this [shown unit] shall look flat."""


def _zero_line(panel: Axes) -> None:
    low, high = panel.get_ylim()
    if low < 0 < high:
        panel.axhline(0, color=MUTED, linewidth=0.6, zorder=1.5)


def _named(quantity: str, unit: str) -> str:
    words = {"wind_y": "wind across", "body_displacement": "rise of the centre of gravity", "yaw_rate": "yaw velocity"}
    return words.get(quantity, quantity.replace("_", " ")) + (f" [{unit}]" if unit else "")
