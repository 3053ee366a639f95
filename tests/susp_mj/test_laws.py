"""Laws that answer more than a force: brakes, air and driver do what physics asks of them, compiled as in Python, and
only in their own role; a user's own join by `register`."""

from __future__ import annotations

import ctypes
import math
from typing import ClassVar, Literal

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import TypeAdapter

from manoeuvres.driving import Driving
from susp_mj import simulate
from susp_mj.compiled import compile_laws
from susp_mj.compiled import laws as compiled_laws
from susp_mj.elements import (
    AERODYNAMICS,
    BRAKE,
    BRAKES,
    DRIVER,
    FAMILIES,
    FORCE,
    LAWS,
    Aerodynamics,
    AnyAerodynamics,
    AnyBrakes,
    Brakes,
    Driver,
    HydraulicDamper,
    Law,
    LinearAerodynamics,
    Path,
    PreviewDriver,
    ProportionalBrakes,
    Spring,
    register,
)
from susp_mj.errors import CallbackError
from vehicles import load_vehicle
from vehicles.mjcf import build

BRAKED = ProportionalBrakes(torque=4000.0, front_share=0.65)
AIR = LinearAerodynamics(area=2.2, drag=0.3, lift_front=0.05, lift_rear=0.1, side=2.1, yaw=0.3)
DRIVER_OF_BOTH = (
    PreviewDriver(Path(np.arange(0.0, 50.0, 0.5), np.sin(np.arange(0.0, 50.0, 0.5) / 9)), understeer=0.003),
    PreviewDriver(Path(radius=-60.0), preview_time=0.5, lag=0.05),
)
EXAMPLES = [
    (BRAKED, [1.0, 1.2, 60.0, 1.0]),
    (AIR, [60.0, 30.0, 3.0]),
    *((driver, [50.0, 5.0, 1.0, 40.0, 3.0, 18.0, 3.0, 9.0]) for driver in DRIVER_OF_BOTH),
]
VECTORED = [pytest.param(*example, id=type(example[0]).__name__) for example in EXAMPLES]


def compiled(law):
    """The compiled function of a law whose role has several answers."""
    compile_laws([(law.number, law.role)])
    pointer = ctypes.POINTER(ctypes.c_double)
    kind = ctypes.CFUNCTYPE(None, *[ctypes.c_double] * len(law.role.asked), pointer, pointer)
    return kind(int(compiled_laws.TABLES[law.role.name][law.number]))


def test_every_law_with_several_answers_has_an_example():
    tyres = {law for law in LAWS.values() if law.role.name == "contact"}  # see test_contact_tyres
    assert {example.law for example, _ in EXAMPLES} | tyres == {law for law in LAWS.values() if law.role != FORCE}


@pytest.mark.parametrize(("example", "largest"), VECTORED)
def test_compiled_it_is_the_same(example, largest):
    machine, parameters = compiled(example.law), example.parameters()
    p = (ctypes.c_double * len(parameters))(*parameters)
    rng = np.random.default_rng(20070612)
    for asked in [np.zeros(len(largest)), *rng.uniform(-1, 1, (200, len(largest))) * largest]:
        out = (ctypes.c_double * len(example.role.answers))(*[9.0] * len(example.role.answers))
        machine(*asked, p, out)
        assert list(out) == pytest.approx(example.law.answer(*asked, parameters=parameters), rel=1e-12, abs=1e-12)


@pytest.mark.parametrize(("number", "role"), [(BRAKED.law.number, FORCE), (AIR.law.number, BRAKE)])
def test_a_law_is_called_in_its_own_role_only(number, role):
    with pytest.raises(CallbackError, match=f"as a {role.name} law; it is a"):
        compile_laws([(number, role)])


# ---- brakes


@given(pedal=st.floats(0, 1), bristle=st.floats(-1, 1), spin=st.floats(-120, 120), front=st.sampled_from([0.0, 1.0]))
def test_a_brake_stays_within_its_limit_and_settles_against_the_turning(pedal, bristle, spin, front):
    torque, rate = BRAKED.law.answer(pedal, bristle, spin, front, parameters=BRAKED.parameters())
    largest = pedal * 4000.0 * (0.65 if front else 0.35) / 2
    assert abs(torque) <= largest * (1 + 1e-12)
    assert rate * (np.sign(spin) - bristle) >= 0
    settled, _ = BRAKED.law.answer(pedal, float(np.sign(spin)), spin, front, parameters=BRAKED.parameters())
    assert settled * spin == pytest.approx(largest * abs(spin), rel=1e-9, abs=1e-9)


# ---- air


@given(along=st.floats(-70, 70), across=st.floats(-30, 30))
def test_air_mirrors_and_its_drag_takes_power(along, across):
    x, y, z, roll, pitch, yaw = AIR.law.answer(along, across, 2.9, parameters=AIR.parameters())
    mirrored = AIR.law.answer(along, -across, 2.9, parameters=AIR.parameters())
    assert mirrored == pytest.approx((x, -y, z, -roll, pitch, -yaw), rel=1e-12, abs=1e-12)
    assert x * along >= 0.0
    assert x == pytest.approx(0.5 * 1.225 * 2.2 * 0.3 * math.hypot(along, across) * along, rel=1e-9, abs=1e-9)


