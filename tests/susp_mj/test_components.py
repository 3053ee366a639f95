"""Component level: virtual work between wheel and component, springs of coils, dampers of valves."""

from __future__ import annotations

import math
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad

from evaluation.characteristics import characteristic
from evaluation.pages.sheet import write_sheet
from evaluation.plots.characteristics import characteristic_plots
from susp_mj import InputError
from susp_mj.components import (
    BlowOff,
    Laminar,
    MotionRatio,
    Orifice,
    Parallel,
    Series,
    auxiliary_springs,
    damper_at_component,
    damper_at_wheel,
    helical_spring,
    hydraulic_damper,
    ring_area,
    rod_area,
    series_springs,
    spring_at_component,
    spring_at_wheel,
)
from susp_mj.description import validate
from susp_mj.elements import ConstantFrequencySpring, LinearSpring, Stops, ZonedDamper
from vehicles import load_vehicle

STOPS = Stops(rebound=-0.1, compression=0.1)
RISING = {"travel": [-0.1, -0.02, 0.03, 0.12], "ratio": [0.62, 0.66, 0.72, 0.85]}
RATIOS = {
    "constant": validate(MotionRatio, 0.7),
    "rising": validate(MotionRatio, RISING),
    "falling": validate(MotionRatio, {"travel": ["-90 mm", "0 mm", "80 mm"], "ratio": [0.9, 0.82, 0.8]}),
    "inside": validate(MotionRatio, {"travel": [0.01, 0.02], "ratio": [0.5, 0.51]}),
    "hump": validate(MotionRatio, {"travel": [-0.1, 0.0, 0.1], "ratio": [0.6, 0.68, 0.62]}),
}
X = np.linspace(-0.12, 0.13, 101)


def wheel_spring(kind=ConstantFrequencySpring, **fields):
    return kind(preload=4743.0, stops=STOPS, **(fields or {"frequency": 1.2}))


def refused(match, key, function, *arguments, **fields):
    with pytest.raises(InputError, match=match) as caught:
        function(*arguments, **fields)
    assert caught.value.key == key and "\n" not in str(caught.value)


# ---- motion ratio


@pytest.mark.parametrize("name", RATIOS)
def test_component_travel_is_the_integral_of_the_ratio(name):
    ratio = RATIOS[name]
    points = [x for x in ratio.travel if abs(x) < 0.12]
    for x in (-0.115, -0.05, 0.0, 0.015, 0.11):
        inside = [p for p in points if min(0, x) < p < max(0, x)]
        assert float(ratio.component_travel(x)) == pytest.approx(
            quad(ratio.at, 0, x, points=inside or None, epsabs=1e-14)[0], abs=1e-12
        )


@pytest.mark.parametrize("name", RATIOS)
def test_travel_there_and_back(name):
    ratio = RATIOS[name]
    assert np.abs(ratio.wheel_travel(ratio.component_travel(X)) - X).max() < 1e-12


@given(st.lists(st.tuples(st.floats(1e-3, 0.05), st.floats(0.05, 3.0)), min_size=2, max_size=12))
def test_travel_there_and_back_for_any_ratio(steps):
    travel = np.cumsum([width for width, _ in steps]) - 0.1
    ratio = MotionRatio(travel=tuple(travel.tolist()), ratio=tuple(i for _, i in steps))
    x = np.linspace(travel[0] - 0.05, travel[-1] + 0.05, 57)
    assert np.abs(ratio.wheel_travel(ratio.component_travel(x)) - x).max() < 1e-9
    assert ratio.at(x).min() >= min(ratio.ratio) * (1 - 1e-12) and ratio.at(x).max() <= max(ratio.ratio) * (1 + 1e-12)


@pytest.mark.parametrize("name", RATIOS)
def test_forces_speeds_and_rates_there_and_back(name):
    ratio, force, rate = RATIOS[name], 4743 * np.exp(6 * X), 27e3 + 1e5 * X
    component = ratio.component_force(force, X)
    np.testing.assert_allclose(ratio.wheel_force(component, X), force, rtol=1e-12)
    np.testing.assert_allclose(ratio.wheel_rate(ratio.component_rate(rate, force, X), component, X), rate, rtol=1e-9)
    np.testing.assert_allclose(ratio.wheel_speed(ratio.component_speed(0.3, X), X), 0.3, rtol=1e-12)


