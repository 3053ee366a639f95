"""Numbers of a car that drives freely, against closed forms of made-up runs: bicycle model, first and second order,
geometry."""

from __future__ import annotations

import math
import re
from dataclasses import replace

import numpy as np
import pytest
from scipy.signal import lsim

from evaluation.numbers import (
    NUMBERS,
    braking,
    compliance,
    cornering,
    course,
    kinematics,
    transient,
    travel_left,
    wheel_lift,
)
from evaluation.numbers import steering_frequency as sweep
from evaluation.numbers.turns import averaged
from evaluation.turning import lifting, turning_table
from manoeuvres import (
    Acceleration,
    Braking,
    BrakingInTurn,
    Bump,
    Crosswind,
    LaneChange,
    LateralForce,
    RampSteer,
    SineSteer,
    SplitMu,
    SteadyCircle,
    StepSteer,
    SuspensionRig,
    SweptSteer,
)
from susp_mj import simulate
from susp_mj.names import CORNERS
from susp_mj.units import to_si
from vehicles import load_vehicle
from vehicles.mjcf import build

from ..builders.runs import STATIC, Bicycle, changed, compared, driven, made_up

CAR = Bicycle()
DRIVING = tuple(
    number
    for module in (cornering, wheel_lift, transient, sweep, braking, course, travel_left, kinematics, compliance)
    for number in module.NUMBERS
)
SLOW = RampSteer(rate="3 deg/s", duration=45.0, limit="125 deg")


@pytest.fixture(scope="module")
def slow_ramp():
    return CAR.run(SLOW)


def circle(**more):
    """The bicycle model on the steady circle, every instant its steady state."""
    manoeuvre = SteadyCircle(**more)
    time = np.arange(round(manoeuvre.duration * 1000) + 1) * 1e-3
    speed = driven(manoeuvre, "speed_target", time)
    radius = manoeuvre.radius
    acceleration = speed**2 / radius
    way = np.concatenate([[0.0], np.cumsum((speed[1:] + speed[:-1]) / 2 * 1e-3)])
    moment = CAR.mass * CAR.height * acceleration / CAR.track
    loads = {}
    for corner in CORNERS:
        share = CAR.front_share if corner.startswith("f") else 1 - CAR.front_share
        loads[f"{corner}_wheel_load"] = STATIC[corner] + (-1 if corner.endswith("l") else 1) * share * moment
    steering = CAR.ratio * (CAR.wheelbase / radius + CAR.understeer * acceleration)
    steering[0] = 0.0  # begins straight
    roll = CAR.roll_gradient * acceleration
    roll[0] = 0.0
    return made_up(
        manoeuvre,
        time,
        speed=speed,
        lateral_acceleration=acceleration,
        steering_wheel_angle=steering,
        roll_angle=roll,
        position_x=abs(radius) * np.sin(way / abs(radius)),
        position_y=radius - radius * np.cos(way / abs(radius)),
        **loads,
    )


# ---- cornering


def test_understeer_gradient_of_the_bicycle_model(slow_ramp):
    """EG = m/l (l_r/C_f - l_f/C_r) and v_ch = sqrt(l/EG)."""
    assert NUMBERS["understeer_gradient"](slow_ramp).value == pytest.approx(CAR.understeer, rel=0.01)
    assert NUMBERS["characteristic_speed"](slow_ramp).value == pytest.approx(
        math.sqrt(CAR.wheelbase / CAR.understeer), rel=0.01
    )


def test_side_slip_gradient_is_the_rear_axle_s_slip(slow_ramp):
    """alpha_r/a_y = m l_f/(l C_r)."""
    expected = CAR.mass * CAR.front / (CAR.wheelbase * CAR.rear_stiffness)
    assert NUMBERS["side_slip_gradient"](slow_ramp).value == pytest.approx(expected, rel=0.02)


def test_an_oversteering_car_has_a_critical_speed():
    car = Bicycle(front_stiffness=200e3, rear_stiffness=150e3)
    run = car.run(RampSteer(rate="2 deg/s", duration=20.0))
    assert NUMBERS["understeer_gradient"](run).value == pytest.approx(car.understeer, rel=0.03)
    number = NUMBERS["characteristic_speed"](run)
    assert number.value is None and "critical speed" in number.note
    assert float(number.note.split()[-2]) == pytest.approx(3.6 * math.sqrt(car.wheelbase / -car.understeer), rel=0.02)


