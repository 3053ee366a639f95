"""What every tyre with slip must do, the user's own included; the linear tyre in closed form; how files choose a
tyre."""

from __future__ import annotations

import ctypes
import math
from typing import ClassVar, Literal

import numba
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numba.extending import register_jitable
from pydantic import TypeAdapter, ValidationError

from susp_mj.elements import (
    CONTACT,
    CONTACT_TYRES,
    LAWS,
    AnyContactTyre,
    ContactTyre,
    Law,
    LinearContactTyre,
    register,
)
from susp_mj.elements.law import helpers
from susp_mj.elements.tyres import slip
from susp_mj.elements.tyres.slip import heading
from susp_mj.elements.tyres.tir import load_tyre
from susp_mj.errors import CallbackError, InputError
from vehicles.reading import FOLDER

TIR = FOLDER / "tyres"
ANY = TypeAdapter(AnyContactTyre)


def side_by_size(x, most):
    """``x/sqrt(1 + (x/most)²)``: a helper of the law below."""
    return x / math.hypot(1.0, x / most)


def brush_contact(kappa, tan_alpha, camber, load, rolling, lateral, friction, p, out):
    for i in range(5):
        out[i] = 0.0
    out[5], out[6], out[7] = p[0], p[0], p[1]
    if load <= 0.0 or friction <= 0.0:
        return
    most = p[2] * friction * load
    out[0] = side_by_size(p[3] * load * kappa, most)
    out[1] = -side_by_size(p[3] * load * (tan_alpha + 0.1 * camber), most)


def foreign_contact(kappa, tan_alpha, camber, load, rolling, lateral, friction, p, out):
    out[0] = heading(rolling, lateral)


class OwnTyre(ContactTyre):
    """A user's own."""

    law: ClassVar[Law] = Law("test_own_tyre", brush_contact, role=CONTACT)
    kind: Literal["own"] = "own"
    friction: float = 1.1

    def parameters(self) -> tuple[float, ...]:
        return (0.3, self.radius, self.friction, 20.0)


LINEAR = LinearContactTyre(
    radius=0.31,
    vertical_stiffness=2e5,
    vertical_damping=400.0,
    nominal_load=4000.0,
    cornering_stiffness=70e3,
    longitudinal_stiffness=100e3,
    camber_stiffness=3e3,
    pneumatic_trail=0.035,
    rolling_resistance=0.012,
    longitudinal_relaxation=0.2,
    lateral_relaxation=0.5,
)
register(OwnTyre)
EXAMPLES = {
    "linear": LINEAR,
    "magic_formula": load_tyre(TIR / "pac2002_245_40R18.tir"),
    "magic_formula_61": load_tyre(TIR / "mf61_205_60R15.tir"),
    "own": OwnTyre(radius=0.3, vertical_stiffness=2e5),
}
every = pytest.mark.parametrize("kind", CONTACT_TYRES)
slips, tangents, cambers = st.floats(-2, 2), st.floats(-50, 50), st.floats(-0.5, 0.5)
loads, speeds = st.floats(1.0, 15000.0), st.floats(-80, 80)


def test_every_kind_has_an_example():
    assert set(EXAMPLES) == set(CONTACT_TYRES)
    assert {tyre.law for tyre in CONTACT_TYRES.values()} == {law for law in LAWS.values() if law.role == CONTACT}


@every
def test_a_file_gives_the_same_tyre(kind):
    tyre = EXAMPLES[kind]
    assert type(tyre) is CONTACT_TYRES[kind]
    assert ANY.validate_python(tyre.model_dump()) == tyre
    assert tyre.vertical_stiffness > 1e5
    assert tyre.vertical_damping >= 0.0


@every
@given(k=slips, t=tangents, c=cambers, v=speeds, w=speeds)
def test_no_load_no_force(kind, k, t, c, v, w):
    tyre = EXAMPLES[kind]
    for load in (0.0, -0.0, -300.0):
        found = tyre.evaluate(k, t, c, load, v, w)
        assert found[:5] == (0.0,) * 5
        assert min(found.longitudinal_relaxation, found.lateral_relaxation) >= slip.SMALLEST_RELAXATION
        assert found.rolling_radius == pytest.approx(tyre.radius, rel=0.05)
    if kind != "linear":
        assert np.abs(tyre.evaluate(k, t, c, 1e-6, v, w)[:5]).max() < 1e-5


@every
@given(k=slips, t=tangents, c=cambers, f=loads)
def test_standstill_is_no_singularity(kind, k, t, c, f):
    """Everything is finite, forces hold the parked car, and the moments that come from rolling are zero and
    continuous."""
    tyre = EXAMPLES[kind]
    still, slow = list(tyre.evaluate(k, t, c, f, 0.0, 0.0)), list(tyre.evaluate(k, t, c, f, 1e-12, 1e-12))
    assert all(map(math.isfinite, still))
    assert still[3] == 0.0
    assert slow == pytest.approx(still, rel=1e-6, abs=1e-4)
    assert tyre.evaluate(0.02, 0.05, 0.0, 4000.0, 0.0, 0.0)[:2] == pytest.approx(
        tyre.evaluate(0.02, 0.05, 0.0, 4000.0)[:2], rel=1e-9
    )


