"""Shapes of a car with several wheels: wheels, struts, road or four-post rig; the body comes from `bodywork`."""

from __future__ import annotations

from typing import Any

import numpy as np

from susp_mj.names import channel_name
from susp_mj.run import Run

from ..clip import tyre_deflection
from ..picture import Picture, contact_shadow, materials, studio
from ..shapes import parts
from ..wheels import outwards, wheel_assets
from ..window import Window
from .bodywork import bodywork
from .pose import WHEEL_RADIUS, Layout, road_speed

HINGE = 0.17
"""How far from the plane of symmetry a lower arm is hinged to the body [m]."""
ARM_HEIGHT = 0.26
_ROAD_EDGE = 0.75


def oscillation_spec(
    run: Run, layout: Layout, colour: str, size: tuple[int, int], window: Window, samples: int = 4
) -> Any:
    """MuJoCo specification of the picture of a car; `scene.place` says where its bodies go."""
    picture = Picture()
    studio(picture, size, extent=4.5, samples=samples)
    picture.spec.visual.quality.numslices, picture.spec.visual.quality.numstacks = 24, 8  # plain shapes are small here
    materials(picture, colour)
    bodywork(picture, layout)
    _wheels(picture, run, layout)
    _struts(picture, layout)
    if layout.one_axle:
        _beam(picture, layout)
    else:
        _arms(picture, layout)
    for station in layout.places:
        contact_shadow(picture, picture.posed(f"{station}_shadow"))
    if road_speed(run, layout) > 0:
        _road(picture, run, layout, window)
    else:
        _rig(picture, layout)
    return picture.spec


def _wheels(picture: Picture, run: Run, layout: Layout) -> None:
    """Wheels as `<station>_wheel`, their outer faces outwards; `<station>_carrier` holds the brake."""
    assets: dict[float, list[tuple[str, str]]] = {}
    for station in layout.places:
        radius = round(WHEEL_RADIUS + tyre_deflection(run, station), 4)
        if radius not in assets:
            assets[radius] = wheel_assets(picture, f"wheel{len(assets)}_", radius)
        side = layout.side(station)
        wheel, carrier = picture.posed(f"{station}_wheel"), picture.posed(f"{station}_carrier")
        for asset, material in assets[radius]:
            picture.copy(wheel, asset, material, **outwards(side))
        picture.shape(carrier, "box", (0.028, 0.03, 0.06), "caliper", (-0.135, -0.018 * side, 0.05))
        if not layout.one_axle:
            inset = layout.strut.inset
            picture.shape(carrier, "box", (0.045, 0.06, 0.07), "dark", (0, -0.10 * side, -0.01))
            picture.shape(
                carrier, "box", (0.03, inset / 2 - 0.02, 0.022), "dark", (0, -side * (inset / 2 + 0.02), -0.035)
            )


def _struts(picture: Picture, layout: Layout) -> None:
    """`<station>_foot`: damper tube, lower seat and the coil, to be stretched; `<station>_head`: piston rod and upper
    seat."""
    strut = layout.strut
    picture.asset("coil", parts.coil(strut.coil, 0.064, 0.0085, turns=6.0 if strut.coil > 0.28 else 5.0))
    for station in layout.places:
        foot, head = picture.posed(f"{station}_foot"), picture.posed(f"{station}_head")
        if strut.seat > 0.1:
            tube = strut.seat + 0.08
            picture.shape(foot, "cylinder", (0.031, tube / 2), "steel", (0, 0, tube / 2 - 0.03))
            picture.shape(foot, "cylinder", (0.036, 0.008), "dark", (0, 0, tube - 0.03))
        else:
            picture.shape(foot, "cylinder", (0.031, 0.06), "steel", (0, 0, 0.05))
        picture.shape(foot, "cylinder", (0.082, 0.007), "dark", (0, 0, strut.seat - 0.007))
        picture.copy(foot, "coil", "spring", (0, 0, strut.seat), name=f"{station}_coil")
        picture.shape(head, "cylinder", (0.013, 0.6 * strut.coil), "chrome", (0, 0, -0.6 * strut.coil))
        picture.shape(head, "cylinder", (0.026, 0.022), "rubber", (0, 0, -0.022))
        picture.shape(head, "cylinder", (0.082, 0.007), "dark", (0, 0, 0.007))
        if not layout.one_axle:
            picture.shape(head, "cylinder", (0.092, 0.012), "paint", (0, 0, 0.066))
            picture.shape(head, "cylinder", (0.035, 0.02), "chrome", (0, 0, 0.085))


