"""Shapes of the quarter car's picture: corner of the body, wheel with spring strut, road or test rig."""

from __future__ import annotations

from typing import Any

import numpy as np

from susp_mj.run import Run

from ..clip import speed_of, tyre_deflection
from ..picture import Picture, contact_shadow, materials, studio
from ..shapes import parts
from ..wheels import wheel_assets
from ..window import Window

WHEEL_RADIUS = 0.33
"""Height of the wheel centre above the road in the design position [m]."""
COIL_LENGTH = 0.29
"""Length of the drawn coil in the design position [m]."""
STRUT = 0.175
LENGTH = 1.12
LOWER_SEAT = 0.37


def quarter_spec(run: Run, colour: str, size: tuple[int, int], window: Window, samples: int = 4) -> Any:
    """MuJoCo specification of the picture of a quarter car; joints ``body``, ``wheel``, ``spin``, ``road`` and
    ``plate``."""
    picture = Picture()
    studio(picture, size, samples=samples)
    materials(picture, colour)
    _bodywork(picture)
    _wheel(picture, WHEEL_RADIUS + tyre_deflection(run))
    road = picture.body("road", 0.0, (1, 0, 0))
    plate = picture.body("plate", 0.0, (0, 0, 1))
    if speed_of(run) > 0:
        _road(picture, road, run, window)
    else:
        _rig(picture, plate)
    contact_shadow(picture, picture.turning(plate, "slope"))
    return picture.spec


def _bodywork(picture: Picture) -> None:
    """Corner of a car with its spring dome; heights from the wheel centre in the design position."""
    body = picture.body("body", WHEEL_RADIUS, (0, 0, 1))
    arch = {"sill": -0.03, "arch": 0.415, "slot": 0.15}
    picture.mesh(body, "fender", parts.fender(length=LENGTH, top=0.735, near=-0.13, far=-0.06, **arch), "paint")
    picture.mesh(body, "lip", parts.arch_lip(near=-0.137, far=-0.06, **arch), "liner")
    picture.mesh(
        body, "deck", parts.deck(length=LENGTH - 0.012, top=0.737, thickness=0.07, near=-0.133, far=0.46), "paint"
    )
    picture.mesh(body, "liner", parts.rounded_box(0.9, 0.1, 0.62, 0.03), "liner", (0, 0.35, 0.345))
    picture.shape(body, "cylinder", (0.1, 0.012), "liner", (0, STRUT, 0.745))
    picture.shape(body, "cylinder", (0.06, 0.02), "dark", (0, STRUT, 0.76))
    picture.shape(body, "cylinder", (0.014, 0.035), "chrome", (0, STRUT, 0.78))
    upper = LOWER_SEAT + COIL_LENGTH
    picture.shape(body, "cylinder", (0.082, 0.007), "dark", (0, STRUT, upper + 0.007))
    picture.shape(body, "cylinder", (0.026, 0.022), "rubber", (0, STRUT, upper - 0.022))
    picture.shape(body, "cylinder", (0.013, 0.25), "chrome", (0, STRUT, upper - 0.25))


def _wheel(picture: Picture, tyre_radius: float) -> None:
    """Wheel with brake, damper tube, lower spring seat and the coil standing on it."""
    carrier = picture.body("wheel", WHEEL_RADIUS, (0, 0, 1))
    picture.shape(carrier, "cylinder", (0.032, 0.22), "steel", (0, STRUT, LOWER_SEAT - 0.18))
    picture.shape(carrier, "cylinder", (0.084, 0.007), "dark", (0, STRUT, LOWER_SEAT - 0.007))
    picture.shape(carrier, "cylinder", (0.036, 0.008), "dark", (0, STRUT, LOWER_SEAT + 0.036))
    picture.shape(carrier, "box", (0.045, 0.07, 0.075), "dark", (0, 0.12, 0.0))
    picture.shape(carrier, "box", (0.028, 0.03, 0.06), "caliper", (-0.135, 0.018, 0.05))
    carrier.add_site(name="coil_foot", pos=[0, STRUT, LOWER_SEAT])
    picture.mesh(carrier, "coil", parts.coil(COIL_LENGTH, 0.064, 0.0085), "spring", (0, STRUT, LOWER_SEAT))
    wheel = picture.turning(carrier, "spin")
    for asset, material in wheel_assets(picture, "", tyre_radius):
        picture.copy(wheel, asset, material, name=asset)


def _road(picture: Picture, body: Any, run: Run, window: Window) -> None:
    """The road that passes underneath: its height over distance is the run's road height over time."""
    speed = speed_of(run)

    def height(x: np.ndarray) -> np.ndarray:
        return np.interp(x / speed, run.time, run["road_height"])

    start, end = speed * window.start - 6.0, speed * window.end + 8.0
    raised = run.time[np.abs(run["road_height"] - run["road_height"][0]) > 1e-4] * speed
    dashes = [(x, x + 0.4) for x in np.arange(np.floor(start), end, 1.0)]
    picture.mesh(
        body, "asphalt", parts.road(height, [(start, end)], near=-0.3, far=1.7, top=0.0, bottom=-0.14), "asphalt"
    )
    picture.mesh(
        body, "edge", parts.road(height, [(start, end)], near=-0.27, far=-0.22, top=0.003, bottom=-0.02), "line"
    )
    picture.mesh(body, "dashes", parts.road(height, dashes, near=1.15, far=1.25, top=0.003, bottom=-0.02), "line")
    if len(raised) and raised[-1] - raised[0] < 6.0:
        span = [(float(raised[0]), float(raised[-1]))]
        picture.mesh(body, "bump", parts.road(height, span, near=-0.302, far=1.701, top=0.0015, bottom=-0.142), "bump")
    picture.shape(picture.spec.worldbody, "plane", (30, 30, 1), "floor", (0, 0, -0.14))


def _rig(picture: Picture, plate: Any) -> None:
    """Test rig: the wheel stands on a plate that a cylinder moves."""
    picture.mesh(plate, "plate", parts.rounded_box(0.72, 0.44, 0.036, 0.012), "steel", (0, 0, -0.018))
    picture.shape(plate, "cylinder", (0.045, 0.15), "chrome", (0, 0, -0.18))
    base = picture.spec.worldbody
    picture.shape(base, "cylinder", (0.085, 0.08), "rig", (0, 0, -0.22))
    picture.shape(base, "cylinder", (0.1, 0.012), "dark", (0, 0, -0.14))
    picture.shape(base, "cylinder", (0.62, 0.01), "dais", (0, 0, -0.26))
    picture.shape(base, "plane", (30, 30, 1), "floor", (0, 0, -0.27))