@every
@given(k=slips, t=tangents, c=cambers, f=loads, v=speeds, w=speeds, grip=st.floats(0, 2))
def test_anything_is_finite(kind, k, t, c, f, v, w, grip):
    found = EXAMPLES[kind].evaluate(k, t, c, f, v, w, grip)
    assert all(map(math.isfinite, found))
    assert min(found.longitudinal_relaxation, found.lateral_relaxation) >= slip.SMALLEST_RELAXATION
    assert found.rolling_moment * v <= 0.0


@every
def test_sliding_sideways_altogether(kind):
    """A slip angle of a right angle: the force is the friction, or what the tyre's valid range leaves of it."""
    tyre = EXAMPLES[kind]
    for tan_alpha in (1e3, 1e9, 1e16, 1e150):
        for grip in (1.0, 0.1, 0.0):
            found = tyre.evaluate(0.1, tan_alpha, 0.02, 4000.0, 0.0, 20.0, grip)
            assert all(map(math.isfinite, found))
            assert kind == "linear" or abs(found.lateral_force) <= 1.3 * 4000 * grip + 1.0


@every
def test_signs(kind):
    """A driven wheel is driven, a tyre that drifts left is pushed right and turned left, one that leans right is pushed
    right."""
    tyre, load = EXAMPLES[kind], 4000.0
    straight = tyre.evaluate(load=load)
    assert tyre.evaluate(0.02, 0.0, 0.0, load)[0] > 500 > -500 > tyre.evaluate(-0.02, 0.0, 0.0, load)[0]
    assert tyre.evaluate(0.0, 0.03, 0.0, load)[1] < -500 < 500 < tyre.evaluate(0.0, -0.03, 0.0, load)[1]
    if kind != "own":
        assert tyre.evaluate(0.0, 0.03, 0.0, load).aligning_moment > straight.aligning_moment + 10
        assert straight.rolling_moment < 0.0 < tyre.evaluate(load=load, rolling=-20.0).rolling_moment
    assert tyre.evaluate(0.0, 0.0, 0.05, load).lateral_force < straight.lateral_force


@every
def test_road_friction_leaves_the_stiffness(kind):
    tyre = EXAMPLES[kind]
    grid = np.linspace(-0.02, 0.02, 2001)
    dry, ice = (np.array([tyre.evaluate(0, t, 0, 4000, friction=grip)[1] for t in grid]) for grip in (1.0, 0.2))
    assert np.diff(ice).min() == pytest.approx(np.diff(dry).min(), rel=1e-3)
    dry, ice = (tyre.evaluate(0, 0.5, 0, 4000, friction=grip)[1] for grip in (1.0, 0.2))
    if kind != "linear":
        assert ice == pytest.approx(0.2 * dry, rel=0.2)
        assert max(map(abs, tyre.evaluate(0.5, 0.5, 0.05, 4000, friction=0.0)[:2])) < 0.1


@every
@given(k=slips, t=tangents, c=cambers, f=loads, v=speeds, w=speeds)
def test_mounted_on_the_other_side_it_is_mirrored(kind, k, t, c, f, v, w):
    tyre = EXAMPLES[kind]
    left, right = tyre.mounted("LEFT").evaluate(k, t, c, f, v, w), tyre.mounted("RIGHT").evaluate(k, -t, -c, f, v, -w)
    for name, a, b in zip(left._fields, left, right, strict=True):
        sign = -1 if name in ("lateral_force", "overturning_moment", "aligning_moment") else 1
        assert a == pytest.approx(sign * b, rel=1e-9, abs=1e-9), name


@every
def test_continuous_in_slip_and_camber(kind):
    tyre, grid = EXAMPLES[kind], np.linspace(-0.1, 0.1, 2001)
    for place in range(3):
        rows = np.array([tyre.evaluate(*np.insert([0.02, -0.03], place, x), 4000.0)[:5] for x in grid])
        assert np.abs(np.diff(rows, axis=0)).max() < 2e5 * (grid[1] - grid[0])


@every
def test_compiled_it_is_the_same(kind):
    tyre = EXAMPLES[kind]
    for helper in helpers(tyre.law.function).values():
        register_jitable(helper)
    pointer = numba.types.CPointer(numba.float64)
    compiled = numba.cfunc(numba.void(*[numba.float64] * 7, pointer, pointer))(tyre.law.function)
    p, out = (ctypes.c_double * len(tyre.parameters()))(*tyre.parameters()), (ctypes.c_double * 8)(*[9.0] * 8)
    rng = np.random.default_rng(5)
    for x in [np.zeros(7), *rng.uniform(-1, 1, (100, 7)) * [1.6, 3.0, 0.2, 9000, 40, 10, 1.0]]:
        compiled.ctypes(*x, p, out)
        assert list(out) == pytest.approx(list(tyre.evaluate(*map(float, x))), rel=1e-12, abs=1e-12)


