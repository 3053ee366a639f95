"""Video of runs: the wheels of several configurations side by side, drawn from their runs, with what was measured beside them.

The picture is a model of its own, posed from a run; the physics are not touched. Drawing happens in a process of its own,
because OpenGL without a screen has to be chosen before MuJoCo is imported.

Four parts, in this order: which stretch of the runs (`Window`), a scene and how to pose it (`QuarterScene`), the texts and
traces around it (`Hud`), and the film (`render_video`). Another scene is another class with a `picture` method.
"""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache, cached_property
from pathlib import Path
from typing import Any

import numpy as np

from susp_mj.errors import InputError, SuspMjError
from susp_mj.run import Run

from .colours import COLOURS, LIFTED, rgb
from .ride import CONTACT_LOST
from .video import NO_FFMPEG, NO_GL, Encoder, ffmpeg_program, gl_backend, gl_environment, unfinished_file

BEFORE, AFTER, AFTER_INPUT, LONGEST = 0.1, 1.3, 1.0, 4.0
"""Stretch of a run that is shown [s]: before the road first moves, after that, at least after it rests, and altogether at most."""
PLAYBACKS = (0.2, 0.25, 1 / 3, 0.5, 1.0)
LONGEST_CLIP = 8.0
"""Default playback is the slowest of these that keeps the clip below this length [s]."""
LAYOUT_HEIGHT = 720
"""Frame height [px] that the layout's numbers are meant for; other sizes scale."""

WHEEL_RADIUS = 0.33
"""Height of the wheel centre above the road in the design position [m]."""
COIL_LENGTH = 0.29
"""Length of the drawn coil in the design position [m]."""
_STRUT = 0.175
_HALF_ANGLE = 8.0
_LENGTH = 1.12
_LOWER_SEAT = 0.37
_VIEW = (2.02, 1.5)
_LOOK_AT = (0.0, 0.0, 0.5)


@dataclass(frozen=True)
class Clip:
    """Label and run of one configuration."""

    label: str
    run: Run


def can_render() -> str | None:
    """None if videos can be made here, else one sentence that names what to install."""
    if gl_backend() is None:
        return NO_GL
    return None if ffmpeg_program() else NO_FFMPEG


def render_video(
    clips: Sequence[Clip],
    path: str | Path,
    *,
    size: tuple[int, int] = (1280, 720),
    fps: int = 30,
    playback: float | None = None,
    progress: Callable[[float], None] | None = None,
) -> Path:
    """Draw the runs side by side into an MP4 file; it appears complete or not at all. Same runs, same file.

    Args:
        clips: one to eight configurations; their order fixes their colours.
        path: the file, ``.mp4``.
        size: (width, height) [px], both even.
        fps: frames per second of the video.
        playback: seconds of the run per second of video; None chooses slow motion that suits the runs.
        progress: called with the fraction done.

    Raises:
        InputError: a value that is not allowed, or a place that cannot be written.
        SuspMjError: this machine cannot render, or rendering failed.
    """
    path = Path(path)
    _check(clips, size, fps, playback)
    unfinished = unfinished_file(path)
    try:
        missing = can_render()
        if missing:
            raise SuspMjError(missing)
        with tempfile.TemporaryDirectory(prefix="susp_mj_") as folder:
            order = {
                "labels": [clip.label for clip in clips],
                "path": str(unfinished.resolve()),
                "size": size,
                "fps": fps,
                "playback": playback,
            }
            for number, clip in enumerate(clips):
                clip.run.save(Path(folder, f"{number}.nc"))
            Path(folder, "order.json").write_text(json.dumps(order), encoding="utf-8")
            _film_in_process(folder, progress)
        unfinished.replace(path)
    finally:
        unfinished.unlink(missing_ok=True)
    return path


def _check(clips: Sequence[Clip], size: tuple[int, int], fps: int, playback: float | None) -> None:
    if not 1 <= len(clips) <= len(COLOURS):
        raise InputError(f"{len(clips)} configurations are not allowed; from 1 to {len(COLOURS)} fit a frame", source="video")
    if any(side < 160 or side > 4096 or side % 2 for side in size):
        raise InputError(f"{size[0]} x {size[1]} is not allowed; both must be even and from 160 to 4096 pixels", key="size", source="video")
    if not 1 <= fps <= 120:
        raise InputError(f"{fps} is not allowed; choose 1 to 120 frames per second", key="fps", source="video")
    if playback is not None and not 0.001 <= playback <= 100:
        raise InputError(f"{playback} is not allowed; choose 0.001 (slow motion) to 100, 1 is real time", key="playback", source="video")
    for clip in clips:
        if not all(quantity in clip.run for quantity in _NEEDED):
            raise InputError(f"'{clip.label}': only runs of quarter cars can be shown; {clip.run.meta.get('model', 'the run')} is none")


_NEEDED = ("body_displacement", "body_acceleration", "suspension_deflection", "wheel_load", "road_height")


# ---- which stretch of the runs ---------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Window:
    """Stretch of the runs that is shown.

    Attributes:
        start, end: [s] of the runs.
        playback: seconds of the run per second of video.
        fps: frames per second.
    """

    start: float
    end: float
    playback: float
    fps: int

    @property
    def frame_step(self) -> float:
        """Time of the runs from frame to frame [s]."""
        return self.playback / self.fps

    @cached_property
    def times(self) -> np.ndarray:
        """(frames,) times of the runs [s]."""
        return self.start + self.frame_step * np.arange(max(round((self.end - self.start) / self.frame_step), 1) + 1)


