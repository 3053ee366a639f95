"""The Magic Formula 6.1: a second implementation as the equations stand in the source, MF 5.2 as a special case, what
any tyre must do."""

from __future__ import annotations

import ctypes
import math
from types import SimpleNamespace

import numba
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numba.extending import register_jitable

from susp_mj.elements.law import helpers
from susp_mj.elements.tyres import magic_formula_61_law as law
from susp_mj.elements.tyres import magic_formula_law as law_52
from susp_mj.elements.tyres import slip
from susp_mj.elements.tyres.magic_formula_61 import MagicFormula61Tyre
from susp_mj.elements.tyres.tir import load_tyre
from vehicles.reading import FOLDER

TYRE = load_tyre(FOLDER / "tyres" / "mf61_205_60R15.tir")
assert isinstance(TYRE, MagicFormula61Tyre)
SECTIONS = (
    "vertical",
    "structure",
    "longitudinal",
    "lateral",
    "aligning",
    "overturning",
    "rolling",
    "scaling",
    "operation",
)
ODD = {
    "longitudinal": ("RHX1",),
    "lateral": ("PEY3", "PHY1", "PHY2", "PVY1", "PVY2", "RBY3", "RVY1", "RVY2"),
    "aligning": ("QBZ4", "QDZ3", "QDZ6", "QDZ7", "QEZ4", "QHZ1", "QHZ2", "SSZ1"),
    "overturning": ("QSX1",),
}
"""Coefficients that change sign when a tyre is mirrored."""


def changed(tyre, **sections):
    """The tyre with coefficients of its sections replaced."""
    return tyre.model_copy(
        update={name: getattr(tyre, name).model_copy(update=values) for name, values in sections.items()}
    )


def scattered(seed=11):
    """The shipped tyre, every coefficient of it moved and the zeros made nonzero, every scale factor and the pressure
    too."""
    rng = np.random.default_rng(seed)
    new = {}
    for name in SECTIONS[2:-1]:
        values = getattr(TYRE, name).model_dump()
        new[name] = {
            key: value * rng.uniform(0.9, 1.1) if value else rng.uniform(0.002, 0.02) for key, value in values.items()
        }
    new["rolling"]["QSY7"] = 0.8
    new["structure"] = {"PCFX2": 0.02, "PCFX3": -0.1, "PCFY2": -0.03}
    return changed(TYRE, **new, operation={"INFLPRES": 2.5e5})


FULL = scattered()
SYMMETRIC = changed(
    TYRE,
    **{name: dict.fromkeys(keys, 0.0) for name, keys in ODD.items() if name != "longitudinal"},
    longitudinal=dict.fromkeys(("PHX1", "PHX2", "PVX1", "PVX2", "PEX4", "RHX1"), 0.0),
)
slips, angles, cambers = st.floats(-1.4, 1.4), st.floats(-1.3, 1.3), st.floats(-0.17, 0.17)
loads, speeds = st.floats(1.0, 9000.0), st.floats(-60.0, 60.0)


