"""The Magic Formula tyre: points computed elsewhere, and what any tyre must do."""

from __future__ import annotations

import ctypes
import math

import numba
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numba.extending import register_jitable

from susp_mj.elements.law import helpers
from susp_mj.elements.tyres import magic_formula_law as law
from susp_mj.elements.tyres import slip
from susp_mj.elements.tyres.tir import load_tyre
from vehicles.reading import FOLDER

# Evaluated elsewhere from the same coefficients (pure slip by two programs), zero camber, ISO-W, no combined slip:
# LFZO, F_z [N], kappa, alpha [rad], F_x0, F_y0, F_x, F_y [N], K_x [N], K_y [N/rad]. fmt: off
POINTS = [
    (1.0, 4850, 0, -0.15, 132.948117418, 5216.22213658, 132.948117418, 5216.22213658, 108169.55, -85018.987047),
    (1.0, 4850, 0, -0.02, 132.948117418, 1611.06178811, 132.948117418, 1611.06178811, 108169.55, -85018.987047),
    (1.0, 4850, 0, 0.02, 132.948117418, -1659.43462222, 132.948117418, -1659.43462222, 108169.55, -85018.987047),
    (1.0, 4850, 0, 0.15, 132.948117418, -4886.62593571, 132.948117418, -4886.62593571, 108169.55, -85018.987047),
    (1.0, 4850, -0.05, 0, -4139.35650929, -46.2561802767, -4139.35650929, -46.2561802767, 108169.55, -85018.987047),
    (1.0, 4850, 0.05, 0, 4260.69176311, -46.2561802767, 4260.69176311, -46.2561802767, 108169.55, -85018.987047),
    (1.0, 1500, 0, 0.04, 26.4649691752, -1076.85008352, 26.4649691752, -1076.85008352, 28449.436856, -32093.7376033),
    (1.0, 7000, 0, 0.04, 246.059692227, -3586.52734438, 246.059692227, -3586.52734438, 173212.198458, -100876.642008),
    (1.0, 4850, 0.05, 0.05, 4260.69176311, -3418.09480749, 4260.69176311, -3418.09480749, 108169.55, -85018.987047),
    (0.81, 4850, 0, -0.15, 152.046957024, 4972.92426871, 152.046957024, 4972.92426871, 114283.475961, -76958.9939845),
    (0.81, 4850, 0, -0.02, 152.046957024, 1466.48634559, 152.046957024, 1466.48634559, 114283.475961, -76958.9939845),
    (0.81, 4850, 0, 0.02, 152.046957024, -1506.65304588, 152.046957024, -1506.65304588, 114283.475961, -76958.9939845),
    (0.81, 4850, 0, 0.15, 152.046957024, -4678.80097697, 152.046957024, -4678.80097697, 114283.475961, -76958.9939845),
    (
        0.81,
        4850,
        -0.05,
        0,
        -4190.78565722,
        -37.7665031663,
        -4190.78565722,
        -37.7665031663,
        114283.475961,
        -76958.9939845,
    ),
    (0.81, 4850, 0.05, 0, 4311.90872183, -37.7665031663, 4311.90872183, -37.7665031663, 114283.475961, -76958.9939845),
    (0.81, 1500, 0, 0.04, 27.8283891811, -1064.94260382, 27.8283891811, -1064.94260382, 28938.1375681, -31706.0593448),
    (0.81, 7000, 0, 0.04, 293.735411792, -3101.99670146, 293.735411792, -3101.99670146, 187502.787271, -85535.6501655),
    (0.81, 4850, 0.05, 0.05, 4311.90872183, -3161.3006932, 4311.90872183, -3161.3006932, 114283.475961, -76958.9939845),
]
# fmt: on
TYRE = load_tyre(FOLDER / "tyres" / "pac2002_245_40R18.tir")
ODD = {
    "longitudinal": ("RHX1",),
    "lateral": ("PEY3", "PHY1", "PHY2", "PVY1", "PVY2", "RBY3", "RVY1", "RVY2"),
    "aligning": ("QBZ4", "QDZ3", "QDZ6", "QDZ7", "QEZ4", "QHZ1", "QHZ2", "SSZ1"),
    "overturning": ("QSX1",),
}
"""Coefficients that change sign when a tyre is mirrored."""
SIDELESS = {
    "longitudinal": ("PHX1", "PHX2", "PVX1", "PVX2", "PEX4"),
    **{k: v for k, v in ODD.items() if k != "longitudinal"},
}


