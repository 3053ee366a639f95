"""What the thesis states, as data: `thesis.toml` holds each claim with its source, its band and what is known of it."""

from __future__ import annotations

from functools import cache
from pathlib import Path

from evaluation.compare import Claim
from evaluation.display import quantity_text
from susp_mj.description import Description, validate
from vehicles.reading import read_toml

from ..case import Band

FILE = Path(__file__).parent / "thesis.toml"


class Stated(Description):
    """A claim of the thesis.

    Attributes:
        claim: the statement.
        source: where it stands in the thesis.
        thesis: its value, or what it says, with what is accepted as agreeing.
        unit: SI unit of a claim of one number.
        band: of that number.
        why: what explains a result, or what limits it.
        disagrees: reason why the claim is known not to come out; without one it is expected to agree.
    """

    claim: str
    source: str
    thesis: str
    unit: str = "1"
    band: Band = Band()
    why: str = ""
    disagrees: str = ""

    def held(self, result: str, *, agrees: bool, why: str = "") -> Claim:
        """The claim beside a result in words."""
        reasons = [each for each in (why, self.why, self.disagrees if not agrees else "") if each]
        return Claim(self.claim, self.thesis, result, agrees, self.source, " ".join(reasons), bool(self.disagrees))

    def accepts(self, value: float | None) -> bool:
        """Whether a number [SI] lies in the band."""
        return self.band.criterion(self.unit, "band").passed(value)

    def valued(self, value: float | None, words: str = "") -> Claim:
        """The claim beside a number [SI], which agrees in its band; `words` say more of it."""
        text = quantity_text(value, self.unit)
        return self.held(f"{text}, {words}" if words else text, agrees=self.accepts(value))

    def failed(self, reason: str) -> Claim:
        """The claim beside a run that did not come to its end."""
        return self.held(f"no run: {reason}", agrees=False)


@cache
def stated() -> dict[str, Stated]:
    """Every claim by its key.

    Raises:
        InputError: the file is not as it shall be.
    """
    tables = read_toml(FILE)
    return {key: validate(Stated, table, source=FILE.name, key=key) for key, table in tables.items()}
