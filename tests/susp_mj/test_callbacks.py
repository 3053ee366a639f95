"""The compiled callbacks: in place once, silent on models that are not ours, right about memory, true to a plain
loop."""

from __future__ import annotations

import dataclasses
import importlib
import subprocess
import sys

import mujoco
import numpy as np
import pytest

from manoeuvres import Bump, RoadStep
from susp_mj import compiled, simulate
from susp_mj.compiled import layout
from susp_mj.elements import LAWS, Law, LinearSpring, register
from susp_mj.elements.law import ACTUATOR_MARK, USERDATA_HEADER, helpers
from susp_mj.equilibrium import static_equilibrium
from susp_mj.errors import CallbackError
from susp_mj.plant import Plant
from vehicles import load_vehicle
from vehicles.mjcf import build, write

GETTERS = (mujoco.get_mjcb_act_bias, mujoco.get_mjcb_act_dyn, mujoco.get_mjcb_control)


@pytest.fixture
def no_callbacks():
    """Start without callbacks, end with none of the test's."""
    compiled.uninstall()
    yield
    mujoco.set_mjcb_control(None)
    mujoco.set_mjcb_act_bias(None)
    mujoco.set_mjcb_act_dyn(None)


@pytest.fixture
def plant():
    return build(load_vehicle("chapter3", "nonlinear"), "quarter_2dof")


def foreign_model(user: int = 6, userdata: int = 6):
    """User actuators with parameters and user data that mean something to somebody else."""
    spec = mujoco.MjSpec()
    spec.nuserdata, spec.nuser_actuator = userdata, user
    spec.option.integrator = mujoco.mjtIntegrator.mjINT_RK4
    body = spec.worldbody.add_body(mass=2.0, inertia=[1, 1, 1], explicitinertial=True)
    body.add_joint(name="j", type=mujoco.mjtJoint.mjJNT_SLIDE, axis=[0, 0, 1])
    actuator = spec.add_actuator(
        name="a",
        target="j",
        trntype=mujoco.mjtTrn.mjTRN_JOINT,
        biastype=mujoco.mjtBias.mjBIAS_USER,
        dyntype=mujoco.mjtDyn.mjDYN_USER,
        actdim=1,
        gainprm=[0.0] * 10,
    )
    actuator.userdata = [7.0, float(LinearSpring.law.number), -1.0, 1.0, 50.0, 10.0][:user]
    return spec.compile()


def motion(model, prepare=None, steps=200):
    data = mujoco.MjData(model)
    if prepare is not None:
        prepare(data)
    states = np.empty((steps, model.nq + model.nv + model.na))
    for row in states:
        mujoco.mj_step(model, data)
        row[:] = np.concatenate([data.qpos, data.qvel, data.act])
    return states, data


# ---- installing


def test_install_is_idempotent(no_callbacks):
    assert not compiled.installed()
    compiled.install()
    first = [get() for get in GETTERS]
    assert compiled.installed()
    assert all(each is not None for each in first)
    compiled.install()
    assert compiled.installed()
    assert [get() for get in GETTERS] == first
    compiled.uninstall()
    assert [get() for get in GETTERS] == [None] * 3
    assert not compiled.installed()


@pytest.mark.parametrize("slot", ["act_bias", "act_dyn", "control"])
def test_a_foreign_callback_is_not_replaced(no_callbacks, slot):
    def mine(*arguments):
        return 0.0

    put, get = getattr(mujoco, f"set_mjcb_{slot}"), getattr(mujoco, f"get_mjcb_{slot}")
    put(mine)
    with pytest.raises(CallbackError, match=f"mjcb_{slot} is taken"):
        compiled.install()
    assert get() is mine
    compiled.uninstall()
    assert get() is mine


# ---- models that are not ours


@pytest.mark.parametrize("user", [0, 1, 2, 6])
@pytest.mark.parametrize("userdata", [0, 1, 2, 6])
def test_foreign_user_actuators_are_left_alone(no_callbacks, user, userdata):
    model = foreign_model(user, userdata)
    content = np.arange(1.0, userdata + 1)

    def prepare(data):
        data.userdata[:] = content
        data.ctrl[:] = 0.25
        data.act[:] = 0.5

    before, _ = motion(model, prepare)
    compiled.install()
    after, data = motion(model, prepare)
    np.testing.assert_array_equal(before, after)
    assert data.actuator_force[0] == 0.0
    np.testing.assert_array_equal(data.act, 0.5)
    np.testing.assert_array_equal(data.userdata, content)
    np.testing.assert_array_equal(data.ctrl, 0.25)