@pytest.mark.parametrize("name", RATIOS)
def test_rate_is_the_derivative_of_force_over_component_travel(name):
    """With the term of di/dx: central differences of F_comp over s; the table's points, where it bends, are left
    out."""
    ratio, h = RATIOS[name], 1e-6
    x = np.array([x for x in X if all(abs(x - knot) > 1e-4 for knot in ratio.travel)])
    force, rate = 4743 * np.exp(6 * x), 6 * 4743 * np.exp(6 * x)
    ahead, behind = (ratio.component_force(4743 * np.exp(6 * (x + d)), x + d) for d in (h, -h))
    expected = (ahead - behind) / (ratio.component_travel(x + h) - ratio.component_travel(x - h))
    np.testing.assert_allclose(ratio.component_rate(rate, force, x), expected, rtol=1e-6)


def test_a_rising_ratio_stiffens_the_wheel_beyond_the_square():
    ratio = RATIOS["rising"]
    assert float(ratio.wheel_rate(40e3, 6500.0, 0.0)) > float(ratio.at(0.0)) ** 2 * 40e3
    assert float(RATIOS["constant"].wheel_rate(40e3, 6500.0, 0.0)) == pytest.approx(0.49 * 40e3, rel=1e-12)


@pytest.mark.parametrize(
    ("data", "match", "key"),
    [
        (0.0, "greater than 0", "ratio.0"),
        ({"ratio": -0.5}, "greater than 0", "ratio.0"),
        ({"ratio": [0.7, 0.8]}, "as many as travels", "ratio"),
        ({"ratio": 0.7, "travel": [0.0]}, "as many as travels", "ratio"),
        ({"ratio": [0.7, 0.8], "travel": [0.1, 0.1]}, "must increase strictly", "travel.1"),
        ({"ratio": [0.7, 0.8], "travel": [0, "20 N"]}, "wrong unit", "travel.1"),
        ({"raito": 0.7}, "did you mean 'ratio'", "raito"),
        ("0.7 m", "wrong unit", "ratio.0"),
        (True, "not a quantity", "ratio.0"),
    ],
)
def test_impossible_ratios(data, match, key):
    refused(match, key, validate, MotionRatio, data)


# ---- springs and dampers through the ratio


@pytest.mark.parametrize("name", RATIOS)
def test_virtual_work_of_the_spring_is_the_same_on_both_sides(name):
    """``∫ F_wheel dx = ∫ F_comp ds`` between any two positions: by the ratio to 1e-9, by the table of the component to
    3e-6."""
    ratio, spring = RATIOS[name], wheel_spring()
    component = spring_at_component(spring, ratio)

    def own_force(s):
        x = ratio.wheel_travel(s)
        return float(ratio.component_force(spring.force_at(x), x))

    for low, high in ((-0.1, 0.1), (-0.06, 0.02), (0.0, 0.09)):
        ends = ratio.component_travel([low, high])
        knots = [s for s in ratio.component_travel(ratio.travel) if ends[0] < s < ends[1]] or None
        expected = quad(lambda x: float(spring.force_at(x)), low, high, epsrel=1e-12)[0]
        assert quad(own_force, *ends, points=knots, epsrel=1e-11)[0] == pytest.approx(expected, rel=1e-9)
        s = np.linspace(*ends, 4001)
        assert np.trapezoid(component.force_at(s), s) == pytest.approx(expected, rel=3e-6)


@pytest.mark.parametrize("name", RATIOS)
@pytest.mark.parametrize("kind", [ConstantFrequencySpring, LinearSpring])
def test_spring_there_and_back(name, kind):
    """Exact at every point of the table and at the stops; between the points as good as the table."""
    ratio, spring = RATIOS[name], wheel_spring(kind)
    component = spring_at_component(spring, ratio)
    back = spring_at_wheel(component, ratio)
    x = ratio.wheel_travel(component.deflection)
    np.testing.assert_allclose(back.force_at(x), spring.force_at(x), rtol=1e-9)
    np.testing.assert_allclose(back.force_at(X), spring.force_at(X), rtol=1e-5)
    assert (back.stops.rebound, back.stops.compression) == pytest.approx((-0.1, 0.1), rel=1e-9)
    assert back.stops.rate == pytest.approx(STOPS.rate, rel=1e-9)


def test_component_spring_of_a_constant_ratio():
    component = spring_at_component(wheel_spring(LinearSpring, rate=27e3), RATIOS["constant"])
    assert float(component.force_at(0.0)) == pytest.approx(4743 / 0.7, rel=1e-12)
    np.testing.assert_allclose(component.rate_at([-0.06, 0.0, 0.06]), 27e3 / 0.49, rtol=1e-6)
    assert (component.stops.rebound, component.stops.compression) == pytest.approx((-0.07, 0.07))