def by_the_book(tyre, kappa, alpha, camber, load, rolling, lateral, grip=1.0):
    """Equations 4.E1 to 4.E78 of [pacejka2012] term by term, in arc tangents and cosines, on the side of the
    measurement.

    Differences: a single friction scale for peaks and shifts (4.E8 with A_mu = 1), trail and its stiffness factor with
    the signed camber, M_x and M_y with the coefficients of [besselink2010], the trail over the nominal load without
    LFZO.
    """
    c = SimpleNamespace(**{k: v for name in SECTIONS for k, v in getattr(tyre, name).model_dump().items()})
    sin, cos, atan, sign = math.sin, math.cos, math.atan, lambda x: math.copysign(1.0, x)
    r0, fz0, fz0s = tyre.radius, c.FNOMIN, c.FNOMIN * c.LFZO
    dfz, dpi = (load - fz0s) / fz0s, (c.INFLPRES - c.NOMPRES) / c.NOMPRES
    a, g = math.tan(alpha), sin(camber)
    lmux, lmuy = c.LMUX * grip, c.LMUY * grip

    def shape(b, e, x):
        return atan(b * x - min(e, 1.0) * (b * x - atan(b * x)))

    # 4.E9 to 4.E18
    mu_x = (c.PDX1 + c.PDX2 * dfz) * (1 + c.PPX3 * dpi + c.PPX4 * dpi**2) * (1 - c.PDX3 * camber**2) * lmux
    k_x = load * (c.PKX1 + c.PKX2 * dfz) * math.exp(c.PKX3 * dfz) * (1 + c.PPX1 * dpi + c.PPX2 * dpi**2) * c.LKX
    s_hx, s_vx = (c.PHX1 + c.PHX2 * dfz) * c.LHX, load * (c.PVX1 + c.PVX2 * dfz) * c.LVX * lmux
    kx, c_x = kappa + s_hx, c.PCX1 * c.LCX
    e_x = (c.PEX1 + c.PEX2 * dfz + c.PEX3 * dfz**2) * (1 - c.PEX4 * sign(kx)) * c.LEX
    fx0 = mu_x * load * sin(c_x * shape(k_x / (c_x * mu_x * load), e_x, kx)) + s_vx

    # 4.E19 to 4.E30
    def side_force(g):
        mu = (c.PDY1 + c.PDY2 * dfz) * (1 + c.PPY3 * dpi + c.PPY4 * dpi**2) * (1 - c.PDY3 * g**2) * lmuy
        inner = atan((load / fz0s) / ((c.PKY2 + c.PKY5 * g**2) * (1 + c.PPY2 * dpi)))
        k = c.PKY1 * fz0s * (1 + c.PPY1 * dpi) * (1 - c.PKY3 * abs(g)) * sin(c.PKY4 * inner) * c.LKY
        s_vg = load * (c.PVY3 + c.PVY4 * dfz) * g * c.LKYC * lmuy
        k_g0 = load * (c.PKY6 + c.PKY7 * dfz) * (1 + c.PPY5 * dpi) * c.LKYC
        s_h = (c.PHY1 + c.PHY2 * dfz) * c.LHY + (k_g0 * g - s_vg) / k
        s_v = load * (c.PVY1 + c.PVY2 * dfz) * c.LVY * lmuy + s_vg
        x, shape_factor = a + s_h, c.PCY1 * c.LCY
        e = (c.PEY1 + c.PEY2 * dfz) * (1 + c.PEY5 * g**2 - (c.PEY3 + c.PEY4 * g) * sign(x)) * c.LEY
        b = k / (shape_factor * mu * load)
        return mu * load * sin(shape_factor * shape(b, e, x)) + s_v, k, s_h, s_v, mu, b * shape_factor

    fy0, k_y, s_hy, s_vy, mu_y, b_c = side_force(g)
    fy00 = side_force(0.0)[0]

    # 4.E50 to 4.E67
    def side_weight(g):
        b = (c.RBY1 + c.RBY4 * g**2) * cos(atan(c.RBY2 * (a - c.RBY3))) * c.LYKA
        e, s_h = c.REY1 + c.REY2 * dfz, c.RHY1 + c.RHY2 * dfz
        return cos(c.RCY1 * shape(b, e, kappa + s_h)) / cos(c.RCY1 * shape(b, e, s_h))

    combined = tyre.model.USE_MODE == 4
    fx, fy, fy_trail, arm, ratio = fx0, fy0, fy00, 0.0, 0.0
    if combined:
        b_xa = (c.RBX1 + c.RBX3 * g**2) * cos(atan(c.RBX2 * kappa)) * c.LXAL
        e_xa = c.REX1 + c.REX2 * dfz
        fx = fx0 * cos(c.RCX1 * shape(b_xa, e_xa, a + c.RHX1)) / cos(c.RCX1 * shape(b_xa, e_xa, c.RHX1))
        d_vyk = mu_y * load * (c.RVY1 + c.RVY2 * dfz + c.RVY3 * g) * cos(atan(c.RVY4 * a))
        fy = side_weight(g) * fy0 + d_vyk * sin(c.RVY5 * atan(c.RVY6 * kappa)) * c.LVYKA
        fy_trail = side_weight(0.0) * fy00
        arm = r0 * (c.SSZ1 + c.SSZ2 * fy / fz0 + (c.SSZ3 + c.SSZ4 * dfz) * g) * c.LS
        ratio = k_x / k_y

    # 4.E31 to 4.E49, 4.E71 to 4.E78
    cos_alpha = slip.heading(rolling, lateral)
    a_t = a + c.QHZ1 + c.QHZ2 * dfz + (c.QHZ3 + c.QHZ4 * dfz) * g
    a_r = a + s_hy + s_vy / k_y
    a_t_eq, a_r_eq = (math.sqrt(x**2 + (ratio * kappa) ** 2) * sign(x) for x in (a_t, a_r))
    b_t = (c.QBZ1 + c.QBZ2 * dfz + c.QBZ3 * dfz**2) * (1 + c.QBZ4 * g + c.QBZ5 * abs(g)) * c.LKY / lmuy
    d_t = load * r0 / fz0 * (c.QDZ1 + c.QDZ2 * dfz) * (1 - c.PPZ1 * dpi) * (1 + c.QDZ3 * g + c.QDZ4 * g**2) * c.LTR
    e_t = (c.QEZ1 + c.QEZ2 * dfz + c.QEZ3 * dfz**2) * (
        1 + (c.QEZ4 + c.QEZ5 * g) * 2 / math.pi * atan(b_t * c.QCZ1 * a_t)
    )
    trail = d_t * cos(c.QCZ1 * shape(b_t, e_t, a_t_eq)) * cos_alpha
    by_camber = (c.QDZ8 + c.QDZ9 * dfz) * (1 + c.PPZ2 * dpi) + (c.QDZ10 + c.QDZ11 * dfz) * abs(g)
    d_r = load * r0 * ((c.QDZ6 + c.QDZ7 * dfz) * c.LRES + by_camber * g * c.LKZC) * lmuy * cos_alpha
    b_r = c.QBZ9 * c.LKY / lmuy + c.QBZ10 * b_c
    mz = -trail * fy_trail + d_r * cos(atan(b_r * a_r_eq)) + arm * fx

    share = load / fz0
    mx = c.QSX1 * c.LVMX - c.QSX2 * camber * (1 + c.PPMX1 * dpi) - c.QSX12 * camber * abs(camber) + c.QSX3 * fy / fz0
    mx += c.QSX4 * cos(c.QSX5 * atan((c.QSX6 * share) ** 2)) * sin(c.QSX7 * camber + c.QSX8 * atan(c.QSX9 * fy / fz0))
    mx += c.QSX10 * atan(c.QSX11 * share) * camber
    mx = r0 * load * mx * c.LMX + r0 * fy * (c.QSX13 + c.QSX14 * abs(camber)) * c.LMX
    v = abs(rolling) / tyre.model.LONGVL
    my = c.QSY1 + c.QSY2 * fx / fz0 + c.QSY3 * v + c.QSY4 * v**4 + (c.QSY5 + c.QSY6 * share) * camber**2
    my *= -r0 * fz0 * c.LMY * share**c.QSY7 * (c.INFLPRES / c.NOMPRES) ** c.QSY8 * cos_alpha
    carcass_x = c.LONGITUDINAL_STIFFNESS * (1 + c.PCFX1 * dfz + c.PCFX2 * dfz**2) * (1 + c.PCFX3 * dpi)
    carcass_y = c.LATERAL_STIFFNESS * (1 + c.PCFY1 * dfz + c.PCFY2 * dfz**2) * (1 + c.PCFY3 * dpi)
    radius = r0 * (c.Q_RE0 + c.Q_V1 * v**2) - fz0 / tyre.vertical_stiffness * (
        c.DREFF * atan(c.BREFF * share) + c.FREFF * share
    )
    return fx, fy, mx, my, mz, max(0.05, k_x / carcass_x), max(0.05, abs(k_y) / carcass_y), radius


