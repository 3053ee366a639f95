"""Identity of the compiled code's sources.

numba's disk cache looks at the file of the outermost function only; this number goes into every function that calls
code of other files, so that a change in one of them is never missed.
"""

from __future__ import annotations

import zlib
from pathlib import Path

_PACKAGE = Path(__file__).parent.parent
_PLACES = ("compiled/**/*.py", "elements/**/*.py", "handling/**/*.py", "roads.py")


def _identity() -> int:
    files = sorted(path for place in _PLACES for path in _PACKAGE.glob(place))
    return zlib.crc32(b"".join(path.read_bytes() for path in files)) | 1


SOURCES = _identity()
