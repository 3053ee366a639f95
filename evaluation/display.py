"""Engineers' units: how an SI value is shown in plots, tables and on screen."""

from __future__ import annotations

import math
from dataclasses import dataclass


@dataclass(frozen=True)
class Shown:
    """How values of one SI unit are shown.

    Attributes:
        unit: the unit shown; empty for pure numbers.
        factor: shown value per SI value.
        decimals: digits after the point; None shows three significant ones.
    """

    unit: str
    factor: float = 1.0
    decimals: int | None = None


_SHOWN: dict[str, Shown] = {
    "m": Shown("mm", 1e3, 1),
    "m/s": Shown("m/s", 1.0, 3),
    "m/s²": Shown("m/s²", 1.0, 2),
    "s": Shown("s", 1.0, 3),
    "Hz": Shown("Hz", 1.0, 2),
    "N": Shown("kN", 1e-3, 3),
    "N/m": Shown("kN/m", 1e-3, 2),
    "N s/m": Shown("N s/m", 1.0, 0),
    "Nm": Shown("kNm", 1e-3, 3),
    "rad": Shown("°", 180 / math.pi, 2),
    "rad/s": Shown("°/s", 180 / math.pi, 2),
    "1/s²": Shown("1/s²", 1.0, 0),
    "metre": Shown("m", 1.0, 2),
    "rad s": Shown("° s", 180 / math.pi, 2),
    "rad/m": Shown("°/m", 180 / math.pi, 2),
    "rad/(m/s²)": Shown("°/(m/s²)", 180 / math.pi, 3),
    "m/s²/rad": Shown("m/s² per 100°", 100 * math.pi / 180, 2),
    "rad/N": Shown("°/kN", 1e3 * 180 / math.pi, 4),
    "rad/(N m)": Shown("° per 100 N m", 1e2 * 180 / math.pi, 4),
    "N m/rad": Shown("N m/°", math.pi / 180, 0),
    "1": Shown(""),
    "": Shown(""),
}


def shown(unit: str) -> Shown:
    """How to show values of an SI unit; a unit without a rule is shown as it is."""
    return _SHOWN.get(unit, Shown(unit))


def number_text(value: float | None, unit: str) -> str:
    """A value in SI `unit` as a reader wants it, without its unit.

    >>> number_text(0.0851, "m"), number_text(4743.0, "N"), number_text(None, "s")
    ('85.1', '4.743', '–')
    """
    if value is None or not math.isfinite(value):
        return "–"
    how = shown(unit)
    scaled = value * how.factor
    if how.decimals is not None:
        text = f"{scaled:.{how.decimals}f}"
    elif scaled == round(scaled):
        text = f"{scaled:.0f}"
    else:
        text = f"{scaled:.3g}"
    return text.replace("-", "−") if float(text) != 0.0 else text.lstrip("-")


def quantity_text(value: float | None, unit: str) -> str:
    """A value with the unit it is shown in.

    >>> quantity_text(-0.0323, "m")
    '−32.3 mm'
    """
    return f"{number_text(value, unit)} {shown(unit).unit}".strip() if value is not None else "–"


def band_text(minimum: float | None, maximum: float | None, unit: str) -> str:
    """A band in words, its bounds in SI `unit`; a bound of None is open.

    >>> band_text(0.001, None, "m"), band_text(None, 0.003, "m"), band_text(0.001, 0.003, "m")
    ('at least 1.0 mm', 'at most 3.0 mm', '1.0 to 3.0 mm')
    """
    if minimum is None:
        return "any value" if maximum is None else f"at most {quantity_text(maximum, unit)}"
    if maximum is None:
        return f"at least {quantity_text(minimum, unit)}"
    return f"{number_text(minimum, unit)} to {quantity_text(maximum, unit)}"
