"""What every force element must do, whatever its kind: carry, resist, never drive, and be the same law compiled."""

from __future__ import annotations

import ctypes
import math
from typing import Literal

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.interpolate import PchipInterpolator

from susp_mj.compiled import laws as compiled_laws
from susp_mj.description import validate
from susp_mj.elements import (
    DAMPERS,
    FORCE,
    LAWS,
    SPRINGS,
    TYRES,
    AntiRollBar,
    Damper,
    HydraulicDamper,
    LinkageFriction,
    Overturning,
    Spring,
    SpringDamper,
    Stops,
    TableDamper,
    TableSpring,
    ZonedDamper,
)
from susp_mj.elements.dampers import DIRECT_DAMPER, MOUNTED_DAMPER
from susp_mj.errors import InputError

STOPS = {"rebound": -0.09, "compression": 0.07, "rate": 3e5}
PRELOAD, FREQUENCY, G = 4000.0, 1.15, 9.81
W2 = (2 * math.pi * FREQUENCY) ** 2
SPRING_FIELDS = {
    "linear": {"frequency": FREQUENCY, "preload": PRELOAD},
    "constant_frequency": {"frequency": FREQUENCY, "preload": PRELOAD},
    "progressive": {
        "frequency": FREQUENCY,
        "preload": PRELOAD,
        "rebound_force": 1800.0,
        "compression_force": 9000.0,
        "progressive_from": 0.02,
        "exponent": 2.2,
    },
    "table": {"deflection": [-0.06, -0.02, 0.0, 0.03, 0.05], "force": [2200.0, 3500.0, 4000.0, 5200.0, 7400.0]},
}
DAMPER_FIELDS = {
    "zoned": {"rates": [3000.0, 900.0, 1400.0], "limits": [0.12, 0.5], "ratio": "1:2"},
    "table": {"speed": [-1.0, -0.3, -0.05, 0.1, 0.4, 0.9], "force": [-2600.0, -1500.0, -500.0, 300.0, 700.0, 1000.0]},
}
TYRE_FIELDS = {"spring": {"rate": 176e3, "static_load": 5000.0}}
# Laws of elements that belong to no registry of kinds, and parameters as an element hands them over.
EXTRA = [
    Stops(**STOPS),
    LinkageFriction(force=150.0),
    AntiRollBar(rate=25286.0),
    Overturning(moment=10245.0),
    SpringDamper(stiffness=1e7, damping=2e4),
]


def spring_of(kind):
    return SPRINGS[kind].model_validate({"kind": kind, "stops": STOPS, **SPRING_FIELDS[kind]})


def damper_of(kind, **more):
    return DAMPERS[kind].model_validate({"kind": kind, **DAMPER_FIELDS[kind], **more})


def dampers():
    """Every kind, with and without friction and mount."""
    return [
        pytest.param(
            damper_of(kind, friction=friction, mount=mount), id=f"{kind} friction={friction} mount={bool(mount)}"
        )
        for kind in DAMPER_FIELDS
        for friction in (0.0, 40.0)
        for mount in (None, {"rate": 4e5})
    ]


springs = pytest.mark.parametrize("spring", [pytest.param(spring_of(kind), id=kind) for kind in SPRING_FIELDS])
each_damper = pytest.mark.parametrize("damper", dampers())
speeds = st.floats(-4.0, 4.0)
deflections = st.floats(-0.15, 0.15)


def test_every_registered_kind_is_tested():
    tried = {"SPRING_FIELDS": (SPRINGS, SPRING_FIELDS), "DAMPER_FIELDS": (DAMPERS, DAMPER_FIELDS)}
    for name, (kinds, fields) in (tried | {"TYRE_FIELDS": (TYRES, TYRE_FIELDS)}).items():
        assert set(kinds) == set(fields), f"{name} needs the fields of one of each kind"


# ---- springs


@springs
def test_spring_carries_its_preload(spring):
    assert float(spring.force_at(0.0)) == PRELOAD


@springs
@given(a=deflections, b=deflections)
def test_spring_is_monotone(spring, a, b):
    low, high = sorted((a, b))
    assert float(spring.force_at(low)) <= float(spring.force_at(high))