def window_of(runs: Sequence[Run], fps: int, playback: float | None) -> Window:
    """From just before the road first moves until the cars have calmed down; of a long excitation, where a wheel load varies most."""
    moves = [_road_moves(run) for run in runs]
    first, last = min(move[0] for move in moves), max(move[1] for move in moves)
    end = max(first + AFTER, last + AFTER_INPUT)
    if end - first > LONGEST:
        peak = max((_largest_load(run) for run in runs), key=lambda each: each[0])[1]
        first, end = peak - AFTER / 2, peak + AFTER / 2
    begins, ends = min(float(run.time[0]) for run in runs), max(float(run.time[-1]) for run in runs)
    start = max(first - BEFORE, begins)
    end = min(max(end, start + BEFORE + AFTER), ends)
    if playback is None:
        playback = next((each for each in PLAYBACKS if (end - start) / each <= LONGEST_CLIP), PLAYBACKS[-1])
    return Window(start, end, playback, fps)


def _road_moves(run: Run) -> tuple[float, float]:
    """When the road first and last moves [s]."""
    moving = np.flatnonzero(np.abs(np.diff(run["road_height"])) > 1e-9)
    return (float(run.time[moving[0]]), float(run.time[moving[-1] + 1])) if len(moving) else (BEFORE, BEFORE)


def _largest_load(run: Run) -> tuple[float, float]:
    """Largest departure of the wheel load from its initial value [N], and when [s]."""
    departure = np.abs(run["wheel_load"] - run["wheel_load"][0])
    return float(departure.max()), float(run.time[int(departure.argmax())])


# ---- the quarter car: scene and pose ---------------------------------------------------------------------------------


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
    wheel = "wheel_displacement" if "wheel_displacement" in run else "road_height"
    speed = speed_of(run)
    slope = (
        (at(run, "road_height", time + run.step) - at(run, "road_height", time - run.step)) / (2 * run.step * speed) if speed > 0 else 0.0
    )
    return Pose(
        body=at(run, "body_displacement", time),
        wheel=at(run, wheel, time),
        spin=speed * time / WHEEL_RADIUS,
        travelled=speed * time,
        road=at(run, "road_height", time),
        slope=slope,
    )


def at(run: Run, quantity: str, time: float) -> float:
    """Value of a channel at a time [s], linear between the records."""
    return float(np.interp(time, run.time, run[quantity]))


def speed_of(run: Run) -> float:
    """Driving speed [m/s]; 0 on a test rig."""
    return float(run.meta.get("manoeuvre", {}).get("speed", 0.0))


def tyre_deflection(run: Run) -> float:
    """How far the tyre is pressed in by the static load [m], from the slope of wheel load over deflection; 0 for a rigid wheel."""
    if "wheel_displacement" not in run:
        return 0.0
    load, squeeze = run["wheel_load"], run["road_height"] - run["wheel_displacement"]
    held = load > CONTACT_LOST
    spread = squeeze[held] - squeeze[0]
    rate = float(spread @ (load[held] - load[0])) / max(float(spread @ spread), 1e-12)
    return float(np.clip(load[0] / rate, 0.0, 0.05)) if rate > 0 else 0.0


class QuarterScene:
    """Picture of one quarter car, driving over its road or standing on a test rig; one OpenGL context each.

    Args:
        run: what to show.
        colour: of the bodywork, ``#rrggbb``.
        size: (width, height) of the picture [px].
        window: stretch of the run, for the length of the road.
    """

    def __init__(self, run: Run, colour: str, size: tuple[int, int], window: Window) -> None:
        import mujoco

        self.run = run
        self.model = quarter_spec(run, colour, size, window).compile()
        self.data = mujoco.MjData(self.model)
        self.renderer = mujoco.Renderer(self.model, size[1], size[0])
        self.renderer.scene.flags[mujoco.mjtRndFlag.mjRND_FOG] = 1
        self.camera = _camera(self.model, size)

    def picture(self, time: float) -> np.ndarray:
        """(height, width, 3) picture at a time of the run [s]."""
        pose = pose_at(self.run, time)
        place(self.model, self.data, pose)
        self.renderer.update_scene(self.data, self.camera)
        stretch_coil(self.model, self.data, self.renderer.scene, pose)
        return self.renderer.render()

    def close(self) -> None:
        """Free the OpenGL context."""
        self.renderer.close()


def place(model: Any, data: Any, pose: Pose) -> None:
    """Put every part of the picture in its place; lights and cameras too, or the scene goes dark."""
    import mujoco

    joints = {"body": pose.body, "wheel": pose.wheel, "spin": pose.spin, "road": -pose.travelled, "plate": pose.road}
    for joint, value in {**joints, "slope": -float(np.arctan(pose.slope))}.items():
        data.joint(joint).qpos[0] = value
    mujoco.mj_kinematics(model, data)
    mujoco.mj_comPos(model, data)
    mujoco.mj_camlight(model, data)


def stretch_coil(model: Any, data: Any, scene: Any, pose: Pose) -> None:
    """Scale the coil along z from its foot, in the updated scene only: a geom's matrix there need not be orthonormal."""
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


