"""How a camera follows a car that drives freely, and which one suits its run."""

from __future__ import annotations

from typing import Any

import numpy as np

from susp_mj.features import Cones, Gust
from susp_mj.run import Run

from ..cameras import CAMERAS, Camera
from ..clip import features_of
from ..picture import SUN_COURSE
from ..scene import free_camera

_CORNERING, _STANDS = 1.5, 0.1
_TURNED = {"roll_angle": np.radians(1.0), "steering_wheel_angle": np.radians(90.0)}
_OVER_SHOULDER = 38.0
_CALM_COURSE, _CALM_PLACE = 0.45, 0.10
_HALF_ANGLE = 14.0


def camera_for(run: Run) -> Camera:
    """Camera that shows what a manoeuvre is about: the front for a bend, behind where a course is to be kept, else the
    side.

    On a rig the front, if the body rolls or the wheels are steered.
    """
    if any(isinstance(feature, Cones | Gust) for feature in features_of(run)):
        return CAMERAS["chase"]
    bends = float(np.abs(run["lateral_acceleration"]).max()) > _CORNERING
    turned = float(run["speed"].max()) < _STANDS and any(
        float(np.ptp(run[name])) > least for name, least in _TURNED.items()
    )
    return CAMERAS["front" if bends or turned else "side"]


def inside(run: Run) -> float:
    """1 if the sharpest bend of a run goes to the left, -1 to the right, also where there is none."""
    sharpest = float(max(run["lateral_acceleration"], key=abs))
    return 1.0 if sharpest > _CORNERING else -1.0


class Follow:
    """A camera that follows a car: it turns with the smoothed course, and does not roll, pitch or heave with the body.

    Args:
        model: of the picture.
        run: of the car followed.
        view: from where.
        inner: side of the bend, 1 left, -1 right.
        size: (width, height) of the picture [px].
        middle: of the car, before its centre of gravity [m].
        room: factor on what must fit into the picture.
    """

    def __init__(
        self, model: Any, run: Run, view: Camera, inner: float, size: tuple[int, int], middle: float, room: float = 1.0
    ) -> None:
        self.view, self.inner, self.middle = view, inner, middle
        self.camera = free_camera(model, _HALF_ANGLE)
        self.camera.elevation = -view.drop
        needed = room * max(view.tall, view.wide * size[1] / size[0])
        self.camera.distance = needed / 2 / np.tan(np.radians(_HALF_ANGLE)) + 1.2
        self.time = run.time
        self.course = _smoothed(run["yaw_angle"], _CALM_COURSE / run.step)
        self.places = np.column_stack(
            [_smoothed(run[name], _CALM_PLACE / run.step) for name in ("position_x", "position_y")]
        )

    def aim(self, time: float) -> Any:
        """The camera at a time [s]."""
        course = float(np.interp(time, self.time, self.course))
        x, y = (float(np.interp(time, self.time, self.places[:, k])) for k in range(2))
        forward = self.middle + self.view.ahead
        self.camera.lookat[:] = [x + forward * np.cos(course), y + forward * np.sin(course), self.view.height]
        self.camera.azimuth = np.degrees(course) + self.view.bearing * self.inner + 180.0
        return self.camera

    def sun(self) -> float:
        """How far the light must be turned about the vertical to come over the camera's right shoulder [rad]."""
        return np.radians(self.camera.azimuth + _OVER_SHOULDER) - SUN_COURSE


def _smoothed(values: np.ndarray, width: float) -> np.ndarray:
    """Values without what is quicker than a width [samples], held in the middle and going on straight at the ends."""
    from scipy.ndimage import gaussian_filter1d

    reach = int(4 * width) + 1
    if len(values) < 3:
        return values
    begin, end = values[1] - values[0], values[-1] - values[-2]
    lead = values[0] + begin * np.arange(-reach, 0)
    tail = values[-1] + end * np.arange(1, reach + 1)
    return gaussian_filter1d(np.concatenate([lead, values, tail]), max(width, 1e-6))[reach:-reach]