def changed(tyre, **sections):
    """The tyre with coefficients of its sections replaced."""
    return tyre.model_copy(
        update={name: getattr(tyre, name).model_copy(update=values) for name, values in sections.items()}
    )


FULL = changed(
    TYRE,
    longitudinal={"PDX3": 0.4, "RHX1": 0.007, "REX1": -0.3, "REX2": 0.1},
    lateral={"RBY3": -0.015, "RHY1": 0.009, "RHY2": 0.002, "REY1": 0.01, "RVY1": 0.053, "RVY2": -0.073, "RVY3": 0.517}
    | {"RVY4": 35.44, "RVY5": 1.9, "RVY6": -10.71},
    aligning={"QBZ10": 0.5, "SSZ1": 0.043, "SSZ2": 0.001, "SSZ3": 0.731, "SSZ4": -0.238},
    overturning={"QSX1": 0.02, "QSX2": 1.1, "QSX3": 0.05},
    rolling={"QSY2": 0.001, "QSY3": 0.002, "QSY4": 0.0005},
)
"""Every coefficient in use."""
SYMMETRIC = changed(TYRE, **{section: dict.fromkeys(names, 0.0) for section, names in SIDELESS.items()})
P, UNCOMBINED, FULL_P, SYMMETRIC_P = (each.parameters() for each in (TYRE, TYRE.uncombined(), FULL, SYMMETRIC))

slips = st.floats(-1.4, 1.4)
angles = st.floats(-1.2, 1.2)
cambers = st.floats(-0.2, 0.2)
loads = st.floats(1.0, 10000.0)
FORCES = {
    "longitudinal": law.longitudinal_force,
    "lateral": law.lateral_force,
    "aligning": lambda k, a, c, f, p: law.aligning_moment(k, a, c, f, math.cos(a), p),
    "overturning": law.overturning_moment,
}


@pytest.mark.parametrize("point", POINTS, ids=lambda each: "-".join(f"{value:g}" for value in each[:4]))
def test_points(point):
    factor, load, kappa, alpha, fx0, fy0, fx, fy, kx, ky = point
    tyre = changed(TYRE, scaling={"LFZO": factor})
    p, alone = tyre.parameters(), tyre.uncombined().parameters()
    found = [
        law.pure_longitudinal_force(kappa, 0.0, load, p),
        law.pure_lateral_force(alpha, 0.0, load, p),
        law.longitudinal_force(kappa, alpha, 0.0, load, alone),
        law.lateral_force(kappa, alpha, 0.0, load, alone),
        law.longitudinal_stiffness(load, p),
        law.cornering_stiffness(0.0, load, p),
    ]
    np.testing.assert_allclose(found, [fx0, fy0, fx, fy, kx, ky], rtol=1e-9)


def test_parameters_are_in_the_order_of_their_indices():
    assert len(set(law.PARAMETERS)) == len(law.PARAMETERS) == len(P)
    assert [getattr(law, name) for name in law.PARAMETERS] == list(range(len(P)))
    assert P[law.PCX1] == TYRE.longitudinal.PCX1
    assert P[law.FZ0] == pytest.approx(4850 * 0.81)


@given(k=slips, a=angles, c=cambers, f=loads)
def test_pure_slip_is_combined_slip_without_the_other(k, a, c, f):
    assert law.longitudinal_force(k, 0.0, c, f, FULL_P) == pytest.approx(
        law.pure_longitudinal_force(k, c, f, FULL_P), rel=1e-13
    )
    assert law.lateral_force(0.0, a, c, f, FULL_P) == pytest.approx(law.pure_lateral_force(a, c, f, FULL_P), rel=1e-13)


@pytest.mark.parametrize("load", [50.0, 1500.0, 4850.0, 9000.0])
def test_slopes_at_the_origin_are_the_stiffnesses(load):
    h = 1e-6
    along = (
        law.pure_longitudinal_force(h, 0, load, SYMMETRIC_P) - law.pure_longitudinal_force(-h, 0, load, SYMMETRIC_P)
    ) / (2 * h)
    across = (law.pure_lateral_force(h, 0, load, SYMMETRIC_P) - law.pure_lateral_force(-h, 0, load, SYMMETRIC_P)) / (
        2 * h
    )
    assert along == pytest.approx(law.longitudinal_stiffness(load, SYMMETRIC_P), rel=1e-6)
    assert across == pytest.approx(law.cornering_stiffness(0.0, load, SYMMETRIC_P), rel=1e-6)