@given(
    k=slips,
    a=angles,
    c=cambers,
    f=loads,
    v=speeds,
    w=st.floats(-20, 20),
    grip=st.sampled_from((1.0, 0.5, 0.1)),
    tyre=st.sampled_from((TYRE, FULL, scattered(3), SYMMETRIC, FULL.uncombined(), TYRE.uncombined())),
)
def test_contact_is_the_book(k, a, c, f, v, w, grip, tyre):
    found, expected = tyre.evaluate(k, math.tan(a), c, f, v, w, grip), by_the_book(tyre, k, a, c, f, v, w, grip)
    sizes = [1e-2 * grip * f] * 2 + [1e-3 * grip * f] * 3 + [0.0] * 3
    for name, value, there, size in zip(found._fields, found, expected, sizes, strict=True):
        assert value == pytest.approx(there, rel=1e-11, abs=1e-11 * size), name


def test_parameters_are_in_the_order_of_their_indices():
    p = TYRE.parameters()
    assert len(set(law.PARAMETERS)) == len(law.PARAMETERS) == len(p)
    assert [getattr(law, name) for name in law.PARAMETERS] == list(range(len(p)))
    assert p[law.PKY1] == TYRE.lateral.PKY1 * 4000


def reduced():
    """The MF 5.2 tyre as one of MF 6.1 without what 6.1 added, and that tyre without camber terms of its side force.

    Where alpha and tan alpha are told apart, and the lean gamma and its sine, the two differ.
    """
    tyre = load_tyre(FOLDER / "tyres" / "pac2002_245_40R18.tir")
    old = changed(
        tyre, lateral={"PHY3": 0.0, "PVY3": 0.0, "PVY4": 0.0, "RVY1": 0.05, "RVY4": 30.0, "RVY5": 1.9, "RVY6": 20.0}
    )
    data = old.model_dump()
    keep = {
        name: set(MagicFormula61Tyre.model_fields[name].annotation.model_fields)
        for name in ("longitudinal", "lateral", "aligning")
    }
    sections = {name: {key: value for key, value in data[name].items() if key in keys} for name, keys in keep.items()}
    sections["lateral"] |= {"PKY4": 2.0, "PKY6": 0.0, "PKY7": 0.0}
    new = {
        **{
            key: data[key]
            for key in ("radius", "vertical_stiffness", "vertical_damping", "model", "ranges", "overturning")
        },
        **sections,
        "vertical": data["vertical"],
        "rolling": {key: value for key, value in data["rolling"].items() if value},
        "scaling": {"LFZO": 0.81},
        "operation": {"INFLPRES": 2e5, "NOMPRES": 2e5},
        "structure": {"LONGITUDINAL_STIFFNESS": 4e5, "LATERAL_STIFFNESS": 2e5},
    }
    return old, MagicFormula61Tyre.model_validate(new)