def _beam(picture: Picture, layout: Layout) -> None:
    """Rigid axle as `beam`, its middle at the origin."""
    beam = picture.posed("beam")
    across = {"quat": [0.7071067811865476, 0.7071067811865476, 0, 0]}
    picture.shape(beam, "cylinder", (0.042, layout.half_track - 0.03), "dark", **across)
    picture.shape(beam, "sphere", (0.105,), "dark", (0, 0, 0))
    for station in layout.places:
        y = layout.mount(station, 0.0)[1] - layout.middle
        picture.shape(beam, "cylinder", (0.05, 0.03), "dark", (0, float(y), 0.03))


def _arms(picture: Picture, layout: Layout) -> None:
    """Lower arms as `<station>_arm`, a tube of unit length along z, to be stretched."""
    for station in layout.places:
        arm = picture.posed(f"{station}_arm")
        picture.shape(arm, "cylinder", (0.021, 0.5), "dark", (0, 0, 0.5), name=f"{station}_arm")


def _road(picture: Picture, run: Run, layout: Layout, window: Window) -> None:
    """The road that passes underneath, its left and right half as high as its track."""
    road, speed = picture.posed("road"), road_speed(run, layout)
    start, end = speed * window.start + layout.rear - 9.0, speed * window.end + layout.front + 9.0
    tracks = _tracks(layout)
    lowest = min(float(run[channel_name(station, "road_height")].min()) for station in layout.places)
    bottom = min(lowest, 0.0) - 0.12
    for name, station, inner, outer in tracks:
        heights = run[channel_name(station, "road_height")]
        ahead = layout.places[station][0]

        def height(x: np.ndarray, heights: np.ndarray = heights, ahead: float = ahead) -> np.ndarray:
            return np.interp(x - ahead, run.time * speed, heights)

        near, far = min(inner, outer), max(inner, outer)
        picture.mesh(
            road,
            f"{name}_asphalt",
            parts.road(height, [(start, end)], near=near, far=far, top=0.0, bottom=bottom),
            "asphalt",
        )
        edge = outer - 0.16 * np.sign(outer - inner)
        dashes = [(start, end)] if name == "right" else [(x, x + 0.7) for x in np.arange(np.floor(start), end, 1.6)]
        line = parts.road(height, dashes, near=edge - 0.045, far=edge + 0.045, top=0.003, bottom=bottom + 0.01)
        picture.mesh(road, f"{name}_line", line, "line")
        raised = run.time[np.abs(heights - heights[0]) > 1e-4] * speed + ahead
        if len(raised) and raised[-1] - raised[0] < 8.0:
            span = [(float(raised[0]), float(raised[-1]))]
            bump = parts.road(height, span, near=near + 0.001, far=far - 0.001, top=0.0015, bottom=bottom + 0.01)
            picture.mesh(road, f"{name}_bump", bump, "bump")
    picture.shape(picture.spec.worldbody, "plane", (60, 60, 1), "floor", (0, 0, bottom))


def _tracks(layout: Layout) -> list[tuple[str, str, float, float]]:
    """Halves of the road: name, the station that leads on it, inner and outer edge in y [m]."""
    halves = []
    for name, side in (("right", -1.0), ("left", 1.0)):
        if any(layout.side(station) == side for station in layout.places):
            halves.append(
                (name, layout.leader(side), layout.middle, layout.middle + side * (layout.half_track + _ROAD_EDGE))
            )
    return halves


def _rig(picture: Picture, layout: Layout) -> None:
    """Test rig: each wheel stands on a plate, ``<station>_plate``, that a cylinder moves."""
    picture.asset("plate_top", parts.rounded_box(0.62, 0.40, 0.036, 0.012))
    base = picture.spec.worldbody
    for station, (x, y) in layout.places.items():
        plate = picture.posed(f"{station}_plate")
        picture.copy(plate, "plate_top", "steel", (0, 0, -0.018))
        picture.shape(plate, "cylinder", (0.045, 0.15), "chrome", (0, 0, -0.18))
        picture.shape(base, "cylinder", (0.085, 0.08), "rig", (x, y, -0.22))
        picture.shape(base, "cylinder", (0.1, 0.012), "dark", (x, y, -0.14))
        picture.shape(base, "cylinder", (0.42, 0.01), "dais", (x, y, -0.26))
    picture.shape(base, "plane", (60, 60, 1), "floor", (0, 0, -0.27))
