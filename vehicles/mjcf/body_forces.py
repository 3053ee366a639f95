"""What acts on the body itself: lateral and longitudinal acceleration, gravity in roll, the roll rig; its seat
channel."""

from __future__ import annotations

from collections.abc import Sequence

from susp_mj.elements import GRAVITY, Overturning, SpringDamper
from susp_mj.errors import InputError

from ..models import Topology
from .axles import Corner, height_at
from .mass import Mass
from .parts import Form, ModelBuilder

_RIG_FREQUENCY = 2000.0  # rad/s; stiff against every suspension, soft enough for a step of 1 ms


def add_lateral(
    builder: ModelBuilder,
    topology: Topology,
    cg_height: float | None,
    corners: Sequence[Corner],
    position: dict[str, Form],
) -> float | None:
    """Lateral acceleration a_y of the sprung mass (positive in a left turn), and gravity on the rolling body.

    The inertial force ``-m a_y`` at the centre of gravity rolls the body about the ground with ``m a_y h_cg``. The
    links carry ``V = m_axle a_y z_rc / t`` between body and wheel, up on the left wheel and down on the right, which
    leaves the body ``m a_y h`` about the roll axis, h = h_cg - z_rc. Returns m h [kg m].
    """
    told = (corner.axle.values.roll_centre_height for corner in corners)
    heights = [height for height in told if height is not None]
    if "roll" not in position or cg_height is None or len(heights) < len(corners):
        return None
    lever = moment = 0.0
    for corner, height in zip(corners, heights, strict=True):
        mass = 2 * corner.axle.corner_mass
        lever += mass / 2 * (cg_height - height)
        moment += mass / 2 * (cg_height if not topology.sprung_wheels else cg_height - height)
        lift = corner.side * mass * height / corner.axle.track
        if lift == 0.0:
            continue
        if topology.sprung_wheels:  # on the wheel only; its reaction is in the body's moment
            builder.motor_on(corner.name("link"), corner.name("tyre"), "lateral_acceleration", -lift)
        else:  # between wheel and body, so that the road's push includes it
            builder.motor_on(corner.name("link"), corner.name("spring"), "lateral_acceleration", lift)
            builder.add_terms("wheel_load", corner.station, ("actuator_force", corner.name("link"), -1.0))
    builder.force("overturning", Overturning(moment=lever * GRAVITY), position["roll"])
    builder.motor("roll_moment", position["roll"], "lateral_acceleration", moment)
    return lever


def add_longitudinal(
    builder: ModelBuilder, topology: Topology, cg_height: float | None, mass: Mass, position: dict[str, Form]
) -> None:
    """Longitudinal acceleration a_x of the sprung mass (positive forward): pitch moment ``- m a_x h`` over the ground.

    The axles transmit it without anti-dive or anti-squat; those belong to a model with wheel paths.
    """
    if "pitch" in position and topology.axles == 2 and cg_height is not None:
        builder.motor("pitch_moment", position["pitch"], "longitudinal_acceleration", -mass.mass * cg_height)


def add_seat(builder: ModelBuilder, seat: Sequence[float] | None, mass: Mass, position: dict[str, Form]) -> None:
    """Vertical acceleration at the driver's seat, in models of the whole body."""
    if seat is not None and "pitch" in position and "roll" in position:
        point = height_at(position, seat[0] - mass.x, seat[1] - mass.y)
        builder.output("seat_acceleration", "", *point.terms("qacc", "input"))


def add_rig(builder: ModelBuilder, rig: str, position: dict[str, Form], mass: Mass) -> None:
    """A servo on the body's roll whose target is an input."""
    if rig != "roll" or "roll" not in position:
        raise InputError(f"no rig '{rig}' for this model; the rig 'roll' needs a model with roll", key="rig")
    damping = 1.4 * mass.roll_inertia * _RIG_FREQUENCY
    servo = SpringDamper(stiffness=mass.roll_inertia * _RIG_FREQUENCY**2, damping=damping)
    builder.force("roll_rig", servo, position["roll"])
    builder.drive("roll_target", "roll_rig", -1.0)
    builder.output("rig_moment", "", ("actuator_force", "roll_rig", 1.0))