@springs
def test_spring_rises_strictly_between_its_stops(spring):
    assert np.diff(spring.force_at(np.linspace(-0.09, 0.07, 801))).min() > 0


@springs
def test_spring_is_continuous(spring):
    x = np.linspace(-0.12, 0.12, 24001)
    steepest = 1.05 * float(np.max(spring.rate_at(np.linspace(-0.0899, 0.0699, 801))))
    assert np.abs(np.diff(spring.force_at(x))).max() <= steepest * (x[1] - x[0])


@springs
def test_spring_force_is_held_beyond_the_stops(spring):
    at_stops = spring.force_at([-0.09, 0.07])
    np.testing.assert_array_equal(spring.force_at([-0.2, 0.2]), at_stops)


@springs
def test_spring_stores_what_it_takes(spring):
    """The force depends on the deflection alone: no speed, no state, so no energy in a closed loop."""
    x = np.linspace(-0.1, 0.1, 41)
    np.testing.assert_array_equal(spring.evaluate(x, 1.5, 0.3), spring.evaluate(x))


@springs
@pytest.mark.parametrize("share", [0.9, 1.0, 1.2])
def test_deflection_at_is_the_inverse(spring, share):
    x = spring.deflection_at(share * PRELOAD)
    assert float(spring.force_at(x)) == pytest.approx(share * PRELOAD, rel=1e-9)
    assert np.sign(round(x, 9)) == np.sign(share - 1.0)


@springs
def test_load_beyond_the_travel_is_refused(spring):
    top = float(spring.force_at(0.07))
    with pytest.raises(ValueError, match="cannot carry"):
        spring.deflection_at(top + 1.0)


def test_linear_spring_formula():
    spring = spring_of("linear")
    x = np.linspace(-0.09, 0.07, 33)
    np.testing.assert_allclose(spring.force_at(x), PRELOAD + PRELOAD / G * W2 * x, rtol=1e-14)
    assert float(spring.frequency_at(0.0)) == pytest.approx(FREQUENCY, rel=1e-6)
    by_rate = SPRINGS["linear"].model_validate({"kind": "linear", "stops": STOPS, "rate": 25e3, "preload": 4000})
    np.testing.assert_allclose(by_rate.force_at(x), 4000 + 25e3 * x, rtol=1e-14)


@given(x=st.floats(-0.0899, 0.0699))
def test_constant_frequency_at_every_load(x):
    """``k g / F = w²``: the mass that the spring carries at x swings at the same frequency everywhere."""
    spring = spring_of("constant_frequency")
    assert float(spring.rate_at(x)) * G / float(spring.force_at(x)) == pytest.approx(W2, rel=1e-6)
    assert float(spring.force_at(x)) == pytest.approx(PRELOAD * math.exp(W2 * x / G), rel=1e-14)


def test_progressive_spring_formula():
    spring = spring_of("progressive")
    assert float(spring.force_at(-0.09)) == pytest.approx(1800.0, rel=1e-13)
    assert float(spring.force_at(0.07)) == pytest.approx(9000.0, rel=1e-13)
    assert float(spring.force_at(-0.045)) == pytest.approx((1800.0 + PRELOAD) / 2, rel=1e-13), "straight in rebound"
    x = np.linspace(0.0, 0.07, 29)
    base = PRELOAD * np.exp(W2 * x / G)
    lacking = 9000.0 - base[-1]
    expected = base + lacking * np.where(x > 0.02, np.clip((x - 0.02) / 0.05, 0, None) ** 2.2, 0.0)
    np.testing.assert_allclose(spring.force_at(x), expected, rtol=1e-13)


def test_table_spring_goes_through_its_points():
    fields = SPRING_FIELDS["table"]
    spring = spring_of("table")
    np.testing.assert_array_equal(spring.force_at(fields["deflection"]), fields["force"])
    inside = np.linspace(-0.06, 0.05, 1101)
    np.testing.assert_allclose(
        spring.force_at(inside), PchipInterpolator(fields["deflection"], fields["force"])(inside), rtol=1e-13
    )


