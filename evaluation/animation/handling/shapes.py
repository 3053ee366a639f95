"""Shapes of a car that drives freely: a saloon with turning wheels, solid or as a translucent ghost."""

from __future__ import annotations

from typing import Any

from ...colours import LIFTED, rgb
from ..picture import Picture
from ..shapes import ground
from ..shapes.saloon import Saloon, saloon
from ..wheels import outwards, wheel_assets
from .pose import Chassis, side_of

_GHOST = 0.32
_GHOSTLY = ("paint", "glass", "gloss", "chrome", "lamp_glass", "tail")
_TONES: dict[str, tuple[tuple[float, float, float], float, float, float]] = {
    "trim": ((0.10, 0.10, 0.11), 0.15, 0.2, 0.0),
    "grille": ((0.045, 0.045, 0.05), 0.3, 0.4, 0.0),
    "lamp": ((0.98, 0.98, 0.94), 0.9, 0.9, 0.55),
    "tail": ((0.62, 0.03, 0.045), 0.7, 0.8, 0.25),
    "gap": ((0.035, 0.035, 0.04), 0.0, 0.0, 0.0),
    "plate": ((0.92, 0.92, 0.88), 0.1, 0.2, 0.05),
    "liner": ((0.03, 0.03, 0.033), 0.0, 0.0, 0.0),
}
_GLOSSY: dict[str, tuple[tuple[float, float, float], float]] = {
    "glass": ((0.05, 0.065, 0.08), 0.42),
    "gloss": ((0.03, 0.03, 0.035), 0.25),
    "chrome": ((0.62, 0.64, 0.67), 0.75),
    "lamp_glass": ((0.30, 0.33, 0.37), 0.45),
}


def car_materials(picture: Picture) -> None:
    """Materials that all cars of a picture share."""
    for name, (colour, specular, shininess, emission) in _TONES.items():
        picture.material(f"car_{name}", colour, specular, shininess, emission=emission)
    for name, (colour, share) in _GLOSSY.items():
        picture.glossy(f"car_{name}", colour, share)
    picture.material("lifted", [value / 255 for value in rgb(LIFTED)], 0.2, 0.3, emission=0.45)
    picture.material("blob", (0.0, 0.0, 0.0, 0.05), 0.0, 0.0)


def add_car(picture: Picture, chassis: Chassis, colour: str, prefix: str, *, ghost: bool, fine: bool) -> None:
    """Bodies `<prefix>body`, `<prefix><station>_wheel`, `<prefix><station>_carrier` and `<prefix>shadow`, to be
    posed."""
    paint = [value / 255 for value in rgb(colour)]
    picture.glossy(f"{prefix}paint", paint, 0.32, _GHOST if ghost else 1.0)
    station = next(iter(chassis.centres))
    radius, tyre = float(chassis.centres[station][2]), max(chassis.tyres.values())
    half_width, stations = max(chassis.half_track + 0.165, 0.80), (130, 56) if fine else (84, 38)
    surfaces = saloon(Saloon(chassis.wheelbase, half_width, radius, tyre + 0.052, stations))
    body = picture.posed(f"{prefix}body")
    if ghost:
        picture.material(f"{prefix}veil", [*paint, _GHOST], 0.2, 0.3)
    for name, surface in surfaces.items():
        if ghost and name not in _GHOSTLY:
            continue
        material = f"{prefix}paint" if name == "paint" else f"{prefix}veil" if ghost else f"car_{name}"
        picture.mesh(body, f"{prefix}{name}", surface, material)
    _wheels(picture, chassis, prefix, ghost=ghost, sections=72 if fine else 40)
    _shadow(picture, chassis, prefix, ghost=ghost)


def _wheels(picture: Picture, chassis: Chassis, prefix: str, *, ghost: bool, sections: int) -> None:
    assets: dict[float, list[tuple[str, str]]] = {}
    for station, tyre in chassis.tyres.items():
        radius, side = round(tyre, 4), side_of(station)
        if radius not in assets:
            assets[radius] = wheel_assets(picture, f"{prefix}wheel{len(assets)}_", radius, sections)
        wheel, carrier = picture.posed(f"{prefix}{station}_wheel"), picture.posed(f"{prefix}{station}_carrier")
        for asset, material in assets[radius]:
            if ghost and material not in ("rubber", "alloy"):
                continue
            shown = f"{prefix}veil" if ghost else material
            picture.copy(wheel, asset, shown, **outwards(side), name=f"{prefix}{station}_{asset.rpartition('_')[2]}")
        if not ghost:
            picture.shape(carrier, "box", (0.028, 0.03, 0.06), "caliper", (-0.135, -0.018 * side, 0.05))


def _shadow(picture: Picture, chassis: Chassis, prefix: str, *, ghost: bool) -> None:
    """Soft shadow under the car: a stack of faint sheets, softer than a shadow map and far cheaper."""
    shadow = picture.posed(f"{prefix}shadow")
    middle, count = -chassis.wheelbase / 2 - 0.10, 5 if ghost else 16
    for number in range(count):
        share = number / (count - 1)
        sheet = ground.disc(
            chassis.wheelbase / 2 + 1.20 - 0.55 * share,
            chassis.half_track + 0.34 - 0.42 * share,
            3.2,
            0.008 + 0.0008 * number,
        )
        picture.mesh(shadow, f"{prefix}shadow{number}", sheet, "blob", (middle, 0, 0))


def fade(model: Any, prefix: str, share: float) -> None:
    """Let a ghost be seen by a share from 0 to 1 of its usual strength."""
    for name in ("paint", "veil"):
        model.material(f"{prefix}{name}").rgba[3] = _GHOST * share


def tint_tyre(model: Any, prefix: str, station: str, *, red: bool, ghost: bool) -> None:
    """Show a tyre in red, or as it usually is."""
    usual = f"{prefix}veil" if ghost else "rubber"
    model.geom(f"{prefix}{station}_tyre").matid = model.material("lifted" if red else usual).id