# ---- driver


@given(off=st.floats(-3, 3), speed=st.floats(5, 40))
def test_a_driver_steers_back_to_a_straight_path(off, speed):
    straight = PreviewDriver(Path())
    rate, deviation = straight.law.answer(0, off, 0, speed, 0, 16, 2.9, 9, parameters=straight.parameters())
    assert deviation == off
    assert rate * off <= 0.0


# ---- how files choose them, and a user's own


def test_files_need_not_name_the_usual_kind():
    assert TypeAdapter(AnyBrakes).validate_python({"torque": 4000, "front_share": 0.65}) == BRAKED
    fields = AIR.model_dump(exclude={"kind"})
    assert TypeAdapter(AnyAerodynamics).validate_python(fields) == AIR


def test_every_family_has_kinds_whose_laws_have_its_role():
    for family, kinds in FAMILIES.items():
        assert kinds
        for name, kind in kinds.items():
            assert issubclass(kind, family)
            assert kind.model_fields["kind"].default == name
            assert kind.law.role == kind.role == family.role


def lagging_brake(pedal, bristle, spin, front, p, out):
    """A viscous brake on the front wheels alone; p = rate."""
    out[0], out[1] = front * p[0] * pedal * spin, -bristle


class ViscousBrakes(Brakes):
    """A user's own."""

    law: ClassVar[Law] = Law("viscous_brake_of_the_tests", lagging_brake, role=BRAKE)
    kind: Literal["viscous"] = "viscous"
    rate: float

    def parameters(self) -> tuple[float, ...]:
        return (self.rate,)


def still_air(along, across, wheelbase, p, out):
    for i in range(6):
        out[i] = 0.0
    out[0] = p[0] * along


class Parachute(Aerodynamics):
    """A user's own."""

    law: ClassVar[Law] = Law("parachute_of_the_tests", still_air, role=AIR.role)
    kind: Literal["parachute"] = "parachute"
    rate: float

    def parameters(self) -> tuple[float, ...]:
        return (self.rate,)


def steady_hand(x, y, heading, speed, angle, ratio, wheelbase, limit, p, out):
    out[0], out[1] = p[0] - angle, y


class SteadyHand(Driver):
    """A user's own: goes to an angle and holds it."""

    law: ClassVar[Law] = Law("steady_hand_of_the_tests", steady_hand, role=DRIVER)

    def parameters(self) -> tuple[float, ...]:
        return (0.5,)


class Course(Driving):
    """Braked from 1 s on by the user's own brakes, in the user's own air, by the user's own driver."""

    kind: Literal["course"] = "course"
    duration: float = 3.0

    def driver(self):
        return SteadyHand()

    def drive(self, place, time):
        if place.quantity == "brake_pedal":
            return np.where(time > 1.0, 0.5, 0.0), np.zeros_like(time)
        if place.quantity == "speed_control":
            return np.where(time > 1.0, 0.0, 1.0), np.zeros_like(time)
        return super().drive(place, time)


@pytest.fixture
def users_own():
    """The user's own elements, registered for one test."""
    own = (ViscousBrakes, Parachute, SteadyHand)
    for element in own:
        register(element)
    yield
    for element in own:
        del LAWS[element.law.number]
    del BRAKES["viscous"], AERODYNAMICS["parachute"]


def test_a_car_on_brakes_air_and_driver_of_the_users_own(users_own):
    """The driver holds his angle, rear wheels are not braked, front ones viscously, and the air pushes as it says."""
    own = {"brakes": {"kind": "viscous", "rate": 30.0}, "aerodynamics": {"kind": "parachute", "rate": 40.0}}
    run = simulate(build(load_vehicle("s_class", "configuration_4", own), "handling"), Course())
    np.testing.assert_allclose(run["fl_brake_torque"], 30.0 * run["brake_pedal"] * run["fl_wheel_speed"], atol=1.0)
    assert not run["rl_brake_torque"].any()
    assert run["steering_wheel_angle"][-1] == pytest.approx(0.5 * (1 - math.exp(-3)), abs=2e-3)
    assert run["speed"][-1] < run["speed"][0] - 1.0


def test_a_law_of_the_wrong_role_is_refused():
    class Wrong(Spring):
        law: ClassVar[Law] = Law("wrong_role_of_the_tests", lagging_brake, role=BRAKE)
        kind: Literal["wrong"] = "wrong"

        def parameters(self) -> tuple[float, ...]:
            return ()

    class Unfinished(HydraulicDamper):
        law: ClassVar[Law] = Law("unfinished_of_the_tests", lagging_brake)
        kind: Literal["unfinished"] = "unfinished"

    with pytest.raises(CallbackError, match="Unfinished does not define branches, which its base class asks for"):
        register(Unfinished)
    with pytest.raises(CallbackError, match="has role 'brake'; that of Wrong needs role 'force'"):
        register(Wrong)
    with pytest.raises(CallbackError, match="must derive from Spring, Damper, Tyre, ContactTyre, Brakes, Aerodynamics"):
        register(dict)