@given(k=slips, a=angles, c=cambers, f=loads)
def test_mirrored_mounting_is_mirrored_coefficients(k, a, c, f):
    """A tyre measured on the left and mounted on the right is the tyre whose odd coefficients have the other sign."""
    flipped = {
        section: {name: -getattr(getattr(FULL, section), name) for name in names} for section, names in ODD.items()
    }
    right, coefficients = FULL.mounted("RIGHT").parameters(), changed(FULL, **flipped).parameters()
    for name, force in FORCES.items():
        value = force(k, a, c, f, right)
        assert value == pytest.approx(force(k, a, c, f, coefficients), rel=1e-9, abs=1e-9), name
        sign = 1 if name == "longitudinal" else -1
        assert value == pytest.approx(sign * force(k, -a, -c, f, FULL_P), rel=1e-9, abs=1e-9), name


@given(k=slips, a=angles, f=loads)
def test_symmetric_tyre_is_odd(k, a, f):
    fx, fy = (law.longitudinal_force(k, a, 0, f, SYMMETRIC_P), law.lateral_force(k, a, 0, f, SYMMETRIC_P))
    assert law.longitudinal_force(-k, a, 0, f, SYMMETRIC_P) == pytest.approx(-fx, rel=1e-12)
    assert law.lateral_force(k, -a, 0, f, SYMMETRIC_P) == pytest.approx(-fy, rel=1e-12)


@pytest.mark.parametrize("load", [200.0, 1500.0, 4000.0, 9000.0])
def test_friction_bounds_the_force(load):
    """Each force alone reaches its friction and no more; together they pass the ellipse by less than 2 %."""
    forces = np.array(
        [
            (law.longitudinal_force(k, a, 0, load, SYMMETRIC_P), law.lateral_force(k, a, 0, load, SYMMETRIC_P))
            for k in np.linspace(-1.4, 1.4, 141)
            for a in np.linspace(-1.5, 1.5, 121)
        ]
    )
    most = load * np.array(
        [law.longitudinal_friction(0, load, SYMMETRIC_P), law.lateral_friction(0, load, SYMMETRIC_P)]
    )
    share = np.abs(forces) / most
    assert share.max(axis=0) == pytest.approx(1.0, abs=0.01)
    assert share.max() <= 1.0 + 1e-12
    assert 0.99 < np.hypot(*share.T).max() < 1.02


@given(v=st.floats(-50, 50), along=st.floats(-30, 30), across=st.floats(-30, 30), f=loads)
def test_sliding_dissipates(v, along, across, f):
    """A tyre without shifts takes energy out of any sliding, rolling either way and at standstill."""
    kappa = slip.steady_slip(-along, v, 1.5)
    alpha = math.atan(slip.steady_slip(across, v, 50.0))
    fx, fy = law.longitudinal_force(kappa, alpha, 0, f, SYMMETRIC_P), law.lateral_force(kappa, alpha, 0, f, SYMMETRIC_P)
    assert fx * along <= 0.0
    assert fy * across <= 0.0


@given(k=slips, a=angles, c=cambers)
def test_no_load_no_force(k, a, c):
    for name, force in FORCES.items():
        for load in (0.0, -0.0, -500.0):
            assert force(k, a, c, load, FULL_P) == 0.0, name
        for load in (5e-324, 1e-300, 1e-12, 1e-6):
            assert abs(force(k, a, c, load, FULL_P)) <= 3 * load, name
    for load in (0.0, -500.0):
        assert law.longitudinal_relaxation_length(load, FULL_P) == law.lateral_relaxation_length(c, load, FULL_P) == 0.0
        assert law.rolling_resistance_moment(100.0, 20.0, load, 1.0, FULL_P) == 0.0