def test_table_spring_continues_straight():
    """Beyond the table: the end slope, up to the stops."""
    fields = SPRING_FIELDS["table"]
    spring, curve = spring_of("table"), PchipInterpolator(fields["deflection"], fields["force"])
    for outside, end in ((np.linspace(-0.09, -0.06, 7), -0.06), (np.linspace(0.05, 0.07, 7), 0.05)):
        np.testing.assert_allclose(
            spring.force_at(outside), curve(end) + curve.derivative()(end) * (outside - end), rtol=1e-12
        )


def test_table_spring_of_two_points_is_a_line():
    spring = TableSpring(deflection=(-0.05, 0.05), force=(3000, 5000), stops=Stops(**STOPS))
    x = np.linspace(-0.09, 0.07, 33)
    np.testing.assert_allclose(spring.force_at(x), 4000 + 20e3 * x, rtol=1e-13)


@given(
    gaps=st.lists(st.tuples(st.floats(0.002, 0.05), st.floats(1.0, 4000.0)), min_size=2, max_size=8),
    places=st.lists(st.floats(-0.3, 0.3), min_size=2, max_size=10),
)
def test_any_table_spring_is_monotone(gaps, places):
    x, f = np.cumsum([(-0.1, 500.0), *gaps], axis=0).T
    spring = TableSpring(deflection=tuple(x), force=tuple(f), stops=Stops(rebound=-0.3, compression=0.4))
    forces = spring.force_at(np.sort(places))
    assert np.diff(forces).min() >= -1e-9
    np.testing.assert_allclose(spring.force_at(x), f, rtol=1e-12)


def test_at_preload_leaves_a_given_preload_alone():
    spring = spring_of("linear")
    assert spring.at_preload(1.0) is spring
    open_spring = SPRINGS["linear"].model_validate({"kind": "linear", "stops": STOPS, "rate": 25e3})
    assert float(open_spring.at_preload(3210.0).force_at(0.0)) == 3210.0


# ---- stops


@given(x=st.floats(-0.3, 0.3))
def test_stops(x):
    beyond = x - 0.07 if x > 0.07 else x + 0.09 if x < -0.09 else 0.0
    force = float(Stops(**STOPS).evaluate(x))
    assert force == pytest.approx(3e5 * beyond, rel=1e-14)
    assert (force == 0.0) == (-0.09 <= x <= 0.07)


@springs
def test_stops_add_to_the_held_spring_force(spring):
    """Beyond a stop the sum rises from the spring's force at the stop with the stop's own stiffness."""
    for stop, x in ((0.07, 0.08), (-0.09, -0.1)):
        total = float(spring.force_at(x)) + float(spring.stops.evaluate(x))
        assert total == pytest.approx(float(spring.force_at(stop)) + 3e5 * (x - stop), rel=1e-13)


# ---- dampers and friction


@each_damper
def test_damper_is_still_at_rest(damper):
    assert float(damper.force_at(0.0)) == 0.0
    assert float(damper.evaluate(0.03, 0.0, 0.03)) == 0.0


@each_damper
@given(a=speeds, b=speeds)
def test_damper_is_strictly_monotone(damper, a, b):
    low, high = sorted((a, b))
    if high - low > 1e-9:
        assert float(damper.force_at(low)) < float(damper.force_at(high))


@each_damper
@given(v=speeds)
def test_damper_never_drives(damper, v):
    assert float(damper.force_at(v)) * v >= 0.0


@each_damper
@given(v=speeds)
def test_damper_characteristic_is_invertible(damper, v):
    assert float(damper.speed_at(damper.force_at(v))) == pytest.approx(v, rel=1e-12, abs=1e-15)


@each_damper
@given(f=st.floats(-2e4, 2e4))
def test_damper_inverse_is_invertible(damper, f):
    assert float(damper.force_at(damper.speed_at(f))) == pytest.approx(f, rel=1e-12, abs=1e-12)


@each_damper
def test_damper_is_continuous(damper):
    v = np.linspace(-1.5, 1.5, 30001)
    assert np.abs(np.diff(damper.force_at(v))).max() < 1.01e4 * (v[1] - v[0])


