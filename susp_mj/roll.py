"""Roll of a car in a steady turn: the stiffness that it needs and the anti-roll bars that complete its springs."""

from __future__ import annotations

from .units import GRAVITY


def required_roll_stiffness(lever: float, lateral_acceleration: float, angle: float, gravity: float = GRAVITY) -> float:
    """Roll stiffness ``K = m h (a_y + g phi)/phi`` [N m/rad] for the roll angle phi at the lateral acceleration a_y.

    Args:
        lever: m h [kg m], h the height of the centre of gravity above the roll axis.
        lateral_acceleration: a_y [m/s²].
        angle: phi [rad].
        gravity: 0 leaves the overturning of the rolled body out.

    Source: thesis appendix 9; the gravity term is reconstructed.
    """
    return lever * (lateral_acceleration + gravity * angle) / angle


def bar_rate(roll_stiffness: float, share: float, track: float, spring_rate: float) -> float:
    """Bar rate at the wheel [N/m] that completes an axle: ``c = K share 2/t² - k``; negative if the springs exceed it.

    Args:
        roll_stiffness: K of the whole car [N m/rad].
        share: of this axle.
        track: t [m].
        spring_rate: secant rate k of one wheel's spring over the roll [N/m].
    """
    return roll_stiffness * share * 2 / track**2 - spring_rate
