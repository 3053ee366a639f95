"""Plots of a car that drives freely: which there are, what stands in them, and that they are the same each time."""

from __future__ import annotations

import json
import re
from xml.etree import ElementTree

import numpy as np
import pytest

from evaluation.colours import COLOURS, LIFTED
from evaluation.pages.page import for_page
from evaluation.pages.report import write_report
from evaluation.pages.summary import write_summary
from evaluation.plots.channels import STATIONS
from evaluation.plots.drawing import draw, handling_plots
from evaluation.plots.over_time import shown_together, time_plots
from evaluation.plots.rig import RIG_CURVES
from evaluation.plots.steering import STEERED
from manoeuvres import (
    MANOEUVRES,
    BrakingInTurn,
    Bump,
    Crosswind,
    LaneChange,
    RampSteer,
    SineSteer,
    SplitMu,
    StepSteer,
    SuspensionRig,
    SweptSteer,
)
from susp_mj.meaning import Input
from susp_mj.names import CORNERS, QUANTITIES

from ..builders.comparisons import compare
from ..builders.runs import Bicycle, compared, driven, made_up

SVG = "{http://www.w3.org/2000/svg}"
SOFT, STIFF = Bicycle(front_share=0.8, roll_gradient=0.016), Bicycle()


def lines(svg, stroke):
    paths = [path for path in ElementTree.fromstring(svg).iter(f"{SVG}path") if path.get("clip-path")]
    return [
        path.get("d", "")
        for path in paths
        if f"stroke: {stroke}" in path.get("style", "") and "fill: none" in path.get("style", "")
    ]


def texts(svg):
    return [text.text or "" for text in ElementTree.fromstring(svg).iter(f"{SVG}text")]


@pytest.fixture(scope="module")
def ramp():
    manoeuvre = RampSteer(limit="90 deg")
    return compared(SOFT.run(manoeuvre), STIFF.run(manoeuvre))


@pytest.fixture(scope="module")
def plots(ramp):
    return handling_plots(ramp)


def test_a_slowly_tightened_turn_is_drawn_over_lateral_acceleration(plots):
    assert list(plots) == [
        "wheel_lift_handling",
        "self_steering_handling",
        "wheel_travel_handling",
        "over_time_handling",
    ]
    for name, panels in (("wheel_lift_handling", 3), ("wheel_travel_handling", 4)):
        assert "lateral acceleration [m/s²]" in texts(plots[name])
        for order in range(2):
            assert len(lines(plots[name], COLOURS[order])) == panels, name


def test_the_wheel_that_lifts_is_marked_with_its_lateral_acceleration(ramp, plots):
    acceleration = ramp.configurations[0].numbers["wheel_lift_acceleration"]
    assert acceleration.note == "fl" and f"lifts at {acceleration.value:.1f}" in texts(plots["wheel_lift_handling"])
    assert f"stroke: {LIFTED}" in plots["wheel_lift_handling"]
    assert len([text for text in texts(plots["wheel_lift_handling"]) if text.startswith("lifts")]) == 1, (
        "the stiffer car's stays down"
    )
    quiet = handling_plots(compared(STIFF.run(RampSteer(limit="40 deg"))))
    assert f"stroke: {LIFTED}" not in quiet["wheel_lift_handling"]


def test_wheels_are_called_inner_and_outer_by_the_turn(plots):
    assert "front left, inner wheel" in texts(plots["wheel_travel_handling"])
    right = handling_plots(compared(STIFF.run(RampSteer(rate="-25 deg/s", limit="60 deg"))))
    assert {"front right, inner wheel", "front left, outer wheel"} <= set(texts(right["wheel_travel_handling"]))


def test_stops_stand_in_the_travel(plots):
    assert {"compression stop", "rebound stop"} <= set(texts(plots["wheel_travel_handling"]))


def test_the_figures_of_the_step_are_those_of_the_thesis():
    """A9.12 to A9.15: yaw velocity, pitch, roll and height of the centre of gravity over time."""
    step = compared(SOFT.run(StepSteer()), STIFF.run(StepSteer()), Bicycle(roll_damping=0.2).run(StepSteer()))
    svg = handling_plots(step)["over_time_handling"]
    wanted = {"yaw velocity [°/s]", "pitch angle [°]", "roll angle [°]", "rise of the centre of gravity [mm]"}
    assert wanted <= set(texts(svg))
    assert [len(lines(svg, COLOURS[order])) for order in range(3)] == [6, 6, 6]
    assert not set(shown_together(step.configurations)) & set(time_plots(step)), "nothing is drawn twice"


def test_a_sweep_gives_gain_phase_and_coherence_of_each_quantity():
    sweep = compared(SOFT.run(SweptSteer()), STIFF.run(SweptSteer()))
    plots = handling_plots(sweep)
    assert [name for name in plots if "frequency" in name] == [
        f"{quantity}_over_frequency_handling" for quantity in STEERED
    ]
    svg = plots["side_slip_angle_over_frequency_handling"]
    assert {"gain [°/°]", "phase [°]", "coherence", "frequency [Hz]"} <= set(texts(svg))
    assert [len(lines(svg, COLOURS[order])) for order in range(2)] == [3, 3]
    assert not any(name.endswith("_amplification") for name in draw(sweep)), "the road does not move"
    assert all(len(each) < 400_000 for each in plots.values())


