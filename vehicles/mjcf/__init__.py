"""Vehicle to MuJoCo: `build` makes a plant of a chosen model, `write` puts it into an MJCF file."""

from __future__ import annotations

from .building import MODELS, build, specification, write
from .handling import HANDLING, K_AND_C
from .topology import OSCILLATION, Topology

__all__ = ["HANDLING", "K_AND_C", "MODELS", "OSCILLATION", "Topology", "build", "specification", "write"]