# ---- the linear tyre


@given(k=slips, t=tangents, c=cambers, f=loads, v=st.floats(0.1, 80), dependent=st.booleans())
def test_linear_tyre_in_closed_form(k, t, c, f, v, dependent):
    found = LINEAR.model_copy(update={"load_dependent": dependent}).evaluate(k, t, c, f, v)
    share = f / 4000.0 if dependent else 1.0
    expected = (
        100e3 * share * k,
        -70e3 * share * t - 3e3 * share * c,
        0.0,
        -0.012 * 0.31 * f,
        0.035 * 70e3 * share * t,
        0.2,
        0.5,
        0.31,
    )
    assert found == pytest.approx(expected, rel=1e-14)
    back = LINEAR.model_copy(update={"load_dependent": dependent}).evaluate(k, t, c, f, -v)
    assert back == pytest.approx([x if i not in (3, 4) else -x for i, x in enumerate(expected)], rel=1e-14)


# ---- choosing a tyre


def test_overrides_of_a_file():
    tyre = ANY.validate_python(
        {
            "kind": "magic_formula",
            "file": TIR / "pac2002_245_40R18.tir",
            "vertical_stiffness": "250 N/mm",
            "vertical_damping": 50,
            "scaling": {"LMUY": 0.9},
        }
    )
    there = EXAMPLES["magic_formula"]
    assert (tyre.vertical_stiffness, tyre.vertical_damping) == (250000.0, 50.0)
    assert (tyre.scaling.LMUY, tyre.scaling.LFZO) == (0.9, there.scaling.LFZO)
    assert tyre.lateral == there.lateral
    at_pressure = ANY.validate_python(
        {"kind": "magic_formula_61", "file": TIR / "mf61_205_60R15.tir", "inflation_pressure": "2.5 bar"}
    )
    assert at_pressure == load_tyre(TIR / "mf61_205_60R15.tir", inflation_pressure=250000.0)


@pytest.mark.parametrize(
    ("data", "parts"),
    [
        ({}, ("kind", "is required", "magic_formula")),
        ({"kind": "magic_formul"}, ("'magic_formul' unknown", "did you mean 'magic_formula'", "linear")),
        ({"kind": "magic_formula"}, ("file",)),
        (
            {"kind": "magic_formula", "file": TIR / "pac2002_245_40R18.tir", "scaling": {"LMUI": 1}},
            ("scaling", "did you mean", "LMUY"),
        ),
        (
            {"kind": "magic_formula", "file": TIR / "pac2002_245_40R18.tir", "scaling": {"LMUY": 0}},
            ("scaling", "greater than 0"),
        ),
        (
            {"kind": "magic_formula", "file": TIR / "pac2002_245_40R18.tir", "vertical_stiffness": -1},
            ("vertical_stiffness",),
        ),
        (
            {"kind": "magic_formula_61", "file": TIR / "pac2002_245_40R18.tir"},
            ("pac2002_245_40R18.tir", "another version"),
        ),
        ({"kind": "linear", "radius": 0.3}, ("vertical_stiffness", "nominal_load", "cornering_stiffness")),
        ({**LINEAR.model_dump(), "cornering_stiffnes": 3}, ("unknown key", "did you mean 'cornering_stiffness'")),
    ],
)
def test_errors(data, parts):
    with pytest.raises(ValidationError) as caught:
        ANY.validate_python(data)
    for part in parts:
        assert part in str(caught.value)


def test_a_missing_file_is_named():
    with pytest.raises(InputError, match=r"none.tir: no such file"):
        ANY.validate_python({"kind": "magic_formula", "file": TIR / "none.tir"})


def test_what_cannot_be_registered():
    class Another(OwnTyre):
        pass

    class Unnamed(ContactTyre):
        law: ClassVar[Law] = Law("unnamed", brush_contact, role=CONTACT)

        def parameters(self) -> tuple[float, ...]:
            return ()

    class Foreign(ContactTyre):
        law: ClassVar[Law] = Law("foreign", foreign_contact, role=CONTACT)
        kind: Literal["foreign"] = "foreign"

        def parameters(self) -> tuple[float, ...]:
            return ()

    class Wrong(Foreign):
        law: ClassVar[Law] = Law("wrong", brush_contact)

    with pytest.raises(CallbackError, match="kind 'own' of Another is taken by OwnTyre"):
        register(Another)
    with pytest.raises(CallbackError, match="needs a default for 'kind'"):
        register(Unnamed)
    with pytest.raises(CallbackError, match="may only call functions of its own module"):
        register(Foreign)
    with pytest.raises(CallbackError, match="has role 'force'; that of Wrong needs role 'contact'"):
        register(Wrong)
    register(OwnTyre)
    assert set(CONTACT_TYRES) == set(EXAMPLES)