@pytest.mark.parametrize("damper", [p for p in dampers() if p.values[0].active_law is DIRECT_DAMPER])
@given(v=speeds)
def test_direct_damper_force(damper, v):
    """Without a mount: the hydraulic force, and friction regularised like that of the linkage."""
    expected = float(damper.force_at(v)) + damper.friction * 2 / math.pi * math.atan(201.7 * v)
    force = float(damper.evaluate(0.02, v, 0.5))
    assert force == pytest.approx(expected, rel=1e-13, abs=1e-12)
    assert force * v >= 0.0


@pytest.mark.parametrize("damper", [p for p in dampers() if p.values[0].active_law is MOUNTED_DAMPER])
@given(x=deflections, y=deflections)
def test_mounted_damper(damper, x, y):
    """The mount carries ``k1 (x - y)``; the rod sticks within its friction, else moves as the inverse tells, and spends
    energy."""
    p = damper.parameters()
    force = MOUNTED_DAMPER.function(x, 0.7, y, p)
    assert force == pytest.approx(4e5 * (x - y), rel=1e-14)
    rod = MOUNTED_DAMPER.state_rate(x, 0.7, y, p)
    excess = abs(force) - damper.friction
    if excess <= 0:
        assert rod == 0.0
    else:
        assert rod == pytest.approx(
            math.copysign(float(damper.speed_at(math.copysign(excess, force))), force), rel=1e-12
        )
        assert float(damper.force_at(rod)) + math.copysign(damper.friction, rod) == pytest.approx(
            force, rel=1e-9, abs=1e-9
        )
    assert force * rod >= 0.0


def test_rod_with_friction_sticks():
    damper = damper_of("zoned", friction=40.0, mount={"rate": 4e5})
    p = damper.parameters()
    assert MOUNTED_DAMPER.state_rate(0.99e-4, 0.0, 0.0, p) == 0.0
    assert MOUNTED_DAMPER.state_rate(1.01e-4, 0.0, 0.0, p) == pytest.approx(0.4 / 2000.0, rel=1e-9)
    assert MOUNTED_DAMPER.state_rate(-1.01e-4, 0.0, 0.0, p) == pytest.approx(-0.4 / 4000.0, rel=1e-9)


def test_ratio_shares_the_average_rate():
    """ "1:2" and 3000 N s/m give 2000 in compression and 4000 in rebound."""
    damper = ZonedDamper.model_validate({"rates": ["3000 N s/m"], "ratio": "1:2"})
    assert float(damper.force_at(1.0)) == pytest.approx(2000.0, rel=1e-14)
    assert float(damper.force_at(-1.0)) == pytest.approx(-4000.0, rel=1e-14)


@given(
    rates=st.lists(st.floats(100.0, 9000.0), min_size=1, max_size=3),
    ratio=st.tuples(st.floats(0.2, 5.0), st.floats(0.2, 5.0)),
    widths=st.tuples(st.floats(0.02, 0.3), st.floats(0.02, 0.3)),
    v=speeds,
)
def test_zones(rates, ratio, widths, v):
    """Sum over the zones of rate times the part of the speed inside; the last zone never ends."""
    limits = list(np.cumsum(widths)[: len(rates) - 1])
    damper = ZonedDamper(rates=tuple(rates), limits=tuple(limits), ratio=ratio)
    share = 2 * (ratio[0] if v > 0 else ratio[1]) / sum(ratio)
    edges = [0.0, *limits, math.inf]
    expected = math.copysign(
        sum(share * r * max(0.0, min(abs(v), b) - a) for r, a, b in zip(rates, edges, edges[1:], strict=False)), v
    )
    assert float(damper.force_at(v)) == pytest.approx(expected, rel=1e-12, abs=1e-12)
    average = (float(damper.force_at(abs(v))) - float(damper.force_at(-abs(v)))) / 2
    assert average == pytest.approx(abs(expected) / share, rel=1e-12, abs=1e-12)