def test_a_ratio_too_steep_for_its_spring():
    steep = validate(MotionRatio, {"travel": [-0.1, 0.1], "ratio": [0.3, 1.2]})
    refused(
        "would fall .* as it is compressed", "ratio", spring_at_component, wheel_spring(LinearSpring, rate=5e3), steep
    )
    refused("no preload", "spring", spring_at_component, LinearSpring(rate=27e3, stops=STOPS), RATIOS["constant"])


def test_damper_at_a_wheel_position():
    """Power is the same on both sides; friction and mount come along; the position matters where the ratio changes."""
    damper = ZonedDamper(rates=(3000, 600), limits=(0.2,), ratio="1:2", friction=25.0, mount={"rate": 4e5})
    ratio, v = RATIOS["rising"], np.array([-1.2, -0.3, -0.05, 0.0, 0.1, 0.2, 0.9, 3.0])
    for x in (-0.08, 0.0, 0.1):
        i, component = float(ratio.at(x)), damper_at_component(damper, ratio, x)
        np.testing.assert_allclose(component.force_at(i * v) * i * v, damper.force_at(v) * v, rtol=1e-12, atol=1e-12)
        assert component.friction == pytest.approx(25.0 / i) and component.mount.rate == pytest.approx(4e5 / i**2)
        back = damper_at_wheel(component, ratio, x)
        np.testing.assert_allclose(back.force_at(v), damper.force_at(v), rtol=1e-9, atol=1e-9)
        assert back.friction == pytest.approx(25.0) and back.mount.rate == pytest.approx(4e5)
    assert damper_at_component(damper, ratio, 0.1).force_at(0.1) < damper_at_component(damper, ratio, -0.1).force_at(
        0.1
    )


# ---- progressive springs


def test_auxiliary_springs_superimpose():
    spring = auxiliary_springs("20 N/mm", ["30 mm", "60 mm"], ["15 N/mm", "40 N/mm"], preload="4 kN", stops=STOPS)
    s = np.array([-0.1, 0.0, 0.029, 0.045, 0.0605, 0.1])
    expected = 4000 + 20e3 * s + 15e3 * np.maximum(0, s - 0.03) + 40e3 * np.maximum(0, s - 0.06)
    np.testing.assert_allclose(spring.force_at(s), expected, rtol=1e-9)
    np.testing.assert_allclose(spring.rate_at([-0.05, 0.02, 0.045, 0.08]), [20e3, 20e3, 35e3, 75e3], rtol=1e-6)


def test_an_auxiliary_spring_that_acts_in_the_design_position_shares_the_preload():
    spring = auxiliary_springs(20e3, -0.05, 10e3, preload=4000.0, stops=STOPS)
    assert float(spring.force_at(0.0)) == pytest.approx(4000.0)
    np.testing.assert_allclose(spring.rate_at([-0.08, 0.0]), [20e3, 30e3], rtol=1e-6)


def test_two_springs_in_series_until_one_is_solid():
    """c1 c2/(c1 + c2), then the other's rate; the kink at the force c1 b1, which neither side misses."""
    c1, c2, b1 = 60e3, 90e3, 0.1
    spring = series_springs([c1, c2], [b1, None], preload=5000.0, stops=STOPS)
    np.testing.assert_allclose(spring.rate_at([-0.09, 0.0, 0.02, 0.04, 0.09]), [36e3, 36e3, 36e3, c2, c2], rtol=1e-6)
    bind = (c1 * b1 - 5000) / 36e3
    assert float(spring.force_at(bind)) == pytest.approx(c1 * b1, rel=1e-9)
    assert float(spring.deflection_at(9000.0)) == pytest.approx(bind + 3000 / c2, rel=1e-6)
    order = series_springs([c2, c1], [None, b1], preload=5000.0, stops=STOPS)
    assert order == spring


def test_a_helical_spring_of_one_pitch_is_linear():
    spring = helical_spring("14 mm", "120 mm", 7.0, "60 mm", preload=5000.0, stops=STOPS, shear_modulus=78.5e9)
    np.testing.assert_allclose(spring.rate_at([-0.09, 0, 0.09]), 78.5e9 * 0.014**4 / (8 * 0.12**3 * 7), rtol=1e-6)


