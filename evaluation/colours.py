"""Colours of configurations by their order, the same in plots and videos; safe for colour-blind readers."""

from __future__ import annotations

COLOURS: tuple[str, ...] = (
    "#1f5fa8",
    "#d9601a",
    "#2a8c57",
    "#8e3b9e",
    "#c2a20c",
    "#17a2b8",
    "#b3243e",
    "#5a5f66",
)
"""Blue, orange, green, purple, ochre, cyan, crimson, grey."""
LIFTED = "#e01b24"
"""Red of a wheel that has left the road; no configuration uses it."""


def rgb(colour: str) -> tuple[int, int, int]:
    """Red, green and blue, 0 to 255, of a colour written ``#rrggbb``."""
    return int(colour[1:3], 16), int(colour[3:5], 16), int(colour[5:7], 16)