def test_zone_limits_are_exact():
    damper = damper_of("zoned")
    np.testing.assert_allclose(damper.force_at([0.12, 0.5]), [2000 * 0.12, 2000 * 0.12 + 600 * 0.38], rtol=1e-13)
    np.testing.assert_allclose(damper.force_at([-0.12, -0.5]), [-4000 * 0.12, -4000 * 0.12 - 1200 * 0.38], rtol=1e-13)


def test_table_damper_goes_through_its_points_and_the_origin():
    fields = DAMPER_FIELDS["table"]
    damper = damper_of("table")
    np.testing.assert_allclose(damper.force_at(fields["speed"]), fields["force"], rtol=1e-13)
    assert float(damper.force_at(0.05)) == pytest.approx(150.0, rel=1e-13)
    assert float(damper.force_at(-0.025)) == pytest.approx(-250.0, rel=1e-13)
    assert float(damper.force_at(1.9)) == pytest.approx(1000 + 600 * 1.0, rel=1e-13), "the last slope goes on"
    assert float(damper.force_at(-2.0)) == pytest.approx(-2600 - 1100 / 0.7, rel=1e-13)


def test_table_damper_may_hold_the_origin_itself():
    with_origin = TableDamper(speed=(-1.0, 0.0, 1.0), force=(-2000.0, 0.0, 900.0))
    without = TableDamper(speed=(-1.0, 1.0), force=(-2000.0, 900.0))
    v = np.linspace(-2, 2, 41)
    np.testing.assert_array_equal(with_origin.force_at(v), without.force_at(v))


def test_time_constant_of_mount_and_damper():
    """The slowest slope over the mount's rate: 600 N s/m in compression of the second zone."""
    assert damper_of("zoned", mount={"rate": 4e5}).time_constant() == pytest.approx(600 / 4e5, rel=1e-12)
    assert damper_of("zoned").time_constant() is None


@given(v=speeds)
def test_linkage_friction(v):
    force = float(LinkageFriction(force=150.0).evaluate(0.01, v))
    assert force == pytest.approx(150.0 * 2 / math.pi * math.atan(201.7 * v), rel=1e-14)
    assert force * v >= 0.0
    assert abs(force) < 150.0
    assert force == -float(LinkageFriction(force=150.0).evaluate(0.01, -v))


def test_linkage_friction_is_90_percent_at_creep():
    assert float(LinkageFriction(force=1.0).evaluate(speed=0.01 * 2 * math.pi * 0.5)) == pytest.approx(0.9, abs=0.001)


# ---- tyres


@pytest.mark.parametrize("kind", TYRES)
@given(d=st.floats(-0.1, 0.1))
def test_tyre_pushes_and_never_pulls(kind, d):
    tyre = TYRES[kind].model_validate({"kind": kind, **TYRE_FIELDS[kind]})
    force = float(tyre.evaluate(d))
    assert force >= 0.0
    assert force == pytest.approx(max(0.0, 5000.0 + 176e3 * d), rel=1e-13, abs=1e-9)
    assert float(tyre.evaluate(d + 0.001)) >= force


@pytest.mark.parametrize("kind", TYRES)
def test_tyre_carries_its_static_load(kind):
    fields = {key: value for key, value in TYRE_FIELDS[kind].items() if key != "static_load"}
    tyre = TYRES[kind].model_validate({"kind": kind, **fields})
    assert float(tyre.at_static_load(4321.0).evaluate(0.0)) == 4321.0


# ---- roll


@given(left=deflections, right=deflections)
def test_anti_roll_bar(left, right):
    """Equal and opposite on both wheels, nothing in heave, and a roll moment of ``c t²/2`` per radian."""
    rate, track = 25286.0, 1.4
    bar = AntiRollBar(rate=rate)
    on_left, on_right = float(bar.evaluate(left - right)), float(bar.evaluate(right - left))
    assert on_left == -on_right
    assert on_left == pytest.approx(rate * (left - right) / 2, rel=1e-14)
    roll = (left - right) / track
    assert (on_left - on_right) * track / 2 == pytest.approx(rate * track**2 / 2 * roll, rel=1e-12, abs=1e-9)
    assert float(bar.evaluate(0.0, 3.0, 2.0)) == 0.0


