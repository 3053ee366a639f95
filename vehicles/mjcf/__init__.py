"""Vehicle to MuJoCo: `build` makes a plant of a chosen topology, `write` puts it into an MJCF file."""

from __future__ import annotations

from .oscillation import MODELS, Topology, build, specification, write

__all__ = ["MODELS", "Topology", "build", "specification", "write"]
