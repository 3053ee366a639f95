"""Base of manoeuvres that raise one input of the plant and hold it."""

from __future__ import annotations

from abc import abstractmethod
from typing import ClassVar

import numpy as np

from susp_mj.manoeuvre import Manoeuvre, ValueAndRate
from susp_mj.meaning import Input
from susp_mj.roads import cosine_ramp
from susp_mj.units import PositiveTime, Time


class Rise(Manoeuvre):
    """An input that rises along half a cosine and stays; `needs` holds its quantity.

    Attributes:
        start: beginning of the rise [s].
        rise_time: [s].
    """

    needs: ClassVar[tuple[str, ...]]

    start: Time = 0.2
    rise_time: PositiveTime = 0.2

    @abstractmethod
    def level(self) -> float:
        """Value at which the input stays."""

    def drive(self, place: Input, time: np.ndarray) -> ValueAndRate | None:
        if place.quantity not in self.needs:
            return None
        value, slope = cosine_ramp((time - self.start) / self.rise_time, self.level())
        return value, slope / self.rise_time
