"""Reader of tyre property files (``.tir``): sections in brackets, ``KEY = value`` lines, comments after ``$`` or
``!``."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ...description import validate
from ...errors import InputError, choices
from ...units import unit_factor
from .magic_formula import MagicFormula, MagicFormulaTyre
from .magic_formula_61 import MagicFormula61Tyre

_UNITS: dict[str, dict[str, str]] = {
    "LENGTH": {"meter": "m", "m": "m", "cm": "cm", "mm": "mm", "millimeter": "mm", "km": "km"},
    "FORCE": {"newton": "N", "n": "N", "kilonewton": "kN", "kn": "kN"},
    "ANGLE": {"radian": "rad", "radians": "rad", "rad": "rad", "degree": "deg", "degrees": "deg", "deg": "deg"},
    "MASS": {"kg": "kg", "kilogram": "kg", "g": "g", "gram": "g", "tonne": "t"},
    "TIME": {"second": "s", "sec": "s", "s": "s", "millisecond": "ms", "ms": "ms"},
    "PRESSURE": {"pascal": "Pa", "pa": "Pa", "kpa": "kPa", "bar": "bar"},
}
_DIMENSIONS: dict[str, dict[str, int]] = {
    "UNLOADED_RADIUS": {"LENGTH": 1},
    "LONGVL": {"LENGTH": 1, "TIME": -1},
    "VERTICAL_STIFFNESS": {"FORCE": 1, "LENGTH": -1},
    "VERTICAL_DAMPING": {"FORCE": 1, "TIME": 1, "LENGTH": -1},
    **{key: {"FORCE": 1, "LENGTH": -1} for key in ("LONGITUDINAL_STIFFNESS", "LATERAL_STIFFNESS")},
    **{key: {"FORCE": 1} for key in ("FNOMIN", "FZMIN", "FZMAX")},
    **{key: {"PRESSURE": 1} for key in ("INFLPRES", "NOMPRES", "PRESMIN", "PRESMAX")},
    **{key: {"ANGLE": 1} for key in ("ALPMIN", "ALPMAX", "CAMMIN", "CAMMAX")},
}
"""Keys with a dimension, as powers of the [UNITS]; every other number is a coefficient of the formula in radians and
SI."""
_SECTIONS = {
    "MODEL": "model",
    "OPERATING_CONDITIONS": "operation",
    "VERTICAL": "vertical",
    "STRUCTURAL": "structure",
    "INFLATION_PRESSURE_RANGE": "ranges",
    "LONG_SLIP_RANGE": "ranges",
    "SLIP_ANGLE_RANGE": "ranges",
    "INCLINATION_ANGLE_RANGE": "ranges",
    "VERTICAL_FORCE_RANGE": "ranges",
    "SCALING_COEFFICIENTS": "scaling",
    "LONGITUDINAL_COEFFICIENTS": "longitudinal",
    "LATERAL_COEFFICIENTS": "lateral",
    "ALIGNING_COEFFICIENTS": "aligning",
    "OVERTURNING_COEFFICIENTS": "overturning",
    "ROLLING_COEFFICIENTS": "rolling",
}
_OF_THE_TYRE = ("VERTICAL_STIFFNESS", "VERTICAL_DAMPING")
"""Keys of [VERTICAL] that every kind of tyre has; its fields are called the same in small letters."""


@dataclass(frozen=True)
class _Version:
    """A version of the formula: its tyre, and coefficients that may stand in a file though they have no effect here."""

    name: str
    tyre: type[MagicFormula]
    without_effect: frozenset[str]


_52 = _Version(
    "MF 5.2",
    MagicFormulaTyre,
    # gyroscopic couple, damping of the slip, pressure
    frozenset({"QTZ1", "MBELT", "LGYR", "PTX4", "PTY3", "LKG", "LCZ", "LIP"}),
)
_61 = _Version(
    "MF 6.1",
    MagicFormula61Tyre,
    # relaxation of other versions, gyroscopic couple, turn slip, fall of friction with speed where it is none
    frozenset(
        {
            "PTX1",
            "PTX2",
            "PTX3",
            "PTY1",
            "PTY2",
            "QTZ1",
            "MBELT",
            "LGYR",
            "LSGKP",
            "LSGAL",
            "LGAX",
            "LGAY",
            "LGAZ",
            "LMP",
        }
    ),
)
_FORMATS = ("PAC2002", "MF_05", "USER")
_FIT_TYPES = {"6": _52, "21": _52, "52": _52, "61": _61, "62": _61}
_NUMBER = re.compile(r"^[+-]?(\d+\.?\d*|\.\d+)([eEdD][+-]?\d+)?$")
_LINE = re.compile(r"^([A-Za-z_][\w]*)\s*=\s*(?:'([^']*)'|\"([^\"]*)\"|([^$!]*))")

Sections = dict[str, dict[str, str]]


def load_tyre(path: str | Path, *, inflation_pressure: float | None = None) -> MagicFormula:
    """Read a Magic Formula tyre, version 5.2 or 6.1, from a ``.tir`` file.

    ``[UNITS]`` applies to the radius, speed, stiffness, damping, loads, pressures and the ranges of angles, loads and
    pressure; SI where a unit is not given. USE_MODE may carry tens and hundreds for transients (14 is 4), which here
    are the caller's choice. The vertical stiffness of a 6.1 tyre becomes the one at its inflation pressure.

    Args:
        path: the file.
        inflation_pressure: [Pa] in place of the file's; only version 6.1 depends on it.

    Raises:
        InputError: not readable, another formula, an unknown unit or coefficient, a missing one, a value that is not
            allowed.
    """
    path = Path(path)
    sections = read_sections(path)
    source = path.name
    version = _version(sections.get("MODEL", {}), source)
    factors = _unit_factors(sections.get("UNITS", {}), source)
    data = _data(sections, version, factors, source)
    radius = sections.get("DIMENSION", {}).get("UNLOADED_RADIUS")
    if radius is None:
        raise InputError("is required", key="DIMENSION.UNLOADED_RADIUS", source=source)
    data["radius"] = _value("UNLOADED_RADIUS", radius, factors, "DIMENSION", source)
    if inflation_pressure is not None:
        if "operation" not in data:
            raise InputError(
                f"{version.name} does not depend on it; take a tyre of MF 6.1", key="inflation_pressure", source=source
            )
        data["operation"]["INFLPRES"] = inflation_pressure
    try:
        tyre = validate(version.tyre, data, source=source)
    except InputError as error:
        raise InputError(error.message, key=_key_in_file(error.key), source=source) from None
    return tyre.at_pressure() if isinstance(tyre, MagicFormula61Tyre) else tyre


def read_sections(path: Path) -> Sections:
    """Section -> key -> text of a ``.tir`` file, names in capitals; tables (lines without ``=``) are left out.

    Raises:
        InputError: no such file, not text, or a value before the first section or given twice.
    """
    try:
        text = path.read_text(encoding="utf-8-sig", errors="replace")
    except FileNotFoundError:
        raise InputError("no such file", source=str(path)) from None
    except OSError as error:
        raise InputError(f"cannot be read: {error.strerror or error}", source=str(path)) from None
    sections: Sections = {}
    current: dict[str, str] | None = None
    name = ""
    for number, line in enumerate((each.strip() for each in text.splitlines()), start=1):
        if line.startswith("["):
            name = line[1:].partition("]")[0].strip().upper()
            current = sections.setdefault(name, {})
        elif match := _LINE.match(line):
            key = match[1].upper()
            if current is None:
                raise InputError(f"line {number} stands before the first [SECTION]", key=key, source=path.name)
            if key in current:
                raise InputError(f"line {number} gives it a second time", key=f"{name}.{key}", source=path.name)
            current[key] = next(part for part in match.groups()[1:] if part is not None).strip()
    return sections


def _version(model: dict[str, str], source: str) -> _Version:
    """The version that a file is written for, by FITTYP or else by its format."""
    fit = model.get("FITTYP")
    if fit is not None and fit not in _FIT_TYPES:
        known = ", ".join(f"{number} ({each.name})" for number, each in _FIT_TYPES.items())
        raise InputError(f"'{fit}' is not supported; choose {known}", key="MODEL.FITTYP", source=source)
    form = model.get("PROPERTY_FILE_FORMAT")
    if form is None and fit is None:
        raise InputError(f"is required; {choices(_FORMATS)}", key="MODEL.PROPERTY_FILE_FORMAT", source=source)
    version = _FIT_TYPES[fit] if fit is not None else _52
    if form is not None and form.upper() not in _FORMATS and version is _52:
        raise InputError(
            f"'{form}' is not supported; {choices(_FORMATS, form)}", key="MODEL.PROPERTY_FILE_FORMAT", source=source
        )
    if form is not None and form.upper() == "USER" and fit is None:
        raise InputError("is required with PROPERTY_FILE_FORMAT 'USER'", key="MODEL.FITTYP", source=source)
    return version


def _data(sections: Sections, version: _Version, factors: dict[str, float], source: str) -> dict[str, Any]:
    """Values of the sections that the version knows, by its fields."""
    data: dict[str, Any] = {field: {} for field in _SECTIONS.values() if field in version.tyre.model_fields}
    for section, values in sections.items():
        field = _SECTIONS.get(section)
        if field in data:
            coefficients: Any = version.tyre.model_fields[field].annotation
            known = coefficients.model_fields
            for key, text in values.items():
                if section == "VERTICAL" and key in _OF_THE_TYRE:
                    data[key.lower()] = _value(key, text, factors, section, source)
                elif key in known:
                    data[field][key] = _value(key, text, factors, section, source)
                elif section.endswith("_COEFFICIENTS"):
                    _refuse_effect(key, text, known, section, version, source)
    return data


def _unit_factors(units: dict[str, str], source: str) -> dict[str, float]:
    factors = dict.fromkeys(_UNITS, 1.0)
    for key, text in units.items():
        if key not in _UNITS:
            raise InputError(f"unknown key; {choices(_UNITS, key)}", key=f"UNITS.{key}", source=source)
        if text.lower() not in _UNITS[key]:
            raise InputError(f"'{text}' unknown; {choices(_UNITS[key], text)}", key=f"UNITS.{key}", source=source)
        factors[key] = unit_factor(_UNITS[key][text.lower()])[0]
    return factors


def _value(key: str, text: str, factors: dict[str, float], section: str, source: str) -> float | int | str:
    if key == "TYRESIDE":
        return text.upper()
    if not _NUMBER.match(text):
        raise InputError(f"'{text}' is not a number", key=f"{section}.{key}", source=source)
    number = float(text.upper().replace("D", "E"))
    if not math.isfinite(number):
        raise InputError(f"'{text}' is not a finite number", key=f"{section}.{key}", source=source)
    if key == "USE_MODE":
        if number < 0 or number != int(number):
            raise InputError(
                f"'{text}' is not a mode; write a whole number, 0 at least", key=f"{section}.{key}", source=source
            )
        return int(number) % 10
    for unit, power in _DIMENSIONS.get(key, {}).items():
        number *= factors[unit] ** power
    return number


def _refuse_effect(key: str, text: str, known: Any, section: str, version: _Version, source: str) -> None:
    """A coefficient that the formula does not have may stand there only if it changes nothing (0; a scale factor 1)."""
    neutral = 1.0 if section == "SCALING_COEFFICIENTS" else 0.0
    neutral = 0.0 if key == "LMUV" else neutral
    if key in version.without_effect:
        _value(key, text, {}, section, source)  # a number all the same
        return
    if _NUMBER.match(text) and float(text.upper().replace("D", "E")) == neutral:
        return
    raise InputError(
        f"unknown coefficient of {version.name}; {choices(known, key)}", key=f"{section}.{key}", source=source
    )


def _key_in_file(key: str) -> str:
    """``longitudinal.PCX1`` -> ``LONGITUDINAL_COEFFICIENTS.PCX1``; a range's section is found by its key."""
    if key.upper() in _OF_THE_TYRE:
        return f"VERTICAL.{key.upper()}"
    field, _, name = key.partition(".")
    if field == "ranges":
        start = {
            "KPU": "LONG_SLIP_RANGE",
            "ALP": "SLIP_ANGLE_RANGE",
            "CAM": "INCLINATION_ANGLE_RANGE",
            "PRE": "INFLATION_PRESSURE_RANGE",
        }
        return f"{start.get(name[:3], 'VERTICAL_FORCE_RANGE')}.{name}"
    section = next((section for section, each in _SECTIONS.items() if each == field), field)
    return ".".join(part for part in (section, name) if part)
