"""Plots: every configuration drawn in its colour, in engineers' units, the same bytes each time."""

from __future__ import annotations

import re
from dataclasses import replace
from xml.etree import ElementTree

import numpy as np
import pytest

from evaluation.characteristics import characteristic
from evaluation.colours import COLOURS
from evaluation.compare import Comparison
from evaluation.pages.page import for_page
from evaluation.plots.characteristics import characteristic_plots
from evaluation.plots.drawing import draw, save_plots
from evaluation.plots.figure import colour
from evaluation.plots.over_time import time_plots
from evaluation.plots.sweeps import SWEEP_QUANTITIES, amplification_plots
from manoeuvres import VerticalSweep
from susp_mj.elements import GRAVITY
from susp_mj.errors import InputError
from vehicles import load_vehicle

from ..builders.comparisons import SETS, compare, on_four_wheels

SVG = "{http://www.w3.org/2000/svg}"


@pytest.fixture(scope="module")
def bump():
    return compare()


@pytest.fixture(scope="module")
def drawn(bump):
    return draw(bump)


def lines(svg: str, stroke: str) -> list[str]:
    """Path data of the lines with a stroke colour; the samples of the legend, which nothing clips, are left out."""
    paths = [path for path in ElementTree.fromstring(svg).iter(f"{SVG}path") if path.get("clip-path")]
    return [
        path.get("d", "")
        for path in paths
        if f"stroke: {stroke}" in path.get("style", "") and "fill: none" in path.get("style", "")
    ]


def texts(svg: str) -> list[str]:
    return [text.text or "" for text in ElementTree.fromstring(svg).iter(f"{SVG}text")]


def test_every_plot_has_one_line_per_configuration_in_its_fixed_colour(drawn):
    for name, svg in drawn.items():
        panels = 3 if name == "element_forces" else 1
        for order in range(3):
            assert len(lines(svg, COLOURS[order])) == panels, (name, order)
        assert not lines(svg, COLOURS[3])
        assert [text for text in texts(svg) if text in SETS.values()] == list(SETS.values())


def test_the_linear_peak_stands_at_its_place_in_the_acceleration_plot(bump, drawn):
    """Reads the drawn line back through the axis ticks: the plot shows the run's own peak in m/s²."""
    svg = drawn["body_acceleration"]
    ticks = {}
    for group in ElementTree.fromstring(svg).iter(f"{SVG}g"):
        if re.fullmatch(r"ytick_\d+", group.get("id", "")):
            label = next(group.iter(f"{SVG}text")).text.replace("−", "-")
            ticks[float(label)] = float(next(use for use in group.iter(f"{SVG}use")).get("y"))
    (v1, y1), (v2, y2) = sorted(ticks.items())[0], sorted(ticks.items())[-1]
    heights = [float(y) for _, y in re.findall(r"[ML] ([-\d.]+) ([-\d.]+)", lines(svg, COLOURS[0])[0])]
    highest = v1 + (min(heights) - y1) * (v2 - v1) / (y2 - y1)
    peak = bump.configurations[0].run["body_acceleration"].max()
    assert highest == pytest.approx(peak, rel=0.01) and peak == pytest.approx(11.24, abs=0.1)


def test_axes_name_quantity_and_unit(drawn):
    expected = {
        "body_acceleration": "body acceleration [m/s²]",
        "body_displacement": "body displacement [mm]",
        "suspension_deflection": "suspension deflection [mm]",
        "suspension_speed": "suspension speed [m/s]",
        "wheel_load": "wheel load [kN]",
        "road_height": "road height [mm]",
        "element_forces": "damper force [kN]",
        "spring_force_characteristic": "spring force at the wheel [kN]",
        "spring_rate_characteristic": "spring rate at the wheel [kN/m]",
        "natural_frequency_characteristic": "natural frequency [Hz]",
        "damper_force_characteristic": "damper force at the wheel [kN]",
    }
    assert set(drawn) == set(expected)
    for name, label in expected.items():
        assert label in texts(drawn[name])


def test_stops_are_lines_in_the_deflection_plot_and_lost_contact_is_shaded(bump, drawn):
    assert {"compression stop", "rebound stop"} <= set(texts(drawn["suspension_deflection"]))
    shaded = re.findall(r"fill: (#\w+); opacity: 0\.25", drawn["wheel_load"])
    lost = [order for order, each in enumerate(bump.configurations) if each.numbers["contact_loss_time"].value]
    assert lost == [0] and shaded == [COLOURS[0]]


def test_same_input_gives_the_same_bytes(bump, drawn):
    assert draw(bump) == drawn
    assert not any(re.search(r"\d{4}-\d\d-\d\dT|dc:date", svg) for svg in drawn.values())


def test_equal_curves_of_two_configurations_are_both_seen(drawn):
    svg = drawn["spring_force_characteristic"]
    assert re.search(f'stroke: {COLOURS[2]};[^"]*stroke-dasharray|stroke-dasharray[^"]*stroke: {COLOURS[2]}', svg)
    assert not re.search(f'stroke-dasharray[^"]*stroke: {COLOURS[1]}', svg)


