"""Story of a design cycle: candidates, the targets held against each, why one is discarded, and which is kept."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from .display import quantity_text

if TYPE_CHECKING:
    from .characteristics import Characteristic


@dataclass(frozen=True)
class Finding:
    """One target held against one candidate.

    Attributes:
        step: of the cycle, e.g. "load range" or the name of a check.
        target: what is asked, e.g. "stop hits"; with `where` it is the same for every candidate.
        where: at which axle, load or speed, e.g. "rear axle, full"; may be empty.
        formula: by which it is found, or the manoeuvre that shows it.
        inputs: what goes in, name -> text with unit.
        value: in SI `unit`; None where there is none (`note` says why).
        unit: SI unit.
        minimum, maximum: band, bounds included; None is open.
        note: place and instant: which wheel, when, at what height.
        words: what to say where the target is missed, a sentence without its end.
        assumed: whether the band is a default, not the user's.
    """

    step: str
    target: str
    where: str
    formula: str
    inputs: Mapping[str, str]
    value: float | None
    unit: str
    minimum: float | None = None
    maximum: float | None = None
    note: str = ""
    words: str = ""
    assumed: bool = False

    @property
    def key(self) -> str:
        """Names the row of a table of candidates."""
        return f"{self.step}: {self.target}" + (f", {self.where}" if self.where else "")

    @property
    def passed(self) -> bool:
        """Whether the value lies in the band; without a value it does not."""
        if self.value is None:
            return False
        return (self.minimum is None or self.value >= self.minimum) and (
            self.maximum is None or self.value <= self.maximum
        )

    @property
    def margin(self) -> float | None:
        """Distance to the nearer bound [SI], negative beyond it; None without a value or a bound."""
        if self.value is None:
            return None
        room = [self.value - self.minimum] if self.minimum is not None else []
        room += [self.maximum - self.value] if self.maximum is not None else []
        return min(room, default=None)

    @property
    def band(self) -> str:
        """The band with its unit, e.g. "at least 1.0 mm"."""
        low, high = quantity_text(self.minimum, self.unit), quantity_text(self.maximum, self.unit)
        if self.minimum is None:
            return "" if self.maximum is None else f"at most {high}"
        return f"at least {low}" if self.maximum is None else low if low == high else f"{low} to {high}"


@dataclass(frozen=True)
class Influence:
    """What one knob does to a missed target, and what else it moves.

    Attributes:
        target: key of the finding that was missed.
        knob: e.g. "front.rebound_rate".
        change: of it, in words, e.g. "+10 %".
        moved: change of the missed target's value [SI].
        unit: of that.
        also: what else moves: key of the finding -> (change [SI], unit), the largest ones first.
    """

    target: str
    knob: str
    change: str
    moved: float
    unit: str
    also: Mapping[str, tuple[float, str]] = field(default_factory=dict)


@dataclass(frozen=True)
class Attempt:
    """A candidate and what became of it.

    Attributes:
        name: a letter, or what the user calls it.
        because: why it was tried.
        parent: name of the candidate that it changes; empty for a first one.
        values: every knob -> (value in SI or text, unit).
        changed: knobs in which it differs from its parent, or from the car.
        findings: in the order of the steps, as far as it came.
        kept: whether it met every target.
        reason: why it was discarded, in words; empty if it is kept.
        influences: the knobs that move what was missed.
    """

    name: str
    because: str
    parent: str
    values: Mapping[str, tuple[float | str, str]]
    changed: Sequence[str]
    findings: Sequence[Finding]
    kept: bool
    reason: str = ""
    influences: Sequence[Influence] = ()

    @property
    def missed(self) -> list[Finding]:
        """Findings outside their bands."""
        return [each for each in self.findings if not each.passed]


@dataclass(frozen=True)
class TradeOff:
    """One response of the kept candidate over the compression to rebound ratio of its dampers.

    Attributes:
        title: what responds, e.g. "side slip gain, lenksweep".
        unit: SI unit.
        ratios: compression to rebound, e.g. "1:2".
        values: of the response; None where a run has none.
    """

    title: str
    unit: str
    ratios: Sequence[str]
    values: Sequence[float | None]


@dataclass(frozen=True)
class Story:
    """A whole cycle.

    Attributes:
        title, description: of the targets.
        vehicle: the car in one line.
        attempts: in the order in which they were tried.
        verdict: one sentence.
        trade_offs: of the kept candidate.
        curves: attempt -> characteristics of its axles.
        static: load -> axle -> static force on one wheel's spring [N].
        runs: of the kept and the last discarded candidate: check -> load -> attempt -> Run.
        notes: what was assumed: defaults and estimates, one sentence each.
        made: versions and what was run, for the foot of a page.
        components: what is asked of springs and dampers themselves: title -> rows of label and text.
    """

    title: str
    description: str
    vehicle: str
    attempts: Sequence[Attempt]
    verdict: str
    trade_offs: Sequence[TradeOff] = ()
    curves: Mapping[str, Sequence[Characteristic]] = field(default_factory=dict)
    static: Mapping[str, Mapping[str, float]] = field(default_factory=dict)
    runs: Mapping[str, Mapping[str, Mapping[str, Any]]] = field(default_factory=dict)
    notes: Sequence[str] = ()
    made: Mapping[str, str] = field(default_factory=dict)
    components: Mapping[str, Sequence[tuple[str, str]]] = field(default_factory=dict)

    @property
    def kept(self) -> Attempt | None:
        """The candidate that is kept: of several that meet every target the one that was tried last."""
        return next((each for each in reversed(self.attempts) if each.kept), None)

    @property
    def rows(self) -> list[str]:
        """Keys of all findings, in the order in which they first appear."""
        return list(dict.fromkeys(each.key for attempt in self.attempts for each in attempt.findings))
