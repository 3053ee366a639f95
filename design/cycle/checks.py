"""Stage 2 of a cycle: manoeuvres of the targets file, their numbers held against bands."""

from __future__ import annotations

from collections.abc import Collection, Iterator

from evaluation.display import quantity_text
from evaluation.numbers import NUMBERS, Criterion, Number
from evaluation.story import Finding, TradeOff
from susp_mj.names import AXLES

from ..case import read_manoeuvre
from .candidate import Layout
from .characteristics import Tried, place_name
from .ledger import Answered, Asked
from .targets import Check, Response

ONE_AXLE = ("quarter", "axle")


def check(tried: Tried, asked: Check, only: Collection[str] | None = None) -> Iterator[Finding]:
    """One check at its loads and axles; a run that does not come to its end misses every band.

    Args:
        only: places, as findings name them, beyond which nothing is run.
    """
    manoeuvre = read_manoeuvre(asked.manoeuvre, tried.layout.path)
    title = f"{manoeuvre.declared().title}, {asked.model}"
    bands = {name: band.criterion(NUMBERS[name].unit, name) for name, band in asked.criteria.items()}
    places = places_of(tried.layout, asked, only)
    answers = tried.ask([run_of(tried, asked, load, axle) for load, axle in places])
    for (load, axle), answer in zip(places, answers, strict=True):
        for name, band in bands.items():
            yield _finding(asked.name, name, place_name(load, axle), title, answer, band)


def places_of(layout: Layout, asked: Check, only: Collection[str] | None = None) -> list[tuple[str, str | None]]:
    """Loads and axles at which a check runs; `only` as of `check`."""
    places = [(load, axle) for axle in axles_of(asked) for load in asked.loads or layout.targets.loads]
    return [each for each in places if only is None or place_name(*each) in only]


def axles_of(asked: Check | Response) -> tuple[str | None, ...]:
    """Axles that a check or response runs on one by one; None for a model of the whole car."""
    return asked.axles or (AXLES if asked.model.startswith(ONE_AXLE) else (None,))


def run_of(tried: Tried, asked: Check, load: str, axle: str | None) -> Asked:
    """The run of a check at one load."""
    label, numbers = f"{asked.name}, {place_name(load, axle)}", tuple(asked.criteria)
    key = f"check.{tried.layout.targets.check.index(asked)}"
    return tried.run(label, asked.model, load, axle, asked.manoeuvre, numbers, asked.step, key)


def _finding(check_name: str, name: str, where: str, title: str, answer: Answered, band: Criterion) -> Finding:
    number = answer.numbers.get(name, Number(None, NUMBERS[name].unit, answer.failed))
    what = (check_name, name.replace("_", " "), where, title, {}, number.value, number.unit, band.minimum, band.maximum)
    bare = Finding(*what)
    short = bare.margin
    by = "" if short is None else f", by {quantity_text(-short, number.unit)}"
    place = f" ({number.note})" if number.note and number.value is not None else ""
    if answer.failed:
        words = f"{check_name} at {where}: {answer.failed}"
    elif number.value is None:
        words = f"{check_name} at {where}: {bare.target} has no value: {number.note}"
    else:
        words = (
            f"{check_name} at {where}: {bare.target} is {quantity_text(number.value, number.unit)}{place}, asked is "
            f"{bare.band}; missed{by}"
        )
    return Finding(*what, number.note, words)


def trade_offs(tried: Tried, with_ratio: dict[str, Tried]) -> list[TradeOff]:
    """Responses of the targets file over the dampers' compression to rebound ratio.

    Args:
        tried: the kept candidate.
        with_ratio: the same candidate with each of the ratios.
    """
    responses = tried.layout.targets.trade_off.response
    asked = [_ratio_runs(other, response) for response in responses for other in with_ratio.values()]
    answers = iter(tried.ask([run for runs in asked for run in runs]))
    found = iter([[next(answers) for _ in runs] for runs in asked])
    return [
        TradeOff(
            response.title,
            NUMBERS[response.number].unit,
            tuple(with_ratio),
            tuple(_worst(next(found), response.number) for _ in with_ratio),
        )
        for response in responses
    ]


def _ratio_runs(tried: Tried, response: Response) -> list[Asked]:
    axles = axles_of(response)
    return [
        tried.run(response.title, response.model, response.load, axle, response.manoeuvre, (response.number,))
        for axle in axles
    ]


def _worst(answers: list[Answered], number: str) -> float | None:
    values = [each.numbers[number].value for each in answers if not each.failed]
    return max((value for value in values if value is not None), key=abs, default=None)
