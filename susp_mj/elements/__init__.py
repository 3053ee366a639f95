"""Force elements: a validated description beside its law, one noun a file."""

from __future__ import annotations

from ..errors import CallbackError
from .aero import Aerodynamics
from .bars import AntiRollBar, Overturning, Rig
from .brakes import Brakes
from .dampers import DAMPERS, DIRECT_DAMPER, MOUNTED_DAMPER, AnyDamper, Damper, TableDamper, ZonedDamper
from .element import Element
from .friction import LinkageFriction
from .kinematics import Compliance, Kinematics
from .law import Law, helpers
from .powertrain import Powertrain
from .springs import (
    GRAVITY,
    SPRINGS,
    AnySpring,
    ConstantFrequencySpring,
    LinearSpring,
    ProgressiveSpring,
    Spring,
    TableSpring,
)
from .steering import Steering
from .stops import Stops
from .tyres.contact import (
    CONTACT_LAWS,
    CONTACT_TYRES,
    AnyContactTyre,
    ContactForces,
    ContactLaw,
    ContactTyre,
    register_contact_tyre,
)
from .tyres.linear import LinearContactTyre
from .tyres.magic_formula import MagicFormulaTyre
from .tyres.vertical import TYRES, AnyTyre, Tyre, TyreSpring

LAWS: dict[int, Law] = {
    law.number: law
    for law in (
        LinearSpring.law,
        ConstantFrequencySpring.law,
        ProgressiveSpring.law,
        TableSpring.law,
        Stops.law,
        DIRECT_DAMPER,
        MOUNTED_DAMPER,
        LinkageFriction.law,
        TyreSpring.law,
        AntiRollBar.law,
        Overturning.law,
        Rig.law,
    )
}
_KINDS: tuple[tuple[type[Element], dict[str, type]], ...] = ((Spring, SPRINGS), (Damper, DAMPERS), (Tyre, TYRES))


def register(element: type[Element]) -> None:
    """Make a spring, damper or tyre of your own available by its `kind`, in files and in compiled callbacks.

    Args:
        element: subclass of Spring, Damper or Tyre with `kind` as a `Literal`, `law` and `parameters`.

    Raises:
        CallbackError: its kind or the number of its law is taken by something else, or the law calls functions of
            another module.
    """
    kinds = next((kinds for base, kinds in _KINDS if issubclass(element, base)), None)
    if kinds is None:
        raise CallbackError(f"{element.__name__} must derive from Spring, Damper or Tyre")
    kind = element.model_fields["kind"].default
    if not isinstance(kind, str):
        raise CallbackError(f"{element.__name__} needs a default for 'kind', like kind: Literal['mine'] = 'mine'")
    if kinds.get(kind, element) is not element:
        raise CallbackError(f"kind '{kind}' of {element.__name__} is taken by {kinds[kind].__name__}")
    law = element.law
    if LAWS.get(law.number, law) != law:
        raise CallbackError(f"law '{law.name}' has the same number as '{LAWS[law.number].name}'; rename it")
    for function in law.functions():
        helpers(function)
    kinds[kind] = element
    LAWS[law.number] = law


__all__ = [
    "CONTACT_LAWS",
    "CONTACT_TYRES",
    "DAMPERS",
    "GRAVITY",
    "LAWS",
    "SPRINGS",
    "TYRES",
    "Aerodynamics",
    "AntiRollBar",
    "AnyContactTyre",
    "AnyDamper",
    "AnySpring",
    "AnyTyre",
    "Brakes",
    "Compliance",
    "ConstantFrequencySpring",
    "ContactForces",
    "ContactLaw",
    "ContactTyre",
    "Damper",
    "Element",
    "Kinematics",
    "Law",
    "LinearContactTyre",
    "LinearSpring",
    "LinkageFriction",
    "MagicFormulaTyre",
    "Overturning",
    "Powertrain",
    "ProgressiveSpring",
    "Rig",
    "Spring",
    "Steering",
    "Stops",
    "TableDamper",
    "TableSpring",
    "Tyre",
    "TyreSpring",
    "ZonedDamper",
    "register",
    "register_contact_tyre",
]
