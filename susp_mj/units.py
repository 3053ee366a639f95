"""Quantities as users write them: a number is SI, a text carries its unit (``"27 N/mm"``, ``"1.2 Hz"``, ``"50 km/h"``).

Each type below is an annotated `float` for pydantic models; its metadata holds the SI unit, which also labels reports.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from typing import Annotated, Any, get_args

from pydantic import GetCoreSchemaHandler
from pydantic.fields import FieldInfo
from pydantic_core import PydanticCustomError, core_schema

# unit -> (factor to SI, exponents of metre, kilogram, second, radian)
_UNITS: dict[str, tuple[float, tuple[int, int, int, int]]] = {
    "": (1.0, (0, 0, 0, 0)),
    "1": (1.0, (0, 0, 0, 0)),
    "%": (0.01, (0, 0, 0, 0)),
    "m": (1.0, (1, 0, 0, 0)),
    "metre": (1.0, (1, 0, 0, 0)),  # of a length along the road, which is shown in metres, not millimetres
    "cm": (1e-2, (1, 0, 0, 0)),
    "mm": (1e-3, (1, 0, 0, 0)),
    "km": (1e3, (1, 0, 0, 0)),
    "l": (1e-3, (3, 0, 0, 0)),
    "kg": (1.0, (0, 1, 0, 0)),
    "g": (1e-3, (0, 1, 0, 0)),
    "t": (1e3, (0, 1, 0, 0)),
    "s": (1.0, (0, 0, 1, 0)),
    "ms": (1e-3, (0, 0, 1, 0)),
    "min": (60.0, (0, 0, 1, 0)),
    "h": (3600.0, (0, 0, 1, 0)),
    "Hz": (1.0, (0, 0, -1, 0)),
    "rpm": (math.tau / 60, (0, 0, -1, 1)),
    "rad": (1.0, (0, 0, 0, 1)),
    "deg": (math.pi / 180, (0, 0, 0, 1)),
    "°": (math.pi / 180, (0, 0, 0, 1)),
    "N": (1.0, (1, 1, -2, 0)),
    "kN": (1e3, (1, 1, -2, 0)),
    "MN": (1e6, (1, 1, -2, 0)),
    "Nm": (1.0, (2, 1, -2, 0)),
    "kNm": (1e3, (2, 1, -2, 0)),
    "Ns": (1.0, (1, 1, -1, 0)),
    "kNs": (1e3, (1, 1, -1, 0)),
    "kgm": (1.0, (1, 1, 0, 0)),
    "Pa": (1.0, (-1, 1, -2, 0)),
    "kPa": (1e3, (-1, 1, -2, 0)),
    "bar": (1e5, (-1, 1, -2, 0)),
    "W": (1.0, (2, 1, -3, 0)),
    "kW": (1e3, (2, 1, -3, 0)),
}
GRAVITY = 9.81
"""[m/s²]; the value of the thesis."""
LARGEST = 1e15
"""Largest magnitude of any quantity, in SI units."""
_SUPERSCRIPT = str.maketrans({"²": "^2", "³": "^3", "·": " ", "*": " ", "−": "-"})
_NUMBER = re.compile(r"^\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*(.*?)\s*$")
_PER_MINUTE = re.compile(r"^(1/min|min\^?-1|min⁻¹)$")
_FACTOR = re.compile(r"^([A-Za-z°%1]*?)(?:\^?(-?\d))?$")


def unit_factor(text: str) -> tuple[float, tuple[int, ...]]:
    """Factor to SI and dimension exponents (m, kg, s, rad) of a unit such as ``N s/m`` or ``kg m²``.

    Raises:
        ValueError: the unit is unknown.
    """
    factor, exponents = 1.0, [0, 0, 0, 0]
    for side, part in enumerate(text.translate(_SUPERSCRIPT).split("/")):
        sign = 1 if side == 0 else -1
        for word in part.replace("(", " ").replace(")", " ").split():
            match = _FACTOR.match(word)
            if match is None or match[1] not in _UNITS:
                raise ValueError(f"unknown unit '{word}'")
            power = sign * int(match[2] or 1)
            scale, dimension = _UNITS[match[1]]
            factor *= scale**power
            exponents = [e + power * d for e, d in zip(exponents, dimension, strict=True)]
    return factor, tuple(exponents)


def to_si(value: Any, unit: str) -> float:
    """Read `value` as a quantity of the dimension of `unit` [any SI unit text]; a bare number is taken as SI.

    >>> to_si("27 N/mm", "N/m")
    27000.0
    >>> to_si(50, "m/s")
    50.0

    Revolutions per minute may be written ``1/min`` where an angular speed is asked for:

    >>> round(to_si("3000 1/min", "rad/s"), 3)
    314.159

    Raises:
        ValueError: not a number, no unit on a text, an unknown unit, another dimension, NaN or infinite.
    """
    if isinstance(value, bool) or not isinstance(value, (int, float, str)):
        raise ValueError(  # noqa: TRY004 - one kind of error for everything a user can write
            f"{value!r} is not a quantity; write a number in {unit or 'plain form'} or a text like '1 {unit}'"
        )
    if isinstance(value, str):
        match = _NUMBER.match(value)
        if match is None:
            raise ValueError(f"'{value}' is not a number with a unit; write it like '1 {unit}'")
        if not match[2] and unit:
            raise ValueError(f"'{value}' has no unit; write '{value} {unit}' or the bare number {value}")
        written = "rpm" if _PER_MINUTE.match(match[2]) and unit_factor(unit)[1] == unit_factor("rpm")[1] else match[2]
        try:
            factor, dimension = unit_factor(written)
        except ValueError as error:
            raise ValueError(f"'{value}': {error}; expected a unit like {unit or 'none'}") from None
        if dimension != unit_factor(unit)[1]:
            raise ValueError(f"'{value}' has the wrong unit; expected one like {unit or 'none'}")
        number = float(match[1]) * factor
    else:
        number = float(value) if abs(value) < LARGEST or not isinstance(value, int) else math.inf
    if not math.isfinite(number):
        raise ValueError(f"{str(value)[:40]} is not a finite number")
    if abs(number) > LARGEST:
        raise ValueError(f"{str(value)[:40]} is beyond anything a car has; at most {LARGEST:g} {unit}".rstrip())
    return number


_READABLE = {"m": ("mm",), "rad": ("deg",), "m/s": ("km/h",), "rad/s": ("deg/s",), "s": ("ms",)}
"""SI unit -> units in which its values may be written shorter."""


def readable(value: float, unit: str) -> str:
    """A value in SI `unit` as a case file would have it, in the unit in which it is short; `to_si` reads it back.

    >>> readable(0.06, "m"), readable(2.0, "m"), readable(50 / 3.6, "m/s"), readable(math.radians(85), "rad")
    ('60 mm', '2 m', '50 km/h', '85 deg')
    """
    texts = [f"{value / unit_factor(each)[0]:.10g} {each}".strip() for each in (unit, *_READABLE.get(unit, ()))]
    return min(texts, key=len)


@dataclass(frozen=True)
class Quantity:
    """Pydantic annotation of a float held in SI `unit`, with optional bounds: ``Annotated[float, Quantity("m",
    gt=0)]``."""

    unit: str
    gt: float | None = None
    ge: float | None = None
    lt: float | None = None
    le: float | None = None

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> core_schema.CoreSchema:
        """Read the text or number first, then check the bounds."""
        number = core_schema.float_schema(allow_inf_nan=False, gt=self.gt, ge=self.ge, lt=self.lt, le=self.le)
        return core_schema.no_info_before_validator_function(self._read, number)

    def _read(self, value: Any) -> float:
        try:
            return to_si(value, self.unit)
        except ValueError as error:
            raise PydanticCustomError("quantity", "{text}", {"text": str(error)}) from None


def unit_of(metadata: Any) -> str:
    """SI unit symbol in a pydantic field's metadata, or an empty text."""
    return next((item.unit for item in metadata if isinstance(item, Quantity)), "")


