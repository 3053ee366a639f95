"""Writing results: a file appears complete or not at all."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from .errors import InputError


@contextmanager
def whole(path: str | Path) -> Iterator[Path]:
    """A temporary name beside `path` to write to; it takes the real name at the end, or goes if anything fails.

    Folders on the way are made.

    Raises:
        InputError: the place cannot be written.
    """
    path = Path(path)
    if not path.name or (path.exists() and not path.is_file()):
        raise InputError("cannot be written: it is not a file", source=str(path))
    unfinished = path.with_name(path.name + ".part")
    done = False
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        yield unfinished
        unfinished.replace(path)
        done = True
    except OSError as error:
        raise InputError(f"cannot be written: {error.strerror or error}", source=str(path)) from None
    finally:
        if not done:
            with contextlib.suppress(OSError):
                unfinished.unlink()


def file_name(label: str) -> str:
    """A label as a file name: letters, digits, dot, dash and underscore stay."""
    return "".join(letter if letter.isalnum() or letter in "._-" else "_" for letter in label)


def write_text(path: str | Path, text: str) -> Path:
    """Write a UTF-8 text file, complete or not at all.

    Raises:
        InputError: the place cannot be written.
    """
    with whole(path) as unfinished:
        unfinished.write_text(text, encoding="utf-8", newline="\n")
    return Path(path)
