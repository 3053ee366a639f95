"""Motion of a body with six freedoms in the terms of ISO 8855, from what MuJoCo records of its free joint."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np


def free_motion(
    qpos: np.ndarray, qvel: np.ndarray, qacc: np.ndarray, facts: Mapping[str, float]
) -> dict[str, np.ndarray]:
    """Channels of the body: position, angles, velocities and accelerations, by quantity.

    Angles are yaw, pitch, roll of the sequence z, y, x; longitudinal and lateral refer to the horizontal axes that turn
    with the yaw angle; side slip is ``atan2(v_y, v_x)`` there, 0 below 0.1 m/s.

    Args:
        qpos: (rows, >= 7) of a model whose first joint is the body's free joint: position, quaternion.
        qvel, qacc: (rows, >= 6): linear in the inertial frame, angular in the body's.
        facts: with ``cg_height`` (height of the body's centre of gravity in the design position), ``cg_x`` and
            ``wheelbase`` [m].
    """
    w, x, y, z = qpos[:, 3:7].T
    yaw = np.unwrap(np.arctan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)))
    pitch = np.arcsin(np.clip(2 * (w * y - x * z), -1, 1))
    roll = np.arctan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y))
    p, q, r = qvel[:, 3:6].T
    turning = q * np.sin(roll) + r * np.cos(roll)
    yaw_rate, pitch_rate = turning / np.cos(pitch), q * np.cos(roll) - r * np.sin(roll)
    roll_rate = p + yaw_rate * np.sin(pitch)
    p_rate, q_rate, r_rate = qacc[:, 3:6].T
    turning_rate = q_rate * np.sin(roll) + r_rate * np.cos(roll) + roll_rate * pitch_rate
    yaw_acceleration = (turning_rate + yaw_rate * pitch_rate * np.sin(pitch)) / np.cos(pitch)
    along, across = _in_heading(qvel[:, :2], yaw)
    ahead, left = _in_heading(qacc[:, :2], yaw)
    # velocity of the point on the ground below the middle of the rear axle, in body axes and then in the heading
    arm = np.array([-facts["wheelbase"] - facts["cg_x"], 0.0, -facts["cg_height"]])
    rear = np.cross(np.column_stack([p, q, r]), arm)
    rear_across = across + rear[:, 1] * np.cos(roll) - rear[:, 2] * np.sin(roll)
    return {
        "position_x": qpos[:, 0],
        "position_y": qpos[:, 1],
        "body_displacement": qpos[:, 2] - facts["cg_height"],
        "body_velocity": qvel[:, 2],
        "body_acceleration": qacc[:, 2],
        "yaw_angle": yaw,
        "pitch_angle": pitch,
        "roll_angle": roll,
        "yaw_rate": yaw_rate,
        "pitch_rate": pitch_rate,
        "roll_rate": roll_rate,
        "pitch_acceleration": q_rate * np.cos(roll) - r_rate * np.sin(roll) - roll_rate * turning,
        "roll_acceleration": p_rate + yaw_acceleration * np.sin(pitch) + yaw_rate * pitch_rate * np.cos(pitch),
        "speed": np.hypot(along, across),
        "longitudinal_velocity": along,
        "lateral_velocity": across,
        "longitudinal_acceleration": ahead,
        "lateral_acceleration": left,
        "side_slip_angle": _slip_angle(along, across),
        "rear_side_slip_angle": _slip_angle(along, rear_across),
    }


def _in_heading(vectors: np.ndarray, yaw: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Components along and across the heading of inertial (rows, 2) vectors."""
    cosine, sine = np.cos(yaw), np.sin(yaw)
    return cosine * vectors[:, 0] + sine * vectors[:, 1], cosine * vectors[:, 1] - sine * vectors[:, 0]


def _slip_angle(along: np.ndarray, across: np.ndarray) -> np.ndarray:
    return np.where(np.hypot(along, across) < 0.1, 0.0, np.arctan2(across, along))