@pytest.mark.parametrize("side", [1, -1])
def test_suspension_roll_is_the_mean_over_the_axles(side):
    """Deflections of a body that rolls by its angle about wheels that stay, less or more at an axle."""
    run = CAR.run(SLOW.model_copy(update={"rate": side * SLOW.rate}))
    tracks, shares = {"front": 1.4, "rear": 1.5}, {"front": 0.9, "rear": 1.1}
    deflections = {
        f"{axle[0]}{wheel}_suspension_deflection": 0.01 + sign * shares[axle] * tracks[axle] / 2 * run["roll_angle"]
        for axle in tracks
        for wheel, sign in (("l", -1), ("r", 1))
    }
    facts = {**run.meta["facts"], **{f"track_{axle}": track for axle, track in tracks.items()}}
    run = replace(changed(run, **deflections), meta={**run.meta, "facts": facts})
    for level in (4, 7):
        number = NUMBERS[f"suspension_roll_at_{level}"](run)
        assert number.value == pytest.approx(NUMBERS[f"roll_angle_at_{level}"](run).value, rel=1e-6)


def test_a_turn_to_the_right_gives_the_same_numbers(slow_ramp):
    other = CAR.run(SLOW.model_copy(update={"rate": -SLOW.rate}))
    for number in (
        *cornering.NUMBERS,
        *wheel_lift.NUMBERS,
        NUMBERS["roll_gradient"],
    ):
        left, right = number(slow_ramp), number(other)
        if left.value is None:
            assert right.value is None, number.name
        else:
            assert right.value == pytest.approx(left.value, rel=1e-9), number.name
        assert right.note == re.sub(r"\b([fr])([lr])\b", lambda m: m[1] + {"l": "r", "r": "l"}[m[2]], left.note)


def test_numbers_on_a_circle_are_those_of_the_steady_state():
    run = circle(duration=70.0)
    assert NUMBERS["understeer_gradient"](run).value == pytest.approx(CAR.understeer, rel=5e-3)
    for level, number in ((4.0, NUMBERS["roll_angle_at_4"]), (7.0, NUMBERS["roll_angle_at_7"])):
        assert number(run).value == pytest.approx(CAR.roll_gradient * level, rel=1e-4)
    expected = CAR.ratio * (CAR.wheelbase / 100.0 + CAR.understeer * 7.0)
    assert NUMBERS["steering_wheel_angle_at_7"](run).value == pytest.approx(expected, rel=1e-3)
    assert NUMBERS["roll_gradient"](run).value == pytest.approx(CAR.roll_gradient, rel=1e-3)
    for number in (NUMBERS["load_transfer_share_at_4"], NUMBERS["load_transfer_share_at_7"]):
        assert number(run).value == pytest.approx(CAR.front_share, rel=1e-3)


def test_a_shift_of_gears_is_no_state():
    """A spike of 0.3 s in the lateral acceleration does not move what belongs to 4 m/s²."""
    run = circle(duration=70.0)
    acceleration = run["lateral_acceleration"]
    at = int(np.argmax(acceleration > 3.7))
    expected = NUMBERS["roll_angle_at_4"](run).value
    acceleration[at : at + 300] += 0.6 * np.hanning(300)
    assert NUMBERS["roll_angle_at_4"](run).value == pytest.approx(expected, rel=0.02)
    assert NUMBERS["understeer_gradient"](run).value == pytest.approx(CAR.understeer, rel=0.04)


def test_what_comes_after_leaving_the_circle_does_not_count():
    run = circle(duration=70.0)
    run["position_y"][60000:] += 10.0
    run["lateral_acceleration"][65000:] = 15.0
    run["fl_wheel_load"][65000:] = 0.0
    assert NUMBERS["lateral_acceleration_max"](run).value == pytest.approx(
        run["lateral_acceleration"][:60000].max(), rel=1e-3
    )
    assert NUMBERS["wheel_lift_time"](run).value == 0.0


def test_a_turn_that_stays_gentle_says_so():
    run = CAR.run(RampSteer(rate="3 deg/s", limit="10 deg"))
    assert NUMBERS["roll_angle_at_7"](run).value is None
    assert "7 m/s²" in NUMBERS["roll_angle_at_7"](run).note
    assert NUMBERS["understeer_gradient"](run).value is None


def test_averages_keep_straight_lines():
    line = np.linspace(-1.0, 3.0, 101)
    np.testing.assert_allclose(averaged(line, 20), line, atol=1e-12)
    assert averaged(np.eye(1, 101, 50)[0], 9)[50] == pytest.approx(1 / 9)


# ---- wheel lift


