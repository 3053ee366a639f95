"""The video of cars that drive freely: where the wheels are, what is red at lift, which camera, side by side and as ghosts."""

from __future__ import annotations

import numpy as np

from susp_mj.names import CORNERS, channel_name
from susp_mj.run import Run, described

WHEELBASE, TRACK, RADIUS, CG_X, CG_HEIGHT = 3.0, 1.5, 0.32, -1.45, 0.56
MASS, TYRE_RATE, STEP = 1900.0, 2.4e5, 0.005
FACTS = {
    "cg_x": CG_X,
    "cg_y": 0.0,
    "cg_height": CG_HEIGHT,
    "wheelbase": WHEELBASE,
    "track_front": TRACK,
    "track_rear": TRACK,
    "steering_ratio": 15.0,
    "wheel_radius_front": RADIUS,
    "wheel_radius_rear": RADIUS,
}


def curve(start, end, value):
    """Value that rises from 0 to `value` between two times."""
    return lambda time: value * np.clip((time - start) / (end - start), 0.0, 1.0)


def driven(
    lateral=curve(1.0, 5.0, 9.0),
    *,
    speed=20.0,
    duration=6.0,
    soft=1.0,
    front=0.8,
    features=(),
    kind="ramp_steer",
    road=None,
    brake=None,
    wind=None,
):
    """A run of a car that corners as `lateral` says [m/s² over time], steadily at every instant: rolling `soft` times as much as usual.

    The front axle carries the share `front` of the load transfer; once its inner wheel is unloaded it lifts, and the rear
    axle takes the rest. `road` gives the road height under a place (x, y), `brake` the longitudinal acceleration over time.
    """
    time = np.arange(0.0, duration + STEP / 2, STEP)
    ay = lateral(time) if lateral else 0 * time
    ax = brake(time) if brake else 0 * time
    v = np.maximum(speed + np.cumsum(ax) * STEP, 0.0)
    rate = np.where(v > 0.5, ay / np.maximum(v, 0.5), 0.0)
    yaw = np.cumsum(rate) * STEP
    slip = -0.006 * ay
    x = CG_X + np.concatenate([[0], np.cumsum(v * np.cos(yaw + slip))[:-1]]) * STEP
    y = np.concatenate([[0], np.cumsum(v * np.sin(yaw + slip))[:-1]]) * STEP
    roll, pitch = np.radians(0.62) * soft * ay, -np.radians(0.35) * soft * ax
    values = {
        "position_x": x,
        "position_y": y,
        "yaw_angle": yaw,
        "yaw_rate": rate,
        "speed": v,
        "side_slip_angle": slip,
        "lateral_acceleration": ay,
        "longitudinal_acceleration": ax,
        "roll_angle": roll,
        "pitch_angle": pitch,
        "steering_wheel_angle": 15.0 * (WHEELBASE * rate / np.maximum(v, 1.0) + 0.004 * ay),
        "gear": np.full_like(time, 4.0),
    }
    channels = {name: described(name, value) for name, value in values.items()}
    share = {"f": -CG_X / WHEELBASE, "r": 1 + CG_X / WHEELBASE}
    share = {"f": share["r"], "r": share["f"]}
    transfer = MASS * CG_HEIGHT * ay / TRACK
    static = {end: 9.81 * MASS * part / 2 for end, part in share.items()}
    at_front = np.clip(front * transfer, -static["f"], static["f"])
    across = {"f": at_front, "r": np.clip(transfer - at_front, -static["r"], static["r"])}
    along = MASS * CG_HEIGHT * ax / WHEELBASE / 2
    heave, wheels = 0 * time, {}
    for station in CORNERS:
        left, ahead = (1 if station[1] == "l" else -1), station[0] == "f"
        wx, wy = (0.0 if ahead else -WHEELBASE) - CG_X, left * TRACK / 2
        load = np.maximum(static[station[0]] - left * across[station[0]] - (along if ahead else -along), 0.0)
        height = 0 * time
        if road:
            height = road(x + wx * np.cos(yaw) - wy * np.sin(yaw), y + wx * np.sin(yaw) + wy * np.cos(yaw))
        unloaded = np.maximum(left * (front * transfer if ahead else transfer * (1 - front)) - static[station[0]], 0.0)
        wheel = height - (load - static[station[0]]) / TYRE_RATE + unloaded / 2.4e4 * ahead
        wheels[station] = (wx, wy, load, height, wheel, left)
    if road:
        heave = np.mean([each[3] for each in wheels.values()], axis=0)
    channels["body_displacement"] = described("body_displacement", heave)
    channels["body_acceleration"] = described("body_acceleration", np.gradient(np.gradient(heave, STEP), STEP))
    if wind:
        channels["wind_y"] = described("wind_y", wind(x))
    for station, (wx, wy, load, height, wheel, left) in wheels.items():
        deflection = wheel - (heave + roll * wy - pitch * wx)
        steer = (WHEELBASE * rate / np.maximum(v, 1.0) + 0.004 * ay) if station[0] == "f" else 0.002 * ay
        more = {
            "wheel_load": load,
            "road_height": height,
            "wheel_displacement": wheel,
            "suspension_deflection": deflection,
            "steer_angle": steer + 0 * time,
            "inclination_angle": -0.35 * deflection - np.radians(0.8),
            "wheel_speed": v / (RADIUS - 0.004) + 0 * left,
        }
        channels |= {channel_name(station, name): described(name, value, station) for name, value in more.items()}
    meta = {
        "title": "synthetic",
        "model": "handling",
        "manoeuvre": {"kind": kind, "speed": speed},
        "facts": FACTS,
        "road": {"features": [dict(feature) for feature in features]},
        "step": STEP,
    }
    return Run(time, channels, meta)