@pytest.mark.parametrize("name", FORCES)
def test_continuous_in_the_load(name):
    """Also through the loss of contact and through the largest valid load, above which nothing changes."""
    load = np.linspace(-100, 10600, 2141)
    for k, a, c in ((0.0, 0.05, 0.0), (0.03, -0.02, 0.03), (-0.3, 0.2, -0.1)):
        values = np.array([FORCES[name](k, a, c, each, FULL_P) for each in load])
        assert np.abs(np.diff(values)).max() < 1.5 * (load[1] - load[0])
        assert np.ptp(values[load > FULL.ranges.FZMAX]) == 0.0
        assert np.abs(values).max() > 1.0


@pytest.mark.parametrize("name", FORCES)
def test_continuous_in_slip(name):
    """No jump where the sign of a slip, shifted or not, changes."""
    grid = np.linspace(-0.05, 0.05, 801)
    for other in (0.0, 0.04):
        over_kappa = np.array([FORCES[name](x, other, 0.02, 4000, FULL_P) for x in grid])
        over_alpha = np.array([FORCES[name](other, x, 0.02, 4000, FULL_P) for x in grid])
        for values in (over_kappa, over_alpha):
            assert np.abs(np.diff(values)).max() < 1.5e5 * (grid[1] - grid[0])


def test_inputs_beyond_the_valid_range_are_held():
    assert law.longitudinal_force(9.0, 0.1, 0.0, 4000, P) == law.longitudinal_force(1.5, 0.1, 0.0, 4000, P)
    assert law.lateral_force(0.1, 0.1, 2.0, 4000, P) == law.lateral_force(0.1, 0.1, 0.26181, 4000, P)
    for name, force in FORCES.items():
        assert math.isfinite(force(1e9, 1e9, 1e9, 1e9, FULL_P)), name


@given(a=st.floats(1e-4, 0.08), f=st.floats(500, 10000))
def test_aligning_moment_turns_the_wheel_back(a, f):
    """A tyre without shifts turns towards where it moves; rolling backwards the trail changes sign; at standstill it is
    gone."""
    moment = law.aligning_moment(0.0, a, 0.0, f, math.cos(a), SYMMETRIC_P)
    assert moment > 0.0
    assert law.aligning_moment(0.0, -a, 0.0, f, math.cos(a), SYMMETRIC_P) == pytest.approx(-moment, rel=1e-12)
    assert law.aligning_moment(0.0, a, 0.0, f, -math.cos(a), SYMMETRIC_P) == pytest.approx(-moment, rel=1e-12)
    assert law.aligning_moment(0.0, a, 0.0, f, 0.0, SYMMETRIC_P) == 0.0


def test_aligning_moment_is_trail_times_force():
    """At vanishing slip of a tyre without shifts: ``dM_z/dalpha = -t K_y``, the trail a few centimetres."""
    a, load = 1e-7, 4000.0
    trail = law.pneumatic_trail(0.0, 0.0, 0.0, load, SYMMETRIC_P)
    assert 0.02 < trail < 0.05
    slope = law.aligning_moment(0.0, a, 0.0, load, 1.0, SYMMETRIC_P) / a
    assert slope == pytest.approx(-trail * law.cornering_stiffness(0.0, load, SYMMETRIC_P), rel=1e-6)


def test_camber_pushes_towards_its_lean():
    """Positive camber leans to the right; so does the force that it adds."""
    assert law.lateral_force(0.0, 0.0, 0.1, 4000, SYMMETRIC_P) < 0.0


def test_overturning_moment_formula():
    p = SYMMETRIC.model_copy(update={"overturning": FULL.overturning}).parameters()
    force = law.lateral_force(0.02, 0.03, 0.05, 4000, p)
    expected = 0.344 * 4000 * (0.02 - 1.1 * 0.05 + 0.05 * force / 4850)
    assert law.overturning_moment(0.02, 0.03, 0.05, 4000, p) == pytest.approx(expected, rel=1e-13)


@given(v=st.floats(-60, 60), fx=st.floats(-5000, 5000), f=loads)
def test_rolling_resistance_never_drives(v, fx, f):
    assert law.rolling_resistance_moment(fx, v, f, slip.heading(v, 0.0), FULL_P) * v <= 0.0


def test_rolling_resistance_formula():
    expected = -0.344 * 4000 * (0.01 + 0.001 * 300 / 4850 + 0.002 * 2 + 0.0005 * 16)
    assert law.rolling_resistance_moment(300.0, 33.2, 4000, 1.0, FULL_P) == pytest.approx(expected, rel=1e-13)


