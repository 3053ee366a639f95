"""Where the user wrote what is wrong: in the case file, in the car's file, or on the command line."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from typing import Any

from susp_mj.errors import InputError
from vehicles.reading import WITH_OVERRIDES

Attempt = Callable[[Mapping[str, Any]], InputError | None]
"""The error of a configuration with other overrides than its own; None if there is none."""


def in_case(error: InputError, overrides: Mapping[str, Any], attempt: Attempt, *, key: str, source: str) -> InputError:
    """The error of a configuration as its case file sees it.

    An error without a source is about the configuration itself, its `load` say. One of the car lies in the case file if
    an override is what is wrong, or holds it; it names both files if an override makes it arise; else it lies in the
    car's file. Any other file, as that of a tyre, speaks for itself.

    Args:
        overrides: of the configuration, by dotted path.
        key: of the configuration in the case file `source`.
    """
    if not error.source:
        return error.within(key=key, source=source)
    car = error.source.removesuffix(WITH_OVERRIDES)
    if car == error.source:
        return error
    if any(f"{error.key}.".startswith(f"{path}.") for path in overrides):
        return InputError(error.message, key=f"{key}.set.{error.key}", source=source)
    alone = InputError(error.message, key=error.key, source=car)
    path = _first_with(error, overrides, attempt)
    return alone if path is None else InputError(f"laid over {alone}", key=f"{key}.set.{path}", source=source)


def _first_with(error: InputError, overrides: Mapping[str, Any], attempt: Attempt) -> str | None:
    """The override with which an error arises when they are laid on one after the other; None if it needs none."""
    laid = list(overrides.items())
    for count, path in enumerate((None, *overrides)):
        met = attempt(dict(laid[:count]))
        if met is not None and met.key == error.key:
            return path
    return None


_OPTION = re.compile(r"(?:manoeuvre\.|configuration\.\d+\.|(?=(?:model|vehicle|workers)$))(\w+)")
"""Keys of the case of a manoeuvre script that stand for one of its options."""


def on_command_line(error: InputError) -> InputError:
    """The error of a manoeuvre script, its key the option where it is one of the case that the script made up."""
    option = _OPTION.match(error.key) if not error.source or error.source.endswith(".py") else None
    return error if option is None else InputError(error.message, key=f"--{option[1].replace('_', '-')}")
