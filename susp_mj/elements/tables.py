"""Checks that every measured table shares: increasing arguments, equal lengths, a zero in its origin."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated, Any

from pydantic import BeforeValidator
from pydantic_core import PydanticCustomError

from ..description import wrong
from ..units import to_si

ORIGIN = 1e-9
"""Largest magnitude, in SI units, that counts as zero."""


def check_increasing(values: Sequence[float], key: str, unit: str, what: str) -> None:
    """Refuse fewer than two values, and one that does not exceed the one before it; `what` says what must increase."""
    if len(values) < 2:
        raise wrong(f"{list(values)} is not allowed; give two {what} at least", key)
    for i in range(1, len(values)):
        if values[i] <= values[i - 1]:
            raise wrong(
                f"{values[i]:g} {unit} follows {values[i - 1]:g} {unit}; {what} must increase strictly", f"{key}.{i}"
            )


def check_length(values: Sequence[object], key: str, arguments: Sequence[float], argument: str) -> None:
    """Refuse a table that has not one value for each of its arguments."""
    if len(values) != len(arguments):
        raise wrong(f"{len(values)} values are not allowed; {argument} has {len(arguments)}", key)


def origin_of(arguments: Sequence[float], key: str, unit: str) -> int:
    """Index of the argument 0, which every such table must have."""
    for i, value in enumerate(arguments):
        if abs(value) <= ORIGIN:
            return i
    raise wrong(f"{arguments[0]:g} to {arguments[-1]:g} {unit} has no point at 0; the table must have one there", key)


def check_zero(values: Sequence[float], key: str, origin: int, unit: str, argument: str) -> None:
    """Refuse a table whose value at argument 0 is not 0."""
    if abs(values[origin]) > ORIGIN:
        raise wrong(f"{values[origin]:g} {unit} is not allowed at {argument} 0; it must be 0 there", f"{key}.{origin}")


def _angles(data: Any) -> tuple[tuple[float, ...], ...]:
    if not isinstance(data, (list, tuple)):
        raise wrong(f"{data!r} is not a table; write a list of angles, or of lists of them")
    rows: list[tuple[float, ...]] = []
    for i, row in enumerate(data):
        if isinstance(row, (list, tuple)):
            rows.append(tuple(_angle(value, f"{i}.{j}") for j, value in enumerate(row)))
        else:
            rows.append((_angle(row, str(i)),))
    return tuple(rows)


def _angle(value: Any, key: str) -> float:
    try:
        return to_si(value, "rad")
    except ValueError as error:
        raise PydanticCustomError("quantity", "{text}", {"text": str(error), "key": key}) from None


AngleTable = Annotated[tuple[tuple[float, ...], ...], BeforeValidator(_angles)]
"""Angles [rad], (n, m) rows by columns; a plain list of n angles is read as n rows of one column."""