@pytest.mark.parametrize("load", [300.0, 2000.0, 4850.0, 9000.0])
@pytest.mark.parametrize("kappa", [-0.3, -0.02, 0.0, 0.05])
def test_without_its_additions_it_is_52(load, kappa):
    """At small angles, where ``tan alpha = alpha``, and at any slip along without an angle."""
    old, new = reduced()
    p = old.parameters()
    for alpha in (0.0, 1e-6, -1e-6):
        a, b = old.evaluate(kappa, alpha, 0.0, load), new.evaluate(kappa, alpha, 0.0, load)
        assert b.longitudinal_force == pytest.approx(a.longitudinal_force, rel=1e-9)
        assert b.lateral_force == pytest.approx(a.lateral_force, rel=1e-5, abs=1e-4 * load)
        assert b.rolling_moment == pytest.approx(a.rolling_moment, rel=1e-9)
        assert b.overturning_moment == pytest.approx(a.overturning_moment, rel=1e-9)
        if abs(kappa) < 0.03:  # the equivalent slip, there of the tangent, here of the angle
            assert b.aligning_moment == pytest.approx(a.aligning_moment, rel=0.02, abs=1e-4 * load)
    sigma = new.evaluate(load=load).lateral_relaxation
    if sigma > slip.SMALLEST_RELAXATION:
        assert law_52.cornering_stiffness(0.0, load, p) == pytest.approx(-2e5 * sigma, rel=1e-9)


