"""What is drawn over a driving car's picture from frame to frame: load columns, marks of lifted wheels, the path so
far."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import Any

import numpy as np

from susp_mj.names import channel_name

from ...colours import LIFTED, rgb
from ..layout import load_tone
from ..rotations import about_z
from .pose import UP, HandlingPose, Motion, side_of

COLUMN = 1.15
"""Height of a load column for the highest load in the video [m]."""
_BESIDE, _HALF, _ABOVE = 0.38, 0.035, 0.012
_STEP, _LENGTH = 0.7, 140.0
Tone = tuple[float, ...]


def column(scene: Any, motion: Motion, pose: HandlingPose, station: str, highest: float, lifted: bool) -> None:
    """Load of a wheel as a column beside it, full at the `highest` load [N], with a mark at its static load; red while
    it is lifted."""
    wheel, level = pose.wheels[station], about_z(pose.yaw)
    static = float(motion.run[channel_name(station, "wheel_load")][0])
    place = wheel.centre + side_of(station) * _BESIDE * level[:, 1]
    foot = np.array([place[0], place[1], wheel.road + _ABOVE])
    back = (*unit(LIFTED), 0.55) if lifted else (0.95, 0.96, 0.97, 0.34)
    add(scene, "BOX", (_HALF, _HALF, COLUMN / 2), foot + COLUMN / 2 * UP, level, back, 0.5 if lifted else 0.0)
    height = 0.0 if lifted else COLUMN * wheel.load / highest
    if height > 0.01:
        red, green, blue = (part / 255 for part in load_tone(wheel.load, static))
        add(
            scene,
            "BOX",
            (_HALF + 0.012, _HALF + 0.012, height / 2),
            foot + height / 2 * UP,
            level,
            (red, green, blue, 1.0),
            0.35,
        )
    add(
        scene,
        "BOX",
        (_HALF + 0.03, _HALF + 0.03, 0.008),
        foot + COLUMN * static / highest * UP,
        level,
        (0.11, 0.13, 0.16, 1.0),
    )


def lift_mark(scene: Any, pose: HandlingPose, station: str) -> None:
    """Red disc on the road under a lifted wheel."""
    wheel = pose.wheels[station]
    foot = np.array([wheel.centre[0], wheel.centre[1], wheel.road + _ABOVE + 0.004])
    add(scene, "CYLINDER", (0.30, 0.004, 0.0), foot, np.eye(3), (*unit(LIFTED), 0.75), 0.6)


class Trail:
    """The path of a car's centre of gravity over the ground, in its colour.

    Args:
        motion: of the car.
        colour: ``#rrggbb``.
        start: where the video begins [s].
        height: above the road [m].
    """

    def __init__(self, motion: Motion, colour: str, start: float, height: float) -> None:
        run = motion.run
        points = np.column_stack([run["position_x"], run["position_y"]])
        distance = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
        self.times = np.interp(np.arange(0.0, distance[-1], _STEP), distance, run.time)
        # the front wheels met a place before the centre of gravity did
        earlier = self.times + motion.chassis.cg[0] / np.maximum(np.interp(self.times, run.time, run["speed"]), 1.0)
        roads = [run[name] for name in (channel_name(each, "road_height") for each in ("fl", "fr")) if name in run]
        high = (
            np.mean([np.interp(earlier, run.time, road) for road in roads], axis=0)
            if roads
            else np.zeros_like(self.times)
        )
        self.points = np.column_stack(
            [*(np.interp(self.times, run.time, points[:, k]) for k in range(2)), high + height]
        )
        self.pieces = [_piece(one, other) for one, other in pairwise(self.points)]
        self.tone = (*(0.25 + 0.75 * part for part in unit(colour)), 1.0)
        self.start = start

    def draw(self, scene: Any, time: float, place: np.ndarray) -> None:
        """Add what has been driven until a time [s], up to a place (x, y) [m]."""
        last = int(np.searchsorted(self.times, time)) - 1
        first = max(last - int(_LENGTH / _STEP), int(np.searchsorted(self.times, self.start)))
        if last < first:
            return
        newest = _piece(self.points[last], np.array([place[0], place[1], self.points[last, 2]]))
        for middle, turned, length in [*self.pieces[first:last], newest]:
            add(scene, "BOX", (length / 2 + 0.02, 0.06, 0.002), middle, turned, self.tone, 0.4)


def _piece(one: np.ndarray, other: np.ndarray) -> tuple[np.ndarray, np.ndarray, float]:
    """Middle, (3, 3) rotation with x along, and length of a straight piece from one point to another [m]."""
    length = float(np.linalg.norm(other - one))
    along = (other - one) / length if length > 1e-9 else np.array([1.0, 0.0, 0.0])
    left = np.array([-along[1], along[0], 0.0])
    left /= max(float(np.linalg.norm(left)), 1e-9)
    return (one + other) / 2, np.column_stack([along, left, np.cross(along, left)]), length


def unit(colour: str) -> Tone:
    """Red, green and blue, 0 to 1, of a colour written ``#rrggbb``."""
    return tuple(part / 255 for part in rgb(colour))


def add(
    scene: Any,
    kind: str,
    size: Sequence[float],
    place: np.ndarray,
    turned: np.ndarray,
    tone: Tone,
    emission: float = 0.0,
) -> None:
    """One more plain shape in what is about to be drawn, if there is room for it."""
    import mujoco

    if scene.ngeom >= scene.maxgeom:
        return
    geom = scene.geoms[scene.ngeom]
    shape = getattr(mujoco.mjtGeom, f"mjGEOM_{kind}")
    mujoco.mjv_initGeom(
        geom, shape, np.array(size), np.array(place), np.array(turned).ravel(), np.array(tone, np.float32)
    )
    geom.category, geom.emission = mujoco.mjtCatBit.mjCAT_DECOR, emission
    geom.specular, geom.shininess = 0.1, 0.1
    scene.ngeom += 1