def unit_of_field(field: FieldInfo) -> str:
    """SI unit symbol of a field, which may be optional; an empty text if it has none."""
    inside = (item for part in get_args(field.annotation) for item in getattr(part, "__metadata__", ()))
    return unit_of((*field.metadata, *inside))


Angle = Annotated[float, Quantity("rad")]
AngularSpeed = Annotated[float, Quantity("rad/s", gt=0)]
Moment = Annotated[float, Quantity("N m")]
Length = Annotated[float, Quantity("m")]
PositiveLength = Annotated[float, Quantity("m", gt=0)]
Mass = Annotated[float, Quantity("kg", ge=1e-6)]
Inertia = Annotated[float, Quantity("kg m²", gt=0)]
Force = Annotated[float, Quantity("N")]
NonNegativeForce = Annotated[float, Quantity("N", ge=0)]
PositiveForce = Annotated[float, Quantity("N", gt=0)]
Stiffness = Annotated[float, Quantity("N/m", gt=0)]
NonNegativeStiffness = Annotated[float, Quantity("N/m", ge=0)]
Damping = Annotated[float, Quantity("N s/m", gt=0)]
Acceleration = Annotated[float, Quantity("m/s²")]
NonNegativeLength = Annotated[float, Quantity("m", ge=0)]
Frequency = Annotated[float, Quantity("Hz", gt=0, le=500)]
NaturalFrequency = Annotated[float, Quantity("Hz", gt=0, le=20)]
Speed = Annotated[float, Quantity("m/s")]
PositiveSpeed = Annotated[float, Quantity("m/s", gt=0)]
Time = Annotated[float, Quantity("s", ge=0)]
PositiveTime = Annotated[float, Quantity("s", gt=0)]
Dimensionless = Annotated[float, Quantity("")]
