"""What drives and steers the compiled car: steering wheel and driver, engine and power train, air."""

from __future__ import annotations

from numba import types

from ...elements import powertrain, speed_control
from ...elements import steering as steering_laws
from ...elements.law import USERDATA_HEADER
from ..laws import air_of, driver_of
from ..memory import doubles, ints, plain, usable
from .lookup import looked_up
from .records import input_of, place_of
from .vectors import cross, turned_back

cruising_gear = usable(powertrain.cruising_gear)
shifted_gear = usable(powertrain.shifted_gear)
engine_torque = usable(powertrain.engine_torque)
passed_torque = usable(powertrain.passed_torque)
controlled_pedal = usable(speed_control.controlled_pedal)
limited_angle = usable(steering_laws.limited_angle)


@plain
def steering(head, model, data, signals, driver, origin, heading, speed):
    """Angle of the steering wheel and its rate: trim, what the manoeuvre asks for, what the driver steers."""
    wheel, actuator = int(head.steering_wheel), int(head.driver)
    angle = doubles(data.ctrl)[wheel] + signals.trim_angle
    rate = doubles(data.userdata)[USERDATA_HEADER + wheel]
    signals.driver_rate = 0.0
    signals.path_deviation = 0.0
    if actuator >= 0 and driver != types.uint64(0):
        held = doubles(data.act)[ints(model.actuator_actadr)[actuator]]
        law, parameters = int(doubles(driver)[0]), doubles(driver + types.uint64(8))
        own_rate, deviation = driver_of(
            law,
            origin[0],
            origin[1],
            heading,
            speed,
            held,
            head.steering_ratio,
            head.wheelbase,
            head.steering_limit,
            parameters,
        )
        signals.driver_rate, signals.path_deviation = own_rate, deviation
        angle, rate = angle + held, rate + own_rate
    angle, rate = limited_angle(angle, rate, head.steering_limit)
    signals.steering_wheel_angle = angle
    return angle, rate


@plain
def power(head, model, data, signals, shaft_speed, rolling_radius, speed):
    """Drive torque of each driven wheel: controller, engine, coupling, gearbox, open differential.

    Args:
        shaft_speed: of the propeller shaft [rad/s].
        rolling_radius: of a driven wheel [m].
        speed: of the car [m/s].
    """
    ctrl, act, states = doubles(data.ctrl), doubles(data.act), ints(model.actuator_actadr)
    base, time = model.numeric_data, data.time
    demanded = input_of(head.engine, ctrl)
    signals.brake_pedal = input_of(head.brake, ctrl)
    signals.control_rate, signals.engine_rate = 0.0, 0.0
    engine_speed = act[states[int(head.engine)]]
    gear = shifted_gear(head, signals, time, abs(speed) / rolling_radius * head.final_drive, demanded)
    ratio = head.ratios[gear - 1] * head.final_drive
    full, _ = looked_up(place_of(base, head.full_torque), engine_speed)
    drag, _ = looked_up(place_of(base, head.drag_torque), engine_speed)
    target, weight = input_of(head.speed_target, ctrl), input_of(head.speed_control, ctrl)
    integral, reduction = act[states[int(head.speed_target)]], ratio * head.efficiency
    pedal = controlled_pedal(
        head, signals, demanded, target, weight, speed, integral, rolling_radius, reduction, full, drag
    )
    torque = engine_torque(head, engine_speed, pedal, full, drag)
    passed = passed_torque(head, signals, time, engine_speed, shaft_speed * head.ratios[gear - 1], torque)
    signals.accelerator, signals.engine_speed, signals.engine_torque = pedal, engine_speed, torque
    efficiency = head.efficiency if passed > 0.0 else 1.0 / head.efficiency
    return passed * ratio * efficiency / 2.0


@plain
def blown(head, model, data, r, velocity):
    """Air force and moment about the chassis' origin, in body axes."""
    ctrl = doubles(data.ctrl)
    u = turned_back(r, (input_of(head.wind_x, ctrl) - velocity[0], input_of(head.wind_y, ctrl) - velocity[1], 0.0))
    parameters = place_of(model.numeric_data, head.air_parameters)
    x, y, z, roll, pitch, yaw = air_of(int(head.air_law), u[0], u[1], head.wheelbase, parameters)
    swept = cross((head.air_x, 0.0, head.ground_z), (x, y, z))
    return (x, y, z), (roll + swept[0], pitch + swept[1], yaw + swept[2])
