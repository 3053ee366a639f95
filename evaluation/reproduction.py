"""Reproduction: published claims beside what comes out, with what is shown beside them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from .compare import Claim


@dataclass(frozen=True)
class Beside:
    """A table that stands beside claims.

    Attributes:
        title: what it shows.
        columns: headings.
        rows: a text for each column.
        note: how to read it.
    """

    title: str
    columns: Sequence[str]
    rows: Sequence[Sequence[str]]
    note: str = ""


@dataclass(frozen=True)
class Part:
    """Claims that belong together.

    Attributes:
        title: of the part.
        claims: in the order of the source.
        tables: beside them.
    """

    title: str
    claims: Sequence[Claim]
    tables: Sequence[Beside] = ()


@dataclass(frozen=True)
class Reproduction:
    """All published claims beside what came out.

    Attributes:
        parts: in the order of the source.
        videos: file names of videos beside the page.
        made: versions and what was run, for the foot of the page.
    """

    parts: Sequence[Part]
    videos: Sequence[str] = ()
    made: Mapping[str, str] = field(default_factory=dict)

    @property
    def claims(self) -> list[Claim]:
        """The claims of all parts."""
        return [claim for part in self.parts for claim in part.claims]

    @property
    def passed(self) -> bool:
        """Whether every claim holds that is not known not to."""
        return all(claim.holds or claim.known for claim in self.claims)

    @property
    def verdict(self) -> str:
        """One sentence: how many claims agree, how many are known not to, and which fail."""
        claims = self.claims
        agree = sum(claim.holds for claim in claims)
        known = sum(claim.known and not claim.holds for claim in claims)
        failing = [claim.text for claim in claims if not (claim.holds or claim.known)]
        words = f"{agree} of {len(claims)} claims agree; {known} are known not to, for the reasons beside them"
        return f"{words}." if not failing else f"{words}; {len(failing)} should agree and do not: {'; '.join(failing)}."

    def plain(self) -> dict[str, Any]:
        """As JSON values."""
        return {
            "verdict": self.verdict,
            "passed": self.passed,
            "parts": [
                {
                    "title": part.title,
                    "claims": [claim.plain() for claim in part.claims],
                    "tables": [
                        {"title": each.title, "columns": [*each.columns], "rows": [[*row] for row in each.rows]}
                        for each in part.tables
                    ],
                }
                for part in self.parts
            ],
            "made": dict(self.made),
        }
