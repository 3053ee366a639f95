"""The table ``[validation]`` of a case file: which measured column is which channel, and how they are compared."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field, model_validator

from susp_mj.description import Description, one_of, wrong
from susp_mj.errors import InputError
from susp_mj.units import PositiveTime, to_si

from .filters import filter_of
from .standards import STANDARDS, Allowed

CORRELATION, NONE = "correlation", "none"


def in_si(value: float | str, unit: str, key: str) -> float:
    """A value of the user in SI `unit`.

    Raises:
        InputError: it has another unit.
    """
    try:
        return to_si(value, "" if unit == "1" else unit)
    except ValueError as error:
        raise InputError(str(error), key=key, source="validation") from None


class Tolerance(Description):
    """Half the width of the band in which a simulated value must lie, see `judgement.judge`.

    Attributes:
        offset: in the unit of the channel.
        gain: share of the measured value; over time, of its largest.
        along: of the abscissa: a time, or a value in the unit of `over`.
    """

    offset: float | str = 0.0
    gain: Annotated[float, Field(ge=0, le=1)] = 0.0
    along: float | str = 0.0

    def allowed(self, unit: str, along: str) -> Allowed:
        """In SI units, those of the channel and of the abscissa."""
        offset, wide = in_si(self.offset, unit, "tolerance.offset"), in_si(self.along, along, "tolerance.along")
        if min(offset, wide) < 0:
            raise InputError("a tolerance is not negative", key="tolerance", source="validation")
        return Allowed(offset, self.gain, wide, given=True)


class MeasuredSignal(Description):
    """A measured column and the channel that it measures.

    Attributes:
        channel: name as `evaluation.channels.channel_of` takes it: ``roll_angle``, ``fl suspension_deflection``.
        column: its name in the measurement; by default the channel's.
        unit: of the column, where its file does not say, or says it wrong.
        factor: on the measured values, -1 for the other sign, say.
        subtract: taken off them then, in the unit of the channel.
        tolerance: by default that of the standard.
    """

    channel: str
    column: str | None = None
    unit: str | None = None
    factor: float = 1.0
    subtract: float | str = 0.0
    tolerance: Tolerance | None = None


class Validation(Description):
    """How measurements are compared with a run.

    Attributes:
        standard: a key of `STANDARDS`; by default ISO 19364 where there is something to draw `over`, else table 6.3.
        signal: what is compared; without any, every column that is called like a channel.
        over: abscissa of a comparison that is not over time; by default the lateral acceleration.
        at: where it is compared, in the unit of `over`; by default at round values.
        within: up to how far from each of these points a value is averaged; by default a quarter of their distance.
        filter: of both, as `filters.filter_of` takes it; empty is none.
        shift: added to the measured time: a time, ``correlation``, or ``none``.
        window: largest shift that correlation looks for.
        confidence: of the mean of several measurements.
    """

    standard: Annotated[str, one_of(STANDARDS)] | None = None
    signal: tuple[MeasuredSignal, ...] = ()
    over: MeasuredSignal | None = None
    at: tuple[float | str, ...] = ()
    within: float | str | None = None
    filter: str = ""
    shift: float | str = CORRELATION
    window: PositiveTime = 0.5
    confidence: Annotated[float, Field(gt=0, lt=1)] = 0.95

    @model_validator(mode="after")
    def _sound(self) -> Validation:
        try:
            filter_of(self.filter)
        except ValueError as error:
            raise wrong(str(error), "filter") from None
        if self.shift not in (CORRELATION, NONE):
            try:
                to_si(self.shift, "s")
            except ValueError as error:
                raise wrong(f"{error}, or '{CORRELATION}' or '{NONE}'", "shift") from None
        if self.over is not None and not STANDARDS[self.compared_by].crossed:
            raise wrong(f"{self.compared_by} compares over time", "over")
        return self

    @property
    def compared_by(self) -> str:
        """The standard that holds."""
        return self.standard or ("table_6_3" if self.over is None else "iso_19364")
