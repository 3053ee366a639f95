"""The proving ground: asphalt with a grid, lane or circle, and what the manoeuvre puts on it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from susp_mj.features import Bump, Circle, Cones, Course, CrossSlope, Feature, Gust, Patch
from susp_mj.names import channel_name
from susp_mj.run import Run

from ..clip import features_of
from ..picture import Picture, studio, sunlight
from ..shapes import ground
from .pose import Motion, side_of

TILE = 10.0
"""Spacing of the grid on the asphalt [m]."""
LANE = 3.5
"""Width of the drawn lane [m]."""
_LINE, _PAINT = 0.12, 0.006
_EDGE = 0.75
_FLAT, _SHORT = 1e-3, 12.0
_HILLS = 300.0


def surroundings(picture: Picture, size: tuple[int, int], samples: int) -> None:
    """Sky, sun over the car as the body `sun`, haze, and hills around it as the body `hills`."""
    studio(picture, size, extent=5.0, samples=samples, sun=False)
    look = picture.spec.visual
    look.map.znear, look.map.zfar = 0.12, 140.0
    look.map.fogstart, look.map.fogend = 14.0, 90.0
    look.headlight.ambient, look.headlight.diffuse = [0.40] * 3, [0.30] * 3
    look.quality.numslices, look.quality.numstacks = 20, 8
    sunlight(picture.posed("sun"), 12.0)
    around = picture.posed("hills")
    picture.material("far_hills", (0.56, 0.65, 0.66), 0.0, 0.0)
    picture.material("near_hills", (0.42, 0.54, 0.44), 0.0, 0.0)
    far = ground.hills(_HILLS, 6.0, 24.0, ((5, 0.45, 0.4), (11, 0.30, 1.9), (23, 0.20, 0.7)))
    near = ground.hills(0.8 * _HILLS, 2.0, 8.0, ((7, 0.5, 2.2), (17, 0.3, 0.1), (41, 0.2, 1.1)))
    picture.mesh(around, "far_hills", far, "far_hills")
    picture.mesh(around, "near_hills", near, "near_hills")


def proving_ground(picture: Picture, motions: Sequence[Motion]) -> None:
    """Asphalt, markings and features under the cars; the features of the first run count."""
    leader = motions[0].run
    features = features_of(leader)
    slope = cross_slope(leader)
    uneven = _unevenness(leader, slope)
    base = picture.spec.worldbody.add_body(name="ground")
    base.quat = [np.cos(np.arctan(slope) / 2), np.sin(np.arctan(slope) / 2), 0, 0]
    _asphalt(picture, base, motions, min(0.0, uneven[0]) - (0.01 if uneven[1] > _FLAT else 0.0))
    for name, tone in (
        ("white", (0.93, 0.93, 0.91)),
        ("yellow", (0.93, 0.74, 0.16)),
        ("orange", (0.93, 0.36, 0.06)),
        ("wet", (0.34, 0.50, 0.66, 0.80)),
        ("ice", (0.70, 0.86, 0.95, 0.85)),
        ("gust", (0.25, 0.66, 0.80, 0.22)),
        ("wind", (0.15, 0.60, 0.78, 0.85)),
    ):
        picture.material(name, tone, 0.1, 0.1)
    _course(picture, base, motions, features)
    for number, feature in enumerate(features):
        draw = _DRAWN.get(type(feature))
        if draw:
            draw(picture, base, f"feature{number}", feature, leader)
    if max(motion.travelled() for motion in motions) > 1.0 and uneven[1] > _FLAT:
        for number, motion in enumerate(motions):
            _tracks(picture, motion, f"track{number}", min(0.0, uneven[0]) - 0.05)


def cross_slope(run: Run) -> float:
    """Rise of the ground per metre to the left."""
    return next((feature.slope for feature in features_of(run) if isinstance(feature, CrossSlope)), 0.0)


def add_plates(picture: Picture, motion: Motion) -> None:
    """Bodies `<station>_plate`: a plate under each wheel of a car that stands on a rig."""
    for station in motion.chassis.centres:
        plate = picture.posed(f"{station}_plate")
        picture.shape(plate, "box", (0.30, 0.20, 0.012), "steel", (0, 0, -0.012))
        picture.shape(plate, "cylinder", (0.05, 0.15), "chrome", (0, 0, -0.16))


def _unevenness(run: Run, slope: float) -> tuple[float, float]:
    """Lowest road height under a wheel, and largest departure from the sloping plane [m]."""
    heights = run.stations("road_height")
    if not heights:
        return 0.0, 0.0
    lowest, largest = 0.0, 0.0
    motion = Motion(run)
    places = {station: wheel_path(motion, station) for station in heights}
    for station, height in heights.items():
        rest = height - slope * places[station][:, 1]
        lowest, largest = min(lowest, float(rest.min())), max(largest, float(np.abs(rest).max()))
    return lowest, largest


def wheel_path(motion: Motion, station: str) -> np.ndarray:
    """(n, 2) places of a wheel over the ground, the body taken as level [m]."""
    run, chassis = motion.run, motion.chassis
    x, y = (chassis.centres[station] - chassis.cg)[:2]
    cos, sin = np.cos(run["yaw_angle"]), np.sin(run["yaw_angle"])
    return np.column_stack([run["position_x"] + x * cos - y * sin, run["position_y"] + x * sin + y * cos])


def _asphalt(picture: Picture, base: Any, motions: Sequence[Motion], height: float) -> None:
    """One large plane under all of the motion; its grid stays where it is."""
    import mujoco

    places = np.concatenate([np.column_stack([m.run["position_x"], m.run["position_y"]]) for m in motions])
    middle = np.round((places.max(axis=0) + places.min(axis=0)) / 2 / TILE) * TILE
    half = np.ceil((float(np.ptp(places, axis=0).max()) / 2 + 1.3 * _HILLS) / TILE) * TILE
    texture = picture.spec.add_texture(
        name="asphalt_tile", type=mujoco.mjtTexture.mjTEXTURE_2D, width=1024, height=1024, nchannel=3
    )
    texture.data = _tile(1024).tobytes()
    material = picture.spec.add_material(name="ground", rgba=[1, 1, 1, 1], specular=0.0, shininess=0.0, reflectance=0.0)
    material.textures[mujoco.mjtTextureRole.mjTEXROLE_RGB] = "asphalt_tile"
    material.texrepeat, material.texuniform = [1 / TILE, 1 / TILE], True
    picture.shape(base, "plane", (half, half, 20.0), "ground", (middle[0], middle[1], height))


def _tile(count: int) -> np.ndarray:
    """(count, count, 3) asphalt with grid lines at its edges, seamless."""
    noise = np.random.default_rng(5).standard_normal((count, count))
    wave = np.hypot(*np.meshgrid(np.fft.fftfreq(count), np.fft.fftfreq(count)))
    grain = sum(
        weight * layer / layer.std()
        for weight, scale in ((0.010, 60.0), (0.014, 9.0), (0.024, 1.2))
        for layer in [np.fft.ifft2(np.fft.fft2(noise) * np.exp(-((wave * scale) ** 2))).real]
    )
    tone = 0.52 + grain
    place = np.arange(count)
    for spacing, light in ((count, 0.13), (count // 2, 0.05)):
        near = np.minimum(place % spacing, spacing - place % spacing)
        line = np.clip(4.5 - near, 0.0, 1.0) * light
        tone = np.maximum(tone, tone + np.maximum(line[:, None], line[None, :]))
    return (np.clip(tone[..., None] * [0.985, 1.0, 1.025], 0, 1) * 255).astype(np.uint8)


def _course(picture: Picture, base: Any, motions: Sequence[Motion], features: Sequence[Feature]) -> None:
    """The lane along the x axis or along the path to be kept, or the circle to be driven."""
    path = next((feature for feature in features if isinstance(feature, Course | Circle)), None)
    if isinstance(path, Circle):
        radius = path.radius
        rings = [
            ground.strip(ground.circle(0.0, radius, abs(radius) + off), _LINE, _PAINT) for off in (-LANE / 2, LANE / 2)
        ]
        picture.mesh(base, "lane", ground.together(rings), "white")
        middle = ground.dashes(ground.circle(0.0, radius, abs(radius), 361), 0.10, _PAINT, 1.0, 2.0)
        picture.mesh(base, "middle", ground.together(middle), "yellow")
        return
    start = min(float(m.run["position_x"].min()) for m in motions) - 60.0
    end = max(float(m.run["position_x"].max()) for m in motions) + 160.0
    straight = np.array([[np.floor(start / 9.0) * 9.0, 0.0], [end, 0.0]])
    edges = [ground.strip(straight, _LINE, _PAINT, side * LANE / 2) for side in (-1.0, 1.0)]
    wide = max(float(np.abs(m.run["position_y"]).max()) for m in motions) > 3 * LANE
    far = (
        []
        if wide
        else [
            sheet
            for side in (-1.0, 1.0)
            for sheet in ground.dashes(straight, _LINE, _PAINT, 3.0, 6.0, side * 1.5 * LANE)
        ]
    )
    gate = ground.plate((-0.12, 0.12), (-LANE / 2, LANE / 2), _PAINT + 0.001)
    picture.mesh(base, "lane", ground.together([*edges, *far, gate]), "white")
    if path is not None:
        points = np.column_stack([path.x, path.y])
        grid = np.linspace(points[0, 0], points[-1, 0], max(int(np.ptp(points[:, 0])), 2))
        points = np.column_stack([grid, np.interp(grid, points[:, 0], points[:, 1])])
        picture.mesh(base, "path", ground.together(ground.dashes(points, 0.10, _PAINT + 0.003, 0.8, 1.2)), "yellow")


def _tracks(picture: Picture, motion: Motion, name: str, bottom: float) -> None:
    """The uneven road where the wheels roll over it: one strip a side, as high as its front wheel says."""
    run, half = motion.run, motion.chassis.half_track
    for station in [each for each in motion.chassis.centres if each[0] == "f"]:
        points, height = wheel_path(motion, station), run[channel_name(station, "road_height")]
        kept = _spaced(points, 0.05)
        side = side_of(station)
        lead = points[kept[-1]] + (points[kept[-1]] - points[kept[-2]]) / 0.05 * np.linspace(0.5, 60.0, 20)[:, None]
        line = np.concatenate([points[kept], lead])
        high = np.concatenate([height[kept], np.full(20, height[kept[-1]])]) + 0.002
        sheet = ground.strip(line, half + _EDGE, high, side * (_EDGE - half) / 2, bottom=bottom)
        picture.mesh(picture.spec.worldbody, f"{name}_{station}", sheet, "asphalt")
        raised = np.flatnonzero(np.abs(high - high[0]) > _FLAT)
        if len(raised) > 1 and np.linalg.norm(line[raised[-1]] - line[raised[0]]) < _SHORT:
            part = slice(int(raised[0]), int(raised[-1]) + 1)
            bump = ground.strip(
                line[part], half + _EDGE + 0.004, high[part] + 0.003, side * (_EDGE - half) / 2, bottom=bottom
            )
            picture.mesh(picture.spec.worldbody, f"{name}_{station}_bump", bump, "bump")


def _spaced(points: np.ndarray, least: float) -> np.ndarray:
    """Indices of points that lie at least a distance [m] apart along the way."""
    distance = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
    _, first = np.unique(np.floor(distance / least), return_index=True)
    return first


def _bump(picture: Picture, base: Any, name: str, bump: Bump, run: Run) -> None:
    """Yellow lines across the road where a bump begins and ends; its shape is the road's."""
    x, y = bump.x, bump.y or (-LANE / 2, LANE / 2)
    lines = [ground.plate((at - 0.06, at + 0.06), y, _PAINT + 0.004) for at in (x[0] - 0.06, x[1] + 0.06)]
    picture.mesh(base, name, ground.together(lines), "yellow")


