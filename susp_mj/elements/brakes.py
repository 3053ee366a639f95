"""Service brakes."""

from __future__ import annotations

from typing import Annotated

from ..description import Description
from ..units import Quantity


class Brakes(Description):
    """Brakes whose torque is proportional to the pedal, with a fixed distribution; both wheels of an axle brake alike.

    A front wheel gets ``pedal * torque * front_share / 2``, against its turning.

    Attributes:
        torque: sum over all wheels [N m] at full pedal.
        front_share: share of the front axle, 0 to 1.
    """

    torque: Annotated[float, Quantity("N m", gt=0)]
    front_share: Annotated[float, Quantity("", ge=0, le=1)]
