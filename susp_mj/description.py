"""Base of everything read from a file: frozen, no unknown keys, errors as one line."""

from __future__ import annotations

from collections.abc import Collection
from pathlib import Path
from typing import Any, TypeVar

from pydantic import AfterValidator, BaseModel, ConfigDict, ValidationError, ValidationInfo, model_validator
from pydantic_core import PydanticCustomError

from .errors import InputError, choices

Described = TypeVar("Described", bound="Description")


class Description(BaseModel):
    """A frozen, validated value; an unknown key is an error that lists the known ones."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False, defer_build=True)

    @model_validator(mode="before")
    @classmethod
    def _known_keys(cls, data: Any) -> Any:
        if isinstance(data, dict):
            for key in data:
                if key not in cls.model_fields:
                    raise PydanticCustomError(
                        "unknown_key",
                        "unknown key; {choices}",
                        {"key": str(key), "choices": choices(cls.model_fields, key)},
                    )
        return data


def beside(name: str, info: ValidationInfo) -> Path:
    """Path of a file that is named relative to the one being read; for use inside a validator."""
    return ((info.context or {}).get("folder") or Path()) / name


def left_out(kind: type) -> str:
    """Names of what a class leaves out that its base class asks for, in a row; empty if it is complete."""
    return ", ".join(sorted(getattr(kind, "__abstractmethods__", ())))


def wrong(message: str, key: str = "") -> PydanticCustomError:
    """Error to raise inside a validator; `key` names the field below the object being validated."""
    return PydanticCustomError("wrong", "{text}", {"text": message, "key": key})


def one_of(names: Collection[str]) -> AfterValidator:
    """A text that must be one of some names; the error shows those that are near."""

    def known(name: str) -> str:
        if name not in names:
            raise wrong(f"'{name}' unknown; {choices(names, name)}")
        return name

    return AfterValidator(known)


def validate(
    kind: type[Described], data: Any, *, source: str = "", key: str = "", folder: Path | None = None
) -> Described:
    """Build `kind` from plain data; what it names by a relative path lies in `folder`, by default the working one.

    Raises:
        InputError: with the dotted path of the first offending value below `key`, in `source`.
    """
    try:
        return kind.model_validate(data, context={"folder": folder})
    except ValidationError as error:
        raise input_error(error, source=source, key=key) from None


def input_error(error: ValidationError, *, source: str = "", key: str = "") -> InputError:
    """The first of pydantic's complaints as one line of ours."""
    details = error.errors()
    first = details[0]
    context = first.get("ctx", {})
    path = [key, *(str(part) for part in first["loc"]), str(context.get("key", ""))]
    value = first.get("input")
    message = {
        "missing": "is required",
        "greater_than": f"{value!r} is not allowed; it must be greater than {context.get('gt')}",
        "greater_than_equal": f"{value!r} is not allowed; it must be at least {context.get('ge')}",
        "less_than": f"{value!r} is not allowed; it must be less than {context.get('lt')}",
        "less_than_equal": f"{value!r} is not allowed; it must be at most {context.get('le')}",
        "literal_error": f"{value!r} is not allowed; choose {context.get('expected')}",
        "model_type": f"{value!r} is not a table of values",
        "dict_type": f"{value!r} is not a table of values",
    }.get(first["type"], first["msg"] if first["type"] in _OURS else f"{value!r} is not allowed; {first['msg']}")
    if len(details) > 1:
        message += f" (and {len(details) - 1} more)"
    return InputError(message, key=".".join(part for part in path if part), source=source)


_OURS = {"wrong", "unknown_key", "quantity", "unknown_kind"}
