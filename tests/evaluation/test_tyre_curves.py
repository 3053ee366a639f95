"""Curves of tyres for the characteristic sheet, and their plots."""

from __future__ import annotations

import math
import re
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from evaluation.characteristics import characteristic
from evaluation.pages.report import write_report
from evaluation.pages.sheet import write_sheet
from evaluation.plots.characteristics import characteristic_plots
from evaluation.plots.drawing import draw
from evaluation.plots.tyres import tyre_plots
from evaluation.tyre_curves import LOADS, tyre_curves
from susp_mj.elements import LinearContactTyre
from susp_mj.elements.tyres import magic_formula_law as law
from susp_mj.elements.tyres.tir import load_tyre
from vehicles import load_vehicle
from vehicles.reading import FOLDER

from ..builders.comparisons import compare

TYRE = load_tyre(FOLDER / "tyres" / "pac2002_245_40R18.tir")
CURVES = tyre_curves(TYRE, 4000.0)
LINEAR = LinearContactTyre(
    radius=0.3,
    vertical_stiffness=2e5,
    nominal_load=4000,
    cornering_stiffness=7e4,
    longitudinal_stiffness=9e4,
    pneumatic_trail=0.03,
)
NAMES = [
    f"tyre_{name}_characteristic"
    for name in ("longitudinal_force", "lateral_force", "aligning_moment", "combined_slip")
]


def test_curves_are_the_laws():
    p = TYRE.parameters()
    np.testing.assert_allclose(CURVES.loads, 4000.0 * np.array(LOADS))
    for i, load in enumerate(CURVES.loads):
        along = [law.longitudinal_force(k, 0.0, 0.0, load, p) for k in CURVES.kappa]
        across = [law.lateral_force(0.0, a, 0.0, load, p) for a in CURVES.alpha]
        moment = [law.aligning_moment(0.0, a, 0.0, load, math.cos(a), p) for a in CURVES.alpha]
        np.testing.assert_allclose(CURVES.longitudinal_force[i], along, rtol=1e-10)
        np.testing.assert_allclose(CURVES.lateral_force[i], across, rtol=1e-10)
        np.testing.assert_allclose(CURVES.aligning_moment[i], moment, rtol=1e-4, atol=1e-2)
    for j, angle in enumerate(CURVES.angles):
        found = [law.lateral_force(k, angle, 0.0, 4000.0, p) for k in CURVES.combined_kappa]
        np.testing.assert_allclose(CURVES.combined_lateral[j], found, rtol=1e-10, atol=1e-9)


def test_friction_is_the_largest_force():
    p = TYRE.parameters()
    expected = 4000 * law.longitudinal_friction(0, 4000, p), 4000 * law.lateral_friction(0, 4000, p)
    assert CURVES.friction == pytest.approx(expected, rel=1e-3)


def test_a_linear_tyre_is_straight_and_has_no_friction():
    curves = tyre_curves(LINEAR, 4000.0, [4000.0])
    np.testing.assert_allclose(curves.longitudinal_force[0], 9e4 * curves.kappa, rtol=1e-12)
    np.testing.assert_allclose(curves.lateral_force[0], -7e4 * np.tan(curves.alpha), rtol=1e-12)
    np.testing.assert_allclose(curves.aligning_moment[0], 0.03 * 7e4 * np.tan(curves.alpha), rtol=1e-12)
    assert curves.friction is None


def test_the_same_tyre_is_recognised():
    assert CURVES.equals(tyre_curves(TYRE, 4000.0))
    assert not CURVES.equals(tyre_curves(TYRE, 4100.0))
    assert not CURVES.equals(tyre_curves(LINEAR, 4000.0))


def lines_in(svg):
    return len(re.findall(r'<g id="line2d_\d+">\s*<path d="[^"]*" clip-path', svg))


def test_plots():
    """A panel an axle; the configurations that share a tyre share its lines, a different one adds its own."""
    axle = SimpleNamespace(title="front axle", tyre=CURVES)
    alone = tyre_plots({"a": [axle]})
    assert list(alone) == NAMES
    assert tyre_plots({"a": [axle], "b": [axle]}).keys() == alone.keys()
    other = SimpleNamespace(title="front axle", tyre=tyre_curves(LINEAR, 4000.0))
    for name in NAMES:
        one, same, two = (
            lines_in(tyre_plots(sets)[name])
            for sets in ({"a": [axle]}, {"a": [axle], "b": [axle]}, {"a": [axle], "b": [other]})
        )
        assert one == same < two, name
    assert "4.0 kN" in alone[NAMES[0]]
    assert "−12°" in alone[NAMES[3]]
    assert tyre_plots({"a": [SimpleNamespace(title="front axle", tyre=None)]}) == {}


def test_the_sheet_shows_the_tyre_of_a_car(tmp_path):
    axle = load_vehicle("s_class").axle("rear").model_copy(update={"handling_tyre": TYRE})
    with_tyre = characteristic("rear axle", axle)
    assert with_tyre.tyre is not None
    assert with_tyre.tyre.nominal_load == pytest.approx(with_tyre.preload + 9.81 * axle.unsprung_mass)
    assert "handling_tyre" in {note.role for note in with_tyre.elements}
    page = write_sheet("car", {"a": [with_tyre]}, tmp_path / "sheet.html").read_text(encoding="utf-8")
    assert "Tyre combined slip" in page
    without = replace(with_tyre, tyre=None)
    assert "Tyre combined slip" not in write_sheet("car", {"a": [without]}, tmp_path / "sheet.html").read_text(
        encoding="utf-8"
    )
    assert not set(NAMES) & set(characteristic_plots({"a": [with_tyre]}))


@pytest.mark.parametrize(
    "tyre", [TYRE, load_tyre(FOLDER / "tyres" / "mf61_205_60R15.tir"), LINEAR], ids=lambda each: each.kind
)
def test_the_report_shows_the_tyre_of_the_model_that_rolls_on_it(tyre, tmp_path):
    comparison = compare(names={"linear": "linear"})
    (configuration,) = comparison.configurations
    axle = load_vehicle("chapter3", "linear").axle("rear").model_copy(update={"handling_tyre": tyre})
    pages = {}
    for car in ("oscillation", "rig"):
        run = replace(configuration.run, meta={**configuration.run.meta, "car": car})
        each = replace(configuration, run=run, characteristics=[characteristic("rear axle", axle)])
        pages[car] = write_report(replace(comparison, outcomes=[each]), tmp_path / f"{car}.html").read_text(
            encoding="utf-8"
        )
        assert set(NAMES) <= set(draw(replace(comparison, outcomes=[each]))) or car != "rig"
    assert "Tyre combined slip" not in pages["oscillation"]
    assert "Tyre combined slip" in pages["rig"]
    name = {"linear": "Tyre: linear", "magic_formula": "Magic Formula 5.2", "magic_formula_61": "Magic Formula 6.1"}[
        tyre.kind
    ]
    assert name in pages["rig"]
    assert name not in pages["oscillation"]
    assert "Tyre spring" in pages["oscillation"]
    assert "Tyre spring" not in pages["rig"]
