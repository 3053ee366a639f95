"""What a measurement is compared by: over time or over another channel, with which tolerances."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field


@dataclass(frozen=True)
class Allowed:
    """Tolerance of a channel in SI units, see `judgement.judge`.

    Attributes:
        offset: in the channel's unit.
        gain: share of the measured value.
        along: of the abscissa, in its unit.
        given: whether the user gave it; else it is ours.
    """

    offset: float = 0.0
    gain: float = 0.0
    along: float = 0.0
    given: bool = False


@dataclass(frozen=True)
class Standard:
    """A way of comparing.

    Attributes:
        title: one line.
        crossed: whether a channel is drawn over another one, point by point; else over time.
        usual: tolerance of a quantity without one of its own.
        tolerances: by quantity.
    """

    title: str
    crossed: bool
    usual: Allowed
    tolerances: Mapping[str, Allowed] = field(default_factory=dict)


_TURNING = {
    "roll_angle": Allowed(offset=3.5e-3, gain=0.05),
    "yaw_rate": Allowed(offset=8.7e-3, gain=0.05),
    "lateral_acceleration": Allowed(offset=0.15, gain=0.05),
    "side_slip_angle": Allowed(offset=3.5e-3, gain=0.1),
    "steering_wheel_angle": Allowed(offset=0.035, gain=0.05),
}
STANDARDS: dict[str, Standard] = {
    "table_6_3": Standard("over time, as table 6.3 of the thesis", crossed=False, usual=Allowed(gain=0.12)),
    "iso_19364": Standard("ISO 19364, steady-state circle", True, Allowed(gain=0.1), _TURNING),
    "iso_19365": Standard("ISO 19365, sine with dwell", False, Allowed(gain=0.1, along=0.01), _TURNING),
    "iso_22140": Standard("ISO 22140, lateral transient response", False, Allowed(gain=0.1, along=0.01), _TURNING),
}
"""Ways of comparing by name. The form of the ISO standards is theirs as we know it, the numbers are reconstructed: take
those of the text that binds you."""
RECONSTRUCTED = "the tolerance is reconstructed, not from the text of a standard: give your own"