@pytest.mark.parametrize("load", [200.0, 2000.0, 4000.0, 8000.0])
def test_slope_at_zero_and_peak(load):
    """Of a tyre without shifts: ``K = sigma C`` of the carcass, ``D = mu F_z``."""
    h, s = 1e-7, SYMMETRIC.structure
    dfz, at = load / 4000 - 1, SYMMETRIC.evaluate(load=load)
    along = (SYMMETRIC.evaluate(h, 0, 0, load)[0] - SYMMETRIC.evaluate(-h, 0, 0, load)[0]) / (2 * h)
    across = (SYMMETRIC.evaluate(0, h, 0, load)[1] - SYMMETRIC.evaluate(0, -h, 0, load)[1]) / (2 * h)
    if at.longitudinal_relaxation > slip.SMALLEST_RELAXATION:
        assert along == pytest.approx(
            at.longitudinal_relaxation * s.LONGITUDINAL_STIFFNESS * (1 + s.PCFX1 * dfz), rel=1e-6
        )
    if at.lateral_relaxation > slip.SMALLEST_RELAXATION:
        assert -across == pytest.approx(at.lateral_relaxation * s.LATERAL_STIFFNESS * (1 + s.PCFY1 * dfz), rel=1e-6)
    most = max(SYMMETRIC.evaluate(k, 0, 0, load)[0] for k in np.linspace(0, 1.5, 3001))
    assert most == pytest.approx((1.0422 - 0.08285 * dfz) * load, rel=1e-4)
    most = max(SYMMETRIC.evaluate(0, -a, 0, load)[1] for a in np.geomspace(1e-3, 14, 3001))
    assert most == pytest.approx((0.8785 - 0.06452 * dfz) * load, rel=1e-4)


def test_pressure():
    """Softer tyres are softer across, have the longer trail and roll harder; every figure by its own formula."""
    soft, hard = (load_tyre(FOLDER / "tyres" / "mf61_205_60R15.tir", inflation_pressure=p) for p in (1.8e5, 2.6e5))
    for tyre in (soft, hard):
        dp = tyre.pressure_change
        assert tyre.vertical_stiffness == pytest.approx(209651 * (1 + 0.7098 * dp), rel=1e-12)
        ratio = tyre.evaluate(load=3000).rolling_moment / TYRE.evaluate(load=3000).rolling_moment
        assert ratio == pytest.approx((tyre.operation.INFLPRES / 2.2e5) ** -0.4089, rel=1e-12)
        peak = [max(each.evaluate(k, 0, 0, 4000)[0] for k in np.linspace(0, 0.5, 2001)) for each in (tyre, TYRE)]
        assert peak[0] / peak[1] == pytest.approx(1 - 0.09603 * dp + 0.06518 * dp * dp, rel=1e-4)
    assert load_tyre(FOLDER / "tyres" / "mf61_205_60R15.tir", inflation_pressure=2.2e5) == TYRE


