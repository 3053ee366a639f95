"""What the scenes of all kinds of cars share: a compiled picture, an OpenGL context, and one picture after the
other."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from typing import Any

import numpy as np


class Scene(ABC):
    """Picture of one or several cars at any time of their runs; one OpenGL context each.

    Args:
        spec: MuJoCo specification of everything that is shown.
        size: (width, height) of the picture [px].
    """

    camera: Any

    def __init__(self, spec: Any, size: tuple[int, int]) -> None:
        import mujoco

        self.model = spec.compile()
        self.data = mujoco.MjData(self.model)
        self.renderer = mujoco.Renderer(self.model, size[1], size[0])
        self.renderer.scene.flags[mujoco.mjtRndFlag.mjRND_FOG] = 1

    @abstractmethod
    def pose(self, time: float) -> None:
        """Put every part in its place for a time of the run [s]."""

    def stage(self, time: float) -> None:
        """Get ready what is to be drawn at a time of the run [s]."""
        self.pose(time)
        self.renderer.update_scene(self.data, self.camera)

    def picture(self, time: float) -> np.ndarray:
        """(height, width, 3) picture at a time of the run [s]."""
        self.stage(time)
        return self.renderer.render()

    def close(self) -> None:
        """Free the OpenGL context."""
        self.renderer.close()


Frame = tuple[np.ndarray, np.ndarray]
"""Place [m] and (3, 3) rotation of a body."""


def put(model: Any, data: Any, placed: Mapping[str, Frame]) -> None:
    """Put bodies made by `Picture.posed` in their places, and the lights too, or the scene goes dark."""
    import mujoco

    for name, (position, rotation) in placed.items():
        body = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_BODY, name)
        if body >= 0:
            slot = model.body_mocapid[body]
            data.mocap_pos[slot] = position
            mujoco.mju_mat2Quat(data.mocap_quat[slot], np.ascontiguousarray(rotation).ravel())
    settle(model, data)


def settle(model: Any, data: Any) -> None:
    """Shapes, cameras and lights follow the bodies."""
    import mujoco

    mujoco.mj_kinematics(model, data)
    mujoco.mj_comPos(model, data)
    mujoco.mj_camlight(model, data)


def free_camera(model: Any, half_angle: float) -> Any:
    """A camera that stands anywhere, with half of its field of view in height [deg]."""
    import mujoco

    camera = mujoco.MjvCamera()
    camera.type = mujoco.mjtCamera.mjCAMERA_FREE
    model.vis.global_.fovy = 2 * half_angle
    return camera
