"""What every element has in common: a description whose law turns its parameters into forces, chosen by its `kind`."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from numbers import Real
from typing import Any, ClassVar, TypeVar

import numpy as np
from numpy.typing import ArrayLike
from pydantic import BeforeValidator
from pydantic_core import PydanticCustomError

from ..description import Description
from ..errors import choices, short, wrong_answer
from .law import FORCE, Law, Role, numbers_of

FloatArray = np.ndarray[Any, np.dtype[np.float64]]


class Element(Description, ABC):
    """Description of an element; `law` turns `parameters()` into what the element does.

    A subclass provides the fields, the class attribute `law` and `parameters`; evaluation, plotting and the MJCF
    builders do the rest.
    """

    role: ClassVar[Role]
    """What the laws of the element's family are asked and answer."""
    law: ClassVar[Law]

    @property
    def active_law(self) -> Law:
        """The law that applies to this instance; the class's own unless its fields select another."""
        return self.law

    @abstractmethod
    def parameters(self) -> tuple[float, ...]:
        """Numbers handed to the law, SI, in the law's own order."""


class ForceElement(Element):
    """An element that pushes two points apart."""

    role: ClassVar[Role] = FORCE
    owed_with_state: ClassVar[tuple[str, ...]] = ("time_constant",)
    """Methods that a kind whose law has an inner state must define itself."""

    def evaluate(self, deflection: ArrayLike = 0.0, speed: ArrayLike = 0.0, state: ArrayLike = 0.0) -> FloatArray:
        """Force [N] of the law, positive in compression; arguments broadcast as in numpy.

        Raises:
            InputError: the law gives no numbers.
        """
        p, function = numbers_of(self), self.active_law.function
        force = np.vectorize(lambda x, v, y: function(x, v, y, p), otypes=[float])
        try:
            return force(np.asarray(deflection, float), np.asarray(speed, float), np.asarray(state, float))
        except (TypeError, ValueError):
            at_rest = function(0.0, 0.0, 0.0, p)
            if not isinstance(at_rest, Real):
                raise wrong_answer(function, short(at_rest), "a number") from None
            raise

    def time_constant(self) -> float | None:
        """Fastest time constant [s] of the inner state, which the step must resolve; None without one."""
        return None


Kind = TypeVar("Kind", bound=Description)


def chosen_kind(data: Mapping[Any, Any], kinds: Mapping[str, type[Kind]], usual: str | None = None) -> type[Kind]:
    """The class that a table asks for by its `kind`, or the `usual` one.

    Raises:
        PydanticCustomError: for use in validators; no kind, or an unknown one.
    """
    kind = data.get("kind", usual)
    if kind is None:
        raise PydanticCustomError("unknown_kind", "is required; {text}", {"text": choices(kinds), "key": "kind"})
    if not isinstance(kind, str) or kind not in kinds:
        text = f"'{kind}' unknown; {choices(kinds, kind)}"
        raise PydanticCustomError("unknown_kind", "{text}", {"text": text, "key": "kind"})
    return kinds[kind]


def chosen_from(kinds: Mapping[str, type[Kind]], usual: str | None = None) -> BeforeValidator:
    """Validator that reads a table by its `kind`; `kinds` is looked up at use, so registered kinds count too.

    Args:
        usual: kind of a table that names none.
    """

    def choose(data: Any) -> Any:
        return chosen_kind(data, kinds, usual).model_validate(data) if isinstance(data, dict) else data

    return BeforeValidator(choose)