def test_a_lane_change_shows_cones_and_corners():
    manoeuvre = LaneChange()
    time = np.arange(8001) * 1e-3
    x = manoeuvre.speed * time - 1.5
    y = manoeuvre.path(x)
    run = made_up(
        manoeuvre,
        time,
        position_x=x,
        position_y=y,
        yaw_angle=np.arctan(np.gradient(y, x)),
        lateral_acceleration=np.sin(time),
    )
    svg = handling_plots(compared(run))["course_handling"]
    assert len(lines(svg, COLOURS[0])) == 5, "four corners and the centre of gravity"
    assert len(re.findall(r"<use ", svg)) >= 18
    assert {"x [m]", "y, to the left [m]"} <= set(texts(svg))


@pytest.mark.parametrize(("manoeuvre", "words"), [(SplitMu(), "friction x 0.3"), (Crosswind(), "wind 20 m/s")])
def test_what_lies_on_the_road_is_named(manoeuvre, words):
    time = np.arange(3001) * 1e-3
    run = made_up(manoeuvre, time, position_x=22 * time, position_y=0.2 * time, yaw_rate=0.1 * np.sin(time))
    assert words in texts(handling_plots(compared(run))["course_handling"])


@pytest.mark.parametrize("test", RIG_CURVES)
def test_curves_of_the_rig(test):
    manoeuvre = SuspensionRig(test=test)
    time = np.arange(0, 20001, 20) * 1e-3
    channels = {"roll_angle": driven(manoeuvre, "roll_target", time)}
    for corner in CORNERS:
        channels[f"{corner}_suspension_deflection"] = -driven(manoeuvre, "heave_target", time)
        for quantity in ("steer_angle", "inclination_angle", "camber_angle", "contact_x", "contact_y"):
            channels[f"{corner}_{quantity}"] = 0.01 * np.sin(time)
        for force in ("lateral_force", "longitudinal_force", "aligning_moment"):
            found = manoeuvre.drive(Input(force, corner, 0.0, 0.7, ()), time)
            channels[f"{corner}_{force}"] = np.zeros_like(time) if found is None else found[0]
    svg = handling_plots(compared(made_up(manoeuvre, time, **channels)))["kinematics_handling"]
    axles = 1 if test == "steer" else 2
    assert len(lines(svg, COLOURS[0])) == axles * len(RIG_CURVES[test])
    assert {name for curve in RIG_CURVES[test] for name in curve[:2]} <= set(texts(svg))


def test_other_models_have_none_of_them():
    assert handling_plots(compare(Bump(duration=0.5), names={"linear": "linear"})) == {}


def test_a_mixture_with_another_model_is_drawn_the_common_way():
    other = compare(Bump(duration=0.5), names={"linear": "linear"}).configurations[0]
    bump = made_up(Bump(duration=0.5), np.arange(501) * 1e-3)
    from dataclasses import replace

    mixed = compared(bump)
    assert handling_plots(replace(mixed, outcomes=[*mixed.configurations, other])) == {}


def test_quantities_drawn_together_are_channels_of_known_manoeuvres():
    for kind, manoeuvre in MANOEUVRES.items():
        assert set(manoeuvre.character.together) <= set(QUANTITIES), kind
    assert set(CORNERS) <= set(STATIONS)


def test_same_input_gives_the_same_bytes(ramp, plots):
    assert handling_plots(ramp) == plots


def test_side_slip_at_a_standstill_is_not_drawn():
    time = np.arange(3001) * 1e-3
    wild = np.where(time > 2.0, np.pi, 0.05 * time)
    run = made_up(
        BrakingInTurn(),
        time,
        speed=np.maximum(10 - 6 * time, 0.0),
        rear_side_slip_angle=wild,
        lateral_acceleration=time,
    )
    svg = handling_plots(compared(run))["over_time_handling"]
    numbers = [float(text.replace("−", "-")) for text in texts(svg) if re.fullmatch(r"[−\d.]+", text)]
    assert max(numbers) < 100, "no 180°"


def test_report_and_summary_of_handling(ramp, tmp_path):
    path = write_report(ramp, tmp_path / "report.html")
    page = path.read_text(encoding="utf-8")
    assert "<h2>Roll and wheel lift</h2>" in page and "<h2>Handling</h2>" in page
    assert "fl at " in page and "wheels that lift" in page
    assert "Largest lateral acceleration of the centre of gravity" in page
    summary = json.loads(write_summary(ramp, tmp_path / "summary.json").read_text())
    assert summary["configurations"][0]["numbers"]["wheel_lift_acceleration"]["note"] == "fl"
    sine = compared(SOFT.run(SineSteer(amplitude="10 deg")))
    assert "Roll and wheel lift" not in write_report(sine, tmp_path / "sine.html").read_text(encoding="utf-8")


def test_colours_of_a_page_follow_its_scheme(plots):
    for svg in plots.values():
        assert not re.findall(r"(?:fill|stroke): #", for_page(svg))