class _Picture:
    """A MuJoCo specification of shapes without mass or contact."""

    def __init__(self) -> None:
        import mujoco

        self.types = mujoco.mjtGeom
        self.spec = mujoco.MjSpec()

    def material(self, name: str, colour: Sequence[float], specular: float = 0.2, shininess: float = 0.3) -> None:
        self.spec.add_material(name=name, rgba=[*colour, 1.0] if len(colour) == 3 else list(colour), specular=specular, shininess=shininess)

    def body(self, name: str, height: float, axis: Sequence[float], parent: Any = None) -> Any:
        """A body on a slide joint of the same name."""
        import mujoco

        body = (parent or self.spec.worldbody).add_body(name=name, pos=[0, 0, height])
        body.mass, body.inertia, body.ipos, body.explicitinertial = 1.0, [1, 1, 1], [0, 0, 0], True
        body.add_joint(name=name, type=mujoco.mjtJoint.mjJNT_SLIDE, axis=list(axis))
        return body

    def turning(self, parent: Any, name: str) -> Any:
        """A body on a hinge about y of the same name."""
        import mujoco

        body = parent.add_body(name=name)
        body.mass, body.inertia, body.ipos, body.explicitinertial = 1.0, [1, 1, 1], [0, 0, 0], True
        body.add_joint(name=name, type=mujoco.mjtJoint.mjJNT_HINGE, axis=[0, 1, 0])
        return body

    def shape(self, body: Any, kind: str, size: Sequence[float], material: str, pos: Sequence[float] = (0, 0, 0), **more: Any) -> None:
        """A plain shape: ``box``, ``cylinder``, ``sphere``, ``ellipsoid``, ``plane``."""
        shape = getattr(self.types, f"mjGEOM_{kind.upper()}")
        body.add_geom(type=shape, size=[*size, 0, 0][:3], material=material, pos=list(pos), mass=0.0, contype=0, conaffinity=0, **more)

    def mesh(self, body: Any, name: str, surface: Any, material: str, pos: Sequence[float] = (0, 0, 0)) -> None:
        """A triangle mesh from `vehicles.mjcf.body`."""
        import mujoco

        mesh = self.spec.add_mesh(name=name, inertia=mujoco.mjtMeshInertia.mjMESH_INERTIA_SHELL)
        mesh.uservert, mesh.userface = surface.vertices.ravel(), surface.faces.ravel()
        body.add_geom(
            name=name, type=self.types.mjGEOM_MESH, meshname=name, material=material, pos=list(pos), mass=0.0, contype=0, conaffinity=0
        )


def quarter_spec(run: Run, colour: str, size: tuple[int, int], window: Window) -> Any:
    """MuJoCo specification of the picture of a quarter car; joints ``body``, ``wheel``, ``spin``, ``road`` and ``plate``."""
    picture = _Picture()
    _studio(picture, size)
    _materials(picture, colour)
    _bodywork(picture)
    _wheel(picture, WHEEL_RADIUS + tyre_deflection(run))
    road = picture.body("road", 0.0, (1, 0, 0))
    plate = picture.body("plate", 0.0, (0, 0, 1))
    if speed_of(run) > 0:
        _road(picture, road, run, window)
    else:
        _rig(picture, plate)
    _contact_shadow(picture, plate)
    return picture.spec


def _studio(picture: _Picture, size: tuple[int, int]) -> None:
    """Light, sky and floor."""
    import mujoco

    spec = picture.spec
    look = spec.visual
    look.global_.offwidth, look.global_.offheight = size
    look.quality.offsamples = 4
    look.map.znear, look.map.zfar = 0.05, 40.0
    look.map.fogstart, look.map.fogend, look.map.haze = 4.5, 10.0, 0.0
    look.rgba.fog = look.rgba.haze = [0.90, 0.925, 0.95, 1.0]
    look.headlight.ambient, look.headlight.diffuse, look.headlight.specular = [0.42] * 3, [0.26] * 3, [0.08] * 3
    spec.stat.extent, spec.stat.center = 2.0, [0, 0, 0.5]
    spec.add_texture(
        name="sky",
        type=mujoco.mjtTexture.mjTEXTURE_SKYBOX,
        builtin=mujoco.mjtBuiltin.mjBUILTIN_GRADIENT,
        rgb1=[0.66, 0.76, 0.87],
        rgb2=[0.93, 0.95, 0.97],
        width=256,
        height=1536,
    )
    spec.worldbody.add_light(
        type=mujoco.mjtLightType.mjLIGHT_DIRECTIONAL,
        pos=[1.6, -2.6, 4.2],
        dir=[-0.36, 0.5, -1.0],
        diffuse=[0.62, 0.61, 0.58],
        specular=[0.5, 0.5, 0.5],
        castshadow=False,
    )


