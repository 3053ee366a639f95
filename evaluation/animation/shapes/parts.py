"""Shapes for pictures: tyre, rim, coil, bodywork and road as triangle meshes; no physics uses them.

Lengths are in m; x points forward, y to the left, z up. Wheels turn about y and show their outer face to negative y.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    import trimesh

RIM_RADIUS = 0.225
WHEEL_WIDTH = 0.22
_SECTIONS = 96


@dataclass(frozen=True)
class Surface:
    """A triangle mesh.

    Attributes:
        vertices: (n, 3) [m].
        faces: (m, 3) vertex numbers, anticlockwise seen from outside.
        normals: (n, 3) unit vectors, or None to have them made from the faces.
    """

    vertices: np.ndarray
    faces: np.ndarray
    normals: np.ndarray | None = None


Profile = Sequence[tuple[float, float]]
"""Closed outline of a body of revolution: (radius, distance along the axis) [m]."""


def tyre(radius: float, sections: int = _SECTIONS) -> Surface:
    """Tyre of an unloaded `radius` [m] with rounded shoulders and three grooves, of so many `sections` around."""
    half = WHEEL_WIDTH / 2
    bead = RIM_RADIUS - 0.006
    side = bead + 0.55 * (radius - bead)
    outer = [
        (bead, 0.84 * half),
        (bead + 0.012, 0.92 * half),
        (side, half),
        (radius - 0.032, 0.98 * half),
        (radius - 0.012, 0.9 * half),
    ]
    shoulder = [(radius - 0.003, 0.8 * half), (radius, 0.68 * half)]
    tread = [(radius - depth, place + edge) for place in (0.045, 0.0, -0.045) for edge, depth in _groove()]
    left = [*outer, *shoulder]
    right = [(r, -w) for r, w in reversed(left)]
    return surface_of(_revolved([*left, *tread, *right], sections=sections))


def sidewall_marks(radius: float, count: int = 3) -> Surface:
    """Light arcs on both sidewalls of a tyre of `radius` [m], so that one sees it turn."""
    import trimesh

    half = WHEEL_WIDTH / 2
    middle = RIM_RADIUS + 0.50 * (radius - RIM_RADIUS)
    parts = []
    for side in (-1.0, 1.0):
        outline = [
            (middle - 0.007, side * (half - 0.004)),
            (middle - 0.007, side * (half + 0.0025)),
            (middle + 0.007, side * (half + 0.0025)),
        ]
        outline.append((middle + 0.007, side * (half - 0.004)))
        for k in range(count):
            arc = _revolved(outline if side < 0 else outline[::-1], angle=0.42)
            arc.apply_transform(trimesh.transformations.rotation_matrix(2 * np.pi * k / count, [0, 1, 0]))
            parts.append(arc)
    return joined(parts)


def rim(spokes: int = 5, sections: int = _SECTIONS) -> Surface:
    """Light-alloy rim: barrel with lips, split spokes and hub."""
    import trimesh

    half = 0.84 * WHEEL_WIDTH / 2
    lip, wall = RIM_RADIUS, 0.011
    barrel = [
        (lip, -half - 0.004),
        (lip, -half + 0.006),
        (lip - 0.014, -half + 0.02),
        (lip - 0.016, half - 0.02),
        (lip, half - 0.004),
        (lip, half),
    ]
    inside = [(r - wall, w) for r, w in reversed(barrel)]
    parts = [
        _revolved([*barrel, *inside], sections=sections),
        _revolved([(0.0, -0.075), (0.0, 0.0), (0.062, 0.0), (0.068, -0.06), (0.06, -0.072), (0.03, -0.075)]),
    ]
    for k in range(spokes):
        turn = trimesh.transformations.rotation_matrix(2 * np.pi * k / spokes, [0, 1, 0])
        for lean in (-1.0, 1.0):
            spoke = _spoke(lean)
            spoke.apply_transform(turn)
            parts.append(spoke)
    return joined(parts)


def wheel_bolts(count: int = 5) -> Surface:
    """Hub cap and wheel bolts on the outer face."""
    parts = [_revolved([(0.0, -0.082), (0.0, -0.07), (0.026, -0.07), (0.024, -0.08)], sections=32)]
    for k in range(count):
        bolt = _revolved([(0.0, -0.078), (0.0, -0.07), (0.008, -0.07), (0.008, -0.078)], sections=12)
        angle = 2 * np.pi * (k + 0.5) / count
        bolt.apply_translation([0.045 * np.cos(angle), 0.0, 0.045 * np.sin(angle)])
        parts.append(bolt)
    return joined(parts)


def brake_disc(sections: int = _SECTIONS) -> Surface:
    """Brake disc with its bell, behind the spokes."""
    outer, inner = 0.168, 0.085
    return surface_of(_revolved([(inner, 0.005), (outer, 0.005), (outer, 0.030), (inner, 0.030)], sections=sections))


def coil(length: float, radius: float, wire: float, turns: float = 6.0) -> Surface:
    """Coil spring along z from 0 to `length` [m], its ends wound flat.

    Args:
        length: free height of the picture's coil [m].
        radius: of the helix [m].
        wire: radius of the wire [m].
        turns: windings, the flat end windings of 3/4 included.
    """
    angle = np.linspace(0.0, 2 * np.pi * turns, int(28 * turns))
    climb = np.clip((angle / (2 * np.pi) - 0.6) / (turns - 1.2), 0.0, 1.0)
    climb = 0.9 * climb + 0.1 * climb**2 * (3 - 2 * climb)
    centre = np.column_stack([radius * np.cos(angle), radius * np.sin(angle), wire + climb * (length - 2 * wire)])
    return surface_of(tube(centre, wire, 12))


def slab(x: np.ndarray, low: np.ndarray, high: np.ndarray, *, near: float, far: float, rounding: float) -> Surface:
    """Bodywork between a lower and an upper outline, its edges rounded.

    Args:
        x: (n,) stations, rising; two equal ones make a vertical wall [m].
        low, high: (n,) heights of the outlines [m], low < high.
        near, far: sides in y [m].
        rounding: radius of the edges [m].
    """
    rings = []
    for station, bottom, top in zip(x, low, high, strict=True):
        rings.append([(station, y, z) for y, z in _rounded_rectangle(near, far, bottom, top, rounding)])
    shrunk = [_inset(ring, rounding, direction) for ring, direction in ((rings[0], -1.0), (rings[-1], 1.0))]
    return surface_of(loft(np.array([*shrunk[0][::-1], *rings, *shrunk[1]])))


def fender(*, length: float, sill: float, top: float, arch: float, slot: float, near: float, far: float) -> Surface:
    """Outer skin of a corner of a car: an arch about the wheel, open upwards for the strut.

    Args:
        length: from end to end [m], the wheel at the middle.
        sill, top: heights of the lower edge and the upper edge above the wheel centre [m].
        arch: radius of the wheel arch [m].
        slot: half the width of the opening above the wheel [m].
        near, far: sides in y [m].
    """
    slot_top, reach = top - 0.075, float(np.sqrt(arch**2 - sill**2))
    arc = [
        (arch * float(np.sin(a)), arch * float(np.cos(a)))
        for a in np.linspace(np.arcsin(slot / arch), np.arctan2(reach, sill), 40)
    ]
    corner = [
        (slot - 0.05 + 0.05 * float(np.sin(a)), slot_top - 0.05 + 0.05 * float(np.cos(a)))
        for a in np.linspace(0, np.pi / 2, 9)
    ]
    end = [(float(x), sill) for x in np.linspace(reach + 1e-4, length / 2, 8)]
    half = [(0.0, slot_top), *corner, *arc, *end]
    outline = np.array([(-x, z) for x, z in half[:0:-1]] + half)
    return slab(outline[:, 0], outline[:, 1], _bonnet(outline[:, 0], length, top), near=near, far=far, rounding=0.022)


def deck(*, length: float, top: float, thickness: float, near: float, far: float) -> Surface:
    """Upper side of the bodywork, curved like the upper edge of `fender` [m]."""
    x = np.linspace(-length / 2, length / 2, 41)
    high = _bonnet(x, length, top)
    return slab(x, high - thickness, high, near=near, far=far, rounding=0.03)


def arch_lip(*, sill: float, arch: float, slot: float, near: float, far: float) -> Surface:
    """Dark trim along both sides of the wheel arch of `fender` [m]."""
    reach = float(np.sqrt(arch**2 - sill**2))
    parts = []
    for side in (-1.0, 1.0):
        rings = [
            [
                (side * r * np.sin(a), y, r * np.cos(a))
                for r, y in ((arch - 0.004, near), (arch - 0.004, far), (arch + 0.03, far), (arch + 0.022, near))
            ]
            for a in np.linspace(np.arcsin((slot + 0.01) / arch), np.arctan2(reach, sill), 40)
        ]
        parts.append(loft(np.array(rings)))
    return joined(parts)


def _bonnet(x: np.ndarray, length: float, top: float) -> np.ndarray:
    """Height [m] of the upper edge of the bodywork along x: it falls towards the ends."""
    return top - 0.085 * np.abs(2 * x / length) ** 2.6


def rounded_box(length: float, width: float, height: float, rounding: float) -> Surface:
    """Box with rounded edges, centred [m]."""
    x = np.array([-length / 2, length / 2])
    return slab(x, np.full(2, -height / 2), np.full(2, height / 2), near=-width / 2, far=width / 2, rounding=rounding)


def road(
    height: Callable[[np.ndarray], np.ndarray],
    spans: Sequence[tuple[float, float]],
    *,
    near: float,
    far: float,
    top: float,
    bottom: float,
) -> Surface:
    """Strips of road, extruded across: their upper side follows the road height.

    Args:
        height: road height [m] over distance [m].
        spans: (start, end) of each strip [m].
        near, far: sides in y [m].
        top: how far the strip's upper side lies above the road height [m].
        bottom: absolute height of its underside [m].
    """
    strips = []
    for start, end in spans:
        x = np.linspace(start, end, max(int((end - start) / 0.05), 1) + 1)
        z = height(x) + top
        rings = np.array(
            [[(a, near, bottom), (a, far, bottom), (a, far, b), (a, near, b)] for a, b in zip(x, z, strict=True)]
        )
        strips.append(loft(rings))
    return joined(strips)


def _groove() -> Profile:
    return ((0.006, 0.0), (0.0045, 0.009), (-0.0045, 0.009), (-0.006, 0.0))


def joined(parts: Sequence[trimesh.Trimesh]) -> Surface:
    """Several meshes as one."""
    starts = np.cumsum([0, *(len(part.vertices) for part in parts)])
    faces = [np.asarray(part.faces) + start for part, start in zip(parts, starts, strict=False)]
    return Surface(
        np.concatenate([np.asarray(part.vertices) for part in parts]), np.concatenate(faces).astype(np.int32)
    )


def surface_of(mesh: trimesh.Trimesh) -> Surface:
    """A trimesh mesh as plain arrays."""
    return Surface(np.asarray(mesh.vertices, dtype=float), np.asarray(mesh.faces, dtype=np.int32))


def _revolved(outline: Profile, *, angle: float | None = None, sections: int = _SECTIONS) -> trimesh.Trimesh:
    """Body of revolution about y from its outline, with outward faces."""
    import trimesh

    closed = np.array([*outline, outline[0]], dtype=float)
    if angle is None:
        mesh = trimesh.creation.revolve(closed, sections=sections)
    else:
        mesh = trimesh.creation.revolve(closed, angle=angle, sections=max(int(sections * angle / 6), 8))
    mesh.apply_transform(np.array([[1.0, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1]]))
    if mesh.volume < 0:
        mesh.invert()
    return mesh


def _spoke(lean: float) -> trimesh.Trimesh:
    """One of a pair of spokes, along z."""
    import trimesh

    mesh = trimesh.creation.box([1.0, 1.0, 1.0])
    vertices = np.array(mesh.vertices)
    out = vertices[:, 2] > 0
    width = np.where(out, 0.017, 0.024)
    vertices[:, 0] = vertices[:, 0] * width + lean * np.where(out, 0.034, 0.014)
    vertices[:, 1] = vertices[:, 1] * np.where(out, 0.02, 0.03) + np.where(out, -0.078, -0.05)
    vertices[:, 2] = np.where(out, RIM_RADIUS - 0.012, 0.045)
    mesh.vertices = vertices
    return mesh


def tube(centre: np.ndarray, radius: float, sides: int) -> trimesh.Trimesh:
    """Round wire along a line of (n, 3) points."""
    along = np.gradient(centre, axis=0)
    along /= np.linalg.norm(along, axis=1)[:, None]
    across = np.cross(along, [0.0, 0.0, 1.0])
    across /= np.linalg.norm(across, axis=1)[:, None]
    upward = np.cross(across, along)
    angle = np.linspace(0.0, 2 * np.pi, sides, endpoint=False)[None, :, None]
    return loft(centre[:, None, :] + radius * (np.cos(angle) * across[:, None, :] + np.sin(angle) * upward[:, None, :]))


def loft(rings: np.ndarray) -> trimesh.Trimesh:
    """Closed surface through (n, k, 3) rings of points, its ends capped, with outward faces."""
    import trimesh

    count, size, _ = rings.shape
    one, other = np.meshgrid(np.arange(count - 1), np.arange(size), indexing="ij")
    a, b = one * size + other, one * size + (other + 1) % size
    walls = np.concatenate(
        [np.stack([a, b, b + size], axis=-1).reshape(-1, 3), np.stack([a, b + size, a + size], axis=-1).reshape(-1, 3)]
    )
    first, last, ends = count * size, count * size + 1, np.arange(size)
    caps = [np.column_stack([np.full(size, first), (ends + 1) % size, ends])]
    base = (count - 1) * size
    caps.append(np.column_stack([np.full(size, last), base + ends, base + (ends + 1) % size]))
    vertices = np.concatenate([rings.reshape(-1, 3), rings[:1].mean(axis=1), rings[-1:].mean(axis=1)])
    mesh = trimesh.Trimesh(vertices, np.concatenate([walls, *caps]), process=False)
    if mesh.volume < 0:
        mesh.invert()
    return mesh


def _rounded_rectangle(
    near: float, far: float, bottom: float, top: float, rounding: float
) -> list[tuple[float, float]]:
    """(y, z) outline of a rectangle with quarter circles at its corners."""
    radius = min(rounding, 0.49 * (far - near), 0.49 * (top - bottom))
    corners = ((far, top, 0), (near, top, 1), (near, bottom, 2), (far, bottom, 3))
    outline = []
    for y, z, quarter in corners:
        for angle in np.pi / 2 * (quarter + np.linspace(0.0, 1.0, 6)):
            centre_y = y - radius if y == far else y + radius
            centre_z = z - radius if z == top else z + radius
            outline.append((centre_y + radius * float(np.cos(angle)), centre_z + radius * float(np.sin(angle))))
    return outline


def _inset(
    ring: list[tuple[float, float, float]], rounding: float, direction: float
) -> list[list[tuple[float, float, float]]]:
    """Rings that close a slab's end with a rounded edge, from the full outline outwards."""
    points = np.array(ring)
    middle, half = (points.max(axis=0) + points.min(axis=0)) / 2, (points.max(axis=0) - points.min(axis=0)) / 2
    rings = []
    for angle in np.linspace(0.0, np.pi / 2, 6)[1:]:
        shrink = 1 - rounding * (1 - np.cos(angle)) / np.where(half > 0, half, 1.0)
        moved = middle + (points - middle) * shrink
        moved[:, 0] = points[:, 0] + direction * rounding * np.sin(angle)
        rings.append([tuple(point) for point in moved])
    return rings