def test_the_inner_front_wheel_lifts_where_its_load_is_gone(slow_ramp):
    """F0 = q m a_y h/t."""
    expected = STATIC["fl"] * CAR.track / (CAR.front_share * CAR.mass * CAR.height)
    number = NUMBERS["wheel_lift_acceleration"](slow_ramp)
    assert number.value == pytest.approx(expected, rel=1e-3) and number.note == "fl"
    at = int(np.argmax(slow_ramp["lateral_acceleration"] >= expected))
    assert NUMBERS["wheel_lift_instant"](slow_ramp).value == pytest.approx(slow_ramp.time[at], abs=2e-3)
    off = np.sum(slow_ramp["fl_wheel_load"] <= 0) * 1e-3
    assert NUMBERS["wheel_lift_time"](slow_ramp).value == pytest.approx(off, abs=1e-9)
    assert NUMBERS["inner_wheel_load_front"](slow_ramp).value == 0.0


def test_which_wheel_lifts_is_a_value(slow_ramp):
    """The inner front wheel that lifts in a turn to the left is the front left one, the rear one stays down."""
    numbers = {name: NUMBERS[f"inner_lift_{name}"](slow_ramp) for name in ("time_front", "time_rear")}
    assert numbers["time_front"].value == NUMBERS["wheel_lift_time"](slow_ramp).value > 0.0
    assert (numbers["time_front"].note, numbers["time_rear"].note) == ("fl", "rl stays down")
    assert numbers["time_rear"].value == 0.0
    assert NUMBERS["inner_lift_instant_front"](slow_ramp).value == NUMBERS["wheel_lift_instant"](slow_ramp).value
    assert NUMBERS["inner_lift_instant_rear"](slow_ramp).value is None


def test_no_wheel_lifts():
    run = CAR.run(RampSteer(limit="40 deg"))
    assert NUMBERS["wheel_lift_time"](run).value == 0.0
    assert NUMBERS["wheel_lift_instant"](run).value is None
    assert NUMBERS["wheel_lift_instant"](run).note == wheel_lift.NONE_LIFTS
    assert lifting(run) == "none"
    reached = run["lateral_acceleration"].max()
    expected = STATIC["rl"] - (1 - CAR.front_share) * CAR.mass * CAR.height * reached / CAR.track
    assert NUMBERS["inner_wheel_load_rear"](run).value == pytest.approx(expected, rel=1e-9)


def test_a_table_says_side_by_side_who_lifts(slow_ramp):
    table = turning_table(compared(slow_ramp, CAR.run(RampSteer(limit="60 deg"))))
    assert table.names == ("configuration 3", "configuration 4")
    word, lifted, stays = table.rows[-1]
    assert word == "wheels that lift" and lifted.startswith("fl at ") and stays == "none"
    assert all(len(row) == 3 for row in table.rows)
    texts = dict((row[0], row[1]) for row in table.rows)
    assert texts["least load of the inner front wheel"] == "0.000 kN"
    assert texts["roll at 4 m/s²"] == f"{math.degrees(NUMBERS['roll_angle_at_4'](slow_ramp).value):.2f} °"
    assert turning_table(compared(CAR.run(RampSteer(limit="10 deg")))) is None


# ---- step


def test_step_of_first_order_is_there_after_t_ln_10():
    manoeuvre = StepSteer(rate="100000 deg/s", angle="50 deg", duration=8.0)
    time = np.arange(8001) * 1e-3
    lag = 0.2
    response = np.where(time > 0.5, 0.3 * (1 - np.exp(-(time - 0.5) / lag)), 0.0)
    run = made_up(manoeuvre, time, yaw_rate=response, lateral_acceleration=10 * response, roll_angle=0.1 * response)
    for number in (
        NUMBERS["yaw_rate_response_time"],
        NUMBERS["lateral_acceleration_response_time"],
        NUMBERS["roll_angle_response_time"],
    ):
        assert number(run).value == pytest.approx(lag * math.log(10), abs=2e-3)
    assert NUMBERS["yaw_rate_overshoot"](run).value == 0.0
    assert NUMBERS["yaw_rate_peak_response_time"](run).value is None
    assert NUMBERS["yaw_rate_gain"](run).value == pytest.approx(0.3 / math.radians(50.0), rel=1e-6)


