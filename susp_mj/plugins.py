"""Plugins: a user's own Python files, which register elements, manoeuvres, numbers or cameras before they are needed.

A case or vehicle file names them by `plugins`; an installed package by an entry point of group `susp_mj.plugins`. Each
is run once in a process.
"""

from __future__ import annotations

import functools
import sys
import traceback
import zlib
from importlib.metadata import entry_points
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from types import ModuleType
from typing import Any

from .errors import InputError, SuspMjError, place_in

GROUP = "susp_mj.plugins"
_FILES: set[str] = set()
"""Files of the plugins of this process, as their code names them."""


def plugin_files() -> list[Path]:
    """Files of the plugins that this process has run."""
    return [Path(each) for each in sorted(_FILES)]


def load_plugins(names: Any, path: Path) -> None:
    """Run the plugins that a file names, after the installed ones.

    Args:
        names: value of the file's `plugins`: paths relative to it.
        path: of the file.

    Raises:
        InputError: the value is no list of files, there is no such file, or a plugin fails; with the line in it.
    """
    load_installed()
    if not isinstance(names, (list, tuple)) or not all(isinstance(name, str) for name in names):
        raise InputError(f"{names!r} is not allowed; give a list of Python files", key="plugins", source=path.name)
    for i, name in enumerate(names):
        try:
            load_plugin(path.parent / name)
        except InputError as error:
            raise InputError(str(error), key=f"plugins.{i}", source=path.name) from error


def load_plugin(path: Path) -> None:
    """Run one plugin, unless a module of this process comes from the same file.

    Raises:
        InputError: there is no such file, or it fails; with the line in it.
    """
    path = path.resolve()
    if not path.is_file():
        raise InputError("no such file", source=str(path))
    _FILES.add(str(path))
    if _is_loaded(path):
        return
    spec = spec_from_file_location(f"susp_mj_plugin_{path.stem}_{zlib.crc32(bytes(path)):08x}", path)
    if spec is None or spec.loader is None:
        raise InputError("is not a Python file (.py)", source=path.name)
    module = sys.modules[spec.name] = module_from_spec(spec)
    try:
        spec.loader.exec_module(module)
    except (Exception, SystemExit) as error:
        del sys.modules[spec.name]
        raise InputError(_reason(error), source=f"{path.name}{_line(error, path)}") from error


@functools.cache
def load_installed() -> None:
    """Run the plugins of installed packages.

    Raises:
        InputError: one fails.
    """
    for entry in entry_points(group=GROUP):
        try:
            entry.load()
            _FILES.add(str(getattr(sys.modules.get(entry.module), "__file__", "")))
        except (Exception, SystemExit) as error:
            raise InputError(_reason(error), source=f"installed plugin '{entry.name}' ({entry.value})") from error


def blamed(error: BaseException) -> str | None:
    """An error that arose in a plugin's code after it was loaded, as one line with its place; None if it did not."""
    frames = [
        (frame.f_code, line)
        for frame, line in traceback.walk_tb(error.__traceback__)
        if frame.f_code.co_filename in _FILES
    ]
    return f"{place_in(*frames[-1])}: {_reason(error)}" if frames else None


def _is_loaded(path: Path) -> bool:
    files = [module.__dict__.get("__file__") for module in list(sys.modules.values()) if isinstance(module, ModuleType)]
    return any(file and Path(file).name == path.name and Path(file).resolve() == path for file in files)


def _reason(error: BaseException) -> str:
    """An error as one line; what we raise on purpose speaks for itself."""
    text = " ".join(str(error.msg if isinstance(error, SyntaxError) else error).split())
    return text if isinstance(error, SuspMjError) else f"{type(error).__name__}: {text}"


def _line(error: BaseException, path: Path) -> str:
    """Where in a file an error arose, as ``, line 12``; empty if the file was not even begun."""
    if isinstance(error, SyntaxError) and error.filename == str(path):
        return f", line {error.lineno}"
    lines = [frame.lineno for frame in traceback.extract_tb(error.__traceback__) if frame.filename == str(path)]
    return f", line {lines[-1]}" if lines else ""
