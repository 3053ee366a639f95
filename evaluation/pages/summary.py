"""Summary of a comparison as JSON, for other programs."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from susp_mj.files import write_text

from ..plain import plain

if TYPE_CHECKING:
    from ..compare import Comparison


def write_summary(comparison: Comparison, path: str | Path, extra: Mapping[str, Any] | None = None) -> Path:
    """Write ``{"title", "configurations", "claims", "passed", **extra}`` as strict JSON, with a ``"baseline"`` where
    there is one; what is not finite becomes null.

    Raises:
        InputError: the place cannot be written.
    """
    summary = {
        "title": comparison.title,
        "configurations": comparison.summary(),
        "claims": [claim.plain() for claim in comparison.claims],
        "passed": comparison.passed,
        **({"baseline": comparison.baseline} if comparison.baseline else {}),
        **(extra or {}),
    }
    return write_json(summary, path)


def write_json(value: Any, path: str | Path) -> Path:
    """Write a value as strict JSON; what is not finite becomes null.

    Raises:
        InputError: the place cannot be written.
    """
    return write_text(path, json.dumps(plain(value), indent=2, ensure_ascii=False, allow_nan=False) + "\n")
