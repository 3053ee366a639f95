"""Magic Formula 5.2 (PAC2002): the description of a tyre, section by section as in its ``.tir`` file."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Annotated, Any, ClassVar, Literal, Self

from pydantic import model_validator

from ...description import Description, wrong
from ...units import Dimensionless, Force, PositiveForce, PositiveSpeed, Quantity
from ..law import Law
from . import magic_formula_law as formula
from .contact_tyre import CONTACT, ContactTyre, Side
from .magic_formula_coefficients import Aligning, Lateral, Longitudinal, Overturning, Rolling, Scaling
from .slip import SMALLEST_RELAXATION

Angle = Annotated[float, Quantity("rad")]
# scale factors that multiply a coefficient; friction and stiffness factors reach the moments through the forces too
_SCALE: dict[str, tuple[str, ...]] = {
    "LCX": ("PCX1",),
    "LMUX": ("PDX1", "PDX2", "PVX1", "PVX2"),
    "LEX": ("PEX1", "PEX2", "PEX3"),
    "LKX": ("PKX1", "PKX2"),
    "LHX": ("PHX1", "PHX2"),
    "LVX": ("PVX1", "PVX2"),
    "LXAL": ("RBX1",),
    "LSGKP": ("PTX1", "PTX2"),
    "LCY": ("PCY1",),
    "LMUY": ("PDY1", "PDY2", "PVY1", "PVY2", "PVY3", "PVY4", "QDZ6", "QDZ7", "QDZ8", "QDZ9"),
    "LEY": ("PEY1", "PEY2"),
    "LKY": ("PKY1", "QBZ1", "QBZ2", "QBZ3", "QBZ9"),
    "LHY": ("PHY1", "PHY2"),
    "LVY": ("PVY1", "PVY2"),
    "LYKA": ("RBY1",),
    "LVYKA": ("RVY1", "RVY2", "RVY3"),
    "LSGAL": ("PTY1",),
    "LFZO": ("PTY1",),
    "LTR": ("QDZ1", "QDZ2"),
    "LRES": ("QDZ6", "QDZ7"),
    "LS": ("SSZ1", "SSZ2", "SSZ3", "SSZ4"),
    "LVMX": ("QSX1",),
    "LMX": ("QSX2", "QSX3"),
    "LMY": ("QSY1", "QSY2", "QSY3", "QSY4"),
}
_DIVIDE: dict[str, tuple[str, ...]] = {"LMUY": ("QBZ1", "QBZ2", "QBZ3", "QBZ9")}


class Model(Description):
    """Section [MODEL].

    Attributes:
        USE_MODE: 3 forces of either slip alone, 4 combined slip.
        LONGVL: V_0 [m/s], speed of the measurement.
        TYRESIDE: side of the car that the coefficients are for.
    """

    USE_MODE: Literal[3, 4] = 4
    LONGVL: PositiveSpeed
    TYRESIDE: Literal["LEFT", "RIGHT"] = "LEFT"


class Vertical(Description):
    """Section [VERTICAL]: coefficients of the rolling radius, nominal load [N]; its stiffness and damping are the
    tyre's own."""

    BREFF: Dimensionless
    DREFF: Dimensionless
    FREFF: Dimensionless
    FNOMIN: PositiveForce


class Ranges(Description):
    """Valid slip [1], slip angle and camber [rad] and load [N]; inputs beyond are held at the limits (the load only
    above)."""

    KPUMIN: Annotated[float, Quantity("", lt=0)] = -1.5
    KPUMAX: Annotated[float, Quantity("", gt=0)] = 1.5
    ALPMIN: Annotated[float, Quantity("rad", lt=0, ge=-1.5708)] = -math.pi / 2
    ALPMAX: Annotated[float, Quantity("rad", gt=0, le=1.5708)] = math.pi / 2
    CAMMIN: Angle = -0.26181
    CAMMAX: Angle = 0.26181
    FZMIN: Force = 0.0
    FZMAX: PositiveForce


class MagicFormula(ContactTyre):
    """What the versions of the Magic Formula have in common.

    Attributes:
        side: side of the car that this tyre is mounted on; on the other side than TYRESIDE it works mirrored.
        model: section of the file.
    """

    side: Side | None = None
    model: Model

    @model_validator(mode="after")
    def _combined_slip_known(self) -> Self:
        if self.model.USE_MODE == 4:
            for section, names in (("longitudinal", ("RBX1", "RBX2", "RCX1")), ("lateral", ("RBY1", "RBY2", "RCY1"))):
                for name in names:
                    if getattr(getattr(self, section), name) is None:
                        raise wrong(
                            "is required for combined slip (USE_MODE 4); USE_MODE 3 does without", f"{section}.{name}"
                        )
        return self

    @model_validator(mode="after")
    def _forces_finite(self) -> Self:
        for slip, load in ((slip, load) for load in (4000.0, 1000.0, 8000.0) for slip in (0.0, 0.1, -0.1)):
            try:
                finite = all(map(math.isfinite, self.evaluate(slip, slip, 0.02, load)))
            except (ArithmeticError, ValueError):
                finite = False
            if not finite:
                raise wrong(
                    f"a coefficient is out of all bounds: at slip {slip:g} and a load of {load:g} N the forces are "
                    "not finite"
                )
        return self

    def mounted(self, side: Side) -> Self:
        """The same tyre on a side of the car: ``F_y, M_x, M_z`` of (-alpha, -camber) change sign between the sides."""
        return self.model_copy(update={"side": side})

    def uncombined(self) -> Self:
        """The same tyre with each force a function of its own slip alone (USE_MODE 3)."""
        return self.model_copy(update={"model": self.model.model_copy(update={"USE_MODE": 3})})


