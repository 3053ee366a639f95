"""The models by their names, and what the oscillation models are made of; `vehicles.mjcf` builds them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal


@dataclass(frozen=True)
class Topology:
    """What an oscillation model is made of.

    Attributes:
        title: one line.
        freedoms: of the body, of heave, pitch, roll.
        axles: how many, 1 or 2.
        sides: wheels of an axle, 1 or 2; with 1 the model is one side of the car.
        sprung_wheels: whether the wheels have mass and stand on tyre springs; else they follow the road, massless.
        rigid_axle: whether a beam joins the two wheels.
    """

    title: str
    freedoms: tuple[str, ...]
    axles: Literal[1, 2]
    sides: Literal[1, 2]
    sprung_wheels: bool
    rigid_axle: bool = False


OSCILLATION: dict[str, Topology] = {
    "quarter_1dof": Topology(
        "OM1: body heave; the massless wheel follows the road", ("heave",), 1, 1, sprung_wheels=False
    ),
    "axle_2dof": Topology(
        "OM2: body heave and roll on a massless rigid axle",
        ("heave", "roll"),
        1,
        2,
        sprung_wheels=False,
        rigid_axle=True,
    ),
    "pitch_2dof": Topology(
        "OM3: body heave and pitch, one side; massless wheels", ("heave", "pitch"), 2, 1, sprung_wheels=False
    ),
    "full_3dof": Topology(
        "OM4: body heave, pitch and roll; massless wheels", ("heave", "pitch", "roll"), 2, 2, sprung_wheels=False
    ),
    "quarter_2dof": Topology("OM5: body heave, wheel mass on a tyre spring", ("heave",), 1, 1, sprung_wheels=True),
    "axle_4dof": Topology(
        "OM6: body heave and roll on a rigid axle with mass",
        ("heave", "roll"),
        1,
        2,
        sprung_wheels=True,
        rigid_axle=True,
    ),
    "full_7dof": Topology(
        "OM7: body heave, pitch and roll, four wheel masses", ("heave", "pitch", "roll"), 2, 2, sprung_wheels=True
    ),
}

HANDLING = "handling"
MODELS: dict[str, str] = {
    **{name: topology.title for name, topology in OSCILLATION.items()},
    HANDLING: "3D car that drives: look-up suspension, tyres with slip, steering, power train, brakes, air",
}
"""Names of the models, and what they are."""
