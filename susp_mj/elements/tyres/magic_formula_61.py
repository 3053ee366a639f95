"""Magic Formula 6.1: the description of a tyre, section by section as in its ``.tir`` file, and its inflation
pressure."""

from __future__ import annotations

import math
from typing import Annotated, Any, ClassVar, Literal

from pydantic import model_validator

from ...description import wrong
from ...units import Quantity
from ..law import Law
from . import magic_formula_61_law as formula
from .contact_tyre import CONTACT
from .magic_formula import MagicFormula, Ranges
from .magic_formula_61_coefficients import (
    Aligning61,
    Lateral61,
    Longitudinal61,
    Operation,
    Overturning61,
    Rolling61,
    Scaling61,
    Structure,
    Vertical61,
)
from .slip import SMALLEST_RELAXATION

STEEPEST = 1.5
"""Largest slip angle [rad] whose tangent is still taken; beyond it the force would not change visibly."""
_MOMENT = ("QSX1", "QSX2", "QSX3", "QSX4", "QSX10", "QSX12", "QSX13", "QSX14")
_ROLLING = ("QSY1", "QSY2", "QSY3", "QSY4", "QSY5", "QSY6")


class Ranges61(Ranges):
    """As `Ranges`, with the valid inflation pressure [Pa]; a pressure outside is an error."""

    PRESMIN: Annotated[float, Quantity("Pa", ge=0)] = 0.0
    PRESMAX: Annotated[float, Quantity("Pa", gt=0)] = 1e7