def test_relaxation_lengths():
    assert law.longitudinal_relaxation_length(4850 * 0.81, P) == pytest.approx(2.3657 * 0.81 * 0.344, rel=1e-12)
    top = law.lateral_relaxation_length(0.0, 1.9829 * 4850 * 0.81, P)
    assert top == pytest.approx(2.1439 * 0.344 * 0.81, rel=1e-12)
    assert max(law.lateral_relaxation_length(0.0, load, P) for load in np.linspace(0, 10000, 101)) <= top


# ---- slip as a state


@given(s=st.floats(-1.5, 1.5), sliding=st.floats(-60, 60), rolling=st.floats(-60, 60), sigma=st.floats(0, 2))
def test_slip_stays_bounded_and_settles_at_the_steady_slip(s, sliding, rolling, sigma):
    """The rate is finite everywhere, points to the steady slip and never out of the largest."""
    rate, steady = slip.slip_rate(s, sliding, rolling, sigma, 1.5), slip.steady_slip(sliding, rolling, 1.5)
    assert math.isfinite(rate)
    assert abs(steady) <= 1.5 * (1 + 1e-15)
    assert rate * (steady - s) >= -1e-9
    assert abs(slip.slip_rate(steady, sliding, rolling, sigma, 1.5)) < 1e-9
    assert slip.slip_rate(math.copysign(1.5, rate), sliding, rolling, sigma, 1.5) * rate <= 1e-9


def test_slip_relaxes_over_its_length():
    """At constant speed the slip has reached ``1 - 1/e`` after rolling one relaxation length."""
    s, speed, sigma, step = 0.0, 10.0, 0.5, 1e-5
    for _ in range(round(sigma / speed / step)):
        s += step * slip.slip_rate(s, 0.003, speed, sigma, 1.5)
    assert s == pytest.approx(0.0003 * (1 - math.exp(-1)), rel=1e-3)


def test_slip_at_standstill_is_a_spring():
    assert slip.slip_rate(0.0, 0.0, 0.0, 0.5, 1.5) == slip.steady_slip(0.0, 0.0, 1.5) == slip.heading(0.0, 0.0) == 0.0
    assert slip.slip_rate(0.0, 1e-3, 0.0, 0.5, 1.5) == pytest.approx(2e-3)
    assert slip.slip_rate(0.2, 0.0, 0.0, 0.5, 1.5) == 0.0, "it holds a parked car"


# ---- vertical


def test_vertical_load_and_rolling_radius():
    assert TYRE.vertical_load(-0.01, 5.0) == TYRE.vertical_load(0.0) == 0.0
    assert TYRE.vertical_load(0.01) == pytest.approx(2808.352941)
    assert TYRE.vertical_load(0.001, -5.0) == 0.0, "the road cannot pull"
    radii = [TYRE.rolling_radius(load) for load in np.linspace(0, 9000, 50)]
    assert radii[0] == TYRE.radius
    assert (np.diff(radii) < 0).all()
    assert radii[-1] > TYRE.radius - 9000 / TYRE.vertical_stiffness


# ---- everything at once


@given(
    k=st.floats(-1.6, 1.6),
    a=st.floats(-1.4, 1.4),
    c=st.floats(-0.3, 0.3),
    f=st.just(0.0) | st.floats(1e-3, 12000.0),
    v=st.floats(-60, 60),
    w=st.floats(-20, 20),
    grip=st.sampled_from((1.0, 0.5, 0.1)),
    tyre=st.sampled_from((TYRE, FULL, FULL.mounted("RIGHT"), TYRE.uncombined(), FULL.uncombined(), SYMMETRIC)),
)
def test_contact_is_the_readable_functions(k, a, c, f, v, w, grip, tyre):
    """To 1e-12 of the value, or of a thousandth of its size; the road's friction is a factor on LMUX and LMUY."""
    scale = tyre.scaling
    p = changed(tyre, scaling={"LMUX": scale.LMUX * grip, "LMUY": scale.LMUY * grip}).parameters()
    found = tyre.evaluate(k, math.tan(a), c, f, v, w, grip)
    a, h = math.atan(math.tan(a)), slip.heading(v, w)
    fx = law.longitudinal_force(k, a, c, f, p)
    expected = (
        fx,
        law.lateral_force(k, a, c, f, p),
        law.overturning_moment(k, a, c, f, p),
        law.rolling_resistance_moment(fx, v, f, h, p),
        law.aligning_moment(k, a, c, f, h, p),
        max(slip.SMALLEST_RELAXATION, law.longitudinal_relaxation_length(f, p)),
        max(slip.SMALLEST_RELAXATION, law.lateral_relaxation_length(c, f, p)),
        tyre.rolling_radius(f),
    )
    sizes = [1e-3 * grip * f] * 2 + [1e-4 * grip * f] * 3 + [0.0] * 3
    for name, value, there, size in zip(found._fields, found, expected, sizes, strict=True):
        assert value == pytest.approx(there, rel=1e-12, abs=1e-12 * size + 1e-18), name


