"""susp_mj: what makes force and lets time pass. Import `simulate`, `Run` and the errors from here."""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

from .hiding import explain_uncaught

if TYPE_CHECKING:
    from .errors import InputError as InputError
    from .errors import SimulationError as SimulationError
    from .errors import SuspMjError as SuspMjError
    from .manoeuvre import Manoeuvre as Manoeuvre
    from .plant import Plant as Plant
    from .run import Channel as Channel
    from .run import Run as Run
    from .simulation import simulate as simulate

_HOMES = {
    "Channel": "run",
    "InputError": "errors",
    "Manoeuvre": "manoeuvre",
    "Plant": "plant",
    "Run": "run",
    "SimulationError": "errors",
    "SuspMjError": "errors",
    "simulate": "simulation",
}
__all__ = [
    "Channel",
    "InputError",
    "Manoeuvre",
    "Plant",
    "Run",
    "SimulationError",
    "SuspMjError",
    "simulate",
]

explain_uncaught()


def __getattr__(name: str) -> Any:
    """Import on first use: MuJoCo and numpy load only when something is simulated."""
    if name not in _HOMES:
        raise AttributeError(f"module 'susp_mj' has no attribute '{name}'")
    value = getattr(importlib.import_module(f"susp_mj.{_HOMES[name]}"), name)
    globals()[name] = value
    return value