class MagicFormulaTyre(MagicFormula):
    """Magic Formula tyre, MF 5.2 / PAC2002: forces and moments of the contact in steady slip, relaxation lengths.

    The laws and their axes stand in `magic_formula_law`; `parameters` is what they take. Coefficients are those of the
    formula in radians and SI units, scale factors not yet applied.

    Attributes:
        radius, vertical_stiffness, vertical_damping: as for every `ContactTyre`.
        side: side of the car that this tyre is mounted on; on the other side than TYRESIDE it works mirrored.
        model, vertical, ranges, scaling, longitudinal, lateral, aligning, overturning, rolling: sections of the file.

    Sources: [msc2008], [pacejka2012] section 4.3.2.
    """

    law: ClassVar[Law] = Law("magic_formula_52", formula.magic_formula_contact, role=CONTACT)

    kind: Literal["magic_formula"] = "magic_formula"
    vertical: Vertical
    ranges: Ranges
    scaling: Scaling = Scaling()
    longitudinal: Longitudinal
    lateral: Lateral
    aligning: Aligning
    overturning: Overturning = Overturning()
    rolling: Rolling = Rolling()

    def parameters(self) -> tuple[float, ...]:
        """Numbers for the laws in the order of `magic_formula_law.PARAMETERS`, scale factors multiplied in."""
        scale = self.scaling.model_dump()
        values: dict[str, Any] = dict(self.ranges.model_dump())
        for section in (self.longitudinal, self.lateral, self.aligning, self.overturning, self.rolling):
            values |= {name: value or 0.0 for name, value in section.model_dump().items()}
        for factor, names in _SCALE.items():
            _multiply(values, names, scale[factor])
        for factor, names in _DIVIDE.items():
            _multiply(values, names, 1.0 / scale[factor])
        nominal = self.vertical.FNOMIN
        values |= {
            "SIDE": 1.0 if self.side in (None, self.model.TYRESIDE) else -1.0,
            "COMBINED": float(self.model.USE_MODE == 4),
            "R0": self.radius,
            "FZ0": nominal * scale["LFZO"],
            "FZN": nominal,
            "VREF": self.model.LONGVL,
            "LGAX": scale["LGAX"],
            "LGAY": scale["LGAY"],
            "LGAZ": scale["LGAZ"],
            "DEFLECTION": nominal * scale["LFZO"] / self.vertical_stiffness,
            "BREFF": self.vertical.BREFF,
            "DREFF": self.vertical.DREFF,
            "FREFF": self.vertical.FREFF,
            "SIGMA_LEAST": SMALLEST_RELAXATION,
        }
        values |= {
            "PER_FZ0": 1.0 / values["FZ0"],
            "PER_FZN": 1.0 / nominal,
            "PER_VREF": 1.0 / self.model.LONGVL,
            "PER_KY_LOAD": 1.0 / (values["PKY2"] * values["FZ0"]),
            "PER_SY_LOAD": 1.0 / (values["PTY2"] * values["FZ0"]),
            "KY_MOST": values["PKY1"] * values["FZ0"],
            "SY_MOST": values["PTY1"] * self.radius,
        }
        return tuple(float(values[name]) for name in formula.PARAMETERS)

    def vertical_load(self, deflection: float, speed: float = 0.0) -> float:
        """``F_z = max(0, C_z rho + D_z rho')`` [N] of the deflection [m] and its rate [m/s], zero where contact is
        lost."""
        if deflection <= 0.0:
            return 0.0
        return max(0.0, self.vertical_stiffness * deflection + self.vertical_damping * speed)

    def rolling_radius(self, load: float) -> float:
        """``R_e = R_0 - rho_0 (DREFF atan(BREFF rho/rho_0) + FREFF rho/rho_0)`` [m], ``rho_0 = F_z0/C_z``."""
        nominal = self.vertical.FNOMIN * self.scaling.LFZO
        deflection, v = nominal / self.vertical_stiffness, self.vertical
        share = max(0.0, load) / nominal
        return self.radius - deflection * (v.DREFF * math.atan(v.BREFF * share) + v.FREFF * share)


def _multiply(values: dict[str, Any], names: Iterable[str], factor: float) -> None:
    for name in names:
        values[name] *= factor