@given(roll=st.floats(-0.2, 0.2))
def test_gravity_pulls_a_rolling_body_further(roll):
    moment = float(Overturning(moment=10245.0).evaluate(roll, 5.0))
    assert moment == pytest.approx(-10245.0 * roll, rel=1e-14)
    assert moment * roll <= 0.0


@given(deviation=st.floats(-0.1, 0.1), rate=speeds)
def test_rig_restores(deviation, rate):
    force = float(SpringDamper(stiffness=1e7, damping=2e4).evaluate(deviation, rate))
    assert force == pytest.approx(1e7 * deviation + 2e4 * rate, rel=1e-12, abs=1e-6)


# ---- compiled laws


def samples():
    """Law number -> parameter sets, from the elements that use the law."""
    elements = [spring_of(kind) for kind in SPRING_FIELDS] + [p.values[0] for p in dampers()] + EXTRA
    elements += [TYRES[kind].model_validate({"kind": kind, **TYRE_FIELDS[kind]}) for kind in TYRE_FIELDS]
    found = {}
    for element in elements:
        found.setdefault(element.active_law.number, []).append(element.parameters())
    return found


def test_every_registered_law_is_compared():
    assert set(samples()) == {number for number, law in LAWS.items() if law.role == FORCE}


FORCE_LAWS = [pytest.param(number, id=law.name) for number, law in LAWS.items() if law.role == FORCE]


def test_law_numbers_are_unique_and_stable():
    """Files hold the number, so it may not depend on the order or the machine."""
    assert len({law.name for law in LAWS.values()}) == len(LAWS)
    assert all(0 < number < 4096 and LAWS[number].number == number for number in LAWS)


@pytest.mark.parametrize("number", FORCE_LAWS)
def test_compiled_law_is_the_python_law(number):
    law = LAWS[number]
    compiled_laws.compile_laws([(number, law.role)])
    prototype = ctypes.CFUNCTYPE(ctypes.c_double, *[ctypes.c_double] * 3, ctypes.POINTER(ctypes.c_double))
    pairs = [(law.function, int(compiled_laws.TABLES["force"][number]))]
    if law.state_rate is not None:
        pairs.append((law.state_rate, int(compiled_laws.TABLES["state_rate"][number])))
    generator = np.random.default_rng(20240229)
    parameter_sets = samples()[number]
    for python, address in pairs:
        assert address != 0
        machine = prototype(address)
        for parameters in parameter_sets:
            memory = (ctypes.c_double * len(parameters))(*parameters)
            x = np.concatenate([generator.uniform(-0.15, 0.15, 150), [0.0, -0.09, 0.07, 0.02, -0.06, 0.05, 0.2, -0.2]])
            v = np.concatenate([generator.uniform(-2, 2, 150), [0.0, 0.12, -0.12, 0.5, -0.5, 1.0, -1.0, 1e-6]])
            y = x + generator.normal(0, 1e-3, len(x))
            expected = np.array([python(*each, parameters) for each in zip(x, v, y, strict=True)])
            got = np.array([machine(*each, memory) for each in zip(x, v, y, strict=True)])
            np.testing.assert_allclose(got, expected, rtol=1e-15, atol=0)


# ---- bad input


