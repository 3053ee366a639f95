"""What the figures of a cycle share: which candidates are drawn, each in a colour of its own, and what is asked."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from susp_mj.run import Run

from ..display import shown
from ..story import Finding, Story
from .figure import LINE_WIDTH, draw_line, limit_line, make_panels, thinned

if TYPE_CHECKING:
    import numpy as np
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

MOST = 6
"""With more candidates than these, characteristics are drawn of the first, the last discarded and the kept one."""
_KEPT_WIDTH, _OTHER_WIDTH = 1.7 * LINE_WIDTH, 0.75 * LINE_WIDTH


@dataclass(frozen=True)
class Plot:
    """A figure of a cycle.

    Attributes:
        title: what it shows.
        caption: check, place and candidates, and how to read it.
        svg: the figure.
    """

    title: str
    caption: str
    svg: str


@dataclass(frozen=True)
class Cast:
    """Candidates that figures show, each in the same colour in all of them; the kept one stands out.

    Attributes:
        names: in the order in which they were tried, which is that of the colours.
        kept: name of the kept one, or empty.
    """

    names: tuple[str, ...]
    kept: str

    @classmethod
    def of(cls, story: Story) -> Cast:
        """Candidates of a story whose characteristics or runs are drawn, and the kept one."""
        kept = "" if story.kept is None else story.kept.name
        run = (name for places in story.runs.values() for runs in places.values() for name in runs)
        seen = {kept, *with_curves(story), *run}
        return cls(tuple(each.name for each in story.attempts if each.name in seen), kept)

    def order(self, name: str) -> int:
        """Place of a candidate in the order of colours."""
        return self.names.index(name)

    def of_these(self, names: Iterable[str]) -> list[str]:
        """Those of the names that are drawn, in their order."""
        wanted = set(names)
        return [each for each in self.names if each in wanted]

    def panels(self, names: Sequence[str], titles: Sequence[str], **how: Any) -> tuple[Figure, list[Axes]]:
        """A figure with these candidates in its legend."""
        labels = [f"{each}, kept" if each == self.kept else each for each in names]
        return make_panels(labels, titles, orders=[self.order(each) for each in names], **how)

    def width(self, name: str) -> float:
        """Of a candidate's line [points]; all are alike where none is kept."""
        if not self.kept:
            return LINE_WIDTH
        return _KEPT_WIDTH if name == self.kept else _OTHER_WIDTH

    def kept_first(self, names: Iterable[str]) -> list[str]:
        """Those of the names that are drawn, in the order of drawing: the kept one's wide line lies lowest."""
        return sorted(self.of_these(names), key=lambda each: each != self.kept)

    def line(self, panel: Axes, name: str, x: np.ndarray, y: np.ndarray) -> None:
        """One candidate's line."""
        draw_line(panel, self.order(name), *thinned(x, y), self.width(name))


def with_curves(story: Story) -> list[str]:
    """Candidates whose characteristics are drawn."""
    names = [each.name for each in story.attempts if story.curves.get(each.name)]
    if len(names) <= MOST:
        return names
    kept = story.kept
    discarded = [each for each in names if kept is None or each != kept.name]
    chosen = {names[0], discarded[-1], *([] if kept is None else [kept.name])}
    return [each for each in names if each in chosen]


@dataclass(frozen=True, eq=False)
class Scene:
    """Runs of several candidates through one check at one place.

    Attributes:
        check, place: as the story names them.
        runs: by candidate.
        findings: of all candidates, for what is asked.
    """

    check: str
    place: str
    runs: Mapping[str, Run]
    findings: Sequence[Finding]

    @property
    def where(self) -> str:
        """Check, place and candidates in words."""
        one = "candidate" if len(self.runs) == 1 else "candidates"
        return f"{self.check}, {self.place}; {one} {', '.join(self.runs)}"

    @property
    def held(self) -> bool:
        """Whether a target is held against these very runs."""
        return any(each.step == self.check for each in self.findings)

    def asked(self, *targets: str, anywhere: bool = False) -> Finding | None:
        """A finding of the first of these targets for this check, or else of another step, at this place.

        Args:
            anywhere: whether one of another place and another step does as well.
        """
        found = [each for target in targets for each in self.findings if each.target == target]
        here = [each for each in found if each.where == self.place]
        other = [each for each in found if not self._of_another_check(each)] if anywhere else []
        return next(iter([*(each for each in here if each.step == self.check), *here, *other]), None)

    def _of_another_check(self, finding: Finding) -> bool:
        return finding.step == self.check and finding.where != self.place


def scenes(story: Story, cast: Cast) -> Iterator[Scene]:
    """All runs of a story, by check and place."""
    findings = [each for attempt in story.attempts for each in attempt.findings]
    for check, places in story.runs.items():
        for place, runs in places.items():
            known = {name: runs[name] for name in cast.of_these(runs)}
            if known:
                yield Scene(check, place, known, findings)


def draw_limits(
    panel: Axes, finding: Finding | None, *, start: float = 0.0, horizontal: bool = True, end: str = "right"
) -> None:
    """Bounds of what is asked, each at ``start + bound`` in the unit shown; nothing without any."""
    if finding is None:
        return
    factor = shown(finding.unit).factor
    bounds = sorted({each for each in (finding.minimum, finding.maximum) if each is not None})
    for place, bound in enumerate(bounds):
        name = f"asked: {finding.band}" if place == len(bounds) - 1 else ""
        limit_line(panel, start + bound * factor, name, horizontal=horizontal, end=end)
