"""The car with several wheels: its picture, from three quarters, so that heave, pitch and roll all show."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..rotations import about_x, about_y, upright
from ..scene import Frame, Scene, free_camera, put
from ..style import Shot
from ..window import Window
from .pose import WHEEL_RADIUS, Layout, OscillationPose, road_speed
from .shapes import ARM_HEIGHT, HINGE, oscillation_spec

_HALF_ANGLE = 9.0


class OscillationScene(Scene):
    """Picture of one car, driving over its road or standing on a test rig.

    Args:
        shot: what to show.
        window: stretch of the run, for the length of the road.
    """

    def __init__(self, shot: Shot, window: Window) -> None:
        self.run = shot.clips[0].run
        self.layout = Layout.of(self.run)
        super().__init__(
            oscillation_spec(self.run, self.layout, shot.colours[0], shot.size, window, shot.style.samples), shot.size
        )
        self.camera = _camera(self.model, self.layout, shot.size, road_speed(self.run, self.layout) > 0)

    def pose(self, time: float) -> None:
        place(self.model, self.data, OscillationPose.of(self.run, self.layout, time))


def place(model: Any, data: Any, pose: OscillationPose) -> None:
    """Put every part of the picture in its place, coils and arms stretched."""
    put(model, data, frames(pose))
    strut = pose.layout.strut
    for station in pose.layout.places:
        stretch(model, data, f"{station}_coil", strut.seat, pose.coil_length(station) / strut.coil)
        if not pose.layout.one_axle:
            stretch(model, data, f"{station}_arm", 0.0, float(np.linalg.norm(np.subtract(*arm_ends(pose, station)))))


def stretch(model: Any, data: Any, geom: str, start: float, scale: float) -> None:
    """Scale a shape along its body's z axis from the height `start` [m]: a geom's matrix need not be orthonormal for
    the picture."""
    import mujoco

    number = model.geom(geom).id
    body = model.geom_bodyid[number]
    turned, rotation = np.zeros(9), data.xmat[body].reshape(3, 3)
    mujoco.mju_quat2Mat(turned, model.geom_quat[number])
    longer, foot = np.diag([1.0, 1.0, scale]), np.array([0.0, 0.0, start])
    data.geom_xpos[number] = data.xpos[body] + rotation @ (foot + longer @ (model.geom_pos[number] - foot))
    data.geom_xmat[number] = (rotation @ longer @ turned.reshape(3, 3)).ravel()


def frames(pose: OscillationPose) -> dict[str, Frame]:
    """Place [m] and (3, 3) rotation of every body of the picture, by name."""
    layout, level = pose.layout, np.eye(3)
    placed = {"body": (pose.on_body(np.zeros(3)), pose.turned), "road": (np.array([-pose.travelled, 0.0, 0.0]), level)}
    if layout.one_axle:
        placed["beam"] = (
            np.mean([pose.wheel_centre(station) for station in layout.places], axis=0),
            about_x(pose.camber),
        )
    for station, (x, y) in layout.places.items():
        centre, upright_wheel = pose.wheel_centre(station), about_x(pose.camber)
        foot, head = pose.strut_foot(station), pose.strut_head(station)
        ground = np.array([x, y, pose.roads[station]])
        placed |= {
            f"{station}_carrier": (centre, upright_wheel),
            f"{station}_wheel": (centre, upright_wheel @ about_y(pose.travelled / WHEEL_RADIUS)),
            f"{station}_foot": (foot, upright(foot, head)),
            f"{station}_head": (head, upright(foot, head)),
            f"{station}_plate": (ground, level),
            f"{station}_shadow": (ground, about_y(-float(np.arctan(pose.slopes[station])))),
        }
        if not layout.one_axle:
            placed[f"{station}_arm"] = (arm_ends(pose, station)[0], upright(*arm_ends(pose, station)))
    return placed


def arm_ends(pose: OscillationPose, station: str) -> tuple[np.ndarray, np.ndarray]:
    """Ends of a lower arm: its hinge on the body, and the wheel carrier [m]."""
    layout = pose.layout
    (x, _), side = layout.places[station], layout.side(station)
    hinge = pose.on_body(np.array([x, layout.middle + side * HINGE, ARM_HEIGHT]))
    return hinge, pose.wheel_centre(station) + np.array([0.0, -0.10 * side, ARM_HEIGHT - WHEEL_RADIUS])


def _camera(model: Any, layout: Layout, size: tuple[int, int], driving: bool) -> Any:
    """Camera at the car's right front, far enough away to see it whole."""
    camera = free_camera(model, _HALF_ANGLE)
    camera.azimuth, camera.elevation = (146.0, -11.0) if layout.one_axle else (133.0, -16.0)
    left = layout.middle + (0.0 if layout.one_sided else layout.half_track + 0.12)
    overhang = (0.60, 0.60) if layout.one_axle else (0.66, 0.86)
    low = np.array([layout.rear - overhang[0], layout.middle - layout.half_track - 0.12, 0.0 if driving else -0.15])
    high = np.array([layout.front + overhang[1], left, 1.1])
    azimuth, elevation = np.radians(camera.azimuth), np.radians(camera.elevation)
    across = np.array([np.sin(azimuth), -np.cos(azimuth), 0.0])
    ahead = np.array([np.cos(azimuth) * np.cos(elevation), np.sin(azimuth) * np.cos(elevation), np.sin(elevation)])
    corners = np.array(np.meshgrid(*zip(low, high, strict=True))).reshape(3, -1).T
    wide, tall = np.ptp(corners @ across), np.ptp(corners @ np.cross(across, ahead))
    camera.lookat[:] = (low + high) / 2 + 0.03 * wide * across + [0.0, 0.0, 0.16]
    needed = max(1.5 * tall, 0.99 * wide * size[1] / size[0])
    camera.distance = needed / 2 / np.tan(np.radians(_HALF_ANGLE)) + np.ptp(corners @ ahead) / 4
    return camera
