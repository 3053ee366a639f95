"""What the header of a frame says."""

from __future__ import annotations

import math

from susp_mj.run import Run

from ..numbers.runs import character, is_a

_PARAMETERS = {
    "height": ("{:+.0f} mm", 1000.0),
    "left_height": ("left {:+.0f} mm", 1000.0),
    "right_height": ("right {:+.0f} mm", 1000.0),
    "acceleration": ("{:+.3g} m/s²", 1.0),
    "angle": ("{:.3g}°", 180 / math.pi),
    "length": ("{:.3g} m long", 1.0),
    "amplitude": ("amplitude {:.3g} mm", 1000.0),
    "rise_time": ("within {:.0f} ms", 1000.0),
    "start_frequency": ("from {:.3g} Hz", 1.0),
    "end_frequency": ("to {:.3g} Hz", 1.0),
    "frequency": ("{:.3g} Hz", 1.0),
    "radius": ("radius {:.4g} m", 1.0),
    "rate": ("{:.3g}°/s", 180 / math.pi),
    "pedal": ("pedal {:.0f} %", 100.0),
    "friction": ("friction × {:.3g}", 1.0),
    "wind": ("wind {:.3g} m/s", 1.0),
    "slope": ("slope {:.3g} %", 100.0),
    "speed": ("at {:.3g} km/h", 3.6),
}
_STEERED = {"amplitude": ("amplitude {:.3g}°", 180 / math.pi)}
"""Instead of those above where it is the steering wheel that is moved."""


def describe(run: Run) -> str:
    """One line that says what is done: ``Bump · +80 mm · 2 m long · at 50 km/h``."""
    manoeuvre = run.meta.get("manoeuvre", {})
    known = _PARAMETERS | (_STEERED if is_a(run, "steering") else {})
    parts = [
        text.format(manoeuvre[key] * factor)
        for key, (text, factor) in known.items()
        if isinstance(manoeuvre.get(key), (int, float))
    ]
    if "road_class" in manoeuvre:
        parts.insert(0, f"class {manoeuvre['road_class']}")
    return "  ·  ".join([character(run).title or "Run", *parts]).replace("-", "−")


def playback_text(playback: float) -> str:
    """How fast the video runs, for the reader."""
    if abs(playback - 1) < 1e-9:
        return "real time"
    return f"slow motion 1 : {1 / playback:.3g}" if playback < 1 else f"{playback:.3g} times real time"


def signed(value: float, unit: str = "") -> str:
    """A number with its sign and one decimal; what rounds to zero has a plus."""
    return f"{round(value, 1) + 0.0:+.1f}{unit}".replace("-", "−")