def test_overshoot_of_second_order():
    """exp(-pi D/sqrt(1 - D²)) at pi/w_d; the TB factor is that time times the side slip."""
    manoeuvre = StepSteer(rate="100000 deg/s", angle="-50 deg", duration=8.0)
    time, w, d = np.arange(8001) * 1e-3, 2 * math.pi * 1.2, 0.4
    wd, since = w * math.sqrt(1 - d**2), np.maximum(time - 0.5, 0.0)
    response = 1 - np.exp(-d * w * since) * (np.cos(wd * since) + d * w / wd * np.sin(wd * since))
    run = made_up(
        manoeuvre, time, yaw_rate=-0.3 * response, lateral_acceleration=-4 * response, side_slip_angle=0.02 * response
    )
    assert NUMBERS["yaw_rate_overshoot"](run).value == pytest.approx(
        math.exp(-math.pi * d / math.sqrt(1 - d**2)), rel=1e-3
    )
    assert NUMBERS["yaw_rate_peak_response_time"](run).value == pytest.approx(math.pi / wd, abs=2e-3)
    assert NUMBERS["tb_factor"](run).value == pytest.approx(0.02 * math.pi / wd, rel=0.01)
    assert NUMBERS["side_slip_angle_steady"](run).value == pytest.approx(0.02, rel=1e-3)


@pytest.mark.parametrize("hold", [None, 3.0])
def test_step_of_the_bicycle_model(hold):
    """Steady gains v/(l + EG v²)/i; times as a ten times finer integration gives them."""
    manoeuvre = StepSteer(angle="30 deg", rate="300 deg/s", hold=hold)
    run, v = CAR.run(manoeuvre), manoeuvre.speed
    gain = v / (CAR.wheelbase + CAR.understeer * v**2) / CAR.ratio
    assert NUMBERS["yaw_rate_gain"](run).value == pytest.approx(gain, rel=1e-4)
    assert NUMBERS["lateral_acceleration_gain"](run).value == pytest.approx(gain * v, rel=1e-4)
    assert NUMBERS["roll_angle_gain"](run).value == pytest.approx(gain * v * CAR.roll_gradient, rel=1e-3)
    time = np.arange(40001) * 1e-4
    a, b = CAR.matrices(v)
    _, states, _ = lsim(
        (a, b, np.eye(2), np.zeros((2, 1))), driven(manoeuvre, "steering_wheel_angle", time) / CAR.ratio, time
    )
    yaw = states[:, 1]
    half = manoeuvre.start + manoeuvre.rise_time / 2
    steady = gain * math.radians(30.0)
    assert NUMBERS["yaw_rate_response_time"](run).value == pytest.approx(
        time[np.argmax(yaw >= 0.9 * steady)] - half, abs=5e-4
    )
    assert NUMBERS["yaw_rate_overshoot"](run).value == pytest.approx(yaw[time < 3.0].max() / steady - 1, abs=1e-4)


def test_a_step_that_does_not_become_steady_says_so():
    time = np.arange(6001) * 1e-3
    run = made_up(
        StepSteer(), time, yaw_rate=np.maximum(time - 0.5, 0.0), lateral_acceleration=np.maximum(time - 0.5, 0.0)
    )
    assert NUMBERS["yaw_rate_gain"](run).note == "not steady in the end"


# ---- sweep


@pytest.mark.parametrize("scale", ["exponential", "linear"])
def test_sweep_gives_the_bicycle_model_s_transfer_function(scale):
    manoeuvre = SweptSteer(scale=scale)
    run = CAR.run(manoeuvre)
    for channel in ("yaw_rate", "lateral_acceleration", "roll_angle", "side_slip_angle", "rear_side_slip_angle"):
        found = sweep.steering_response(run, channel)
        exact = CAR.transfer(found.frequency, manoeuvre.speed)[channel]
        inside = (found.frequency > 0.3) & (found.frequency < 2.4)
        assert np.abs(found.ratio[inside] / exact[inside] - 1).max() < 0.02, channel
        assert found.coherence[inside].min() > 0.98


def test_phase_delay_and_peaks_of_the_bicycle_model():
    run, v = CAR.run(SweptSteer()), SweptSteer().speed
    exact = CAR.transfer(np.array([1.0]), v)
    for name, number in (
        ("yaw_rate", NUMBERS["yaw_rate_phase"]),
        ("lateral_acceleration", NUMBERS["lateral_acceleration_phase"]),
    ):
        assert number(run).value == pytest.approx(float(np.angle(exact[name][0])), abs=0.01)
    assert NUMBERS["yaw_rate_delay"](run).value == pytest.approx(
        -float(np.angle(exact["yaw_rate"][0])) / (2 * math.pi), abs=2e-3
    )
    frequency = np.linspace(0.26, 2.5, 2000)
    stiff = Bicycle(front_stiffness=80e3, rear_stiffness=170e3)
    run = stiff.run(SweptSteer(speed="140 km/h"))
    gain = np.abs(stiff.transfer(frequency, 140 / 3.6)["yaw_rate"])
    assert NUMBERS["yaw_rate_gain_peak"](run).value == pytest.approx(gain.max(), rel=0.01)
    assert NUMBERS["yaw_rate_peak_frequency"](run).value == pytest.approx(frequency[np.argmax(gain)], abs=0.06)