def test_models_without_user_actuators_move_the_same(no_callbacks):
    xml = """<mujoco><option integrator="RK4"/><worldbody>
        <body pos="0 0 1"><joint name="a" type="hinge" axis="0 1 0" damping="0.1"/>
        <geom type="capsule" size="0.05 0.3"/>
        <body pos="0.3 0 0"><joint name="b" type="hinge" axis="0 1 0"/><geom type="sphere" size="0.1"/></body>
        </body></worldbody>
        <actuator><motor joint="a" ctrlrange="-2 2"/><position joint="b" kp="30"/></actuator></mujoco>"""
    model = mujoco.MjModel.from_xml_string(xml)

    def prepare(data):
        data.ctrl[:] = [1.0, 0.5]

    before, _ = motion(model, prepare)
    compiled.install()
    after, data = motion(model, prepare)
    np.testing.assert_array_equal(before, after)
    np.testing.assert_array_equal(data.ctrl, [1.0, 0.5])
    assert np.ptp(after, axis=0).min() > 0.01


@pytest.mark.parametrize("place", ["<actuator>", "</actuator>"], ids=["first", "last"])
def test_a_motor_added_to_a_written_model_is_left_alone(tmp_path, place):
    """A user's own actuator in one of our files has no law; it neither stops the run nor changes it."""
    vehicle = load_vehicle("chapter3", "nonlinear")
    path = write(vehicle, "quarter_2dof", tmp_path / "car.xml")
    text, motor = path.read_text(), '<motor name="mine" joint="heave"/>'
    assert text.count(place) == 1
    path.write_text(text.replace(place, place + motor if place == "<actuator>" else motor + place))
    manoeuvre = Bump(duration=0.5)
    run = simulate(Plant.from_mjcf(path), manoeuvre)
    expected = simulate(build(vehicle, "quarter_2dof"), manoeuvre)
    np.testing.assert_array_equal(run["body_displacement"], expected["body_displacement"])


def test_motors_added_first_do_not_move_the_callbacks_out_of_their_memory(tmp_path):
    """With more actuators than `userdata` was sized for, the rate of an input may not land in the array behind it."""
    path = write(load_vehicle("chapter3", "nonlinear"), "quarter_2dof", tmp_path / "car.xml")
    motors = "".join(f'<motor name="mine{i}" joint="heave"/>' for i in range(10))
    text = path.read_text().replace("<actuator>", "<actuator>" + motors)
    path.write_text(text)
    plant = Plant.from_mjcf(path)
    compiled.install(plant.laws)
    data = mujoco.MjData(plant.model)
    block = compiled.input_block(np.full((3, 1, 2), 0.125), 0.5e-3, plant.entries())
    compiled.attach_input(data, block)
    mujoco.mj_forward(plant.model, data)
    assert data.ctrl[plant.model.actuator("tyre").id] == 0.125
    np.testing.assert_array_equal(data.xpos[0], 0.0, err_msg="the world has been moved")


# ---- unknown laws


def model_with_law(number):
    spec = mujoco.MjSpec()
    spec.nuserdata, spec.nuser_actuator = 3, 9
    body = spec.worldbody.add_body(mass=1.0, inertia=[1, 1, 1], explicitinertial=True)
    body.add_joint(name="j", type=mujoco.mjtJoint.mjJNT_SLIDE, axis=[0, 0, 1])
    actuator = spec.add_actuator(
        name="a",
        target="j",
        trntype=mujoco.mjtTrn.mjTRN_JOINT,
        biastype=mujoco.mjtBias.mjBIAS_USER,
        dyntype=mujoco.mjtDyn.mjDYN_USER,
        actdim=1,
    )
    actuator.userdata = [ACTUATOR_MARK, float(number), 0.0, 1.0, 0.0, 1.0, 1.0, 2.0, 3.0]
    return spec.compile()


