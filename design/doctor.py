"""Examine the machine: MuJoCo and its callbacks, rendering, ffmpeg; each finding with its fix."""

from __future__ import annotations

import os
import platform
import tempfile
from collections.abc import Callable
from dataclasses import dataclass

from susp_mj.errors import SuspMjError


@dataclass(frozen=True)
class Finding:
    """One thing examined: what was found, and what to do about it (None if all is well)."""

    name: str
    found: str
    fix: str | None = None


def examine() -> list[Finding]:
    """Everything susp_mj needs, in the order it needs it."""
    checks: tuple[Callable[[], Finding], ...] = (_python, _mujoco, _callbacks, _compiler_cache, _rendering, _ffmpeg)
    return [check() for check in checks]


def _python() -> Finding:
    return Finding("Python", platform.python_version())


def _mujoco() -> Finding:
    try:
        import mujoco
    except (ImportError, AttributeError, OSError) as error:
        return Finding("MuJoCo", f"does not import: {error}", "unset MUJOCO_GL; pip install 'mujoco>=4.0,<4.1'")
    fix = None if mujoco.__version__.startswith("4.0") else "pip install 'mujoco>=4.0,<4.1'"
    return Finding("MuJoCo", mujoco.__version__, fix)


def _callbacks() -> Finding:
    try:
        from susp_mj.compiled import install

        install()
    except (SuspMjError, ImportError) as error:
        return Finding("compiled callbacks", str(error), "pip install --force-reinstall numba 'mujoco>=4.0,<4.1'")
    return Finding("compiled callbacks", "struct layout checked, laws compiled, installed")


def _compiler_cache() -> Finding:
    from pathlib import Path

    import susp_mj

    folder = os.environ.get("NUMBA_CACHE_DIR") or str(Path(susp_mj.__file__).parent)
    try:
        with tempfile.TemporaryFile(dir=folder):
            return Finding("compiler cache", folder)
    except OSError:
        home = Path.home()
        if os.access(home, os.W_OK):
            return Finding("compiler cache", f"{folder} is read-only; numba uses your home folder")
        fix = "set NUMBA_CACHE_DIR to a folder you can write, else every start compiles anew"
        return Finding("compiler cache", f"{folder} is read-only", fix)


def _rendering() -> Finding:
    from evaluation.animation.render import can_render

    obstacle = can_render()
    return Finding("offscreen rendering", "works" if obstacle is None else "not available", obstacle)


def _ffmpeg() -> Finding:
    from evaluation.animation.video import NO_FFMPEG, ffmpeg_program

    program = ffmpeg_program()
    return Finding("ffmpeg", program or "not found", None if program else NO_FFMPEG)