@given(f=st.floats(1.0, 9000), v=speeds, fx=st.floats(-4000, 4000), fy=st.floats(-4000, 4000))
def test_loaded_radius_inverts_the_load(f, v, fx, fy):
    tyre = changed(TYRE, vertical={"Q_FCX": 0.1, "Q_FCY": 0.2})
    free = tyre.loaded_radius(0.0, v)
    assert tyre.vertical_load(free - tyre.loaded_radius(f, v, fx, fy), 0.0, v, fx, fy) == pytest.approx(f, rel=1e-9)
    if f > 1500:
        assert tyre.loaded_radius(f, v) < tyre.rolling_radius(f, v) < free


def test_vertical_stiffness_is_the_slope_at_the_nominal_load():
    assert TYRE.vertical_load(-0.01) == 0.0
    rho, h = TYRE.radius * 0.9974 - TYRE.loaded_radius(4000.0), 1e-6
    slope = (TYRE.vertical_load(rho + h) - TYRE.vertical_load(rho - h)) / (2 * h)
    assert slope == pytest.approx(209651, rel=1e-6)


@given(k=slips, a=angles, c=cambers, f=loads, v=speeds)
def test_mirrored_mounting_is_mirrored_coefficients(k, a, c, f, v):
    flipped = {
        section: {name: -getattr(getattr(FULL, section), name) for name in names} for section, names in ODD.items()
    }
    right, coefficients = FULL.mounted("RIGHT"), changed(FULL, **flipped)
    for side, sign in ((coefficients, 1), (FULL, -1)):
        found, there = right.evaluate(k, math.tan(a), c, f, v), side.evaluate(k, sign * math.tan(a), sign * c, f, v)
        for i, odd in enumerate((False, True, True, False, True, False, False, False)):
            assert found[i] == pytest.approx(sign * there[i] if odd else there[i], rel=1e-9, abs=1e-9)


@given(v=speeds, along=st.floats(-30, 30), across=st.floats(-30, 30), f=loads)
def test_sliding_dissipates(v, along, across, f):
    tyre = changed(SYMMETRIC, lateral={"RVY3": 0.0})
    kappa, tan_alpha = slip.steady_slip(-along, v, 1.5), slip.steady_slip(across, v, 50.0)
    found = tyre.evaluate(kappa, tan_alpha, 0.0, f, v, across)
    assert found.longitudinal_force * along <= 0.0
    assert found.lateral_force * across <= 0.0
    assert found.rolling_moment * v <= 0.0


@pytest.mark.parametrize("load", [500.0, 2000.0, 4000.0, 8000.0])
def test_forces_stay_near_the_friction_ellipse(load):
    forces = np.array(
        [
            SYMMETRIC.evaluate(k, a, 0, load)[:2]
            for k in np.linspace(-1.4, 1.4, 71)
            for a in np.tan(np.linspace(-1.4, 1.4, 71))
        ]
    )
    dfz = load / 4000 - 1
    share = np.abs(forces) / (load * np.array([1.0422 - 0.08285 * dfz, 0.8785 - 0.06452 * dfz]))
    assert share.max() <= 1.0 + 1e-12
    assert 0.97 < np.hypot(*share.T).max() < 1.08


def test_compiled_law_is_the_same():
    for helper in helpers(law.contact).values():
        register_jitable(helper)
    pointer = numba.types.CPointer(numba.float64)
    compiled = numba.cfunc(numba.void(*[numba.float64] * 7, pointer, pointer))(law.contact)
    rng = np.random.default_rng(7)
    for tyre in (TYRE, FULL, FULL.mounted("RIGHT"), FULL.uncombined()):
        p = (ctypes.c_double * len(law.PARAMETERS))(*tyre.parameters())
        out = (ctypes.c_double * 8)()
        for x in [np.zeros(7), *rng.uniform(-1, 1, (100, 7)) * [1.6, 3.0, 0.2, 9000, 40, 10, 1.0]]:
            compiled.ctypes(*x, p, out)
            assert list(out) == pytest.approx(list(tyre.evaluate(*map(float, x))), rel=1e-12, abs=1e-12)