UNKNOWN = next(number for number in range(1, 4096) if number not in LAWS)


@pytest.mark.parametrize("number", [UNKNOWN, 0, -3, 4096, 10**9])
def test_an_unknown_law_gives_no_force(number):
    compiled.install()
    _, data = motion(model_with_law(number), steps=20)
    assert data.actuator_force[0] == 0.0
    assert data.act[0] == 0.0
    assert data.qvel[0] == pytest.approx(-9.81 * 20 * 0.002, rel=1e-12)


@pytest.mark.parametrize("number", [UNKNOWN, 4096, 10**9])
def test_an_unknown_law_is_named(plant, number):
    broken = dataclasses.replace(plant, model=model_with_law(number))
    with pytest.raises(CallbackError, match=str(number)):
        simulate(broken, Bump(duration=0.01))


# ---- memory layout

FIELDS = [(struct, name) for struct in ("model", "data") for name in getattr(layout.LAYOUT, struct)]


@pytest.mark.parametrize("shift", [-8, -4, 4, 8, 1])
@pytest.mark.parametrize(("struct", "name"), FIELDS)
def test_a_wrong_offset_is_caught(struct, name, shift):
    offsets = getattr(layout.LAYOUT, struct)
    wrong = dataclasses.replace(layout.LAYOUT, **{struct: {**offsets, name: offsets[name] + shift}})
    with pytest.raises(CallbackError, match=name):
        layout.check_layout(wrong)


def test_the_layout_is_found_the_same_twice():
    found = layout.find_layout()
    assert found == layout.LAYOUT
    layout.check_layout(found)


def test_the_version_is_part_of_the_record_type():
    """The compiler's disk cache is keyed on types: another MuJoCo must give another type."""
    version = mujoco.__version__.replace(".", "_")
    assert any(version in name for name in layout.LAYOUT.record("data").names)
    assert any(version in name for name in layout.LAYOUT.record("model").names)


# ---- the loop


@pytest.mark.parametrize("model_name", ["quarter_1dof", "quarter_2dof"])
@pytest.mark.parametrize("manoeuvre", [Bump(duration=1.0), RoadStep(duration=1.0, rise_time=0.0)], ids=["bump", "jump"])
def test_the_loop_equals_plain_mj_step(model_name, manoeuvre):
    """MuJoCo's own stepping function, called from Python, gives the same states to the last bit."""
    plant = build(load_vehicle("chapter3", "nonlinear"), model_name)
    run = simulate(plant, manoeuvre)
    steps = len(run.time) - 1

    half = np.arange(2 * steps + 1) * 0.5e-3
    value, rate = manoeuvre.drive(plant.meaning.inputs[0], half)
    block = compiled.input_block(np.stack([value, rate], axis=-1)[:, None, :], 0.5e-3, plant.entries())
    data = static_equilibrium(plant)
    compiled.attach_input(data, block)
    heave = int(plant.model.joint("heave").qposadr[0])
    positions, speeds = [data.qpos[heave]], [data.qvel[heave]]
    for _ in range(steps):
        mujoco.mj_step(plant.model, data)
        positions.append(data.qpos[heave])
        speeds.append(data.qvel[heave])
    np.testing.assert_array_equal(run["body_displacement"], positions)
    np.testing.assert_array_equal(run["body_velocity"], speeds)
    assert np.ptp(positions) > 0.01


def test_inputs_reach_the_stages(plant):
    """At a half step the control callback hands over the half step's sample; outside the block its ends."""
    samples = np.zeros((5, 1, 2))
    samples[:, 0, 0], samples[:, 0, 1] = [0.0, 0.01, 0.04, 0.02, 0.03], [1.0, 2.0, 3.0, 4.0, 5.0]
    block = compiled.input_block(samples, 0.5e-3, plant.entries())
    compiled.install()
    data = mujoco.MjData(plant.model)
    compiled.attach_input(data, block)
    tyre = plant.model.actuator("tyre").id
    for time, value, rate in (
        (0.0, 0.0, 1.0),
        (0.5e-3, 0.01, 2.0),
        (1e-3, 0.04, 3.0),
        (1.25e-3, 0.03, 3.5),
        (2e-3, 0.03, 5.0),
        (9.0, 0.03, 5.0),
    ):
        data.time = time
        mujoco.mj_forward(plant.model, data)
        assert data.ctrl[tyre] == pytest.approx(value, abs=1e-15)
        assert data.userdata[USERDATA_HEADER + tyre] == pytest.approx(rate, abs=1e-12)
    compiled.attach_input(data, None)
    assert not data.userdata.any()