def test_friction_of_the_road_leaves_the_stiffness():
    """Halved, it halves the peak; at vanishing slip the force is the same. The stiffness is that of F_y0 over alpha."""
    p = SYMMETRIC_P
    for grip in (1.0, 0.5, 0.1, 0.01):
        slope = (
            SYMMETRIC.evaluate(0, 1e-7, 0, 4000, friction=grip)[1]
            - SYMMETRIC.evaluate(0, -1e-7, 0, 4000, friction=grip)[1]
        ) / 2e-7
        assert slope == pytest.approx(law.cornering_stiffness(0.0, 4000, p), rel=1e-6)
        peak = max(abs(SYMMETRIC.evaluate(0, a, 0, 4000, friction=grip)[1]) for a in np.geomspace(1e-4, 10, 2000))
        assert peak == pytest.approx(grip * 4000 * law.lateral_friction(0, 4000, p), rel=1e-3)


def test_own_arc_tangent_and_sine():
    x = np.concatenate(
        [np.linspace(-6, 6, 4001), np.geomspace(1e-300, 1e300, 4001), -np.geomspace(1e-12, 1e12, 101)]
    ).tolist()
    np.testing.assert_allclose([law.arctangent(each) for each in x], np.arctan(x), rtol=4e-16)
    x = np.linspace(-15, 15, 4001).tolist()
    np.testing.assert_allclose([law.sine(each) for each in x], np.sin(x), rtol=1e-15, atol=2e-15)
    assert math.isnan(law.arctangent(math.nan))
    assert law.arctangent(0.0) == law.sine(0.0) == 0.0


# ---- compiled

COMPILED = {
    law.longitudinal_force: (0.05, 0.03, 0.02, 4000.0),
    law.lateral_force: (0.05, 0.03, 0.02, 4000.0),
    law.overturning_moment: (0.05, 0.03, 0.02, 4000.0),
    law.aligning_moment: (0.05, 0.03, 0.02, 4000.0, 0.99),
    law.rolling_resistance_moment: (300.0, 20.0, 4000.0, 0.99),
    law.longitudinal_relaxation_length: (4000.0,),
    law.lateral_relaxation_length: (0.02, 4000.0),
}


@pytest.mark.parametrize("function", COMPILED, ids=lambda each: each.__name__)
def test_compiled_law_is_the_same(function):
    for helper in helpers(function).values():
        register_jitable(helper)
    arguments = COMPILED[function]
    signature = numba.float64(*[numba.float64] * len(arguments), numba.types.CPointer(numba.float64))
    compiled = numba.cfunc(signature)(function)
    rng = np.random.default_rng(7)
    for tyre in (TYRE, FULL, FULL.mounted("RIGHT"), FULL.uncombined()):
        p = tyre.parameters()
        pointer = (ctypes.c_double * len(p))(*p)
        for scale in (np.zeros(len(arguments)), *rng.uniform(-2, 2, (200, len(arguments)))):
            values = [float(each) for each in scale * arguments]
            assert compiled.ctypes(*values, pointer) == pytest.approx(function(*values, p), rel=1e-15, abs=1e-300)


@pytest.mark.parametrize("function", [slip.steady_slip, slip.slip_rate, slip.heading], ids=lambda each: each.__name__)
def test_compiled_slip_is_the_same(function):
    count = function.__code__.co_argcount
    compiled = numba.cfunc(numba.float64(*[numba.float64] * count))(function)
    for values in np.random.default_rng(7).uniform(-2, 2, (200, count)):
        values[-1] = abs(values[-1]) + 0.1
        assert compiled.ctypes(*values) == pytest.approx(function(*map(float, values)), rel=1e-15)
