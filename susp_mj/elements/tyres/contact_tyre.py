"""What every tyre of the handling car has in common: forces and moments of the contact from slip, camber and load."""

from __future__ import annotations

import zlib
from abc import ABC, abstractmethod
from collections.abc import Callable, MutableSequence
from dataclasses import dataclass
from typing import Annotated, Any, ClassVar, Literal, NamedTuple, Self

from ...description import Description
from ...units import PositiveLength, Quantity, Stiffness
from ..law import LAW_TABLE_SIZE, Parameters

Side = Literal["LEFT", "RIGHT"]
VerticalDamping = Annotated[float, Quantity("N s/m", ge=0)]
ContactFunction = Callable[[float, float, float, float, float, float, float, Parameters, MutableSequence[float]], None]


class ContactForces(NamedTuple):
    """What a contact law writes, in its order. Axes ISO-W: x forward in the wheel plane, y left, z up out of the road.

    Attributes:
        longitudinal_force, lateral_force: F_x, F_y [N] of the road on the tyre.
        overturning_moment: M_x [N m], positive left side up.
        rolling_moment: M_y [N m] of rolling resistance alone, negative rolling forwards.
        aligning_moment: M_z [N m], positive to the left.
        longitudinal_relaxation, lateral_relaxation: sigma_x, sigma_y [m].
        rolling_radius: R_e [m].
    """

    longitudinal_force: float
    lateral_force: float
    overturning_moment: float
    rolling_moment: float
    aligning_moment: float
    longitudinal_relaxation: float
    lateral_relaxation: float
    rolling_radius: float


@dataclass(frozen=True)
class ContactLaw:
    """Contact law of a tyre: a plain scalar function that runs in Python as it stands and compiled inside the car.

        contact(kappa, tan_alpha, camber, load, rolling, lateral, friction, p, out) -> None

    with the slips kappa and tan alpha [1] (lagged ones, see `slip`; a driven wheel has kappa > 0, a tyre that drifts to
    the left alpha > 0 and F_y < 0), camber [rad] (positive: the wheel leans to the right), load F_z [N], velocity of
    the contact point forwards ``rolling`` V_x and to the left ``lateral`` V_y [m/s], and the road's ``friction`` [1], a
    factor on the friction of the measurement. It writes ``out[0..7]`` in the order of `ContactForces`, at zero load no
    force and no moment, and divides by no speed.

    Attributes:
        name: unique; the number that stands for the law in compiled code is derived from it.
        contact: the function. It sees `p` and `out` as something that only ``[i]`` works on, may use `math` and
            helper functions of its own module, and nothing else: that lets numba compile it unchanged.
    """

    name: str
    contact: ContactFunction

    @property
    def number(self) -> int:
        """Identity of the law, 1..4095, derived from its name and thus the same on every machine."""
        return zlib.crc32(self.name.encode()) % (LAW_TABLE_SIZE - 1) + 1


class ContactTyre(Description, ABC):
    """Description of a tyre with slip; `law` turns `parameters()` into forces and moments.

    A subclass provides its `kind` as a `Literal`, the class attribute `law` and `parameters`.

    Attributes:
        radius: R_0 [m], unloaded.
        vertical_stiffness: C_z [N/m] of the tyre on the road.
        vertical_damping: D_z [N s/m] of the tyre on the road.
    """

    law: ClassVar[ContactLaw]

    kind: str
    radius: PositiveLength
    vertical_stiffness: Stiffness
    vertical_damping: VerticalDamping = 0.0

    @abstractmethod
    def parameters(self) -> tuple[float, ...]:
        """Numbers handed to the law, SI, in the law's own order."""

    def mounted(self, side: Side) -> Self:
        """The same tyre on a side of the car; mirrored where it was measured on the other one."""
        del side
        return self

    def evaluate(
        self,
        kappa: float = 0.0,
        tan_alpha: float = 0.0,
        camber: float = 0.0,
        load: float = 0.0,
        rolling: float = 20.0,
        lateral: float = 0.0,
        friction: float = 1.0,
    ) -> ContactForces:
        """Forces and moments of the law, in Python; arguments as in `ContactLaw`."""
        out: Any = [0.0] * len(ContactForces._fields)
        self.law.contact(kappa, tan_alpha, camber, load, rolling, lateral, friction, self.parameters(), out)
        return ContactForces(*out)
