"""The tyres of the handling car, by the `kind` that files choose them by."""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, Field

from ...description import Description, wrong
from ...errors import InputError
from ...units import Dimensionless, Stiffness
from ..element import chosen_kind
from .contact_tyre import ContactTyre, VerticalDamping
from .linear import LinearContactTyre
from .magic_formula import MagicFormula, MagicFormulaTyre
from .magic_formula_61 import MagicFormula61Tyre
from .magic_formula_61_coefficients import Pressure
from .tir import load_tyre

CONTACT_TYRES: dict[str, type[ContactTyre]] = {
    "magic_formula": MagicFormulaTyre,
    "magic_formula_61": MagicFormula61Tyre,
    "linear": LinearContactTyre,
}


class TyreFile(Description):
    """A Magic Formula tyre as a vehicle file gives it: a tyre property file and what is to differ from it.

    Attributes:
        kind: ``magic_formula`` for whichever version the file has, ``magic_formula_61`` to insist on 6.1.
        file: path of the ``.tir`` file.
        vertical_stiffness: C_z [N/m] in place of the file's.
        vertical_damping: D_z [N s/m] in place of the file's.
        inflation_pressure: p_i [Pa] in place of the file's; MF 6.1 only.
        scaling: scale factors in place of the file's, e.g. ``{LMUY = 0.9}``.
    """

    kind: Literal["magic_formula", "magic_formula_61"] = "magic_formula"
    file: Path
    vertical_stiffness: Stiffness | None = None
    vertical_damping: VerticalDamping | None = None
    inflation_pressure: Pressure | None = None
    scaling: dict[str, Dimensionless] = Field(default_factory=dict)

    def tyre(self) -> MagicFormula:
        """The tyre that the file describes.

        Raises:
            InputError: in the tyre property file.
        """
        try:
            tyre = _loaded(self.file, _changed(self.file), self.inflation_pressure)
        except InputError as error:
            if error.key == "inflation_pressure":  # stands here, not in the tyre property file
                raise wrong(error.message, "inflation_pressure") from None
            raise
        if self.kind not in ("magic_formula", tyre.kind):
            raise wrong(f"{self.file.name} is of another version; write kind = 'magic_formula'", "kind")
        own = self.model_dump(include={"vertical_stiffness", "vertical_damping"}, exclude_none=True)
        if not own and not self.scaling:
            return tyre
        data = tyre.model_dump()
        return type(tyre).model_validate({**data, **own, "scaling": {**data["scaling"], **self.scaling}})


@lru_cache(maxsize=32)
def _loaded(file: Path, changed: int, inflation_pressure: float | None) -> MagicFormula:
    """The tyre of a file, which is read again only when it has changed."""
    return load_tyre(file, inflation_pressure=inflation_pressure)


def _changed(file: Path) -> int:
    """When a file was last written [ns]; 0 where that is not known, reading it then says why."""
    try:
        return file.stat().st_mtime_ns
    except OSError:
        return 0


def _chosen(data: Any) -> Any:
    """A tyre by its kind; of a Magic Formula without its sections, the file is read."""
    if not isinstance(data, dict):
        return data
    chosen = chosen_kind(data, CONTACT_TYRES)
    if issubclass(chosen, MagicFormula) and "model" not in data:
        return TyreFile.model_validate(data).tyre()
    return chosen.model_validate(data)


AnyContactTyre = Annotated[ContactTyre, BeforeValidator(_chosen)]