def test_coils_become_solid_one_after_another():
    """Each segment at the force of its own gap, ``G d⁴/(8 D³) (p - d)``, then fewer turns are active."""
    turn = 78.5e9 * 0.014**4 / (8 * 0.12**3)
    closing = [turn * (pitch - 0.014) for pitch in (0.036, 0.045)]
    spring = helical_spring(
        0.014, 0.12, [2, 1.5, 5], [0.036, 0.045, 0.08], preload=4000.0, stops=STOPS, shear_modulus=78.5e9
    )
    for force, turns in (
        (closing[0] - 100, 8.5),
        (closing[0] + 100, 6.5),
        (closing[1] - 100, 6.5),
        (closing[1] + 100, 5.0),
    ):
        assert float(spring.rate_at(spring.deflection_at(force))) == pytest.approx(turn / turns, rel=1e-6)


def test_segments_of_equal_pitch_are_one_spring():
    halves = helical_spring(0.014, 0.12, [3, 4], [0.06, 0.06], preload=5000.0, stops=STOPS)
    whole = helical_spring(0.014, 0.12, 7, 0.06, preload=5000.0, stops=STOPS)
    np.testing.assert_allclose(halves.force_at(X), whole.force_at(X), rtol=1e-9)


def test_a_barrel_closes_its_wide_coils_first():
    """Equal pitch and wire: the wide, soft coils are solid before the narrow ones, so the spring stiffens."""
    spring = helical_spring(
        "14 mm", ["130 mm", "100 mm"], [3, 4], "55 mm", preload=6500.0, stops=Stops(rebound=-0.1, compression=0.06)
    )
    rates = spring.rate_at([-0.05, 0.055])
    compliance = [8 * D**3 * n / (78.5e9 * 0.014**4) for D, n in ((0.13, 3), (0.1, 4))]
    np.testing.assert_allclose(rates, [1 / sum(compliance), 1 / compliance[1]], rtol=1e-6)


HELIX = {
    "wire_diameter": 0.014,
    "coil_diameter": 0.12,
    "turns": [2, 5],
    "pitch": [0.036, 0.06],
    "preload": 4000.0,
    "stops": STOPS,
}


@pytest.mark.parametrize(
    ("change", "match", "key"),
    [
        ({"turns": [2, 0]}, "greater than 0", "turns.1"),
        ({"turns": []}, "give one or more", "turns"),
        ({"pitch": [0.036, 0.06, 0.1]}, "give 2", "pitch"),
        ({"pitch": [0.036, "13 mm"]}, "exceed the wire", "pitch.1"),
        ({"coil_diameter": "10 mm"}, "exceed the wire", "coil_diameter"),
        ({"wire_diameter": "14 N"}, "wrong unit", "wire_diameter"),
        ({"pitch": [0.036, 0.04]}, "all coils are solid at", "stops.compression"),
        ({"preload": 40e3}, "all coils are solid at", "preload"),
        ({"preload": 1000.0}, "unloaded at", "stops.rebound"),
        ({"preload": float("nan")}, "not a finite number", "preload"),
    ],
)
def test_impossible_helical_springs(change, match, key):
    refused(match, key, helical_spring, **{**HELIX, **change})


def test_impossible_combinations_of_springs():
    refused("unloaded at", "stops.rebound", auxiliary_springs, 60e3, [0.03], [1e4], preload=4000.0, stops=STOPS)
    refused("give 2", "rates", auxiliary_springs, 20e3, [0.03, 0.05], [1e4], preload=4000.0, stops=STOPS)
    refused("wrong unit", "engagements", auxiliary_springs, 20e3, ["3 kg"], [1e4], preload=4000.0, stops=STOPS)
    refused("one for each of 2 rates", "travels", series_springs, [6e4, 9e4], [0.1], preload=4000.0, stops=STOPS)
    refused("greater than 0", "travels.0", series_springs, [6e4, 9e4], [-0.1, None], preload=4000.0, stops=STOPS)


# ---- hydraulic dampers

OIL = {"viscosity": 0.012}
CHANNEL = Laminar(length=0.03, radius=0.0006, **OIL)
HOLE = Orifice(area=1.5e-5, coefficient=0.7, density=860.0)
VALVE = BlowOff(opening_pressure="15 bar", full_pressure="40 bar", area="16 mm^2")
CIRCUITS = {
    "laminar": CHANNEL,
    "orifice": HOLE,
    "series": Series(CHANNEL, HOLE),
    "parallel": Parallel(CHANNEL, HOLE),
    "bleed and blow-off": Parallel(Series(CHANNEL, HOLE), VALVE),
    "nested": Series(Parallel(CHANNEL, VALVE, CHANNEL), Parallel(HOLE, Series(HOLE, CHANNEL))),
}