@pytest.mark.parametrize(
    ("base", "fields", "key", "text"),
    [
        (Stops, {"rebound": 0.1, "compression": 0.1}, "rebound", "below 0"),
        (Stops, {"rebound": -0.1, "compression": -0.1}, "compression", "above 0"),
        (Stops, {**STOPS, "rate": 0}, "rate", "greater than 0"),
        (SPRINGS["linear"], {"stops": STOPS}, "", "exactly one"),
        (SPRINGS["linear"], {"stops": STOPS, "rate": 2e4, "frequency": 1.2}, "", "exactly one"),
        (SPRINGS["linear"], {"stops": STOPS, "rate": "-20 N/mm"}, "rate", "greater than 0"),
        (
            SPRINGS["progressive"],
            {**SPRING_FIELDS["progressive"], "stops": STOPS, "progressive_from": 0.07},
            "progressive_from",
            "below",
        ),
        (
            SPRINGS["progressive"],
            {**SPRING_FIELDS["progressive"], "stops": STOPS, "rebound_force": 4000},
            "rebound_force",
            "below",
        ),
        (
            SPRINGS["progressive"],
            {**SPRING_FIELDS["progressive"], "stops": STOPS, "compression_force": 5000},
            "compression_force",
            "reaches",
        ),
        (SPRINGS["table"], {"stops": STOPS, "deflection": [0, 0.1], "force": [100, 100]}, "force.1", "increase"),
        (
            SPRINGS["table"],
            {"stops": STOPS, "deflection": [0, 0.1, 0.05], "force": [1, 2, 3]},
            "deflection.2",
            "increase",
        ),
        (
            SPRINGS["table"],
            {"stops": STOPS, "deflection": [0, 0.1], "force": [100, 200, 300]},
            "force",
            "deflection has 2",
        ),
        (ZonedDamper, {"rates": [3000, 600]}, "limits", "one fewer"),
        (ZonedDamper, {"rates": [3000, 600, 800], "limits": [0.3, 0.2]}, "limits", "increase"),
        (ZonedDamper, {"rates": [-3000]}, "rates.0", "greater than 0"),
        (ZonedDamper, {"rates": [0.0]}, "rates.0", "greater than 0"),
        (ZonedDamper, {"rates": [3000], "ratio": "1-2"}, "ratio", "1:2"),
        (ZonedDamper, {"rates": [3000], "ratio": "0:2"}, "ratio", "1:2"),
        (TableDamper, {"speed": [-1, 1], "force": [100, 200]}, "force.0", "feed energy in"),
        (TableDamper, {"speed": [-1, 0.5, 1], "force": [-100, 300, 200]}, "force.2", "increase strictly"),
        (TableDamper, {"speed": [0.1, 1], "force": [100, 200]}, "speed", "below 0"),
        (LinkageFriction, {"force": -1}, "force", "at least 0"),
        (LinkageFriction, {"force": float("nan")}, "force", "finite"),
    ],
)
def test_impossible_elements_are_refused(base, fields, key, text):
    with pytest.raises(InputError, match=text) as caught:
        validate(base, fields, source="car.toml")
    assert caught.value.key == key
    assert "\n" not in str(caught.value)
    assert str(caught.value).startswith("car.toml: ")


def test_bases_cannot_be_used_bare():
    for base in (Spring, Damper):
        with pytest.raises(TypeError):
            base(kind="linear", stops=Stops(**STOPS))


@pytest.mark.parametrize(
    "branches",
    [
        None,
        (([0.0, 1.0], [0.0, 900.0]),),
        (([0.0, 1.0], [0.0, 900.0]), ([0.0, 1.0], [0.0, -900.0])),
        (([0.0, 1.0], [0.0, 900.0]), ([0.1, 1.0], [0.0, 900.0])),
        (([0.0, 1.0], [0.0, 900.0]), ([0.0, 1.0, 2.0], [0.0, 900.0, 900.0])),
        (([0.0, 1.0], [0.0, 900.0]), ([0.0, 1.0, 2.0], [0.0, 900.0])),
        (([0.0, 1.0], [0.0, 900.0]), ([0.0], [0.0])),
        (([0.0, 1.0], [0.0, 900.0]), ([0.0, 1.0], [0.0, float("inf")])),
        (([0.0, 1.0], [0.0, 900.0]), ([0.0, 1.0], "ab")),
    ],
)
def test_a_damper_of_ones_own_whose_branches_do_not_rise_is_refused_where_it_is_written(branches):
    class Mine(HydraulicDamper):
        kind: Literal["mine"] = "mine"

        def branches(self):
            return branches

    for ask in (Mine.parameters, Mine.slopes, lambda damper: damper.force_at(0.1)):
        with pytest.raises(InputError, match=r"test_elements\.py, line \d+, in .*Mine\.branches: gives .*, not speeds"):
            ask(Mine())
