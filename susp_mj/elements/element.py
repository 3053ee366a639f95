"""What every force element has in common, and how a file chooses one by its `kind`."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from typing import Any, ClassVar, TypeVar

import numpy as np
from numpy.typing import ArrayLike
from pydantic import BeforeValidator
from pydantic_core import PydanticCustomError

from ..description import Description
from ..errors import choices
from .law import Law

FloatArray = np.ndarray[Any, np.dtype[np.float64]]


class Element(Description, ABC):
    """Description of a force element; `law` turns `parameters()` into a force.

    A subclass provides the fields, the class attribute `law` and `parameters`; evaluation, plotting and the MJCF
    builders do the rest.
    """

    law: ClassVar[Law]

    @property
    def active_law(self) -> Law:
        """The law that applies to this instance; the class's own unless its fields select another."""
        return self.law

    @abstractmethod
    def parameters(self) -> tuple[float, ...]:
        """Numbers handed to the law, SI, in the law's own order."""

    def evaluate(self, deflection: ArrayLike = 0.0, speed: ArrayLike = 0.0, state: ArrayLike = 0.0) -> FloatArray:
        """Force [N] of the law, positive in compression; arguments broadcast as in numpy."""
        p = self.parameters()
        force = np.vectorize(lambda x, v, y: self.active_law.force(x, v, y, p), otypes=[float])
        return force(np.asarray(deflection, float), np.asarray(speed, float), np.asarray(state, float))


Kind = TypeVar("Kind", bound=Description)


def chosen_kind(data: Mapping[Any, Any], kinds: Mapping[str, type[Kind]]) -> type[Kind]:
    """The class that a table asks for by its `kind`.

    Raises:
        PydanticCustomError: for use in validators; no kind, or an unknown one.
    """
    kind = data.get("kind")
    if kind is None:
        raise PydanticCustomError("unknown_kind", "is required; {text}", {"text": choices(kinds), "key": "kind"})
    if not isinstance(kind, str) or kind not in kinds:
        raise PydanticCustomError(
            "unknown_kind", "{text}", {"text": f"'{kind}' unknown; {choices(kinds, kind)}", "key": "kind"}
        )
    return kinds[kind]


def chosen_from(kinds: Mapping[str, type[Kind]]) -> BeforeValidator:
    """Validator that reads a table by its `kind`; `kinds` is looked up at use, so registered kinds count too."""

    def choose(data: Any) -> Any:
        return chosen_kind(data, kinds).model_validate(data) if isinstance(data, dict) else data

    return BeforeValidator(choose)
