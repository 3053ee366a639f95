"""The only place that knows numba and the memory layout of MuJoCo's structs.

`install()` puts the callbacks into MuJoCo, `advance()` is the stepping loop; see docs/callbacks.md.
"""

from __future__ import annotations

from .callbacks import install, installed, uninstall
from .laws import compile_laws
from .loop import advance, attach_input, input_block

__all__ = ["advance", "attach_input", "compile_laws", "input_block", "install", "installed", "uninstall"]
