"""Plots of the kinematics and compliance rig."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

import numpy as np

from susp_mj.run import Run

from ..colours import MUTED
from ..numbers.runs import facts, parameter
from ..numbers.turns import stations_of
from .figure import draw_line, draw_svg, label_axes, make_panels, thinned_way

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from ..compare import Configuration

_Sampled = Callable[[Run, str], tuple[np.ndarray, np.ndarray]]
_DEGREE = 180 / np.pi
_TRAVEL = "wheel travel, compression positive [mm]"
_LEAST_ANGLE = 0.02
"""A curve on the rig that moves less than this [shown unit] shall look flat."""


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
    return np.degrees(run["roll_angle"]), (right - left) * facts(run).get(f"track_{axle}", 1.0) / 2 * 1e-3


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


def rig_plots(configurations: Sequence[Configuration]) -> dict[str, str]:
    """The curves of a test on the rig, as SVG text by name."""
    return {"kinematics_handling": draw_svg(_rig_figure, configurations)} if _rig_panels(configurations) else {}


def _rig_panels(configurations: Sequence[Configuration]) -> list[tuple[str, tuple[str, str, _Sampled]]]:
    """Axle and curve of every panel: front and rear side by side; the rear axle does not steer."""
    test = str(parameter(configurations[0].run, "test", ""))
    axles = ("front",) if test == "steer" else ("front", "rear")
    return [(axle, curve) for curve in RIG_CURVES.get(test, ()) for axle in axles]


def _rig_figure(configurations: Sequence[Configuration]) -> Figure:
    """The curves of a test, left wheels or both wheels' mean."""
    chosen = _rig_panels(configurations)
    figure, panels = make_panels([each.name for each in configurations], [f"{axle} axle" for axle, _ in chosen])
    for panel, (axle, (x_name, y_name, sample)) in zip(panels, chosen, strict=True):
        for order, each in enumerate(configurations):
            draw_line(panel, order, *thinned_way(*sample(each.run, axle)))
        for line in (panel.axhline, panel.axvline):
            line(0, color=MUTED, linewidth=0.6, zorder=1.5)
        if y_name == "wheel load [kN]":
            panel.set_ylim(bottom=min(0.0, panel.get_ylim()[0]))
        elif np.ptp(panel.dataLim.intervaly) < _LEAST_ANGLE:
            middle = float(np.mean(panel.dataLim.intervaly))
            panel.set_ylim(middle - _LEAST_ANGLE, middle + _LEAST_ANGLE)
        label_axes(panel, x_name, y_name)
    return figure