def _materials(picture: _Picture, colour: str) -> None:
    paint = [value / 255 for value in rgb(colour)]
    for name, tone, specular, shininess in (
        ("paint", paint, 0.55, 0.7),
        ("liner", (0.13, 0.14, 0.16), 0.05, 0.1),
        ("rubber", (0.085, 0.087, 0.092), 0.12, 0.12),
        ("mark", (0.88, 0.88, 0.86), 0.1, 0.1),
        ("alloy", (0.74, 0.76, 0.79), 0.7, 0.7),
        ("steel", (0.56, 0.58, 0.61), 0.8, 0.8),
        ("chrome", (0.86, 0.88, 0.9), 1.0, 0.9),
        ("dark", (0.2, 0.21, 0.23), 0.3, 0.4),
        ("spring", (0.97, 0.77, 0.1), 0.6, 0.6),
        ("caliper", (0.72, 0.12, 0.1), 0.4, 0.5),
        ("asphalt", (0.40, 0.415, 0.435), 0.05, 0.1),
        ("bump", (0.58, 0.575, 0.55), 0.05, 0.1),
        ("line", (0.95, 0.95, 0.93), 0.1, 0.1),
        ("floor", (0.83, 0.855, 0.88), 0.02, 0.1),
        ("rig", (0.30, 0.33, 0.37), 0.3, 0.4),
        ("dais", (0.60, 0.635, 0.675), 0.1, 0.2),
        ("shadow", (0.0, 0.0, 0.0, 0.11), 0.0, 0.0),
    ):
        picture.material(name, tone, specular, shininess)


def _bodywork(picture: _Picture) -> None:
    """Corner of a car with its spring dome; heights from the wheel centre in the design position."""
    from vehicles.mjcf import body as shapes

    body = picture.body("body", WHEEL_RADIUS, (0, 0, 1))
    arch = {"sill": -0.03, "arch": 0.415, "slot": 0.15}
    picture.mesh(body, "fender", shapes.fender(length=_LENGTH, top=0.735, near=-0.13, far=-0.06, **arch), "paint")
    picture.mesh(body, "lip", shapes.arch_lip(near=-0.137, far=-0.06, **arch), "liner")
    picture.mesh(body, "deck", shapes.deck(length=_LENGTH - 0.012, top=0.737, thickness=0.07, near=-0.133, far=0.46), "paint")
    picture.mesh(body, "liner", shapes.rounded_box(0.9, 0.1, 0.62, 0.03), "liner", (0, 0.35, 0.345))
    picture.shape(body, "cylinder", (0.1, 0.012), "liner", (0, _STRUT, 0.745))
    picture.shape(body, "cylinder", (0.06, 0.02), "dark", (0, _STRUT, 0.76))
    picture.shape(body, "cylinder", (0.014, 0.035), "chrome", (0, _STRUT, 0.78))
    upper = _LOWER_SEAT + COIL_LENGTH
    picture.shape(body, "cylinder", (0.082, 0.007), "dark", (0, _STRUT, upper + 0.007))
    picture.shape(body, "cylinder", (0.026, 0.022), "rubber", (0, _STRUT, upper - 0.022))
    picture.shape(body, "cylinder", (0.013, 0.25), "chrome", (0, _STRUT, upper - 0.25))


def _wheel(picture: _Picture, tyre_radius: float) -> None:
    """Wheel with brake, damper tube, lower spring seat and the coil standing on it."""
    from vehicles.mjcf import body as shapes

    carrier = picture.body("wheel", WHEEL_RADIUS, (0, 0, 1))
    picture.shape(carrier, "cylinder", (0.032, 0.22), "steel", (0, _STRUT, _LOWER_SEAT - 0.18))
    picture.shape(carrier, "cylinder", (0.084, 0.007), "dark", (0, _STRUT, _LOWER_SEAT - 0.007))
    picture.shape(carrier, "cylinder", (0.036, 0.008), "dark", (0, _STRUT, _LOWER_SEAT + 0.036))
    picture.shape(carrier, "box", (0.045, 0.07, 0.075), "dark", (0, 0.12, 0.0))
    picture.shape(carrier, "box", (0.028, 0.03, 0.06), "caliper", (-0.135, 0.018, 0.05))
    carrier.add_site(name="coil_foot", pos=[0, _STRUT, _LOWER_SEAT])
    picture.mesh(carrier, "coil", shapes.coil(COIL_LENGTH, 0.064, 0.0085), "spring", (0, _STRUT, _LOWER_SEAT))
    wheel = picture.turning(carrier, "spin")
    for name, surface, material in (
        ("tyre", shapes.tyre(tyre_radius), "rubber"),
        ("marks", shapes.sidewall_marks(tyre_radius), "mark"),
        ("rim", shapes.rim(), "alloy"),
        ("bolts", shapes.wheel_bolts(), "dark"),
        ("disc", shapes.brake_disc(), "steel"),
    ):
        picture.mesh(wheel, name, surface, material)


def _road(picture: _Picture, body: Any, run: Run, window: Window) -> None:
    """The road that passes underneath: its height over distance is the run's road height over time."""
    from vehicles.mjcf import body as shapes

    speed = speed_of(run)

    def height(x: np.ndarray) -> np.ndarray:
        return np.interp(x / speed, run.time, run["road_height"])

    start, end = speed * window.start - 6.0, speed * window.end + 8.0
    raised = run.time[np.abs(run["road_height"] - run["road_height"][0]) > 1e-4] * speed
    dashes = [(x, x + 0.4) for x in np.arange(np.floor(start), end, 1.0)]
    picture.mesh(body, "asphalt", shapes.road(height, [(start, end)], near=-0.3, far=1.7, top=0.0, bottom=-0.14), "asphalt")
    picture.mesh(body, "edge", shapes.road(height, [(start, end)], near=-0.27, far=-0.22, top=0.003, bottom=-0.02), "line")
    picture.mesh(body, "dashes", shapes.road(height, dashes, near=1.15, far=1.25, top=0.003, bottom=-0.02), "line")
    if len(raised) and raised[-1] - raised[0] < 6.0:
        span = [(float(raised[0]), float(raised[-1]))]
        picture.mesh(body, "bump", shapes.road(height, span, near=-0.302, far=1.701, top=0.0015, bottom=-0.142), "bump")
    picture.shape(picture.spec.worldbody, "plane", (30, 30, 1), "floor", (0, 0, -0.14))


