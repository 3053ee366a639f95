"""Measured or recorded signals, read from CSV, NetCDF (runs of our own among them) or MDF4."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np

from .errors import InputError, choices, short
from .units import unit_factor

STANDARD_GRAVITY = 9.80665
"""What ``g`` stands for as the unit of an acceleration [m/s²]; elsewhere it is a gram."""
FORMATS = (".csv", ".txt", ".nc", ".mf4")
"""Endings of the files that can be read."""
_TIMES = ("time", "t", "zeit", "timestamps")
_HEADING = re.compile(r"^(.*?)\s*(?:\[([^\]]*)\]|\(([^)]*)\))?$")


@dataclass(frozen=True, eq=False)
class Signal:
    """One signal as its file has it.

    Attributes:
        time: (n,) [s], increasing, not always evenly.
        values: (n,) in `unit`.
        unit: as written; empty if the file names none.
    """

    time: np.ndarray
    values: np.ndarray
    unit: str = ""

    def __eq__(self, other: object) -> bool:
        return (
            isinstance(other, Signal)
            and self.unit == other.unit
            and np.array_equal(self.time, other.time)
            and np.array_equal(self.values, other.values)
        )

    def __hash__(self) -> int:
        return hash((self.unit, len(self.time)))

    def si(self, unit: str, written: str | None = None) -> np.ndarray:
        """Values in the SI `unit`.

        Args:
            written: unit of the values where the file names none, or a wrong one.

        Raises:
            ValueError: no unit, an unknown one, or one of another dimension.
        """
        own = self.unit if written is None else written
        wanted = "" if unit == "1" else unit
        if not own and wanted:
            raise ValueError(f"has no unit; expected one like {wanted}")
        if own == "g" and unit_factor(wanted)[1] == unit_factor("m/s²")[1]:
            return self.values * STANDARD_GRAVITY
        factor, dimension = unit_factor(own)
        if dimension != unit_factor(wanted)[1]:
            raise ValueError(f"has the wrong unit '{own}'; expected {f'one like {wanted}' if wanted else 'none'}")
        return self.values * factor


@dataclass(frozen=True)
class Signals:
    """The signals of one file by name.

    Attributes:
        by_name: in the order of the file.
        source: name of the file.
    """

    by_name: Mapping[str, Signal]
    source: str

    def __contains__(self, name: object) -> bool:
        return name in self.by_name

    def __iter__(self) -> Iterator[str]:
        return iter(self.by_name)

    def __getitem__(self, name: str) -> Signal:
        """A signal.

        Raises:
            InputError: no such signal; the text lists those there are.
        """
        if name not in self.by_name:
            raise InputError(f"no signal '{name}'; {choices(self.by_name, name)}", source=self.source)
        return self.by_name[name]

    def si(self, name: str, unit: str, written: str | None = None) -> np.ndarray:
        """Values of a signal in the SI `unit`; `written` as in `Signal.si`.

        Raises:
            InputError: no such signal, or its unit does not fit.
        """
        try:
            return self[name].si(unit, written)
        except ValueError as error:
            raise InputError(str(error), key=name, source=self.source) from None


def read_signals(path: Path) -> Signals:
    """The signals of a file, by its ending: CSV (``.csv``, ``.txt``), NetCDF (``.nc``) or MDF4 (``.mf4``).

    A CSV file has a line of names with their units, as ``time [s], fl [mm]`` (or the units in a line of their own),
    then numbers; separated by comma, semicolon or tab. Time is the column called ``time``, ``t`` or ``Zeit``. In NetCDF
    it is the one dimension, its variable of the same name.

    Raises:
        InputError: no such file, none of these formats, or damaged; naming the line where there is one.
    """
    if not path.is_file():
        raise InputError("no such file", source=str(path))
    readers = {".csv": _csv, ".txt": _csv, ".nc": _netcdf, ".mf4": _mdf}
    reader = readers.get(path.suffix.lower())
    if reader is None:
        raise InputError(f"cannot be read by its ending '{path.suffix}'; {choices(FORMATS)}", source=path.name)
    try:
        found = reader(path)
    except OSError as error:
        raise InputError(f"cannot be read: {error.strerror or error}", source=path.name) from None
    if not found:
        raise InputError("holds no signal over time", source=path.name)
    for name, signal in found.items():
        _check(name, signal, path.name)
    return Signals(found, path.name)


def _check(name: str, signal: Signal, source: str) -> None:
    """Refuse a signal that is no function of time."""
    if len(signal.time) < 2:
        raise InputError(f"has {len(signal.time)} samples; at least 2 are needed", key=name, source=source)
    if not np.isfinite(signal.time).all():
        raise InputError("its time is not finite", key=name, source=source)
    back = np.flatnonzero(np.diff(signal.time) <= 0)
    if len(back):
        first, second = signal.time[back[0] : back[0] + 2]
        text = f"time must increase, but {second:.9g} s follows {first:.9g} s (sample {back[0] + 2})"
        raise InputError(text, key=name, source=source)
    gaps = np.flatnonzero(~np.isfinite(signal.values))
    if len(gaps):
        text = f"has {len(gaps)} values that are no numbers, the first at {signal.time[gaps[0]]:.9g} s"
        raise InputError(text, key=name, source=source)


def _timed(
    time: np.ndarray, unit: str, columns: Mapping[str, tuple[np.ndarray, str]], source: str
) -> dict[str, Signal]:
    """Signals that share a time axis; without a unit it is in seconds."""
    try:
        seconds = Signal(time, time, unit).si("s", unit or "s")
    except ValueError as error:
        raise InputError(f"time {error}", source=source) from None
    return {name: Signal(seconds, values, unit) for name, (values, unit) in columns.items()}


def _csv(path: Path) -> dict[str, Signal]:
    text = _text(path)
    lines = [(i, line) for i, line in enumerate(text.splitlines(), start=1) if line.strip() and line.strip()[0] != "#"]
    if len(lines) < 2:
        raise InputError("holds no line of names and numbers below it", source=path.name)
    separator = max(";\t,", key=lines[0][1].count)
    rows = [(i, next(csv.reader(io.StringIO(line), delimiter=separator))) for i, line in lines]
    headings = [_HEADING.match(cell.strip()) for cell in rows[0][1]]
    names = [each[1].strip() if each else "" for each in headings]
    units = [(each[2] or each[3] or "").strip() if each else "" for each in headings]
    rows = rows[1:]
    if not any(units) and not any(_is_number(cell) for cell in rows[0][1]):
        units = [cell.strip(" []()") for cell in rows[0][1]]
        rows = rows[1:]
    twice = next((name for i, name in enumerate(names) if name in names[:i]), None)
    if twice is not None:
        raise InputError(f"two columns are called '{twice}'", source=path.name)
    table = np.array([_numbers(row, len(names), line, path.name) for line, row in rows]).reshape(-1, len(names))
    at = next((i for i, name in enumerate(names) if name.lower() in _TIMES), None)
    if at is None:
        raise InputError(f"no column of time; call it 'time [s]' (there are {', '.join(names)})", source=path.name)
    columns = {name: (table[:, i], units[i]) for i, name in enumerate(names) if i != at}
    return _timed(table[:, at], units[at], columns, path.name)


def _text(path: Path) -> str:
    """Text of a file in UTF-8 or UTF-16 by its mark, else in the letters of western Europe."""
    content = path.read_bytes()
    if content[:2] in (b"\xff\xfe", b"\xfe\xff"):
        return content.decode("utf-16", errors="replace")
    if b"\0" in content:
        raise InputError("is not a text file", source=path.name)
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError:
        return content.decode("cp1252", errors="replace")


def _numbers(row: list[str], wanted: int, line: int, source: str) -> list[float]:
    if len(row) != wanted:
        raise InputError(f"has {len(row)} values, the line of names {wanted}", key=f"line {line}", source=source)
    wrong = next((cell for cell in row if cell.strip() and not _is_number(cell)), None)
    if wrong is not None:
        raise InputError(f"{short(wrong)} is not a number", key=f"line {line}", source=source)
    return [float(cell.replace(",", ".")) if cell.strip() else np.nan for cell in row]


def _is_number(cell: str) -> bool:
    """Whether a cell is a number, with a point or a comma."""
    try:
        float(cell.replace(",", "."))
    except ValueError:
        return False
    return True


def _netcdf(path: Path) -> dict[str, Signal]:
    import netCDF4

    try:
        with netCDF4.Dataset(path) as file:
            variables: Mapping[str, Any] = file.variables
            axes = [name for name, each in variables.items() if each.dimensions == (name,)]
            axis = next((name for name in axes if name.lower() in _TIMES), None)
            if axis is None:
                raise InputError("no variable 'time' over a dimension of that name", source=path.name)
            columns = {
                name: (_filled(each), str(getattr(each, "units", "")))
                for name, each in variables.items()
                if each.dimensions == (axis,) and name != axis and each.dtype != str and each.dtype.kind in "fiu"
            }
            unit = str(getattr(variables[axis], "units", ""))
            return _timed(_filled(variables[axis]), unit, columns, path.name)
    except (OSError, RuntimeError) as error:
        raise InputError(f"is not NetCDF: {error}", source=path.name) from None


def _filled(variable: Any) -> np.ndarray:
    return np.ma.filled(np.ma.asarray(variable[:], dtype=float), np.nan)


def _mdf(path: Path) -> dict[str, Signal]:
    try:
        read: Any = import_module("asammdf").MDF
    except ImportError:
        raise InputError("MDF4 needs the package asammdf: pip install 'susp_mj[mdf]'", source=path.name) from None
    found: dict[str, Signal] = {}
    try:
        with read(path) as file:
            for each in file.iter_channels(skip_master=True):
                values = np.asarray(each.samples)
                if values.ndim == 1 and values.dtype.kind in "fiu" and len(values):
                    name = each.name if each.name not in found else f"{each.name} ({each.group_index})"
                    times = np.asarray(each.timestamps, dtype=float)
                    found[name] = Signal(times, values.astype(float), str(each.unit or ""))
    except Exception as error:  # asammdf has no error of its own for a damaged file
        raise InputError(f"is not MDF4: {short(str(error))}", source=path.name) from None
    return found
