"""A manoeuvre module as a script: its parameters and the configurations to compare as command-line options."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NoReturn

from evaluation.animation.cameras import offered
from manoeuvres import MANOEUVRES, find_manoeuvre
from susp_mj.description import validate
from susp_mj.errors import InputError
from susp_mj.manoeuvre import Manoeuvre
from susp_mj.plugins import load_installed, load_plugin
from susp_mj.units import unit_of_field
from vehicles.models import MODELS
from vehicles.reading import VehicleFile
from vehicles.vehicle import DESIGN_LOAD

from .case import Case, usual_load, with_film

DEFAULT_VEHICLE = "chapter3"
WHOLE_CAR, WHOLE_CAR_SETS = "s_class", ("configuration_3", "configuration_4")
"""Car and sets of characteristics of models that need more than a quarter of a car."""


@dataclass(frozen=True)
class Asked:
    """What a command line asks for: a case with its nominal path, and where and how it is carried out."""

    case: Case
    path: Path
    out: Path
    video: bool
    workers: int | None


def case_from_arguments(name: str, arguments: Sequence[str]) -> Asked:
    """The case that the arguments of a manoeuvre script describe; plugins among them may bring the manoeuvre itself.

    A configuration is one combination of the given vehicles, sets of characteristics and load cases. Without a vehicle,
    a quarter car is that of chapter 3, any other model the whole car with two of its sets.
    """
    plugins = _plugins(arguments)
    kind = find_manoeuvre(name)
    manoeuvre = MANOEUVRES[kind]
    options = vars(_parser(kind, manoeuvre).parse_args(arguments))
    parameters = {name: options[name] for name in manoeuvre.model_fields if options.get(name) is not None}
    vehicles, chosen_sets = options["vehicle"], options["characteristics"]
    if not vehicles:
        quarter = options["model"].startswith("quarter")
        vehicles, chosen_sets = (
            ([DEFAULT_VEHICLE], chosen_sets) if quarter else ([WHOLE_CAR], chosen_sets or list(WHOLE_CAR_SETS))
        )
    loads = {
        vehicle: options["load"] or [usual_load(manoeuvre, VehicleFile.open(vehicle).loads)] for vehicle in vehicles
    }
    settings = [
        dict(
            name=_label(vehicles, vehicle, sets, load, loads[vehicle]),
            vehicle=_absolute(vehicle),
            characteristics=sets,
            load=load,
            axle=options["axle"],
        )
        for vehicle in vehicles
        for sets in chosen_sets or [None]
        for load in loads[vehicle]
    ]
    case = validate(
        Case,
        {
            "title": _title(manoeuvre, settings),
            "model": options["model"],
            "manoeuvre": {**parameters, "kind": kind},
            "configuration": settings,
            "plugins": plugins,
        },
        source=f"{kind}.py",
    )
    case = with_film(case, options["camera"], ghost=options["ghost"], fine=options["fine"])
    return Asked(case, Path(f"{kind}.py"), options["out"], options["video"], options["workers"])


def _plugins(arguments: Sequence[str]) -> list[str]:
    """Load what `--plugin` names; returns the files."""
    parser = _Parser(add_help=False, allow_abbrev=False)
    _add_plugin(parser)
    names = parser.parse_known_args(arguments)[0].plugin or []
    files = [str(Path(name).resolve()) for name in names]
    load_installed()
    for file in files:
        load_plugin(Path(file))
    return files


def _add_plugin(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--plugin", action="append", help="Python file that brings elements, manoeuvres, numbers or cameras, repeatable"
    )


class _Parser(argparse.ArgumentParser):
    """A parser whose complaints are one line, as all of ours."""

    def error(self, message: str) -> NoReturn:
        raise InputError(message, source=self.prog)


def _title(manoeuvre: type[Manoeuvre], settings: Sequence[dict[str, Any]]) -> str:
    """What is driven, and by which configurations in which load cases."""
    return f"{manoeuvre.title()}: " + ", ".join(f"{each['name']} (load {each['load']})" for each in settings)


def _absolute(vehicle: str) -> str:
    return str(Path(vehicle).resolve()) if vehicle.endswith(".toml") else vehicle


def _label(vehicles: Sequence[str], vehicle: str, sets: str | None, load: str, loads: Sequence[str]) -> str:
    parts = [
        Path(vehicle).stem if len(vehicles) > 1 or sets is None else "",
        sets or "",
        load if len(loads) > 1 else "",
    ]
    return ", ".join(part for part in parts if part)


def _parser(kind: str, manoeuvre: type[Manoeuvre]) -> argparse.ArgumentParser:
    parser = _Parser(prog=f"{kind}.py", description=(manoeuvre.__doc__ or "").split("\n\n")[0], allow_abbrev=False)
    parser.add_argument(
        "--vehicle", action="append", help=f"car or vehicle file, repeatable (default {DEFAULT_VEHICLE} or {WHOLE_CAR})"
    )
    parser.add_argument(
        "--characteristics", "-c", action="append", help="set of characteristics of the car, repeatable"
    )
    model, test = manoeuvre.default_model, manoeuvre.test_load
    load = f"{test} where the car has it, as ISO 15037-1 asks for, else {DESIGN_LOAD}" if test else DESIGN_LOAD
    parser.add_argument("--load", nargs="+", help=f"load cases (default {load})")
    parser.add_argument("--model", "-m", default=model, help=f"{', '.join(MODELS)} (default {model})")
    parser.add_argument("--axle", choices=("front", "rear"))
    parser.add_argument(
        "--out", "-o", type=Path, default=Path("out") / kind, help=f"folder for the results (default out/{kind})"
    )
    _add_plugin(parser)
    parser.add_argument("--workers", type=int, help="configurations at a time (default: as many as there are cores)")
    parser.add_argument("--video", action="store_true", help="also render an animation")
    parser.add_argument("--camera", help=f"of a driving car: {offered()} (default: what suits the manoeuvre)")
    parser.add_argument("--ghost", action="store_true", help="two driving cars in one scene")
    parser.add_argument("--fine", action="store_true", help="finer pictures of driving cars")
    group = parser.add_argument_group("parameters", "a number in SI, or a text with its unit like '80 mm'")
    for name, field in manoeuvre.model_fields.items():
        if name != "kind":
            unit = unit_of_field(field)
            text = f"default {field.default}{' ' + unit if unit else ''}"
            several = "+" if "tuple" in str(field.annotation) else None
            group.add_argument(
                f"--{name.replace('_', '-')}", dest=name, type=_value, nargs=several, help=text, metavar=unit or "VALUE"
            )
    return parser


def _value(text: str) -> Any:
    """A bare number is SI; true and false are switches; the rest is a text with a unit."""
    if text.lower() in ("true", "false"):
        return text.lower() == "true"
    try:
        return float(text)
    except ValueError:
        return text