def test_a_pure_delay_and_a_sign():
    """A channel that is minus the steering wheel 80 ms ago: delay 80 ms, the sign is no phase."""
    manoeuvre = SweptSteer()
    time = np.arange(60001) * 1e-3
    steering = driven(manoeuvre, "steering_wheel_angle", time)
    run = made_up(manoeuvre, time, yaw_rate=-0.3 * np.concatenate([np.zeros(80), steering[:-80]]))
    assert NUMBERS["yaw_rate_delay"](run).value == pytest.approx(0.08, abs=1e-3)
    assert NUMBERS["yaw_rate_gain_peak"](run).value == pytest.approx(0.3, rel=0.01)


def test_coherence_falls_where_the_car_is_not_linear_and_the_gain_is_the_first_harmonic():
    manoeuvre = SweptSteer()
    time = np.arange(60001) * 1e-3
    steering = driven(manoeuvre, "steering_wheel_angle", time) / manoeuvre.amplitude
    run = made_up(manoeuvre, time, yaw_rate=steering + steering**3, roll_angle=steering)
    bent, straight = (sweep.steering_response(run, channel) for channel in ("yaw_rate", "roll_angle"))
    inside = (bent.frequency > 0.8) & (bent.frequency < 2.2)
    np.testing.assert_allclose(bent.gain[inside], (1 + 0.75) / manoeuvre.amplitude, rtol=0.02)
    assert bent.coherence[inside].min() < 0.995 < straight.coherence[inside].min()


def test_a_peak_at_the_edge_is_none():
    number = NUMBERS["roll_angle_peak_frequency"](Bicycle(roll_damping=0.9, roll_frequency=3.0).run(SweptSteer()))
    assert number.value is None and "lowest" in number.note


# ---- braking and accelerating


def braked_run(manoeuvre, deceleration, **more):
    """Constant deceleration from the first movement of the pedal on."""
    time = np.arange(round(manoeuvre.duration * 1000) + 1) * 1e-3
    begin = getattr(manoeuvre, "brake_start", manoeuvre.start)
    speed = np.clip(manoeuvre.speed - deceleration * (time - begin), 0.0, manoeuvre.speed)
    return made_up(manoeuvre, time, speed=speed, **more)


def test_constant_deceleration():
    run = braked_run(Braking(speed="100 km/h"), 8.0)
    assert NUMBERS["braking_deceleration"](run).value == pytest.approx(8.0, rel=2e-3)
    assert NUMBERS["stopping_distance"](run).value == pytest.approx((100 / 3.6) ** 2 / 16, rel=1e-3)
    assert NUMBERS["stopping_distance"](run).unit == "metre"
    assert NUMBERS["braking_yaw_deviation"](run).value == 0.0


def test_a_car_that_still_moves_has_no_stopping_distance():
    number = NUMBERS["stopping_distance"](braked_run(Braking(duration=3.0), 2.0))
    assert number.value is None and "km/h at the end" in number.note


def test_front_share_and_locked_wheels():
    manoeuvre = Braking()
    time = np.arange(8001) * 1e-3
    braked = time >= 0.5
    loads = {f"{c}_wheel_load": STATIC[c] + (1500.0 if c.startswith("f") else -1500.0) * braked for c in CORNERS}
    spin = {"rl_wheel_speed": np.where((time > 1.0) & (time < 1.75), 0.0, 100.0)}
    run = braked_run(
        manoeuvre, 6.0, **loads, **spin, **{f"{c}_wheel_speed": np.full_like(time, 100.0) for c in ("fl", "fr", "rr")}
    )
    assert NUMBERS["braking_load_share_front"](run).value == pytest.approx(14000 / 21000, rel=1e-6)
    locked = NUMBERS["wheel_lock_time"](run)
    assert locked.value == pytest.approx(0.749, abs=2e-3) and locked.note == "rl"


def test_split_ground_turns_and_drifts():
    manoeuvre = SplitMu()
    time = np.arange(8001) * 1e-3
    run = braked_run(
        manoeuvre,
        4.0,
        yaw_angle=np.where(time > 0.5, 0.05 * (time - 0.5), 0.0),
        position_x=20 * time,
        position_y=-0.1 * time,
    )
    assert NUMBERS["braking_yaw_deviation"](run).value == pytest.approx(0.375, rel=1e-3)
    assert NUMBERS["braking_yaw_deviation"](run).note == "turns to the left"
    assert NUMBERS["braking_lateral_deviation"](run).value == pytest.approx(0.75, rel=1e-3)
    assert NUMBERS["braking_lateral_deviation"](run).note == "drifts to the right"


