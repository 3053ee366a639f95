"""Writing results: a file appears complete or not at all."""

from __future__ import annotations

from pathlib import Path

from susp_mj.errors import InputError


def write_text(path: str | Path, text: str) -> Path:
    """Write UTF-8 text under a temporary name, then rename; folders on the way are made.

    Raises:
        InputError: the place cannot be written.
    """
    path = Path(path)
    unfinished = path.with_name(path.name + ".part")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        unfinished.write_text(text, encoding="utf-8", newline="\n")
        unfinished.replace(path)
    except OSError as error:
        _remove(unfinished)
        raise InputError(f"cannot be written: {error.strerror or error}", source=str(path)) from None
    return path


def _remove(path: Path) -> None:
    """Take a leftover away, if the place allows."""
    try:
        path.unlink(missing_ok=True)
    except OSError:
        return
