"""What a turn of a knob does to targets: how far it moves them, whether that helps, what it makes up for."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from ..display import number_text, quantity_text
from ..story import Attempt, Finding, Influence, Story

HARDLY = "hardly anything"
"""A change that the decimals shown do not show."""


def knob_words(knob: str) -> str:
    """A knob as a reader calls it.

    >>> knob_words("front.rebound_rate")
    'front rebound rate'
    """
    return knob.replace(".", " ").replace("_", " ")


def change_text(change: float, unit: str) -> str:
    """A change in SI `unit` with its sign.

    >>> change_text(0.0021, "m"), change_text(-900.0, "N/m"), change_text(1e-6, "m")
    ('+2.1 mm', '−0.90 kN/m', 'hardly anything')
    """
    text = quantity_text(change, unit)
    if change and not any(each in "123456789" for each in number_text(change, unit)):
        return HARDLY
    return text if text.startswith("−") else f"+{text}"


def effect(finding: Finding | None, change: float) -> str:
    """ "helps" where a change [SI] of a value leaves more room to its band, "hurts" where it leaves less; empty where
    that is not known."""
    if finding is None or finding.value is None or finding.margin is None:
        return ""
    moved = replace(finding, value=finding.value + change).margin
    if moved is None or moved == finding.margin:
        return ""
    return "helps" if moved > finding.margin else "hurts"


def made_up_for(finding: Finding, moved: float) -> float | None:
    """Share of what is missing that a move of the value [SI] makes up for, negative where it adds to it; None where
    that is not known."""
    if finding.value is None or finding.margin is None or finding.margin >= 0:
        return None
    below = finding.minimum is not None and finding.value < finding.minimum
    return (moved if below else -moved) / -finding.margin


def known_bands(story: Story, attempt: Attempt) -> Mapping[str, Finding]:
    """Findings of a candidate by key; beyond where it came, those of others whose band is open on one side, which tells
    the good direction whatever the value."""
    others = {
        each.key: each
        for other in story.attempts
        for each in other.findings
        if (each.minimum is None) != (each.maximum is None)
    }
    return {**others, **{each.key: each for each in attempt.findings}}


def influence_row(influence: Influence, missed: Finding, known: Mapping[str, Finding]) -> dict[str, Any]:
    """What one knob does: to the missed target, and besides."""
    moved, share = change_text(influence.moved, influence.unit), made_up_for(missed, influence.moved)
    return {
        "knob": knob_words(influence.knob),
        "change": influence.change,
        "moved": moved,
        "effect": "" if moved == HARDLY else effect(missed, influence.moved),
        "share": "" if share is None else f"{100 * share:.0f} %".replace("-", "−"),
        "also": [
            {"target": key, "moved": change_text(change, unit), "effect": effect(known.get(key), change)}
            for key, (change, unit) in influence.also.items()
        ],
    }