@pytest.mark.parametrize("factor", [1.0, 1.3])
def test_braking_in_a_turn_against_the_same_circle(factor):
    manoeuvre = BrakingInTurn()
    time = np.arange(12001) * 1e-3
    speed = np.clip(manoeuvre.speed - 4.0 * (time - 5.0), 0.0, manoeuvre.speed)
    run = braked_run(
        manoeuvre,
        4.0,
        yaw_rate=speed / 100.0 * np.where(time > 5.0, factor, 1.0),
        lateral_acceleration=speed**2 / 100.0,
    )
    assert NUMBERS["braking_yaw_ratio"](run).value == pytest.approx(factor, rel=1e-3)
    assert not NUMBERS["braking_yaw_deviation"](run).applies


def test_constant_acceleration():
    manoeuvre = Acceleration()
    time = np.arange(12001) * 1e-3
    since = np.maximum(time - 0.5, 0.0)
    pedal, pushed = 0.2 * (time < 0.5), np.where(time > 0.5, 4.0, 0.0)
    run = made_up(manoeuvre, time, speed=4.0 * since, longitudinal_acceleration=pushed, brake_pedal=pedal)
    assert NUMBERS["acceleration_time_100"](run).value == pytest.approx(100 / 3.6 / 4.0, abs=2e-3)
    assert NUMBERS["acceleration_distance_100"](run).value == pytest.approx((100 / 3.6) ** 2 / 8.0, rel=1e-3)
    assert NUMBERS["longitudinal_acceleration_max"](run).value == 4.0
    assert not NUMBERS["stopping_distance"](run).applies, "the controller's brake is no braking"
    slow = made_up(manoeuvre, time, speed=1.0 * since)
    assert (
        NUMBERS["acceleration_time_100"](slow).value is None
        and "reaches 41 km/h" in NUMBERS["acceleration_time_100"](slow).note
    )


# ---- course


def test_drift_in_the_wind():
    """Half a parabola to the left from the beginning of the gust."""
    manoeuvre = Crosswind()
    time = np.arange(5001) * 1e-3
    since = np.maximum(time - 0.5, 0.0)
    heading = 0.3
    sideways, along = 0.4 * since**2, 27.0 * time
    run = made_up(
        manoeuvre,
        time,
        yaw_angle=np.full_like(time, heading),
        yaw_rate=0.02 * np.sin(since),
        position_x=along * math.cos(heading) - sideways * math.sin(heading),
        position_y=along * math.sin(heading) + sideways * math.cos(heading),
    )
    assert NUMBERS["lateral_drift_1s"](run).value == pytest.approx(0.4, rel=1e-6)
    assert NUMBERS["lateral_drift_2s"](run).value == pytest.approx(1.6, rel=1e-6)
    assert NUMBERS["lateral_drift_2s"](run).note == "to the left"
    assert NUMBERS["disturbance_yaw_rate_max"](run).value == pytest.approx(0.02, rel=1e-5)
    steered = made_up(
        manoeuvre.model_copy(update={"steered": True}),
        time,
        position_y=0.2 * np.sin(time),
        steering_wheel_angle=0.1 * since,
    )
    assert not NUMBERS["lateral_drift_1s"](steered).applies
    assert NUMBERS["disturbance_steering_max"](steered).value == pytest.approx(0.45, rel=1e-3)
    assert NUMBERS["path_deviation_max"](steered).value == pytest.approx(0.2, rel=1e-3)


def along_path(manoeuvre, offset=0.0):
    """A car whose centre of gravity follows the driver's path, pointing along it."""
    time = np.arange(round(manoeuvre.duration * 1000) + 1) * 1e-3
    x = manoeuvre.speed * time - CAR.front
    y = manoeuvre.path(x) + offset
    return made_up(manoeuvre, time, position_x=x, position_y=y, yaw_angle=np.arctan(np.gradient(y, x)))


def test_a_car_on_the_path_touches_no_cone():
    run = along_path(LaneChange())
    assert NUMBERS["cones_hit"](run).value == 0.0 and NUMBERS["cones_hit"](run).note == "none"
    assert NUMBERS["path_deviation_max"](run).value < 0.01
    assert NUMBERS["lane_entry_speed"](run).value == pytest.approx(80 / 3.6)
    assert NUMBERS["lane_exit_speed"](run).value == pytest.approx(80 / 3.6)