def _rig(picture: _Picture, plate: Any) -> None:
    """Test rig: the wheel stands on a plate that a cylinder moves."""
    from vehicles.mjcf import body as shapes

    picture.mesh(plate, "plate", shapes.rounded_box(0.72, 0.44, 0.036, 0.012), "steel", (0, 0, -0.018))
    picture.shape(plate, "cylinder", (0.045, 0.15), "chrome", (0, 0, -0.18))
    base = picture.spec.worldbody
    picture.shape(base, "cylinder", (0.085, 0.08), "rig", (0, 0, -0.22))
    picture.shape(base, "cylinder", (0.1, 0.012), "dark", (0, 0, -0.14))
    picture.shape(base, "cylinder", (0.62, 0.01), "dais", (0, 0, -0.26))
    picture.shape(base, "plane", (30, 30, 1), "floor", (0, 0, -0.27))


def _contact_shadow(picture: _Picture, plate: Any) -> None:
    """Soft shadow of the wheel: a stack of faint discs on the road, far cheaper than a shadow map."""
    patch = picture.turning(plate, "slope")
    for number, radius in enumerate(np.linspace(0.13, 0.30, 8)):
        picture.shape(patch, "ellipsoid", (float(radius), float(0.55 * radius), 0.0004), "shadow", (0, 0.02, 0.004 + 0.0005 * number))


def _camera(model: Any, size: tuple[int, int]) -> Any:
    """Camera at the car's right front, far enough away to see it whole."""
    import mujoco

    camera = mujoco.MjvCamera()
    camera.type = mujoco.mjtCamera.mjCAMERA_FREE
    camera.lookat[:] = _LOOK_AT
    camera.azimuth, camera.elevation = 101.0, -8.0
    model.vis.global_.fovy = 2 * _HALF_ANGLE
    needed = max(_VIEW[1], _VIEW[0] * size[1] / size[0])
    camera.distance = needed / 2 / np.tan(np.radians(_HALF_ANGLE))
    return camera


# ---- texts and traces around the scenes ------------------------------------------------------------------------------

_INK, _SOFT, _RULE, _PAPER, _BAND = (28, 33, 40), (98, 107, 118), (205, 211, 218), (250, 251, 252), (236, 240, 244)
_HEADER, _STRIP = 50, 196


@dataclass(frozen=True)
class Box:
    """Rectangle in a frame [px]."""

    left: int
    top: int
    width: int
    height: int


