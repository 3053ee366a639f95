"""Reader of tyre property files (``.tir``): sections in brackets, ``KEY = value`` lines, comments after ``$`` or ``!``."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

from ...description import validate
from ...errors import InputError, choices
from ...units import unit_factor
from .magic_formula import MagicFormulaTyre

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
    **{key: {"FORCE": 1} for key in ("FNOMIN", "FZMIN", "FZMAX")},
    **{key: {"ANGLE": 1} for key in ("ALPMIN", "ALPMAX", "CAMMIN", "CAMMAX")},
}
"""Keys with a dimension, as powers of the [UNITS]; every other number is a coefficient of the formula in radians and SI."""
_SECTIONS = {
    "MODEL": "model",
    "VERTICAL": "vertical",
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
_WITHOUT_EFFECT = {"QTZ1", "MBELT", "LGYR", "PTX4", "PTY3", "LKG", "LCZ", "LIP"}
"""Coefficients of the standard that describe what is not modelled here: gyroscopic couple, damping of the slip, pressure."""
_FORMATS = ("PAC2002", "MF_05", "USER")
_FIT_TYPES = {"6": "MF 5.2", "21": "MF 5.2", "52": "MF 5.2"}
_NUMBER = re.compile(r"^[+-]?(\d+\.?\d*|\.\d+)([eEdD][+-]?\d+)?$")
_LINE = re.compile(r"^([A-Za-z_][\w]*)\s*=\s*(?:'([^']*)'|\"([^\"]*)\"|([^$!]*))")

Sections = dict[str, dict[str, str]]


def load_tyre(path: str | Path) -> MagicFormulaTyre:
    """Read a Magic Formula 5.2 tyre from a ``.tir`` file.

    ``[UNITS]`` applies to the radius, speed, stiffness, damping, loads and the ranges of angles and loads; SI where a unit is not given.
    USE_MODE may carry 10 or 20 for transients (14 is 4), which here are the caller's choice.

    Raises:
        InputError: not readable, another formula, an unknown unit or coefficient, a missing one, a value that is not allowed.
    """
    path = Path(path)
    sections = read_sections(path)
    source = path.name
    _check_formula(sections.get("MODEL", {}), source)
    factors = _unit_factors(sections.get("UNITS", {}), source)
    data: dict[str, Any] = {field: {} for field in _SECTIONS.values()}
    for section, values in sections.items():
        if section in _SECTIONS:
            field = _SECTIONS[section]
            coefficients: Any = MagicFormulaTyre.model_fields[field].annotation
            known = coefficients.model_fields
            for key, text in values.items():
                if key in _OF_THE_TYRE:
                    data[key.lower()] = _value(key, text, factors, section, source)
                elif key in known:
                    data[field][key] = _value(key, text, factors, section, source)
                elif section.endswith("_COEFFICIENTS"):
                    _refuse_effect(key, text, known, section, source)
    radius = sections.get("DIMENSION", {}).get("UNLOADED_RADIUS")
    if radius is None:
        raise InputError("is required", key="DIMENSION.UNLOADED_RADIUS", source=source)
    data["radius"] = _value("UNLOADED_RADIUS", radius, factors, "DIMENSION", source)
    try:
        return validate(MagicFormulaTyre, data, source=source)
    except InputError as error:
        raise InputError(error.message, key=_key_in_file(error.key), source=source) from None


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


def _check_formula(model: dict[str, str], source: str) -> None:
    fit = model.get("FITTYP")
    if fit is not None and fit not in _FIT_TYPES:
        known = ", ".join(f"{number} ({name})" for number, name in _FIT_TYPES.items())
        raise InputError(f"'{fit}' is not supported; choose {known}", key="MODEL.FITTYP", source=source)
    form = model.get("PROPERTY_FILE_FORMAT")
    if form is None and fit is None:
        raise InputError(f"is required; {choices(_FORMATS)}", key="MODEL.PROPERTY_FILE_FORMAT", source=source)
    if form is not None and form.upper() not in _FORMATS:
        raise InputError(f"'{form}' is not supported; {choices(_FORMATS, form)}", key="MODEL.PROPERTY_FILE_FORMAT", source=source)
    if form is not None and form.upper() == "USER" and fit is None:
        raise InputError("is required with PROPERTY_FILE_FORMAT 'USER'", key="MODEL.FITTYP", source=source)


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
    if key == "USE_MODE":
        return int(number) % 10
    for unit, power in _DIMENSIONS.get(key, {}).items():
        number *= factors[unit] ** power
    return number


def _refuse_effect(key: str, text: str, known: Any, section: str, source: str) -> None:
    """A coefficient that the formula does not have may stand there only if it changes nothing (0; a scale factor 1)."""
    neutral = 1.0 if section == "SCALING_COEFFICIENTS" else 0.0
    if key in _WITHOUT_EFFECT or (_NUMBER.match(text) and float(text.upper().replace("D", "E")) == neutral):
        return
    raise InputError(f"unknown coefficient of MF 5.2; {choices(known, key)}", key=f"{section}.{key}", source=source)


def _key_in_file(key: str) -> str:
    """``longitudinal.PCX1`` -> ``LONGITUDINAL_COEFFICIENTS.PCX1``; a range's section is found by its key."""
    if key.upper() in _OF_THE_TYRE:
        return f"VERTICAL.{key.upper()}"
    field, _, name = key.partition(".")
    if field == "ranges":
        start = {"KPU": "LONG_SLIP_RANGE", "ALP": "SLIP_ANGLE_RANGE", "CAM": "INCLINATION_ANGLE_RANGE"}
        return f"{start.get(name[:3], 'VERTICAL_FORCE_RANGE')}.{name}"
    section = next((section for section, each in _SECTIONS.items() if each == field), field)
    return ".".join(part for part in (section, name) if part)
