"""Summary of a comparison as JSON, for other programs."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from susp_mj.files import write_text

if TYPE_CHECKING:
    from ..compare import Comparison


def write_summary(comparison: Comparison, path: str | Path, extra: Mapping[str, Any] | None = None) -> Path:
    """Write ``{"title", "configurations", "claims", "passed", **extra}`` as strict JSON; what is not finite becomes
    null.

    Raises:
        InputError: the place cannot be written.
    """
    summary = {
        "title": comparison.title,
        "configurations": comparison.summary(),
        "claims": [claim.plain() for claim in comparison.claims],
        "passed": comparison.passed,
        **(extra or {}),
    }
    return write_json(summary, path)


def write_json(value: Any, path: str | Path) -> Path:
    """Write a value as strict JSON; what is not finite becomes null.

    Raises:
        InputError: the place cannot be written.
    """
    return write_text(path, json.dumps(_plain(value), indent=2, ensure_ascii=False, allow_nan=False) + "\n")


def _plain(value: Any) -> Any:
    """The same as plain JSON values; numpy numbers become numbers, what is not finite None."""
    if isinstance(value, Mapping):
        return {str(key): _plain(each) for key, each in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(each) for each in value]
    if isinstance(value, (np.generic, np.ndarray)):
        return _plain(value.tolist())
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value if isinstance(value, (str, int, float, bool, type(None))) else str(value)
