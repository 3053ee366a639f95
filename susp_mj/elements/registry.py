"""Every law by its number, every kind of element by its family, and how a user's own joins them."""

from __future__ import annotations

import inspect

from ..description import left_out
from ..errors import CallbackError, place_of
from .aero import AERODYNAMICS, Aerodynamics
from .bars import AntiRollBar, Overturning
from .brakes import BRAKES, Brakes
from .dampers import DAMPERS, DIRECT_DAMPER, MOUNTED_DAMPER, Damper, HydraulicDamper
from .driver import Driver, PreviewDriver
from .element import Element, ForceElement
from .friction import LinkageFriction
from .law import Law, helpers
from .spring_damper import SpringDamper
from .springs import SPRINGS, Spring
from .stops import Stops
from .tyres.contact import CONTACT_TYRES
from .tyres.contact_tyre import ContactTyre
from .tyres.vertical import TYRES, Tyre

FAMILIES: dict[type, dict[str, type]] = {
    Spring: SPRINGS,
    Damper: DAMPERS,
    Tyre: TYRES,
    ContactTyre: CONTACT_TYRES,
    Brakes: BRAKES,
    Aerodynamics: AERODYNAMICS,
}
"""Elements that files choose by their `kind`."""
_OTHERS = (Stops, LinkageFriction, AntiRollBar, Overturning, SpringDamper, PreviewDriver)
LAWS: dict[int, Law] = {
    law.number: law
    for law in (
        *(kind.law for kinds in FAMILIES.values() for kind in kinds.values()),
        DIRECT_DAMPER,
        MOUNTED_DAMPER,
        *(other.law for other in _OTHERS),
    )
}


def register(element: type[Element] | type[Driver]) -> None:
    """Make an element of your own available by its `kind`, in files and in compiled code.

    Args:
        element: subclass of Spring, Damper, Tyre, ContactTyre, Brakes or Aerodynamics with `kind` as a `Literal`, `law`
            and `parameters`; or of Driver, which no file chooses and which needs no kind.

    Raises:
        CallbackError: it leaves out what its base class asks for, its kind or the number of its law is taken by
            something else, its law has another role than its family, takes other arguments than its role says, calls
            functions of another module, or has an inner state that the element says too little of.
    """
    kinds = next((kinds for family, kinds in FAMILIES.items() if issubclass(element, family)), None)
    if kinds is None and not issubclass(element, Driver):
        names = ", ".join(family.__name__ for family in FAMILIES)
        raise CallbackError(f"{element.__name__} must derive from {names} or Driver")
    if left_out(element):
        raise CallbackError(f"{element.__name__} does not define {left_out(element)}, which its base class asks for")
    _check_law(element)
    if kinds is not None and issubclass(element, Element):
        element.model_rebuild()  # a field that no file can give is refused here, by the line of a plugin
        kind = element.model_fields["kind"].default
        if not isinstance(kind, str):
            raise CallbackError(f"{element.__name__} needs a default for 'kind', like kind: Literal['mine'] = 'mine'")
        if kinds.get(kind, element) is not element:
            raise CallbackError(f"kind '{kind}' of {element.__name__} is taken by {kinds[kind].__name__}")
        kinds[kind] = element
    LAWS[element.law.number] = element.law


def _check_law(element: type[Element] | type[Driver]) -> None:
    """Refuse a law that compiled code could not call by its number."""
    law = element.law
    if law.role != element.role:
        wanted, family = element.role.name, element.__name__
        raise CallbackError(f"law '{law.name}' has role '{law.role.name}'; that of {family} needs role '{wanted}'")
    if LAWS.get(law.number, law) != law:
        raise CallbackError(f"law '{law.name}' has the same number as '{LAWS[law.number].name}'; rename it")
    taken = (*law.role.asked, "parameters", *(["out"] if law.role.answers else []))
    for function in law.functions():
        helpers(function)
        if len(inspect.signature(function).parameters) != len(taken):
            raise CallbackError(f"{place_of(function)}: a {law.role.name} law takes {', '.join(taken)}")
    if issubclass(element, HydraulicDamper) and law is not DIRECT_DAMPER:
        raise CallbackError(
            f"{element.__name__} has a law of its own, '{law.name}'; then it derives from Damper, without the friction "
            "and mount of HydraulicDamper"
        )
    if issubclass(element, ForceElement) and law.state_rate is not None:
        family = next(family for family in (*FAMILIES, ForceElement) if issubclass(element, family))
        owed = [name for name in element.owed_with_state if getattr(element, name) is getattr(family, name)]
        if owed:
            raise CallbackError(
                f"law '{law.name}' has an inner state; {element.__name__} must define {', '.join(owed)} for it"
            )
