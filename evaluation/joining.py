"""Comparisons of several folders as one: unique names, numbers and criteria in common, what sets the runs apart."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace

from susp_mj.errors import InputError, choices
from susp_mj.files import file_name

from .compare import Comparison, Configuration, Outcome
from .numbers.number import Criterion

_PARAMETER = "manoeuvre: "


def joined(comparisons: Mapping[str, Comparison], baseline: str = "") -> Comparison:
    """Several comparisons as one that holds the configurations of all against one of them.

    A name that several of them have becomes ``label/name``. Numbers are those that the baseline and another
    configuration have. Criteria are those of the baseline's own comparison, then those of the others, on numbers that
    every configuration has.

    Args:
        comparisons: by a label of each.
        baseline: name of a configuration; empty takes the first that has a run.

    Raises:
        InputError: an unknown baseline, one without a run, or fewer than two runs.
    """
    named = _renamed(comparisons)
    outcomes = [each for outcomes in named.values() for each in outcomes]
    own, against = _baseline(named, baseline)
    together = _with_numbers_of(against, outcomes)
    criteria = _criteria([comparisons[own], *comparisons.values()])
    common = set.intersection(*(set(each.numbers) for each in _runs(together)))
    changed = {name for each in comparisons.values() for name, band in each.criteria.items() if band != criteria[name]}
    sentences = (
        _sentence("What differs", what_differs({label: _runs(outcomes) for label, outcomes in named.items()})),
        _sentence("Bands that differ are those of the baseline, else of the first", _listed(changed & common)),
        _sentence("Criteria left out, not every configuration has the number", _listed(criteria.keys() - common)),
    )
    return Comparison(
        title=f"Comparison of {', '.join(comparisons)}",
        description=" ".join(sentence for sentence in sentences if sentence),
        outcomes=together,
        criteria={name: band for name, band in criteria.items() if name in common},
        baseline=against.name,
        descriptions={name: text for each in comparisons.values() for name, text in each.descriptions.items()},
    )


def _renamed(comparisons: Mapping[str, Comparison]) -> dict[str, list[Outcome]]:
    """The outcomes by label, under names that no two of them share, as names of files neither."""
    taken = Counter(_key(each.name) for comparison in comparisons.values() for each in comparison.outcomes)
    named = {
        label: [
            replace(each, name=f"{label}/{each.name}") if taken[_key(each.name)] > 1 else each
            for each in comparison.outcomes
        ]
        for label, comparison in comparisons.items()
    }
    again = Counter(_key(each.name) for outcomes in named.values() for each in outcomes)
    twice = [each.name for outcomes in named.values() for each in outcomes if again[_key(each.name)] > 1]
    if twice:
        raise InputError(f"'{twice[0]}' names two configurations; give a folder another name", key="compare")
    return named


def _key(name: str) -> str:
    return file_name(name).casefold()


def _runs(outcomes: Iterable[Outcome]) -> list[Configuration]:
    return [each for each in outcomes if isinstance(each, Configuration)]


def _baseline(named: Mapping[str, Sequence[Outcome]], name: str) -> tuple[str, Configuration]:
    """The configuration that is the baseline, and the label of its comparison."""
    found = {each.name: (label, each) for label, outcomes in named.items() for each in _runs(outcomes)}
    failed = [each.name for outcomes in named.values() for each in outcomes if each.name not in found]
    if name in failed:
        raise InputError(f"'{name}' has no run", key="baseline")
    if name and name not in found:
        raise InputError(f"'{name}' unknown; {choices(found, name)}", key="baseline")
    if len(found) < 2:
        raise InputError(f"{len(found) or 'no'} configuration has a run; two are needed", key="compare")
    return found[name or next(iter(found))]


def _with_numbers_of(baseline: Configuration, outcomes: Sequence[Outcome]) -> list[Outcome]:
    """The outcomes with those numbers alone that the baseline and another configuration have."""
    others = {name for each in _runs(outcomes) if each.name != baseline.name for name in each.numbers}
    kept = [name for name in baseline.numbers if name in others]
    return [
        replace(each, numbers={name: each.numbers[name] for name in kept if name in each.numbers})
        if isinstance(each, Configuration)
        else each
        for each in outcomes
    ]


def _criteria(comparisons: Iterable[Comparison]) -> dict[str, Criterion]:
    """Criteria by number; of several on one number that of the first comparison."""
    found: dict[str, Criterion] = {}
    for each in comparisons:
        found = {**each.criteria, **found}
    return found


def _sentence(about: str, text: str) -> str:
    return f"{about}: {text}." if text else ""


def _listed(names: Iterable[str]) -> str:
    return ", ".join(sorted(names))


def what_differs(named: Mapping[str, Sequence[Configuration]]) -> str:
    """What sets runs apart, in one line: car, load, model, manoeuvre or its parameters, step, version; each value with
    those that have it. Characteristics and overrides are what is compared, and not among them.

    Args:
        named: configurations by label.
    """
    aspects = {each.name: _aspects(each) for configurations in named.values() for each in configurations}
    if len({each["manoeuvre"] for each in aspects.values()}) > 1:
        aspects = {name: _without_parameters(each) for name, each in aspects.items()}
    said = []
    for key in dict.fromkeys(key for each in aspects.values() for key in each):
        values = {name: each.get(key, "none") for name, each in aspects.items()}
        if len(set(values.values())) > 1:
            words = ", ".join(f"{value} ({_who(named, values, value)})" for value in dict.fromkeys(values.values()))
            said.append(f"{key.removeprefix(_PARAMETER)} {words}")
    return "; ".join(said)


def _who(named: Mapping[str, Sequence[Configuration]], values: Mapping[str, str], value: str) -> str:
    """Who has a value: labels all of whose configurations have it, else the configurations."""
    found: list[str] = []
    for label, configurations in named.items():
        having = [each.name for each in configurations if values[each.name] == value]
        found += [label] if len(having) == len(configurations) > 0 and len(named) > 1 else having
    return ", ".join(found)


def _aspects(configuration: Configuration) -> dict[str, str]:
    meta, asked = configuration.run.meta, configuration.asked
    return {
        **configuration.facts,
        **{key: asked[key] for key in ("axle", "step") if key in asked},
        **{f"{_PARAMETER}{name}": text for name, text in asked.get("parameters", {}).items()},
        **{f"version of {name}": version for name, version in meta.get("versions", {}).items()},
    }


def _without_parameters(aspects: Mapping[str, str]) -> dict[str, str]:
    return {key: value for key, value in aspects.items() if not key.startswith(_PARAMETER)}
