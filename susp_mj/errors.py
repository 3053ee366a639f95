"""Every error that susp_mj raises on purpose: one line that names the culprit, the place and the choices."""

from __future__ import annotations

import difflib
import reprlib
from collections.abc import Callable, Iterable
from pathlib import Path
from types import CodeType
from typing import Any


class SuspMjError(Exception):
    """Base class; the command line prints its text as one line and never a traceback."""


class InputError(SuspMjError):
    """Something the user wrote is wrong.

    Args:
        message: what is wrong and what is allowed.
        key: dotted path of the value inside its file or call, e.g. ``rear.spring.kind``.
        source: file (or object) that holds it, e.g. ``chapter3.toml``.
    """

    def __init__(self, message: str, *, key: str = "", source: str = "") -> None:
        self.message, self.key, self.source = message, key, source
        text = ": ".join(part for part in (source, key, message) if part)
        super().__init__("".join(letter if letter.isprintable() else repr(letter)[1:-1] for letter in text))

    def within(self, *, key: str = "", source: str = "") -> InputError:
        """The same error seen from one level further out: `key` is put in front, `source` filled in if unknown."""
        path = ".".join(part for part in (key, self.key) if part)
        return InputError(self.message, key=path, source=self.source or source)


class SimulationError(SuspMjError):
    """A run could not be completed: it diverged, or no equilibrium exists."""


class CallbackError(SuspMjError):
    """The compiled callbacks do not fit this MuJoCo, or another program's callbacks are in their place."""


def place_of(function: Callable[..., Any]) -> str:
    """Where a function is written, and its name: ``mine.py, line 12, in jerk_max``."""
    code = getattr(getattr(function, "__func__", function), "__code__", None)
    return place_in(code, code.co_firstlineno) if isinstance(code, CodeType) else repr(function)


def wrong_answer(function: Callable[..., Any], given: str, wanted: str) -> InputError:
    """Error of a function of a user's own that gives something else than what is wanted of it."""
    return InputError(f"gives {given}, not {wanted}", source=place_of(function))


def short(value: object) -> str:
    """A value that may be long or large, on one short line."""
    return " ".join(reprlib.repr(value).split())


def place_in(code: CodeType, line: int) -> str:
    """A line of a function's code, in the same words."""
    name = code.co_qualname if hasattr(code, "co_qualname") else code.co_name
    within = "" if name == "<module>" else f", in {name.replace('<locals>.', '')}"
    return f"{Path(code.co_filename).name}, line {line}{within}"


FEW, NEAREST = 12, 8
"""An error lists so many options; of a longer list the nearest ones."""


def choices(options: Iterable[object], wrong: object = None) -> str:
    """List the options for an error text, the nearest one first; of a long list only those that are near.

    >>> choices(["spring", "damper"], "dampr")
    "did you mean 'damper'? choose spring, damper"
    >>> choices(range(100), 42)
    "did you mean '42'? choose 42, 4, 2, 94, 92, 84, 82, 74, … (8 of 100)"
    """
    names = [str(option) for option in options]
    near = difflib.get_close_matches(str(wrong), names, n=1) if wrong is not None else []
    hint = f"did you mean '{near[0]}'? " if near else ""
    if len(names) <= FEW:
        return f"{hint}choose {', '.join(names)}"
    listed = names[:NEAREST] if wrong is None else difflib.get_close_matches(str(wrong), names, n=NEAREST, cutoff=0.0)
    return f"{hint}choose {', '.join(listed)}, … ({len(listed)} of {len(names)})"