def _patch(picture: Picture, base: Any, name: str, patch: Patch, run: Run) -> None:
    """A slippery or wet stretch: lighter the more slippery."""
    x, y = _bounded(patch.x, run["position_x"]), _bounded(patch.y, run["position_y"])
    picture.mesh(base, name, ground.plate(x, y, 0.003), "ice" if patch.friction < 0.45 else "wet")
    picture.mesh(base, f"{name}_edge", ground.together(ground.frame(x, y, 0.08, _PAINT - 0.002)), "white")


def _bounded(span: tuple[float, float], places: np.ndarray) -> tuple[float, float]:
    """A span cut to what the video can show of it [m]."""
    return max(span[0], float(places.min()) - 200.0), min(span[1], float(places.max()) + 200.0)


def _cones(picture: Picture, base: Any, name: str, cones: Cones, run: Run) -> None:
    """Traffic cones at the places given."""
    picture.asset(f"{name}_cone", ground.cone())
    picture.asset(f"{name}_band", ground.cone_band())
    for x, y in cones.points:
        picture.copy(base, f"{name}_cone", "orange", (x, y, 0.0))
        picture.copy(base, f"{name}_band", "white", (x, y, 0.0))
        picture.shape(base, "box", (0.17, 0.17, 0.015), "orange", (x, y, 0.015))


def _gust(picture: Picture, base: Any, name: str, gust: Gust, run: Run) -> None:
    """Zone of the side wind, with arrows that point with it."""
    x, y = gust.x, (-LANE, LANE)
    if x[1] - x[0] < 0.5:
        return
    picture.mesh(base, name, ground.plate(x, y, 0.003), "gust")
    arrows = []
    wing = 0.55 if gust.wind >= 0 else -0.55
    for at in np.arange(x[0] + 1.5, x[1] - 0.5, 3.0):
        for y_tip in (-0.75 * LANE, 0.75 * LANE):
            lines = (
                [(at - 0.5, y_tip - wing), (at, y_tip)],
                [(at, y_tip), (at + 0.5, y_tip - wing)],
                [(at, y_tip - 2 * wing), (at, y_tip)],
            )
            arrows += [ground.strip(np.array(line), 0.13, _PAINT + 0.002 * number) for number, line in enumerate(lines)]
    if arrows:
        picture.mesh(base, f"{name}_arrows", ground.together(arrows), "wind")


_DRAWN: dict[type[Feature], Callable[..., None]] = {Bump: _bump, Patch: _patch, Cones: _cones, Gust: _gust}
"""What is laid on the ground for a feature; the others are the road's shape, or the course."""