def panels(count: int, size: tuple[int, int]) -> list[Box]:
    """Where the scenes go: side by side, from four on in two rows."""
    width, height = size
    scale = height / LAYOUT_HEIGHT
    top, bottom = round(_HEADER * scale), height - round(_STRIP * scale)
    rows = 1 if count <= 3 else 2
    columns = -(-count // rows)
    xs, ys = np.linspace(0, width, columns + 1).round().astype(int), np.linspace(top, bottom, rows + 1).round().astype(int)
    gap = max(round(3 * scale), 1)
    boxes = []
    for number in range(count):
        row, column = divmod(number, columns)
        left, right = int(xs[column]) + (gap if column else 0), int(xs[column + 1])
        upper, lower = int(ys[row]) + (gap if row else 0), int(ys[row + 1])
        boxes.append(Box(left, upper, right - left, lower - upper))
    return boxes


@cache
def _font(height: float, bold: bool = False) -> Any:
    """DejaVu Sans, which matplotlib brings, in a height [px]."""
    import matplotlib
    from PIL import ImageFont

    name = "DejaVuSans-Bold.ttf" if bold else "DejaVuSans.ttf"
    return ImageFont.truetype(str(Path(matplotlib.get_data_path(), "fonts", "ttf", name)), max(round(height), 6))


class Chart:
    """Time traces of one quantity of all runs; what is past is drawn in full colour, what is to come faint."""

    def __init__(self, clips: Sequence[Clip], quantity: str, title: str, factor: float, window: Window, box: Box, scale: float) -> None:
        self.box, self.window, self.scale = box, window, scale
        self.plot = Box(round(46 * scale), round(27 * scale), box.width - round(60 * scale), box.height - round(50 * scale))
        grid = np.linspace(window.start, window.times[-1], max(self.plot.width * 2, 2))
        self.traces = [np.interp(grid, clip.run.time, clip.run[quantity]) * factor for clip in clips]
        self.grid, self.title = grid, title
        low, high = min(0.0, *(float(t.min()) for t in self.traces)), max(0.0, *(float(t.max()) for t in self.traces))
        margin = 0.06 * max(high - low, 1e-3)
        self.low, self.high = low - (margin if low < 0 else 0.35 * margin), high + margin
        self.lifts = [t <= CONTACT_LOST for t in self.traces] if quantity == "wheel_load" else []
        self.faint, self.full = self._layer(0.33), self._layer(1.0)

    def x(self, time: float | np.ndarray) -> Any:
        """Horizontal place in the chart [px]."""
        return self.plot.left + (time - self.window.start) / max(self.window.times[-1] - self.window.start, 1e-9) * self.plot.width

    def y(self, value: float | np.ndarray) -> Any:
        """Vertical place in the chart [px]."""
        return self.plot.top + (self.high - value) / (self.high - self.low) * self.plot.height

    def _layer(self, strength: float) -> Any:
        """The chart with its traces in a strength from 0 to 1, drawn large and reduced."""
        from PIL import Image, ImageDraw

        fine = 3
        image = Image.new("RGB", (self.box.width * fine, self.box.height * fine), _PAPER)
        draw = ImageDraw.Draw(image)
        right, base = self.plot.left + self.plot.width, self.plot.top + self.plot.height
        hair = max(round(self.scale * fine), 1)
        for value in ticks(self.low, self.high, 4):
            y = self.y(value)
            draw.line([self.plot.left * fine, y * fine, right * fine, y * fine], _SOFT if value == 0 else _RULE, hair)
        for time in ticks(self.window.start, self.window.times[-1], 8):
            x = self.x(time)
            draw.line([x * fine, base * fine, x * fine, (base + 4 * self.scale) * fine], _SOFT, hair)
        for number, trace in enumerate(self.traces):
            tone = _mixed(rgb(COLOURS[number]), _PAPER, strength)
            points = np.column_stack([self.x(self.grid), self.y(trace)]) * fine
            draw.line([tuple(point) for point in points.tolist()], tone, max(round(2.3 * self.scale * fine), 1), joint="curve")
        for lifted in self.lifts:
            for one, other in _spans(lifted):
                edge = [self.x(self.grid[one]) * fine, (self.y(0.0) - 3 * self.scale) * fine, self.x(self.grid[other]) * fine]
                draw.rectangle([*edge, (self.y(0.0) + 3 * self.scale) * fine], _mixed(rgb(LIFTED), _PAPER, strength))
        image = image.resize((self.box.width, self.box.height), Image.Resampling.LANCZOS)
        self._label(ImageDraw.Draw(image))
        return image

    def _label(self, draw: Any) -> None:
        font = _font(11.5 * self.scale)
        draw.text((self.plot.left, 5 * self.scale), self.title, _INK, _font(13 * self.scale, bold=True))
        for value in ticks(self.low, self.high, 4):
            draw.text((self.plot.left - 6 * self.scale, self.y(value)), f"{value:g}".replace("-", "−"), _SOFT, font, anchor="rm")
        base = self.plot.top + self.plot.height
        for time in ticks(self.window.start, self.window.times[-1], 8):
            draw.text((self.x(time), base + 5 * self.scale), f"{time:.3g}", _SOFT, font, anchor="mt")
        draw.text((self.plot.left + self.plot.width, 6 * self.scale), "time in s", _SOFT, font, anchor="rt")

    def draw(self, frame: Any, time: float) -> None:
        """Paste the chart with its cursor at a time [s] into a frame."""
        from PIL import ImageDraw

        cursor = round(self.x(time))
        frame.paste(self.faint, (self.box.left, self.box.top))
        frame.paste(self.full.crop((0, 0, cursor, self.box.height)), (self.box.left, self.box.top))
        draw = ImageDraw.Draw(frame)
        x, top = self.box.left + cursor, self.box.top + self.plot.top
        draw.line([x, top - 3 * self.scale, x, top + self.plot.height + 3 * self.scale], _INK, max(round(self.scale), 1))
        for number, trace in enumerate(self.traces):
            y, radius = self.box.top + self.y(float(np.interp(time, self.grid, trace))), 4.5 * self.scale
            draw.ellipse([x - radius, y - radius, x + radius, y + radius], rgb(COLOURS[number]), (255, 255, 255), max(round(self.scale), 1))


class Hud:
    """Everything in a frame that is not a scene: header, labels, numbers, load bars and traces."""

    def __init__(self, clips: Sequence[Clip], window: Window, size: tuple[int, int]) -> None:
        self.clips, self.window, self.size = clips, window, size
        self.scale = size[1] / LAYOUT_HEIGHT
        self.boxes = panels(len(clips), size)
        self.highest_load = max(float(clip.run["wheel_load"].max()) for clip in clips)
        strip = round(_STRIP * self.scale)
        half, top = size[0] // 2, size[1] - strip
        left, right = Box(0, top, half, strip), Box(half, top, size[0] - half, strip)
        self.charts = [
            Chart(clips, "body_acceleration", "Body acceleration in m/s²", 1.0, window, left, self.scale),
            Chart(clips, "wheel_load", "Wheel load in kN", 1e-3, window, right, self.scale),
        ]
        self.background = self._background()

    def _background(self) -> Any:
        from PIL import Image, ImageDraw

        image = Image.new("RGB", self.size, _PAPER)
        draw = ImageDraw.Draw(image)
        s, width = self.scale, self.size[0]
        meta = self.clips[0].run.meta
        middle = _HEADER * s / 2
        draw.text((18 * s, middle), describe(meta.get("manoeuvre", {})), _INK, _font(17 * s, bold=True), anchor="lm")
        text = playback_text(self.window.playback)
        font = _font(14 * s, bold=True)
        length = font.getlength(text)
        draw.rounded_rectangle([width - length - 38 * s, 11 * s, width - 14 * s, (_HEADER - 11) * s], 13 * s, _BAND)
        draw.text((width - 26 * s - length / 2, middle), text, _SOFT, font, anchor="mm")
        self._clock_right = width - length - 56 * s
        return image

    def draw(self, frame: Any, time: float) -> None:
        """Draw onto a frame that already shows the scenes."""
        from PIL import ImageDraw

        draw = ImageDraw.Draw(frame)
        s = self.scale
        draw.text((self._clock_right, _HEADER * s / 2), f"t = {time:.3f} s".replace("-", "−"), _INK, _font(20 * s, bold=True), anchor="rm")
        for number, (clip, box) in enumerate(zip(self.clips, self.boxes, strict=True)):
            self._panel(draw, clip, rgb(COLOURS[number]), box, time)
        for chart in self.charts:
            chart.draw(frame, time)

    def _panel(self, draw: Any, clip: Clip, colour: tuple[int, int, int], box: Box, time: float) -> None:
        s, run = self.scale, clip.run
        left, top = box.left + 16 * s, box.top + 14 * s
        font = _font(16 * s, bold=True)
        label = shortened(clip.label, font, box.width - 146 * s)
        draw.rounded_rectangle([left, top, left + font.getlength(label) + 24 * s, top + 29 * s], 8 * s, colour)
        draw.text((left + 12 * s, top + 14.5 * s), label, (255, 255, 255), font, anchor="lm")
        draw.text((left + 2 * s, top + 42 * s), "body acceleration", _SOFT, _font(12.5 * s))
        value, big = f"{at(run, 'body_acceleration', time):+.1f}".replace("-", "−"), _font(22 * s, bold=True)
        draw.text((left + 2 * s, top + 80 * s), value, _INK, big, anchor="ls")
        draw.text((left + 7 * s + big.getlength(value), top + 80 * s), "m/s²", _SOFT, _font(13 * s), anchor="ls")
        self._load_bar(draw, run, box, time)

    def _load_bar(self, draw: Any, run: Run, box: Box, time: float) -> None:
        """Wheel load as a bar with the static load as a mark; red while the wheel is off the road."""
        s = self.scale
        right, top = box.left + box.width - 18 * s, box.top + 40 * s
        width, height = 20 * s, min(210 * s, box.height - 120 * s)
        lifted, total = lift(run, self.window, time)
        load, static = 0.0 if lifted else at(run, "wheel_load", time), float(run["wheel_load"][0])
        tone = rgb(LIFTED) if lifted else _mixed((38, 140, 88), (235, 150, 20), float(np.clip(2 - load / max(static, 1.0), 0.0, 1.0)))
        draw.rounded_rectangle(
            [right - width, top, right, top + height], 4 * s, (255, 255, 255), rgb(LIFTED) if lifted else _SOFT, max(round(s), 1)
        )
        filled = height * min(load / (1.05 * self.highest_load), 1.0)
        if filled >= 1:
            draw.rectangle([right - width + 3 * s, top + height - filled, right - 3 * s, top + height - 2 * s], tone)
        mark = top + height - height * static / (1.05 * self.highest_load)
        draw.line([right - width - 5 * s, mark, right + 5 * s, mark], _INK, max(round(1.5 * s), 1))
        draw.text((right - width - 8 * s, mark), "static", _SOFT, _font(11 * s), anchor="rm")
        draw.text((right, top - 8 * s), "wheel load", _SOFT, _font(12.5 * s), anchor="rb")
        number = _font(18 * s, bold=True)
        outlined: dict[str, Any] = {"anchor": "rt", "stroke_width": 2.2 * s, "stroke_fill": _PAPER}
        draw.text((right, top + height + 8 * s), f"{load / 1000:.1f} kN", rgb(LIFTED) if lifted else _INK, number, **outlined)
        if total > 0:
            note = f"lifted for {1000 * total:.0f} ms"
            draw.text((right, top + height + 32 * s), note, rgb(LIFTED), _font(12.5 * s, bold=True), **outlined)
        if lifted:
            self._alarm(draw, box)

    def _alarm(self, draw: Any, box: Box) -> None:
        s = self.scale
        x, y = box.left + box.width / 2, box.top + box.height - 26 * s
        font = _font(19 * s, bold=True)
        half = font.getlength("NO CONTACT") / 2 + 16 * s
        draw.rounded_rectangle([x - half, y - 17 * s, x + half, y + 17 * s], 8 * s, rgb(LIFTED))
        draw.text((x, y), "NO CONTACT", (255, 255, 255), font, anchor="mm")


def lift(run: Run, window: Window, time: float) -> tuple[bool, float]:
    """Whether the wheel is off the road at any record since the last frame, and how long it has been in the window so far [s]."""
    off = run["wheel_load"] <= CONTACT_LOST
    latest = (run.time > time - max(window.frame_step, run.step)) & (run.time <= time + 1e-9)
    past = (run.time >= window.start) & (run.time <= time + 1e-9)
    return bool(off[latest].any()), float(off[past].sum()) * run.step


def ticks(low: float, high: float, count: int) -> list[float]:
    """About `count` round numbers from `low` to `high`."""
    raw = (high - low) / count
    power = 10.0 ** np.floor(np.log10(raw))
    step = power * next(factor for factor in (1, 2, 2.5, 5, 10) if factor * power >= raw * 0.999)
    return [round(float(k * step), 9) + 0.0 for k in range(int(np.ceil(low / step - 1e-9)), int(np.floor(high / step + 1e-9)) + 1)]


def playback_text(playback: float) -> str:
    """How fast the video runs, for the reader."""
    if abs(playback - 1) < 1e-9:
        return "real time"
    return f"slow motion 1 : {1 / playback:.3g}" if playback < 1 else f"{playback:.3g} times real time"


_PARAMETERS = {
    "height": ("{:+.0f} mm", 1000.0),
    "length": ("{:.3g} m long", 1.0),
    "amplitude": ("amplitude {:.3g} mm", 1000.0),
    "rise_time": ("within {:.0f} ms", 1000.0),
    "start_frequency": ("from {:.3g} Hz", 1.0),
    "end_frequency": ("to {:.3g} Hz", 1.0),
    "speed": ("at {:.3g} km/h", 3.6),
}
_TITLES = {"bump": "Bump", "step": "Road step", "vertical_sweep": "Vertical sine sweep"}


def describe(manoeuvre: Mapping[str, Any]) -> str:
    """One line that says what is done: ``Bump · +80 mm · 2 m long · at 50 km/h``."""
    kind = str(manoeuvre.get("kind", "run"))
    parts = [
        text.format(manoeuvre[key] * factor) for key, (text, factor) in _PARAMETERS.items() if isinstance(manoeuvre.get(key), (int, float))
    ]
    return "  ·  ".join([_TITLES.get(kind, kind.replace("_", " ")), *parts]).replace("-", "−")


def shortened(text: str, font: Any, width: float) -> str:
    """The text, or as much of it as fits [px], with an ellipsis."""
    while len(text) > 1 and font.getlength(text) > width:
        text = text[:-2].rstrip() + "…"
    return text


def _mixed(colour: Sequence[int], ground: Sequence[int], share: float) -> tuple[int, int, int]:
    red, green, blue = (round(share * a + (1 - share) * b) for a, b in zip(colour, ground, strict=True))
    return red, green, blue


def _spans(flags: np.ndarray) -> list[tuple[int, int]]:
    """First and last index of every stretch that is true."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], flags, [False]])))
    return [(int(one), int(other) - 1) for one, other in edges.reshape(-1, 2)]


# ---- the film --------------------------------------------------------------------------------------------------------


def frames(clips: Sequence[Clip], window: Window, size: tuple[int, int]) -> Iterator[np.ndarray]:
    """(height, width, 3) frames one by one; needs a working OpenGL in this process."""
    from PIL import Image

    hud = Hud(clips, window, size)
    scenes = [QuarterScene(clip.run, COLOURS[k], (hud.boxes[k].width, hud.boxes[k].height), window) for k, clip in enumerate(clips)]
    try:
        for time in window.times.tolist():
            frame = hud.background.copy()
            for scene, box in zip(scenes, hud.boxes, strict=True):
                frame.paste(Image.fromarray(scene.picture(time)), (box.left, box.top))
            hud.draw(frame, time)
            yield np.asarray(frame)
    finally:
        for scene in scenes:
            scene.close()


def _film_in_process(folder: str, progress: Callable[[float], None] | None) -> None:
    """Draw what `folder` orders in a process with OpenGL; its last line says what went wrong, if anything."""
    backend = gl_backend()
    assert backend is not None
    command = [sys.executable, "-m", "evaluation.animation", folder]
    said = ""
    with (
        tempfile.TemporaryFile() as noise,
        subprocess.Popen(command, env=gl_environment(backend), stdout=subprocess.PIPE, stderr=noise, text=True) as process,
    ):
        assert process.stdout is not None
        try:
            for line in process.stdout:
                said = line.strip()
                if progress is not None and said.startswith("done "):
                    progress(float(said.removeprefix("done ")))
        except BaseException:
            process.kill()
            raise
        if process.wait():
            noise.seek(0)
            lines = noise.read().decode(errors="replace").strip().splitlines()
            reason = said.removeprefix("failed ") if said.startswith("failed ") else (lines or [f"exit status {process.returncode}"])[-1]
            raise SuspMjError(f"the video could not be rendered: {reason}")


def _film(folder: Path) -> None:
    """The process' side: read the order, draw, encode, and print the fraction done."""
    order = json.loads((folder / "order.json").read_text(encoding="utf-8"))
    clips = [Clip(label, Run.load(folder / f"{number}.nc")) for number, label in enumerate(order["labels"])]
    size = (int(order["size"][0]), int(order["size"][1]))
    window = window_of([clip.run for clip in clips], order["fps"], order["playback"])
    with Encoder(Path(order["path"]), size, order["fps"], {"title": " / ".join(order["labels"])}) as encoder:
        for number, frame in enumerate(frames(clips, window, size), start=1):
            encoder.write(frame.tobytes())
            print(f"done {number / len(window.times):.4f}", flush=True)


if __name__ == "__main__":
    try:
        _film(Path(sys.argv[1]))
    except SuspMjError as error:
        print(f"failed {error}")
        raise SystemExit(1) from None
