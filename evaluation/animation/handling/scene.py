"""The car that drives freely: its picture on the proving ground, followed by a camera; a second car as a ghost."""

from __future__ import annotations

import numpy as np

from ..cameras import CAMERAS
from ..picture import Picture, materials
from ..rotations import about_x, about_y, about_z
from ..scene import Frame, Scene, put
from ..style import Shot
from ..window import Window, lift
from .camera import Follow, camera_for, inside
from .decor import Trail, column, lift_mark
from .pose import HandlingPose, Motion
from .shapes import add_car, car_materials, fade, tint_tyre
from .world import add_plates, proving_ground, surroundings

_GHOST_ROOM = 1.12
STANDS = 1.0
"""Distance [m]; a car that goes less far stands on a rig."""


class HandlingScene(Scene):
    """Picture of cars on the proving ground, the first one solid, the others as ghosts.

    Args:
        shot: what to show.
        window: stretch of the runs.
    """

    def __init__(self, shot: Shot, window: Window) -> None:
        self.window, self.highest_load = window, shot.highest_load
        self.motions = [Motion(clip.run) for clip in shot.clips]
        self.standing = all(motion.travelled() <= STANDS for motion in self.motions)
        picture = Picture()
        surroundings(picture, shot.size, shot.style.samples)
        materials(picture, shot.colours[0])
        car_materials(picture)
        proving_ground(picture, self.motions)
        for number, (motion, colour) in enumerate(zip(self.motions, shot.colours, strict=True)):
            add_car(picture, motion.chassis, colour, prefix(number), ghost=number > 0, fine=shot.style.fine)
        if self.standing:
            add_plates(picture, self.motions[0])
        super().__init__(picture.spec, shot.size)
        self.trails = [
            Trail(motion, colour, window.start, 0.010 + 0.002 * number)
            for number, (motion, colour) in enumerate(zip(self.motions, shot.colours, strict=True))
        ]
        lead = self.motions[0]
        view = CAMERAS[shot.style.camera] if shot.style.camera else camera_for(shot.leader.run)
        middle = -float(lead.chassis.cg[0]) - lead.chassis.wheelbase / 2 - 0.1
        room = _GHOST_ROOM if len(self.motions) > 1 else 1.0
        self.follow = Follow(self.model, lead.run, view, inside(shot.leader.run), shot.size, middle, room)
        self.camera = self.follow.camera
        self.poses: list[HandlingPose] = []
        self.lifted: list[set[str]] = []

    def pose(self, time: float) -> None:
        self.poses = [motion.pose(time) for motion in self.motions]
        self.lifted = [
            {station for station in motion.chassis.centres if lift(motion.run, self.window, time, station)[0]}
            for motion in self.motions
        ]
        placed: dict[str, Frame] = {}
        for number, pose in enumerate(self.poses):
            placed |= pose.frames(prefix(number))
            placed[f"{prefix(number)}shadow"] = _under(pose, self.motions[number])
            if number > 0:
                fade(self.model, prefix(number), _apart(self.poses[0], pose))
            for station in pose.wheels:
                tint_tyre(self.model, prefix(number), station, red=station in self.lifted[number], ghost=number > 0)
        self.follow.aim(time)
        here = np.append(self.poses[0].place, 0.0)
        placed |= {"sun": (here, about_z(self.follow.sun())), "hills": (here, np.eye(3))}
        if self.standing:
            for station, wheel in self.poses[0].wheels.items():
                placed[f"{station}_plate"] = (np.array([wheel.centre[0], wheel.centre[1], wheel.road]), np.eye(3))
        put(self.model, self.data, placed)

    def stage(self, time: float) -> None:
        super().stage(time)
        scene = self.renderer.scene
        for number, pose in enumerate(self.poses):
            self.trails[number].draw(scene, time, pose.place)
            for station in self.lifted[number]:
                lift_mark(scene, pose, station)
        for station in self.poses[0].wheels:
            column(scene, self.motions[0], self.poses[0], station, self.highest_load, station in self.lifted[0])


def prefix(number: int) -> str:
    """Beginning of the names of a car's bodies in the picture."""
    return f"car{number}_"


def _under(pose: HandlingPose, motion: Motion) -> Frame:
    """Where a car's shadow lies: on the plane nearest to the road under its wheels."""
    names, centres = list(pose.wheels), motion.chassis.centres
    flat = np.array([[centres[name][0], centres[name][1], 1.0] for name in names])
    (ahead, left, height), *_ = np.linalg.lstsq(flat, np.array([pose.wheels[name].road for name in names]), rcond=None)
    tilted = about_z(pose.yaw) @ about_y(-float(np.arctan(ahead))) @ about_x(float(np.arctan(left)))
    return np.array([pose.origin[0], pose.origin[1], height]), tilted


def _apart(solid: HandlingPose, ghost: HandlingPose) -> float:
    """Strength of a ghost, from 0.3 where it hides the solid car to 1 at some distance or lean from it."""
    distance = float(np.linalg.norm(ghost.origin - solid.origin)) + 3.0 * float(
        np.abs(ghost.turned - solid.turned).max()
    )
    return min(0.3 + distance / 0.8, 1.0)