def test_four_wheels_become_four_panels(bump):
    car = replace(bump, outcomes=[replace(each, run=on_four_wheels(each.run)) for each in bump.configurations])
    plots = time_plots(car)
    assert {"front left", "front right", "rear left", "rear right"} <= set(texts(plots["wheel_load"]))
    assert all(len(lines(plots["wheel_load"], colour(order))) == 4 for order in range(3))
    assert len(lines(plots["body_acceleration"], COLOURS[0])) == 1


def test_a_sweep_gives_amplifications_and_stays_small():
    sweep = compare(VerticalSweep(duration=30.0), names={"linear": "linear", "soft_linear": "soft"})
    plots = amplification_plots(sweep)
    assert list(plots) == [
        f"{each}_amplification" for each in SWEEP_QUANTITIES if each not in ("pitch_angle", "roll_angle")
    ]
    for svg in plots.values():
        assert all(len(lines(svg, COLOURS[order])) == 1 for order in range(2))
        assert "frequency [Hz]" in texts(svg)
    assert all(len(svg) < 400_000 for svg in time_plots(sweep).values())


def test_a_bump_has_no_amplification_and_a_comparison_without_characteristics_none_of_them(bump):
    assert amplification_plots(bump) == {}
    assert characteristic_plots({"linear": []}) == {}


@pytest.mark.parametrize("name", ["_hidden", "$x^2$", "a <b> & c", "日本", "x" * 200, "tab\there", "\x01", ""])
def test_any_name_of_a_configuration_can_be_drawn(bump, name, recwarn):
    one = Comparison("t", "", [replace(bump.configurations[0], name=name)])
    svg = time_plots(one)["body_acceleration"]
    shown = texts(svg)
    assert not [str(each.message) for each in recwarn]
    assert (
        any(text and (text in name or text.rstrip("…") in name) for text in shown)
        or not name.strip()
        or not name.isprintable()
    )


def test_characteristic_follows_its_spring_and_damper():
    axle = load_vehicle("chapter3", "nonlinear").axle("rear")
    curve = characteristic("rear axle", axle)
    inside = np.isfinite(curve.spring_rate)
    assert curve.stops == (-0.1, 0.1) and curve.preload == pytest.approx(4743.0)
    assert curve.deflection[0] < -0.1 and curve.deflection[-1] > 0.1 and 0.0 in curve.deflection
    assert np.all(np.diff(curve.spring_force) > 0)
    assert curve.spring_force[-1] - curve.spring_force[inside][-1] == pytest.approx(
        1e7 * (curve.deflection[-1] - 0.1), rel=1e-9
    )
    frequency = np.sqrt(curve.spring_rate[inside] * GRAVITY / curve.spring_force[inside]) / (2 * np.pi)
    assert np.allclose(curve.spring_frequency[inside], frequency) and np.allclose(frequency, 1.2, atol=1e-4)
    at = dict(zip(curve.speed.round(2).tolist(), curve.damper_force.tolist(), strict=True))
    assert at[0.1] == pytest.approx(200.0) and at[-0.1] == pytest.approx(-400.0) and at[0.0] == 0.0
    assert [(note.role, note.kind) for note in curve.elements] == [
        ("spring", "constant_frequency"),
        ("stops", "stops"),
        ("damper", "zoned"),
        ("mount", "mount"),
        ("friction", "friction"),
        ("tyre", "spring"),
    ]


def test_a_spring_that_gives_way_has_no_frequency_and_is_drawn():
    axle = load_vehicle("chapter3", "linear").rear
    known = characteristic("rear axle", axle)
    gives_way = replace(known, spring_rate=-known.spring_rate, spring_frequency=np.full(known.deflection.shape, np.nan))
    plots = characteristic_plots({"stiff": [known], "gives way": [gives_way]})
    assert set(plots) == set(characteristic_plots({"stiff": [known]}))


def test_colours_of_a_page_follow_its_scheme_and_no_others_are_left(drawn):
    for svg in drawn.values():
        page = for_page(svg)
        assert "prefers-color-scheme:dark" in page
        assert not re.findall(r"(?:fill|stroke): #", page)
        ElementTree.fromstring(page)


def test_save_writes_one_file_for_each_plot(bump, drawn, tmp_path):
    paths = save_plots(bump, tmp_path / "plots", drawn)
    assert {path.name for path in paths} == {f"{name}.svg" for name in drawn}
    assert all(path.read_text(encoding="utf-8") == drawn[path.stem] for path in paths)
    assert sorted(path.name for path in (tmp_path / "plots").iterdir()) == sorted(path.name for path in paths)


def test_an_unwritable_folder_is_an_input_error(drawn, bump, tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(InputError, match="cannot be written"):
        save_plots(bump, tmp_path / "file" / "plots", drawn)
    assert [path.name for path in tmp_path.iterdir()] == ["file"]
