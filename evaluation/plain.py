"""Values as plain JSON values."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import fields, is_dataclass
from typing import Any

import numpy as np


def plain(value: Any) -> Any:
    """The same as plain JSON values: a dataclass becomes the mapping of its fields, a numpy number a number, a complex
    one the pair of its parts, what is not finite None.

    >>> plain({"found": (np.float64(1.5), float("nan"), 2 + 1j)})
    {'found': [1.5, None, [2.0, 1.0]]}
    """
    if isinstance(value, (np.generic, np.ndarray)):
        value = value.tolist()
    elif is_dataclass(value) and not isinstance(value, type):
        value = {each.name: getattr(value, each.name) for each in fields(value)}
    if isinstance(value, complex):
        value = (value.real, value.imag)
    if isinstance(value, Mapping):
        return {str(key): plain(each) for key, each in value.items()}
    if isinstance(value, (list, tuple)):
        return [plain(each) for each in value]
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value if isinstance(value, (str, int, float, bool, type(None))) else str(value)