@pytest.mark.parametrize("name", CIRCUITS)
def test_flow_and_pressure_are_inverse_and_rise(name):
    circuit = CIRCUITS[name]
    flows = np.geomspace(1e-8, 1e-3, 60)
    pressures = np.array([circuit.pressure(q) for q in flows])
    np.testing.assert_allclose([circuit.flow(p) for p in pressures], flows, rtol=1e-9)
    assert np.diff(pressures).min() > 0 and circuit.pressure(0.0) == circuit.flow(0.0) == 0.0


def test_textbook_resistances():
    assert CHANNEL.pressure(2e-5) == pytest.approx(8 * 0.012 * 0.03 * 2e-5 / (math.pi * 0.0006**4), rel=1e-12)
    assert HOLE.pressure(2e-4) == pytest.approx(860 / 2 * (2e-4 / (0.7 * 1.5e-5)) ** 2, rel=1e-12)
    assert VALVE.flow(1.4e6) == 0.0 and VALVE.pressure(1e-12) == pytest.approx(1.5e6, rel=1e-3)
    assert VALVE.flow(5e6) == pytest.approx(0.7 * 16e-6 * math.sqrt(2 * 5e6 / 860), rel=1e-12)
    assert VALVE.flow(4e6 * (1 - 1e-9)) == pytest.approx(VALVE.flow(4e6 * (1 + 1e-9)), rel=1e-7), (
        "fully open without a jump"
    )


def test_combinations_of_equal_resistances():
    flow = 5e-5
    assert Series(CHANNEL, CHANNEL).pressure(flow) == pytest.approx(2 * CHANNEL.pressure(flow), rel=1e-12)
    assert Parallel(CHANNEL, CHANNEL).pressure(flow) == pytest.approx(CHANNEL.pressure(flow) / 2, rel=1e-9)
    assert Parallel(HOLE, HOLE).pressure(flow) == pytest.approx(HOLE.pressure(flow) / 4, rel=1e-9)
    assert Series(CHANNEL, HOLE).pressure(flow) == pytest.approx(
        CHANNEL.pressure(flow) + HOLE.pressure(flow), rel=1e-12
    )


def test_a_laminar_damper_is_linear_and_an_orifice_damper_square():
    ring, rod = ring_area("36 mm", "22 mm"), rod_area("22 mm")
    assert ring == pytest.approx(math.pi / 4 * (0.036**2 - 0.022**2)) and ring + rod == pytest.approx(
        math.pi / 4 * 0.036**2
    )
    linear = hydraulic_damper(CHANNEL, CHANNEL, compression_area=rod, rebound_area=ring)
    slope = 8 * 0.012 * 0.03 / (math.pi * 0.0006**4)
    v = np.array([0.01, 0.13, 1.0, 4.0])
    np.testing.assert_allclose(linear.force_at(v), rod**2 * slope * v, rtol=1e-9)
    np.testing.assert_allclose(linear.force_at(-v), -(ring**2) * slope * v, rtol=1e-9)
    square = hydraulic_damper(HOLE, HOLE, compression_area=rod, rebound_area=ring)
    v = np.array(square.speed)[square.speed.index(max(square.speed)) - 40 :: 13]
    np.testing.assert_allclose(square.force_at(v), rod * HOLE.pressure(1.0) * (rod * v) ** 2, rtol=1e-9)
    between = np.linspace(0.1, 1.4, 500)
    np.testing.assert_allclose(square.force_at(between), rod * HOLE.pressure(1.0) * (rod * between) ** 2, rtol=5e-3)


def test_a_blow_off_valve_makes_the_damper_degressive():
    """Before p0 the damper is that of its bleed; after it the slope falls."""
    bleed, area = CIRCUITS["series"], ring_area("36 mm", "22 mm")
    damper = hydraulic_damper(
        CIRCUITS["bleed and blow-off"], bleed, compression_area=area, rebound_area=area, friction=20.0, mount=4e5
    )
    opening = bleed.flow(1.5e6) / area
    below, above = np.linspace(0.0, 0.95 * opening, 20), np.linspace(1.1 * opening, 1.5, 20)
    np.testing.assert_allclose(damper.force_at(below), -damper.force_at(-below), rtol=1e-3, atol=0.1)
    assert np.all(damper.force_at(above) < -damper.force_at(-above))
    assert damper.friction == 20.0 and damper.mount.rate == 4e5