@pytest.mark.parametrize("offset", [0.4, -0.4])
def test_a_car_beside_the_path_hits_the_cones_of_the_first_lane(offset):
    """Straight on, ``offset`` aside: beyond the first lane's limit by that less the room of (0.1 b + 0.25 m)/2."""
    manoeuvre = LaneChange(vehicle_width=1.8)
    time = np.arange(8001) * 1e-3
    x = manoeuvre.speed * time - CAR.front
    run = made_up(manoeuvre, time, position_x=x, position_y=np.full_like(time, offset))
    room = (0.1 * 1.8 + 0.25) / 2
    first = manoeuvre.lanes[0]
    corners = course.corners(run)["front left" if offset > 0 else "front right"]
    inside = (corners[0] > first.x[0]) & (corners[0] < first.x[1])
    beyond = np.abs(corners[1][inside]).max() - (first.y[1] - first.y[0]) / 2
    assert beyond == pytest.approx(0.4 - room, abs=1e-9)
    assert (
        "left" in NUMBERS["cones_hit"](run).note if offset > 0 else "x = 11 m right" in NUMBERS["cones_hit"](run).note
    )
    assert NUMBERS["lane_departure"](run).value > 2.0, "it misses the second lane"


def test_the_outline_touches_a_cone_with_its_side_not_its_centre_line():
    manoeuvre = LaneChange(vehicle_width=1.8)
    first = manoeuvre.lanes[0]
    room = (first.y[1] - first.y[0] - 1.8) / 2
    time = np.arange(1201) * 1e-3
    x = manoeuvre.speed * time - CAR.front
    for offset, hit in ((room - 0.01, 0.0), (room + 0.01, 3.0)):
        run = made_up(manoeuvre, time, position_x=x, position_y=np.full_like(time, offset))
        assert (NUMBERS["cones_hit"](run).value or 0.0) == hit  # the run ends in the first lane


# ---- rig


def test_kinematics_from_straight_lines():
    manoeuvre = SuspensionRig()
    time = np.arange(20001) * 1e-3
    travel = -driven(manoeuvre, "heave_target", time)
    side = {"fl": 1.0, "fr": -1.0, "rl": 1.0, "rr": -1.0}
    channels = {}
    for corner in CORNERS:
        front = corner.startswith("f")
        channels[f"{corner}_suspension_deflection"] = travel
        channels[f"{corner}_steer_angle"] = -side[corner] * (0.002 + (-0.05 if front else 0.03) * travel)
        channels[f"{corner}_inclination_angle"] = -0.01 - 0.3 * travel
        channels[f"{corner}_wheel_load"] = 5000 + (30e3 if front else 25e3) * travel
        channels[f"{corner}_contact_y"] = side[corner] * (0.15 if front else 0.2) * travel
        channels[f"{corner}_contact_x"] = (0.08 if front else -0.06) * travel
    run = made_up(manoeuvre, time, **channels)
    expected = {
        "bump_steer": (-0.05, 0.03),
        "bump_camber": (-0.3, -0.3),
        "wheel_rate": (30e3, 25e3),
        "roll_centre_height": (0.15 * 0.7, 0.2 * 0.7),
        "path_angle": (math.atan(0.08), math.atan(0.06)),
    }
    for name, values in expected.items():
        for axle, value in zip(("front", "rear"), values, strict=True):
            assert NUMBERS[f"{name}_{axle}"](run).value == pytest.approx(value, rel=1e-9), name
    assert not NUMBERS["roll_steer_front"](run).applies
    assert not NUMBERS["lateral_acceleration_max"](run).applies
    assert not NUMBERS["body_acceleration_max"](run).applies
    assert not NUMBERS["roll_gradient"](run).applies


def test_roll_steer_and_roll_stiffness():
    manoeuvre = SuspensionRig(test="roll")
    time = np.arange(20001) * 1e-3
    roll = driven(manoeuvre, "roll_target", time)
    channels = {"roll_angle": roll}
    for corner in CORNERS:
        side = 1.0 if corner.endswith("l") else -1.0
        channels[f"{corner}_suspension_deflection"] = -side * 0.7 * 0.9 * roll
        channels[f"{corner}_wheel_load"] = 5000 - side * 30e3 * 0.7 * 0.9 * roll
        channels[f"{corner}_steer_angle"] = -0.002 * side + 0.04 * roll
        channels[f"{corner}_camber_angle"] = 0.01 * side + 0.75 * roll
    run = made_up(manoeuvre, time, **channels)
    assert NUMBERS["roll_steer_front"](run).value == pytest.approx(0.04, rel=1e-9)
    assert NUMBERS["roll_camber_rear"](run).value == pytest.approx(0.75, rel=1e-9)
    assert NUMBERS["roll_stiffness_front"](run).value == pytest.approx(30e3 * 1.4**2 / 2, rel=1e-9)


