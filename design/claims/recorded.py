"""Wheel centres as a run recorded them, as a manoeuvre for models without tyres."""

from __future__ import annotations

from typing import Any, ClassVar, Literal

import numpy as np
from pydantic import PrivateAttr

from susp_mj.manoeuvre import Manoeuvre, ValueAndRate
from susp_mj.meaning import Input
from susp_mj.run import Run
from susp_mj.units import PositiveTime


class RecordedWheels(Manoeuvre):
    """The road under each wheel moves as a recorded wheel centre did; between records a cubic spline.

    A model of one wheel follows the left one of its axle, one of pitch the left wheels.
    """

    needs: ClassVar[tuple[str, ...]] = ("road_height",)

    kind: Literal["recorded_wheels"] = "recorded_wheels"
    duration: PositiveTime = 4.0
    _paths: dict[str, Any] = PrivateAttr(default_factory=dict)

    @classmethod
    def of(cls, run: Run, axle: str | None = None) -> RecordedWheels:
        """The wheels of a run of a whole car; `axle` is that of a model of one wheel."""
        from scipy.interpolate import CubicSpline

        paths = {
            station: CubicSpline(run.time, height - height[0])
            for station, height in run.stations("wheel_displacement").items()
        }
        made = cls(duration=float(run.time[-1]))
        made._paths = {**paths, "front": paths["fl"], "rear": paths["rl"]}
        if axle is not None:
            made._paths[""] = paths[f"{axle[0]}l"]
        return made

    def drive(self, place: Input, time: np.ndarray) -> ValueAndRate | None:
        if place.quantity != "road_height":
            return None
        path = self._paths[place.station]
        return path(time), path(time, 1)
