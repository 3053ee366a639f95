"""Values given to the functions of this package: SI numbers or texts with a unit, refused in one line."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from ..errors import InputError
from ..units import to_si


def positive(value: Any, unit: str, key: str) -> float:
    """A value in SI `unit` above 0.

    Raises:
        InputError: naming `key`.
    """
    try:
        number = to_si(value, unit)
    except ValueError as error:
        raise InputError(str(error), key=key) from None
    if number <= 0:
        raise InputError(f"{value!r} is not allowed; it must be greater than 0", key=key)
    return number


def positives(values: Any, unit: str, key: str, count: int | None = None) -> list[float]:
    """A list of values above 0; one value stands for `count` equal ones.

    Raises:
        InputError: naming `key` and the place in the list.
    """
    if isinstance(values, str) or not isinstance(values, Sequence):
        return [positive(values, unit, key)] * (count or 1)
    if not values or (count is not None and len(values) != count):
        raise InputError(f"{len(values)} values are not allowed; give {count or 'one or more'}", key=key)
    return [positive(value, unit, f"{key}.{i}") for i, value in enumerate(values)]
