"""The palette: colours of configurations by their order, the same in plots and videos, and what plots are drawn on."""

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
"""Of configurations, safe for colour-blind readers: blue, orange, green, purple, ochre, cyan, crimson, grey."""
LIFTED = "#e01b24"
"""Red of a wheel that has left the road, and of limits; no configuration uses it."""
INK, MUTED, GRID, PAPER = "#24292f", "#6b7480", "#dfe3e8", "#ffffff"
LIGHT = {"ink": INK, "muted": MUTED, "grid": GRID, "paper": PAPER, "lifted": LIFTED}
DARK = {"ink": "#dfe4ea", "muted": "#8d96a1", "grid": "#333a43", "paper": "#1b2026", "lifted": "#ff6b70"}
"""The same on a dark ground."""


def rgb(colour: str) -> tuple[int, int, int]:
    """Red, green and blue, 0 to 255, of a colour written ``#rrggbb``."""
    return int(colour[1:3], 16), int(colour[3:5], 16), int(colour[5:7], 16)


def on_dark(colour: str) -> str:
    """A line colour made lighter for a dark ground."""
    parts = [int(colour[i : i + 2], 16) for i in (1, 3, 5)]
    return "#" + "".join(f"{round(part + 0.42 * (255 - part)):02x}" for part in parts)
