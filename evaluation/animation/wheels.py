"""The wheel that the cars of all pictures have."""

from __future__ import annotations

from typing import Any

from .picture import Picture
from .shapes import parts


def wheel_assets(picture: Picture, name: str, radius: float, sections: int = 96) -> list[tuple[str, str]]:
    """Shapes of a wheel whose unloaded tyre has a radius [m], to be copied: (asset, material)."""
    surfaces = (
        ("tyre", parts.tyre(radius, sections), "rubber"),
        ("marks", parts.sidewall_marks(radius), "mark"),
        ("rim", parts.rim(sections=sections), "alloy"),
        ("bolts", parts.wheel_bolts(), "dark"),
        ("disc", parts.brake_disc(sections), "steel"),
    )
    for part, surface, _ in surfaces:
        picture.asset(f"{name}{part}", surface)
    return [(f"{name}{part}", material) for part, _, material in surfaces]


def outwards(side: float) -> dict[str, Any]:
    """Turn of a wheel's shapes so that their outer face looks outwards; `side` is 1 on the left, -1 on the right."""
    return {"quat": [0, 0, 0, 1] if side > 0 else [1, 0, 0, 0]}
