"""The quarter car: where its parts are in a run, and its picture."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from susp_mj.run import Run

from ..clip import at, slope_at, speed_of, wheel_height
from ..scene import Scene, free_camera, settle
from ..style import Shot
from ..window import Window
from .shapes import COIL_LENGTH, WHEEL_RADIUS, quarter_spec

HALF_ANGLE = 8.0
VIEW = (2.02, 1.5)
LOOK_AT = (0.0, 0.0, 0.5)


@dataclass(frozen=True)
class Pose:
    """Where the parts of a quarter car are.

    Attributes:
        body, wheel: heights above the design position [m].
        spin: turning angle of the wheel, positive forwards [rad].
        travelled: distance driven [m].
        road: height of the road under the wheel [m].
        slope: of the road there, rising forwards positive.
    """

    body: float
    wheel: float
    spin: float
    travelled: float
    road: float
    slope: float = 0.0

    @property
    def coil_length(self) -> float:
        """Length of the drawn coil [m]: the seats move with body and wheel."""
        return COIL_LENGTH + self.body - self.wheel


def pose_at(run: Run, time: float) -> Pose:
    """The quarter car of a run at a time [s]; a massless wheel stands on the road."""
    speed = speed_of(run)
    return Pose(
        body=at(run, "body_displacement", time),
        wheel=at(run, wheel_height("", run), time),
        spin=speed * time / WHEEL_RADIUS,
        travelled=speed * time,
        road=at(run, "road_height", time),
        slope=slope_at(run, "", time),
    )


class QuarterScene(Scene):
    """Picture of one quarter car, driving over its road or standing on a test rig.

    Args:
        shot: what to show.
        window: stretch of the run, for the length of the road.
    """

    def __init__(self, shot: Shot, window: Window) -> None:
        self.run = shot.clips[0].run
        super().__init__(quarter_spec(self.run, shot.colours[0], shot.size, window, shot.style.samples), shot.size)
        self.camera = _camera(self.model, shot.size)

    def pose(self, time: float) -> None:
        place(self.model, self.data, pose_at(self.run, time))

    def stage(self, time: float) -> None:
        super().stage(time)
        stretch_coil(self.model, self.data, self.renderer.scene, pose_at(self.run, time))


def place(model: Any, data: Any, pose: Pose) -> None:
    """Put every part of the picture in its place."""
    joints = {"body": pose.body, "wheel": pose.wheel, "spin": pose.spin, "road": -pose.travelled, "plate": pose.road}
    for joint, value in {**joints, "slope": -float(np.arctan(pose.slope))}.items():
        data.joint(joint).qpos[0] = value
    settle(model, data)


def stretch_coil(model: Any, data: Any, scene: Any, pose: Pose) -> None:
    """Scale the coil along z from its foot, in the updated scene only: a geom's matrix there need not be
    orthonormal."""
    import mujoco

    coil = model.geom("coil").id
    mesh = model.geom_dataid[coil]
    turned = np.zeros(9)
    mujoco.mju_quat2Mat(turned, model.mesh_quat[mesh])
    scale = np.diag([1.0, 1.0, pose.coil_length / COIL_LENGTH])
    for drawn in scene.geoms[: scene.ngeom]:
        if drawn.objtype == mujoco.mjtObj.mjOBJ_GEOM and drawn.objid == coil:
            drawn.pos[:] = data.site("coil_foot").xpos + scale @ model.mesh_pos[mesh]
            drawn.mat[:] = scale @ turned.reshape(3, 3)


def _camera(model: Any, size: tuple[int, int]) -> Any:
    """Camera at the car's right front, far enough away to see it whole."""
    camera = free_camera(model, HALF_ANGLE)
    camera.lookat[:] = LOOK_AT
    camera.azimuth, camera.elevation = 101.0, -8.0
    needed = max(VIEW[1], VIEW[0] * size[1] / size[0])
    camera.distance = needed / 2 / np.tan(np.radians(HALF_ANGLE))
    return camera
