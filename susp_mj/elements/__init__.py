"""Elements: a validated description beside its law, one noun a file; `register` adds your own."""

from __future__ import annotations

from .aero import AERODYNAMICS, AIR, Aerodynamics, AnyAerodynamics, LinearAerodynamics
from .bars import AntiRollBar, Overturning
from .brakes import BRAKE, BRAKES, AnyBrakes, Brakes, ProportionalBrakes
from .dampers import DAMPERS, AnyDamper, Damper, HydraulicDamper, TableDamper, ZonedDamper
from .driver import DRIVER, Driver, Path, PreviewDriver
from .element import Element, ForceElement
from .friction import LinkageFriction
from .kinematics import Compliance, Kinematics
from .law import FORCE, Law, Role
from .powertrain import Powertrain
from .registry import FAMILIES, LAWS, register
from .spring_damper import SpringDamper
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
from .tyres.contact import CONTACT_TYRES, AnyContactTyre
from .tyres.contact_tyre import CONTACT, ContactForces, ContactTyre
from .tyres.linear import LinearContactTyre
from .tyres.magic_formula import MagicFormulaTyre
from .tyres.vertical import TYRES, AnyTyre, Tyre, TyreSpring

__all__ = [
    "AERODYNAMICS",
    "AIR",
    "BRAKE",
    "BRAKES",
    "CONTACT",
    "CONTACT_TYRES",
    "DAMPERS",
    "DRIVER",
    "FAMILIES",
    "FORCE",
    "GRAVITY",
    "LAWS",
    "SPRINGS",
    "TYRES",
    "Aerodynamics",
    "AntiRollBar",
    "AnyAerodynamics",
    "AnyBrakes",
    "AnyContactTyre",
    "AnyDamper",
    "AnySpring",
    "AnyTyre",
    "Brakes",
    "Compliance",
    "ConstantFrequencySpring",
    "ContactForces",
    "ContactTyre",
    "Damper",
    "Driver",
    "Element",
    "ForceElement",
    "HydraulicDamper",
    "Kinematics",
    "Law",
    "LinearAerodynamics",
    "LinearContactTyre",
    "LinearSpring",
    "LinkageFriction",
    "MagicFormulaTyre",
    "Overturning",
    "Path",
    "Powertrain",
    "PreviewDriver",
    "ProgressiveSpring",
    "ProportionalBrakes",
    "Role",
    "Spring",
    "SpringDamper",
    "Steering",
    "Stops",
    "TableDamper",
    "TableSpring",
    "Tyre",
    "TyreSpring",
    "ZonedDamper",
    "register",
]