@pytest.mark.parametrize("opposed", [False, True])
@pytest.mark.parametrize(
    ("test", "steer"), [("lateral_force", -3e-6), ("longitudinal_force", 2e-6), ("aligning_moment", 6e-5)]
)
def test_compliance_from_straight_lines(test, steer, opposed):
    manoeuvre = SuspensionRig(test=test, opposed=opposed)
    time = np.arange(20001) * 1e-3
    from susp_mj.meaning import Input

    channels = {}
    for corner in CORNERS:
        side = 1.0 if corner.endswith("l") else -1.0
        pushed = manoeuvre.drive(Input(test, corner, 0.0, 0.7 * side, ()), time)[0]
        channels[f"{corner}_{test}"] = pushed
        toe = -side if test == "longitudinal_force" else 1.0  # a forward force turns both wheels inwards
        channels[f"{corner}_steer_angle"] = -0.002 * side + toe * steer * pushed
        channels[f"{corner}_camber_angle"] = 0.01 * side + 5e-6 * pushed
    run = made_up(manoeuvre, time, **channels)
    for axle in ("front", "rear"):
        assert NUMBERS[f"{test}_steer_{axle}"](run).value == pytest.approx(steer, rel=1e-9)
    if test == "lateral_force":
        assert NUMBERS["lateral_force_camber_front"](run).value == pytest.approx(5e-6, rel=1e-9)


def test_steering_ratio_on_the_rig():
    manoeuvre = SuspensionRig(test="steer")
    time = np.arange(20001) * 1e-3
    wheel = driven(manoeuvre, "steering_wheel_angle", time)
    angles = {f"{c}_steer_angle": s * 0.003 + wheel / 16.0 + 1e-4 * wheel**3 for c, s in (("fl", -1), ("fr", 1))}
    assert NUMBERS["steering_ratio"](made_up(manoeuvre, time, **angles)).value == pytest.approx(16.0, rel=2e-3)


# ---- everything


def test_on_an_oscillation_model_none_of_them_applies():
    run = simulate(build(load_vehicle("s_class", "configuration_4"), "full_3dof"), LateralForce(duration=1.0))
    for number in DRIVING:
        found = number(run)
        assert not found.applies and found.value is None, number.name


@pytest.mark.parametrize(
    "manoeuvre",
    [
        RampSteer(),
        StepSteer(),
        SineSteer(),
        SweptSteer(),
        LaneChange(),
        Crosswind(),
        Braking(),
        SplitMu(),
        Bump(duration=2.0),
    ],
)
def test_every_number_answers_or_says_why_not(manoeuvre):
    run = CAR.run(manoeuvre)
    for name, number in NUMBERS.items():
        found = number(run)
        assert found.value is None or math.isfinite(found.value), name
        assert found.value is not None or found.note, name


def test_the_body_s_vertical_motion_in_a_turn_is_no_ride_number():
    run = CAR.run(RampSteer())
    for number in (
        NUMBERS["body_acceleration_rms"],
        NUMBERS["body_displacement_max"],
        NUMBERS["overshoot"],
        NUMBERS["settling_time"],
    ):
        assert not number(run).applies
    assert NUMBERS["travel_left_rebound_front"](run).applies


def test_a_step_ends_in_a_state_a_ramp_and_a_sine_do_not():
    assert NUMBERS["load_share_front"](CAR.run(StepSteer())).applies
    assert not NUMBERS["load_share_front"](CAR.run(RampSteer())).applies
    assert not NUMBERS["load_share_front"](CAR.run(SineSteer())).applies
    assert NUMBERS["roll_gradient"](CAR.run(StepSteer())).value == pytest.approx(CAR.roll_gradient, rel=1e-3)


def test_travel_left_of_each_axle():
    time = np.arange(3001) * 1e-3
    run = made_up(
        RampSteer(), time, fr_suspension_deflection=0.05 * time / 3, rl_suspension_deflection=-0.07 * time / 3
    )
    assert NUMBERS["travel_left_compression_front"](run).value == pytest.approx(0.04)
    assert NUMBERS["travel_left_rebound_rear"](run).value == pytest.approx(0.03)
    assert NUMBERS["travel_left_rebound_rear"](run).note.startswith("rl")
    assert NUMBERS["travel_left_compression_rear"](run).value == pytest.approx(0.09)


@pytest.mark.parametrize("name", [number.name for number in DRIVING])
def test_a_criterion_can_be_written_for_every_number(name):
    """Its unit can be read back from a case file, and what it means starts its docstring."""
    unit = NUMBERS[name].unit
    assert to_si(f"2.5 {unit}", "" if unit == "1" else unit) == pytest.approx(2.5)
    assert NUMBERS[name].description
