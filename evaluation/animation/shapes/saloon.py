"""Shapes for pictures of a closed car: a four-door saloon, one curved shell cut into paint, glass, lamps and trim; no
physics uses them.

Lengths are in m; x points forward from the front axle, y to the left, z up from the road in the design position.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from .parts import Surface

_CAP = 0.26
"""How far the nose and the tail are rounded in x."""
_SIDE, _RAIL, _TOP = 8.2, 11.4, 12.2
"""Numbers of the lines that bound the side windows below and above, and the windscreen at its side."""


@dataclass(frozen=True)
class Saloon:
    """Measures that a saloon is drawn for.

    Attributes:
        wheelbase: [m].
        half_width: half of its width [m].
        wheel_radius: height of the wheel centres in the design position [m].
        arch: radius of the wheel arches [m].
        fine: number of stations along the car, and of points around half of it.
    """

    wheelbase: float
    half_width: float
    wheel_radius: float
    arch: float
    fine: tuple[int, int] = (130, 56)

    @property
    def nose(self) -> float:
        """Foremost point [m]."""
        return 0.84

    @property
    def tail(self) -> float:
        """Rearmost point [m]."""
        return -self.wheelbase - 1.06

    def x(self, share: float) -> float:
        """Place between the front axle (0) and the rear axle (1) [m]."""
        return -share * self.wheelbase

    def behind(self, distance: float) -> float:
        """Place behind the front axle by a distance [m], which is for a wheelbase of 3 m and grows with it."""
        return -distance * self.wheelbase / 3.0

    def before(self, distance: float) -> float:
        """Place before the rear axle by a distance [m], which is for a wheelbase of 3 m and grows with it."""
        return (distance / 3.0 - 1.0) * self.wheelbase


def saloon(shape: Saloon) -> dict[str, Surface]:
    """Surfaces of a saloon by material.

    ``paint``, ``glass``, ``trim``, ``gloss``, ``chrome``, ``grille``, ``lamp``, ``lamp_glass``, ``tail``, ``gap``,
    ``plate``, ``liner``.
    """
    shell = _shell(shape)
    parts: dict[str, list[Surface]] = {}

    def take(material: str, chosen: Callable[[_Shell], np.ndarray], frame: tuple[str, float] | None = None) -> None:
        """Cut what `chosen` calls positive out of the shell; a `frame` of a material and a width stands around it."""
        nonlocal shell
        inside, shell = _split(shell, chosen(shell))
        if frame:
            inside, edge = _split(inside, chosen(inside) - frame[1])
            parts.setdefault(frame[0], []).append(edge.surface())
        parts.setdefault(material, []).append(inside.surface())

    for axle in (0.0, -shape.wheelbase):
        _, shell = _split(shell, _arch(shape, shell, axle))
        take("gloss", lambda s, axle=axle: _arch(shape, s, axle) + 0.022)
    take("trim", lambda s: np.minimum(0.265 - s.z, 0.5 - np.abs(s.line - 2.0) * 0.1))
    for material, chosen, frame in [*_windows(shape), *_faces(shape)]:
        take(material, chosen, frame)
    for away, within in _joints(shape):
        gap, shell = _band(shell, away, within)
        parts.setdefault("gap", []).append(gap.surface())
    parts["paint"] = [shell.surface()]
    whole = {material: [_mirrored(each) for each in surfaces] for material, surfaces in parts.items()}
    for material, surface in _extras(shape):
        whole.setdefault(material, []).append(surface)
    return {material: _joined(surfaces) for material, surfaces in whole.items()}


@dataclass(frozen=True)
class _Shell:
    """Left half of a surface: vertices (n, 3), faces (m, 3), normals (n, 3), and the number of the line a vertex lies
    on (n,)."""

    vertices: np.ndarray
    faces: np.ndarray
    normals: np.ndarray
    line: np.ndarray

    @property
    def x(self) -> np.ndarray:
        return self.vertices[:, 0]

    @property
    def y(self) -> np.ndarray:
        return self.vertices[:, 1]

    @property
    def z(self) -> np.ndarray:
        return self.vertices[:, 2]

    def surface(self) -> Surface:
        return Surface(self.vertices, self.faces.astype(np.int32), self.normals)


def _curve(points: Sequence[tuple[float, float]], x: np.ndarray, soft: float = 0.05) -> np.ndarray:
    """Curve through points from the tail to the nose, without overshoot, its corners softened over a length [m]."""
    from scipy.interpolate import PchipInterpolator
    from scipy.ndimage import gaussian_filter1d

    known = np.array(sorted(points))
    grid = np.arange(known[0, 0] - 0.5, known[-1, 0] + 0.5, 0.01)
    raw = PchipInterpolator(known[:, 0], known[:, 1])(np.clip(grid, known[0, 0], known[-1, 0]))
    return np.interp(x, grid, gaussian_filter1d(raw, soft / 0.01, mode="nearest"))


def _shell(shape: Saloon) -> _Shell:
    """The closed left half, from the middle of the underside around to the middle of the roof."""
    count, around = shape.fine
    turn = np.linspace(0.0, np.pi / 2, 14)
    ends = _CAP * (1 - np.cos(turn[::-1]))
    x = np.concatenate(
        [shape.tail + ends, np.linspace(shape.tail + _CAP, shape.nose - _CAP, count)[1:-1], shape.nose - ends]
    )
    x = np.sort(np.unique(np.round(x, 6)))
    lines = _lines(shape, x)
    ring = _smooth(lines, around)
    to_end = np.minimum(x - shape.tail, shape.nose - x) / _CAP
    shrink = np.maximum(1 - (1 - np.clip(to_end, 0.0, 1.0)) ** 3.4, 1e-7) ** (1 / 3.4)
    middle = np.where(x > -shape.wheelbase / 2, 0.47, 0.66)
    y = ring[..., 0] * ((0.15 + 0.85 * shrink) * np.clip(shrink / 0.12, 0.0, 1.0))[:, None]
    z = middle[:, None] + (ring[..., 1] - middle[:, None]) * shrink[:, None]
    ahead, behind = np.clip((x - 0.1) / 0.74, 0, 1) ** 2, np.clip((-shape.wheelbase - 0.2 - x) / 0.86, 0, 1) ** 2
    across = np.abs(y) / shape.half_width
    bowed = x[:, None] - 0.20 * ahead[:, None] * across**2.3 + 0.15 * behind[:, None] * across**2.5
    bowed -= 0.16 * ahead[:, None] * np.clip((z - 0.52) / 0.3, 0, 1) ** 1.8
    bowed += 0.16 * behind[:, None] * np.clip((0.95 - z) / 0.7, 0, 1) ** 1.6
    rows, columns = bowed.shape
    one, other = np.meshgrid(np.arange(rows - 1), np.arange(columns - 1), indexing="ij")
    a = one * columns + other
    quads = np.stack([a, a + 1, a + columns + 1, a + columns], axis=-1).reshape(-1, 4)
    faces = np.concatenate([quads[:, [0, 2, 1]], quads[:, [0, 3, 2]]])
    vertices = np.stack([bowed, y, z], axis=-1).reshape(-1, 3)
    normals = _normals(vertices, faces)
    if float(np.sum(normals[:, 2] * (vertices[:, 2] - 0.6))) < 0:
        faces, normals = faces[:, ::-1], -normals
    normals[vertices[:, 1] < 1e-6, 1] = 0.0
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-12)
    return _Shell(vertices, faces, normals, np.tile(np.linspace(0.0, lines.shape[1] - 1.0, columns), rows))


def _lines(shape: Saloon, x: np.ndarray) -> np.ndarray:
    """(n, k, 2) points (y, z) that the section at each x is drawn around, from the underside to the roof."""
    at, behind, before, rear, wide = shape.x, shape.behind, shape.before, -shape.wheelbase, shape.half_width
    boot = [(shape.tail, 0.95), (rear - 0.80, 1.005), (rear - 0.42, 1.035), (rear - 0.30, 1.05)]
    roof = [
        (before(0.02), 1.185),
        (before(0.36), 1.33),
        (at(0.77), 1.405),
        (at(0.66), 1.445),
        (at(0.55), 1.455),
        (at(0.46), 1.435),
    ]
    screen = [
        (behind(1.27), 1.385),
        (behind(1.08), 1.30),
        (behind(0.80), 1.135),
        (behind(0.50), 0.965),
        (behind(0.36), 0.945),
    ]
    bonnet = [(0.0, 0.90), (0.40, 0.83), (0.64, 0.765), (shape.nose, 0.69)]
    top = _curve([*boot, *roof, *screen, *bonnet], x, 0.035)
    waist = [(shape.tail, 0.93), (rear - 0.5, 0.965), (rear, 0.95), (at(0.6), 0.925), (behind(0.7), 0.90), (0.0, 0.845)]
    belt = _curve([*waist, (0.5, 0.745), (shape.nose, 0.64)], x, 0.08)
    low = _curve(
        [(shape.tail, 0.30), (rear - 0.6, 0.21), (rear, 0.175), (0.0, 0.175), (0.5, 0.19), (shape.nose, 0.24)], x
    )
    slim = [
        (shape.tail, 0.82),
        (rear - 0.7, 0.92),
        (rear - 0.2, 0.985),
        (before(0.5), 1.0),
        (behind(0.8), 1.0),
        (0.0, 0.985),
    ]
    half = wide * _curve([*slim, (0.45, 0.92), (shape.nose, 0.78)], x, 0.08)
    glass = [
        (before(0.02), 0.45),
        (before(0.36), 0.85),
        (at(0.72), 1.0),
        (behind(1.40), 1.0),
        (behind(1.08), 0.80),
        (behind(0.8), 0.42),
    ]
    cabin = _curve(
        [(rear - 0.45, 0.0), (rear - 0.32, 0.02), *glass, (behind(0.52), 0.03), (behind(0.40), 0.0)], x, 0.03
    )
    cabin = np.where((x < behind(0.36)) & (x > rear - 0.5), cabin, 0.0)
    rail_y = half * 0.86 + cabin * (0.655 * wide - half * 0.86)
    rail_z = top - 0.062 * cabin - (1 - cabin) * 0.03

    def mixed(one: np.ndarray, other: np.ndarray) -> np.ndarray:
        return one + cabin * (other - one)

    deck = belt + 0.55 * (top - belt)
    rows = [
        (0 * x, low),
        (0.6 * half, low),
        (0.90 * half, low + 0.008),
        (0.962 * half, low + 0.07),
        (0.978 * half, low + 0.20),
        (1.0 * half, 0.48 * (low + belt)),
        (1.0 * half, belt - 0.15),
        (0.985 * half, belt - 0.035),
        (mixed(0.945 * half, 0.955 * half), belt),
        (mixed(0.92 * half, 0.925 * half), mixed(belt + 0.25 * (deck - belt), belt + 0.03)),
        (mixed(0.86 * half, 0.5 * (0.925 * half + rail_y)), mixed(deck, 0.5 * (belt + 0.03 + rail_z))),
        (mixed(0.78 * half, rail_y + 0.018), mixed(belt + 0.78 * (top - belt), rail_z - 0.035)),
        (mixed(0.66 * half, rail_y - 0.035), mixed(belt + 0.89 * (top - belt), rail_z + 0.022)),
        (mixed(0.45 * half, 0.70 * rail_y), mixed(belt + 0.97 * (top - belt), rail_z + 0.70 * (top - rail_z))),
        (mixed(0.20 * half, 0.34 * rail_y), top - 0.002),
        (0 * x, top),
    ]
    return np.stack([np.stack(np.broadcast_arrays(y, z), axis=-1) for y, z in rows], axis=1)


def _smooth(lines: np.ndarray, around: int) -> np.ndarray:
    """(n, around, 2) points of the quadratic B-spline of each section."""
    from scipy.interpolate import BSpline

    count = lines.shape[1]
    knots = np.concatenate([[0.0, 0.0], np.linspace(0.0, 1.0, count - 1), [1.0, 1.0]])
    return np.moveaxis(BSpline(knots, np.moveaxis(lines, 1, 0), 2)(np.linspace(0.0, 1.0, around)), 0, 1)


def _arch(shape: Saloon, shell: _Shell, axle: float) -> np.ndarray:
    """Positive inside a wheel arch."""
    away = np.hypot(
        shell.x - axle,
        np.maximum(shell.z - shape.wheel_radius, -0.4) * np.where(shell.z < shape.wheel_radius, 0.35, 1.0),
    )
    return np.minimum(shape.arch - away, shell.y - 0.42 * shape.half_width)


def _rounded(radius: float, *sides: np.ndarray) -> np.ndarray:
    """Smallest of several distances, its corners rounded: positive inside all."""
    least = sides[0]
    for side in sides[1:]:
        share = np.clip(0.5 + 0.5 * (side - least) / radius, 0.0, 1.0)
        least = side * (1 - share) + least * share - radius * share * (1 - share)
    return least


_Field = Callable[[_Shell], np.ndarray]
_Opening = tuple[str, _Field, tuple[str, float] | None]


def _windows(shape: Saloon) -> list[_Opening]:
    """Windows and the pillars between them: material, where, and what frames it."""
    before, behind, pillar = shape.before, shape.behind, shape.x(0.535)

    def windscreen(s: _Shell) -> np.ndarray:
        bow = 0.10 * (s.y / 0.6) ** 2
        return _rounded(
            0.05, 0.10 * (s.line - _TOP), behind(0.50) - bow - s.x, s.x - behind(1.26) + 0.5 * bow, s.z - 0.9
        )

    def backlight(s: _Shell) -> np.ndarray:
        bow = 0.06 * (s.y / 0.6) ** 2
        return _rounded(
            0.05, 0.10 * (s.line - _TOP), before(0.40) - bow - s.x, s.x + shape.wheelbase + 0.28 - bow, s.z - 0.9
        )

    def side_window(s: _Shell) -> np.ndarray:
        ahead = (behind(0.60) - s.x) * 0.54 - (s.z - 0.93) * 0.84 + 0.03
        back = (s.x - before(-0.02)) * 0.56 - (s.z - 0.95) * 0.83 - 0.10
        return _rounded(0.03, 0.07 * (s.line - _SIDE), 0.07 * (_RAIL - s.line), ahead, back, s.y - 0.3)

    def pillars(s: _Shell) -> np.ndarray:
        slant = 0.10 * (s.z - 1.15)
        either = np.maximum(0.045 - np.abs(s.x - pillar + slant), 0.016 - np.abs(s.x - before(0.42) + slant))
        return np.minimum(either, side_window(s) + 0.003)

    return [
        ("gloss", pillars, None),
        ("glass", side_window, ("chrome", 0.012)),
        ("glass", windscreen, ("gloss", 0.022)),
        ("glass", backlight, ("gloss", 0.022)),
    ]


def _faces(shape: Saloon) -> list[_Opening]:
    """Lamps, grille and bumpers: material, where, and what frames it."""
    rear, wide = -shape.wheelbase, shape.half_width

    def headlamp(s: _Shell) -> np.ndarray:
        up = 0.10 * (s.y - 0.45 * wide)
        return _rounded(0.03, s.z - 0.565 - up, 0.665 + up - s.z, s.y - 0.50 * wide, s.x - 0.36)

    def bulb(s: _Shell) -> np.ndarray:
        away = [
            0.036 - np.hypot(s.y - share * wide, s.z - 0.615 - 0.10 * (share - 0.45) * wide) for share in (0.62, 0.75)
        ]
        return np.minimum(np.maximum(*away), s.x - 0.4)

    def grille(s: _Shell) -> np.ndarray:
        return _rounded(0.04, 0.36 * wide + 0.15 * (s.z - 0.5) - s.y, s.z - 0.455, 0.645 - s.z, s.x - 0.4)

    def intake(s: _Shell) -> np.ndarray:
        return _rounded(0.03, 0.70 * wide - s.y, s.z - 0.275, 0.355 - s.z, s.x - 0.4)

    def tail_lamp(s: _Shell) -> np.ndarray:
        return _rounded(0.03, s.z - 0.725, 0.865 - s.z, s.y - 0.42 * wide, rear - 0.70 - s.x)

    def bumper(s: _Shell) -> np.ndarray:
        return _rounded(0.05, 0.42 - s.z, rear - 0.55 - s.x, 0.75 * wide - s.y)

    return [
        ("lamp", bulb, None),
        ("lamp_glass", headlamp, ("gloss", 0.008)),
        ("grille", grille, ("chrome", 0.018)),
        ("grille", intake, None),
        ("tail", tail_lamp, ("gloss", 0.006)),
        ("trim", bumper, None),
    ]


def _joints(shape: Saloon) -> list[tuple[_Field, _Field]]:
    """Joints of doors, bonnet and boot lid: distance from the joint, and where it runs (positive)."""
    rear, pillar, split = -shape.wheelbase, shape.x(0.535), 0.72
    high = shape.wheel_radius

    def side(s: _Shell) -> np.ndarray:
        return np.minimum(8.6 - s.line, s.z - 0.30)

    def lids(s: _Shell) -> np.ndarray:
        return s.line - 10.6

    edge = (
        rear + float(np.sqrt((shape.arch + 0.05) ** 2 - (split - high) ** 2))
        if shape.arch + 0.05 > split - high
        else rear
    )
    return [
        (lambda s: s.x - shape.behind(0.62) - 0.12 * (s.z - 0.6), side),
        (lambda s: s.x - pillar, side),
        (lambda s: s.x - edge - 0.30 * (s.z - split), lambda s: np.minimum(side(s), s.z - split)),
        (
            lambda s: np.hypot(s.x - rear, s.z - high) - shape.arch - 0.05,
            lambda s: np.minimum.reduce([side(s), s.x - rear, split - s.z]),
        ),
        (
            lambda s: s.z - 0.30,
            lambda s: np.minimum.reduce([shape.behind(0.58) - s.x, s.x - rear - shape.arch - 0.05, 6.0 - s.line]),
        ),
        (lambda s: 0.07 * (s.line - 10.7), lambda s: np.minimum(s.x - shape.behind(0.52), 0.52 - s.x)),
        (lambda s: s.x - 0.54 + 0.22 * (s.y / 0.8) ** 2, lambda s: np.minimum(lids(s), s.x)),
        (lambda s: 0.07 * (s.line - 10.7), lambda s: np.minimum(rear - 0.42 - s.x, s.x - rear + 0.93)),
    ]


def _band(shell: _Shell, away: _Field, within: _Field) -> tuple[_Shell, _Shell]:
    """What lies within 5 mm of the zero line of `away`, and the rest: edge by edge, for the band is narrower than a
    face."""
    beyond, before = _split(shell, away(shell) - 0.005)
    band, before = _split(before, away(before) + 0.005)
    chosen, other = _split(band, within(band))
    return chosen, _together([beyond, before, other])


def _together(shells: Sequence[_Shell]) -> _Shell:
    """Several shells as one."""
    starts = np.cumsum([0, *(len(each.vertices) for each in shells)])
    return _Shell(
        np.concatenate([each.vertices for each in shells]),
        np.concatenate([each.faces + start for each, start in zip(shells, starts, strict=False)]),
        np.concatenate([each.normals for each in shells]),
        np.concatenate([each.line for each in shells]),
    )


def _extras(shape: Saloon) -> list[tuple[str, Surface]]:
    """Mirrors, door handles, number plates, and the dark insides of the wheel arches."""
    rear, wide = -shape.wheelbase, shape.half_width
    extras = []
    for side in (1.0, -1.0):
        extras.append(("paint", _blob((0.075, 0.105, 0.06), (shape.behind(0.86), side * (wide + 0.06), 1.0))))
        extras.append(("gloss", _blob((0.035, 0.07, 0.018), (shape.behind(0.84), side * (wide - 0.02), 0.955))))
        for share in (0.44, 0.80):
            extras.append(("chrome", _blob((0.09, 0.014, 0.014), (shape.x(share), side * (wide - 0.005), 0.80))))
        for axle in (0.0, rear):
            extras.append(("liner", _wheelhouse(shape, axle, side)))
    extras.append(("plate", _blob((0.012, 0.25, 0.05), (shape.nose - 0.008, 0.0, 0.39), 0.25)))
    extras.append(("plate", _blob((0.012, 0.26, 0.055), (shape.tail + 0.02, 0.0, 0.66), 0.25)))
    return extras


def _blob(half: tuple[float, float, float], centre: tuple[float, float, float], exponent: float = 0.7) -> Surface:
    """Superellipsoid: a rounded lump with half axes about a centre; a small exponent makes it a box."""
    around, up = np.meshgrid(np.linspace(-np.pi, np.pi, 25), np.linspace(-np.pi / 2, np.pi / 2, 13), indexing="ij")

    def power(value: np.ndarray) -> np.ndarray:
        return np.sign(value) * np.abs(value) ** exponent

    unit = np.stack(
        [power(np.cos(up)) * power(np.cos(around)), power(np.cos(up)) * power(np.sin(around)), power(np.sin(up))],
        axis=-1,
    )
    vertices = (unit * half + centre).reshape(-1, 3)
    one, other = np.meshgrid(np.arange(24), np.arange(12), indexing="ij")
    a = one * 13 + other
    faces = np.stack([a, a + 13, a + 14, a, a + 14, a + 1], axis=-1).reshape(-1, 3)
    normals = unit.reshape(-1, 3) / np.array(half)
    return Surface(
        vertices, faces.astype(np.int32), normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-9)
    )


def _wheelhouse(shape: Saloon, axle: float, side: float) -> Surface:
    """Inside of a wheel arch: half a drum, open downwards and outwards, seen from within."""
    radius, inner, outer = shape.arch + 0.02, 0.46 * shape.half_width, 0.985 * shape.half_width
    turn = np.linspace(-0.35, np.pi + 0.35, 33)
    ring = np.column_stack([axle + radius * np.cos(turn), np.zeros(33), shape.wheel_radius + radius * np.sin(turn)])
    across, hub = np.array([0.0, side, 0.0]), np.array([[axle, side * inner, shape.wheel_radius]])
    drum = np.concatenate([ring + inner * across, ring + outer * across, hub])
    one = np.arange(32)
    walls = np.concatenate([np.column_stack([one, one + 1, one + 34]), np.column_stack([one, one + 34, one + 33])])
    faces = np.concatenate([walls, np.column_stack([one + 1, one, np.full(32, 66)])])
    inward = _normals(drum, faces)
    if float(inward[66, 1]) * side < 0:
        faces, inward = faces[:, ::-1], -inward
    return Surface(drum, faces.astype(np.int32), inward)


def _split(shell: _Shell, chosen: np.ndarray) -> tuple[_Shell, _Shell]:
    """The part of a shell where `chosen` is positive and the rest, cut along its zero line."""
    positive = chosen > 0
    inside = positive[shell.faces].sum(axis=1)
    crossed = shell.faces[(inside > 0) & (inside < 3)]
    lone = positive[crossed]
    lone = np.where((lone.sum(axis=1) == 1)[:, None], lone, ~lone).argmax(axis=1)
    rows = np.arange(len(crossed))
    a, b, c = (crossed[rows, (lone + k) % 3] for k in range(3))
    edges, place = np.unique(
        np.sort(np.concatenate([np.column_stack([a, b]), np.column_stack([a, c])]), axis=1), axis=0, return_inverse=True
    )
    place = np.reshape(place, -1) + len(shell.vertices)
    start, end = edges[:, 0], edges[:, 1]
    share = (chosen[start] / (chosen[start] - chosen[end]))[:, None]

    def extended(values: np.ndarray) -> np.ndarray:
        column = values.reshape(len(values), -1)
        return np.concatenate([column, (1 - share) * column[start] + share * column[end]]).reshape(
            -1, *values.shape[1:]
        )

    normals = extended(shell.normals)
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-12)
    cut = _Shell(extended(shell.vertices), shell.faces, normals, extended(shell.line))
    ab, ac = place[: len(crossed)], place[len(crossed) :]
    tips = np.column_stack([a, ab, ac])
    stumps = np.concatenate([np.column_stack([ab, b, c]), np.column_stack([ab, c, ac])])
    tip_in = positive[a]
    stump_in = np.concatenate([tip_in, tip_in])
    kept = np.concatenate([shell.faces[inside == 3], tips[tip_in], stumps[~stump_in]])
    rest = np.concatenate([shell.faces[inside == 0], tips[~tip_in], stumps[stump_in]])
    return _used(cut, kept), _used(cut, rest)


def _used(shell: _Shell, faces: np.ndarray) -> _Shell:
    """Some faces of a shell with only the vertices that they use."""
    used, numbers = np.unique(faces, return_inverse=True)
    return _Shell(shell.vertices[used], np.reshape(numbers, faces.shape), shell.normals[used], shell.line[used])


def _normals(vertices: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """(n, 3) unit normals at the vertices, the faces around weighted by their area."""
    corners = vertices[faces]
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals = np.zeros_like(vertices)
    for corner in range(3):
        np.add.at(normals, faces[:, corner], across)
    return normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-12)


def _mirrored(surface: Surface) -> Surface:
    """A left half with its right half."""
    assert surface.normals is not None
    flip = np.array([1.0, -1.0, 1.0])
    return _joined(
        [
            surface,
            replace(
                surface, vertices=surface.vertices * flip, faces=surface.faces[:, ::-1], normals=surface.normals * flip
            ),
        ]
    )


def _joined(parts: Sequence[Surface]) -> Surface:
    """Several surfaces with normals as one."""
    starts = np.cumsum([0, *(len(part.vertices) for part in parts)])
    normals = [part.normals for part in parts if part.normals is not None]
    faces = [part.faces + start for part, start in zip(parts, starts, strict=False)]
    return Surface(
        np.concatenate([part.vertices for part in parts]),
        np.concatenate(faces).astype(np.int32),
        np.concatenate(normals),
    )