class MagicFormula61Tyre(MagicFormula):
    """Magic Formula tyre, MF 6.1 (and 6.2, whose forces are the same): as MF 5.2, and inflation pressure.

    The law and its axes stand in `magic_formula_61_law`. Pressure enters as ``dp_i = (p_i - p_i0)/p_i0``:

        mu_x (1 + PPX3 dp + PPX4 dp²), K_x (1 + PPX1 dp + PPX2 dp²), mu_y (1 + PPY3 dp + PPY4 dp²), K_y (1 + PPY1 dp)
        and the load of its largest value (1 + PPY2 dp), camber stiffness (1 + PPY5 dp), trail (1 - PPZ1 dp),
        residual moment by camber (1 + PPZ2 dp), QSX2 (1 + PPMX1 dp), M_y (p_i/p_i0)^QSY8, vertical stiffness (1 + PFZ1
        dp), carcass (1 + PCFX3 dp), (1 + PCFY3 dp)

    MF 6.1 has no relaxation coefficients: the relaxation lengths are slip stiffness over stiffness of the carcass.

    Attributes:
        radius, vertical_stiffness, vertical_damping: as for every `ContactTyre`; the stiffness at the pressure of
            `operation`.
        side: side of the car that this tyre is mounted on; on the other side than TYRESIDE it works mirrored.
        model, operation, vertical, structure, ranges, scaling, longitudinal, lateral, aligning, overturning, rolling:
            sections of the file.

    Sources: [besselink2010], [pacejka2012] section 4.3.2.
    """

    law: ClassVar[Law] = Law("magic_formula_61", formula.contact, role=CONTACT)

    kind: Literal["magic_formula_61"] = "magic_formula_61"
    operation: Operation
    vertical: Vertical61
    structure: Structure
    ranges: Ranges61
    scaling: Scaling61 = Scaling61()
    longitudinal: Longitudinal61
    lateral: Lateral61
    aligning: Aligning61
    overturning: Overturning61 = Overturning61()
    rolling: Rolling61 = Rolling61()

    @model_validator(mode="after")
    def _pressure_is_valid(self) -> MagicFormula61Tyre:
        low, high, pressure = self.ranges.PRESMIN, self.ranges.PRESMAX, self.operation.INFLPRES
        if not low <= pressure <= high:
            raise wrong(f"{pressure:g} Pa is outside the valid {low:g} to {high:g} Pa", "operation.INFLPRES")
        return self

    def at_pressure(self) -> MagicFormula61Tyre:
        """This tyre, whose stiffness is the one at nominal pressure, with the stiffness at the pressure it runs at."""
        return self.model_copy(update={"vertical_stiffness": self.vertical_stiffness * self._stiffness_ratio})

    @property
    def pressure_change(self) -> float:
        """``dp_i = (p_i - p_i0)/p_i0`` [1]."""
        return self.operation.INFLPRES / self.operation.NOMPRES - 1.0

    def parameters(self) -> tuple[float, ...]:
        """Numbers for the law in the order of `magic_formula_61_law.PARAMETERS`, scale factors and pressure multiplied
        in."""
        scale, nominal, dp = self.scaling, self.vertical.FNOMIN, self.pressure_change
        structure, reference = self.structure, nominal * scale.LFZO
        values: dict[str, Any] = self.structure.model_dump() | self.vertical.model_dump() | self.ranges.model_dump()
        for section in (self.longitudinal, self.lateral, self.aligning, self.overturning, self.rolling):
            values |= {name: value or 0.0 for name, value in section.model_dump().items()}
        for names, factor in self._factors():
            for name in names:
                values[name] *= factor
        values |= {
            "SIDE": 1.0 if self.side in (None, self.model.TYRESIDE) else -1.0,
            "COMBINED": float(self.model.USE_MODE == 4),
            "R0": self.radius,
            "TANMIN": math.tan(max(self.ranges.ALPMIN, -STEEPEST)),
            "TANMAX": math.tan(min(self.ranges.ALPMAX, STEEPEST)),
            "PKY1": values["PKY1"] * reference,
            "DEFLECTION": nominal / self.vertical_stiffness,
            "CX": structure.LONGITUDINAL_STIFFNESS * (1.0 + structure.PCFX3 * dp),
            "CY": structure.LATERAL_STIFFNESS * (1.0 + structure.PCFY3 * dp),
            "SIGMA_LEAST": SMALLEST_RELAXATION,
            "FZN": nominal,
            "PER_FZ0": 1.0 / reference,
            "PER_FZN": 1.0 / nominal,
            "PER_VREF": 1.0 / self.model.LONGVL,
        }
        return tuple(float(values[name]) for name in formula.PARAMETERS)

    def _factors(self) -> tuple[tuple[tuple[str, ...], float], ...]:
        """Scale factors and pressure: names of the coefficients that each multiplies."""
        scale, dp = self.scaling, self.pressure_change
        along, across, aligning = self.longitudinal, self.lateral, self.aligning
        return (
            (("PCX1",), scale.LCX),
            (("PDX1", "PDX2"), scale.LMUX * (1.0 + along.PPX3 * dp + along.PPX4 * dp * dp)),
            (("PEX1", "PEX2", "PEX3"), scale.LEX),
            (("PKX1", "PKX2"), scale.LKX * (1.0 + along.PPX1 * dp + along.PPX2 * dp * dp)),
            (("PHX1", "PHX2"), scale.LHX),
            (("PVX1", "PVX2"), scale.LVX * scale.LMUX),
            (("RBX1", "RBX3"), scale.LXAL),
            (("PCY1",), scale.LCY),
            (("PDY1", "PDY2"), scale.LMUY * (1.0 + across.PPY3 * dp + across.PPY4 * dp * dp)),
            (("PEY1", "PEY2"), scale.LEY),
            (("PKY1",), scale.LKY * (1.0 + across.PPY1 * dp)),
            (("PKY2", "PKY5"), 1.0 + across.PPY2 * dp),
            (("PKY6", "PKY7"), scale.LKYC * (1.0 + across.PPY5 * dp)),
            (("PHY1", "PHY2"), scale.LHY),
            (("PVY1", "PVY2"), scale.LVY * scale.LMUY),
            (("PVY3", "PVY4"), scale.LKYC * scale.LMUY),
            (("RBY1", "RBY4"), scale.LYKA),
            (("RVY1", "RVY2", "RVY3"), scale.LVYKA),
            (("QBZ1", "QBZ2", "QBZ3", "QBZ9"), scale.LKY / scale.LMUY),
            (("QDZ1", "QDZ2"), scale.LTR * (1.0 - aligning.PPZ1 * dp)),
            (("QDZ6", "QDZ7"), scale.LRES * scale.LMUY),
            (("QDZ8", "QDZ9"), scale.LKZC * scale.LMUY * (1.0 + aligning.PPZ2 * dp)),
            (("QDZ10", "QDZ11"), scale.LKZC * scale.LMUY),
            (("SSZ1", "SSZ2", "SSZ3", "SSZ4"), scale.LS),
            (_MOMENT, scale.LMX),
            (("QSX1",), scale.LVMX),
            (("QSX2",), 1.0 + self.overturning.PPMX1 * dp),
            (_ROLLING, scale.LMY * (1.0 + dp) ** self.rolling.QSY8),
        )

    def vertical_load(
        self,
        deflection: float,
        speed: float = 0.0,
        rolling: float = 0.0,
        longitudinal: float = 0.0,
        lateral: float = 0.0,
    ) -> float:
        """Load [N] of the deflection, zero where contact is lost.

            F_z = (1 + Q_V2 |V_x|/V_0 - (Q_FCX F_x/F_zN)² - (Q_FCY F_y/F_zN)²)(Q_FZ1 rho/R_0 + Q_FZ2 (rho/R_0)²) F_zN +
            D_z rho'

        with ``Q_FZ1 = sqrt((C_z R_0/F_zN)² - 4 Q_FZ2)``, so that C_z is the stiffness at the nominal load.

        Args:
            deflection: rho [m].
            speed: its rate [m/s].
            rolling: V_x [m/s].
            longitudinal: F_x [N].
            lateral: F_y [N].
        """
        if deflection <= 0.0:
            return 0.0
        linear, share = self._linear_load, deflection / self.radius
        load = self._stiffening(rolling, longitudinal, lateral) * (linear + self._square_load * share) * share
        return max(0.0, load + self.vertical_damping * speed)

    def loaded_radius(
        self, load: float, rolling: float = 0.0, longitudinal: float = 0.0, lateral: float = 0.0
    ) -> float:
        """Height of the wheel centre [m] under a load [N]: ``R_0 (Q_RE0 + Q_V1 (V_x/V_0)²) - rho``; rho inverts
        `vertical_load`."""
        v, speed = self.vertical, rolling / self.model.LONGVL
        free = self.radius * (v.Q_RE0 + v.Q_V1 * speed * speed)
        height = max(0.0, load) / self._stiffening(rolling, longitudinal, lateral)
        linear = self._linear_load
        return free - self.radius * 2.0 * height / (
            linear + math.sqrt(linear * linear + 4.0 * self._square_load * height)
        )

    def rolling_radius(self, load: float, rolling: float = 0.0) -> float:
        """R_e [m] of the law under a load [N] at a speed [m/s]."""
        return self.evaluate(load=load, rolling=rolling).rolling_radius

    @property
    def _stiffness_ratio(self) -> float:
        """Vertical stiffness over the one at nominal pressure."""
        return 1.0 + self.vertical.PFZ1 * self.pressure_change

    @property
    def _square_load(self) -> float:
        """Load [N] over the square of ``rho/R_0``."""
        return self.vertical.Q_FZ2 * self.vertical.FNOMIN * self._stiffness_ratio

    @property
    def _linear_load(self) -> float:
        """Load [N] over ``rho/R_0``, at small deflection."""
        nominal, ratio = self.vertical.FNOMIN, self._stiffness_ratio
        square = (self.vertical_stiffness / ratio * self.radius / nominal) ** 2 - 4.0 * self.vertical.Q_FZ2
        return math.sqrt(max(0.0, square)) * nominal * ratio

    def _stiffening(self, rolling: float, longitudinal: float, lateral: float) -> float:
        """Factor of speed and forces on the vertical stiffness, at least 0.1."""
        v, nominal = self.vertical, self.vertical.FNOMIN
        forces = (v.Q_FCX * longitudinal / nominal) ** 2 + (v.Q_FCY * lateral / nominal) ** 2
        return max(0.1, 1.0 + v.Q_V2 * abs(rolling) / self.model.LONGVL - forces)