# ---- laws of the user's own

FAR_HELPER = "def far(x):\n    return 2.0 * x\n"
NEAR_LAW = (
    "def near(x):\n    return 2.0 * x\n\n\ndef force(deflection, speed, state, p):\n    return near(deflection) * "
    "p[0]\n"
)
FAR_LAW = (
    "from susp_test_far import far\n\n\ndef middle(x):\n    return far(x)\n\n\n"
    "def force(deflection, speed, state, p):\n    return middle(deflection) * p[0]\n"
)


@pytest.fixture
def user_modules(tmp_path, monkeypatch):
    for name, text in (("susp_test_far", FAR_HELPER), ("susp_test_near_law", NEAR_LAW), ("susp_test_far_law", FAR_LAW)):
        (tmp_path / f"{name}.py").write_text(text)
    monkeypatch.syspath_prepend(tmp_path)
    importlib.invalidate_caches()
    yield
    for name in ("susp_test_far", "susp_test_near_law", "susp_test_far_law"):
        sys.modules.pop(name, None)


def spring_class(kind, law):
    return type("MySpring", (LinearSpring,), {"__annotations__": {"kind": str}, "kind": kind, "law": law})


def test_helpers_of_the_same_module_are_found(user_modules):
    module = importlib.import_module("susp_test_near_law")
    assert helpers(module.force) == {"near": module.near}


def test_a_helper_of_another_module_is_refused(user_modules):
    """The disk cache looks at the law's own file only, and would keep an old helper."""
    module = importlib.import_module("susp_test_far_law")
    with pytest.raises(CallbackError, match=r"susp_test_far\.far"):
        helpers(module.force)
    element = spring_class("user_linear", Law("user_spring_far", module.force))
    before = dict(LAWS)
    with pytest.raises(CallbackError, match="own module"):
        register(element)
    assert before == LAWS


COMPILE = """\
import importlib.util, sys
from susp_mj.compiled import compile_laws
from susp_mj.elements import LAWS, Law
spec = importlib.util.spec_from_file_location(sys.argv[1], sys.argv[2])
module = importlib.util.module_from_spec(spec)
sys.modules[spec.name] = module
spec.loader.exec_module(module)
law = Law("user_law_of_two_names", module.force)
LAWS[law.number] = law
compile_laws([(law.number, law.role)])
"""


def test_a_users_file_may_be_loaded_under_another_name(tmp_path):
    """As a script it is ``__main__``, imported it has its own name: what one left on the disk may not break the
    other."""
    (tmp_path / "mine.py").write_text(NEAR_LAW)
    for name in ("under_one_name", "under_another_name"):
        call = [sys.executable, "-c", COMPILE, name, tmp_path / "mine.py"]
        result = subprocess.run(call, capture_output=True, text=True, timeout=120, check=False)
        assert result.returncode == 0, result.stderr


def test_a_law_that_numba_cannot_compile_is_named():
    def force(deflection, speed, state, p):
        return float(str(deflection)) + object()

    law = Law("user_spring_impossible", force)
    LAWS[law.number] = law
    try:
        with pytest.raises(CallbackError, match="user_spring_impossible"):
            compiled.compile_laws([(law.number, law.role)])
    finally:
        del LAWS[law.number]


def test_a_taken_kind_or_law_is_refused():
    with pytest.raises(CallbackError, match="taken by LinearSpring"):
        register(spring_class("linear", LinearSpring.law))
    other = Law(LinearSpring.law.name, lambda x, v, y, p: 0.0)
    with pytest.raises(CallbackError, match="same number"):
        register(spring_class("mine", other))
    assert LAWS[LinearSpring.law.number] is LinearSpring.law