def test_impossible_dampers():
    areas = {"compression_area": 4e-4, "rebound_area": 6e-4}
    refused(r"shut up to 600 N \(15.0 bar\)", "compression", hydraulic_damper, VALVE, HOLE, **areas)
    refused("shut up to 900 N", "rebound", hydraulic_damper, HOLE, Parallel(VALVE, VALVE), **areas)
    refused("shut", "rebound", hydraulic_damper, HOLE, Series(VALVE, HOLE), **areas)
    refused("greater than 0", "rebound_area", hydraulic_damper, HOLE, HOLE, compression_area=4e-4, rebound_area=0)
    refused("greater than 0", "radius", Laminar, length=0.03, radius=-1e-3)
    refused("wrong unit", "area", Orifice, area="12 mm")
    refused("exceed the opening pressure", "full_pressure", BlowOff, "20 bar", "10 bar", "5 mm^2")
    refused("below the piston", "rod_diameter", ring_area, "20 mm", "22 mm")
    refused("one after another", "Series", Series)


# ---- on the sheet


@pytest.fixture
def curve():
    overrides = {"rear.spring_ratio": RISING, "rear.damper_ratio": {"ratio": 0.8}}
    return characteristic("rear axle", load_vehicle("chapter3", "nonlinear", overrides).axle("rear"))


def test_characteristic_of_the_components_balances_the_work_of_the_wheel(curve):
    spring, damper = curve.component_spring, curve.component_damper
    inside = np.isfinite(curve.spring_rate)
    wheel = np.trapezoid(curve.spring_force[inside], curve.deflection[inside])
    assert np.trapezoid(spring.force, spring.travel) == pytest.approx(wheel, rel=1e-5)
    np.testing.assert_allclose(spring.rate[1:-1], np.gradient(spring.force, spring.travel)[1:-1], rtol=5e-3)
    np.testing.assert_allclose(damper.force * damper.speed, curve.damper_force * curve.speed, rtol=1e-12, atol=1e-12)
    assert damper.ratio == 0.8 and spring.ratio == pytest.approx(float(RATIOS["rising"].at(0.0)))


def test_sheet_shows_the_components_where_a_ratio_is_given_and_nothing_new_elsewhere(curve, tmp_path):
    plain = characteristic("rear axle", load_vehicle("chapter3", "linear").axle("rear"))
    assert plain.component_spring is None and plain.component_damper is None
    new = {"component_spring_force_characteristic", "component_damper_force_characteristic"}
    without, both = (
        characteristic_plots({"linear": [plain]}),
        characteristic_plots({"linear": [plain], "ratio": [curve]}),
    )
    assert not new & set(without) and set(both) == set(without) | new
    assert "spring travel [mm]" in both["component_spring_force_characteristic"]
    assert "damper speed, compression positive [m/s]" in both["component_damper_force_characteristic"]
    html = write_sheet("t", {"linear": [plain], "ratio": [curve]}, tmp_path / "sheet.html").read_text(encoding="utf-8")
    row = re.search(r"<th>force of the spring itself at KO</th>.*?</tr>", html)[0]
    assert ">–<" in row and f">{4.743 / curve.component_spring.ratio:.3f}<" in row
    assert "itself" not in write_sheet("t", {"linear": [plain]}, tmp_path / "plain.html").read_text(encoding="utf-8")


def test_a_wrong_ratio_in_a_car_is_told_with_its_place():
    refused(
        "must increase strictly",
        "rear.spring_ratio.travel.1",
        load_vehicle,
        "chapter3",
        "linear",
        {"rear.spring_ratio": {"ratio": [0.7, 0.8], "travel": [0.1, 0.0]}},
    )


def test_the_example_runs_as_a_program(tmp_path):
    example, sheet = Path(__file__).parents[2] / "examples" / "component_level.py", tmp_path / "sheet.html"
    result = subprocess.run([sys.executable, example, sheet], capture_output=True, text=True, timeout=120, check=False)
    assert result.returncode == 0, result.stderr
    car = {
        name: float(peak) for name, peak in re.findall(r"car (asked|laid out) *: acceleration +([\d.]+)", result.stdout)
    }
    assert car["asked"] == pytest.approx(7.89, abs=0.05) and car["laid out"] == pytest.approx(car["asked"], rel=0.05)
    assert "rate F/v of the damper itself" in sheet.read_text(encoding="utf-8")
