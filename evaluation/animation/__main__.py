"""The process that draws: ``python -m evaluation.animation <folder>``; its last line says what went wrong, if
anything."""

from __future__ import annotations

import sys
from pathlib import Path

from susp_mj.errors import SuspMjError

from .film import film

if __name__ == "__main__":
    try:
        film(Path(sys.argv[1]))
    except SuspMjError as error:
        print(f"failed {error}")
        raise SystemExit(1) from None
