"""The claims of the thesis: all that is expected to come out does, what is known not to is told with its reason."""

from __future__ import annotations

import json
import re

import numpy as np
import pytest

from design import cli
from design.claims import reproducing, zuziehen
from design.claims.runs import Answered
from design.claims.stated import Stated, stated
from evaluation.compare import Claim
from evaluation.numbers import NUMBERS, Number
from evaluation.pages.reproduction import write_reproduction, write_reproduction_json
from evaluation.reproduction import Beside, Part, Reproduction


@pytest.fixture(scope="module")
def reproduction():
    """Everything but the window of the zuziehen, which is shown and not held against the thesis."""
    patch = pytest.MonkeyPatch()
    shipped = [zuziehen.Variation(f"as it ships, load {load}", load) for load in zuziehen.LOADS]
    patch.setattr(zuziehen, "variations", lambda: shipped)
    yield reproducing.reproduce()
    patch.undo()


def by_text(reproduction: Reproduction, key: str) -> Claim:
    return next(claim for claim in reproduction.claims if claim.text == stated()[key].claim)


def test_every_claim_is_answered_once(reproduction):
    texts = [claim.text for part in reproduction.parts[1:] for claim in part.claims]
    assert sorted(texts) == sorted(each.claim for each in stated().values())
    assert all(claim.source and claim.expected and claim.result for claim in reproduction.claims)


def test_what_is_expected_to_agree_agrees(reproduction):
    failing = [claim.text for claim in reproduction.claims if not claim.holds and not claim.known]
    assert failing == []
    assert reproduction.passed


def test_what_is_listed_as_not_agreeing_does_not_and_says_why(reproduction):
    """A reason that no longer applies is to be taken out of the list."""
    for key, each in stated().items():
        claim = by_text(reproduction, key)
        assert claim.holds is not bool(each.disagrees), key
        assert each.disagrees in claim.why


def test_figures_of_the_thesis(reproduction):
    """Figures stand in the results: under-damped cases, bars, roll, lift with time, acceleration and side."""
    assert by_text(reproduction, "under_damped").result.startswith("3 full 0.194, 2 empty 0.229")
    assert by_text(reproduction, "damping_lowers_stop_hits").result == "1: 6, 5, 5, 3; 2: 6, 5, 5, 3"
    for number, bars in {"3": (25.286, 14.387), "4": (7.118, 0.0)}.items():
        for axle, bar in zip(("front", "rear"), bars, strict=True):
            found = float(by_text(reproduction, f"anti_roll_bar_{axle}_{number}").result.split()[0])
            assert found == pytest.approx(bar, rel=0.02, abs=0.142)
        for load in ("full", "ko"):
            roll = float(by_text(reproduction, f"suspension_roll_{number}_{load}").result.split()[0])
            assert roll == pytest.approx(5.0, abs=0.2)
    lift = by_text(reproduction, "configuration_3_lifts_full").result
    found = re.match(r"lifts the inner front wheel \(fl\) after ([\d.]+) s at ([\d.]+) m/s²; on its stop", lift)
    assert (float(found[1]), float(found[2])) == pytest.approx((6.8, 7.76), abs=0.3)
    assert "mm left" in by_text(reproduction, "configuration_4_keeps_travel_full").result


def answered(**values):
    return Answered({name: Number(values.get(name), NUMBERS[name].unit) for name in zuziehen.NUMBERS})


NOT_LIFTED = {"travel_left_rebound_front": 0.003, "inner_wheel_load_front": 110.0}
ON_STOP = {"travel_left_rebound_front": -1e-4, "inner_wheel_load_front": 40.0}
LIFTED = {"inner_lift_instant_front": 6.8, "wheel_lift_instant": 6.8, **ON_STOP, "inner_wheel_load_front": 0.0}


@pytest.mark.parametrize(
    ("three", "four", "lift", "order"),
    [
        (LIFTED, NOT_LIFTED, True, True),
        (ON_STOP, NOT_LIFTED, False, True),
        (LIFTED, {**LIFTED, "inner_lift_instant_front": 7.5}, False, True),
        (LIFTED, ON_STOP, False, True),
        (ON_STOP, ON_STOP, False, False),
        (NOT_LIFTED, LIFTED, False, False),
        (NOT_LIFTED, ON_STOP, False, False),
    ],
)
def test_lift_and_order(three, four, lift, order):
    assert zuziehen.as_claimed(answered(**three), answered(**four)) is lift
    assert zuziehen.in_order(answered(**three), answered(**four)) is order


def test_a_car_that_falls_over_comes_first():
    fallen = Answered({}, "s_class, handling, ramp_steer: the car fell over at t = 9.4 s")
    assert zuziehen.in_order(fallen, answered(**LIFTED)) and not zuziehen.in_order(answered(**LIFTED), fallen)
    assert not zuziehen.as_claimed(fallen, answered(**NOT_LIFTED))


def test_a_claim_of_one_number_agrees_in_its_band():
    claim = Stated(claim="a", source="b", thesis="5°", unit="rad", band={"min": "4.8 deg", "max": "5.2 deg"})
    assert claim.valued(np.radians(5.1)).holds and not claim.valued(np.radians(5.3)).holds
    assert not claim.valued(None).holds and claim.valued(np.radians(5.1), "front").result == "5.10 °, front"
    assert claim.failed("it fell over").verdict == "does not agree"
    known = claim.model_copy(update={"disagrees": "because"})
    assert known.failed("it fell over").verdict == "does not agree, as is known" and known.failed("").why == "because"


# ---- what is left behind

CLAIMS = (
    Claim("holds & <is> so", "5", "5", True, "figure 1"),
    Claim("is known", "more", "less", False, "figure 2", "for this reason", known=True),
    Claim("should be so", "7", "8", False, "figure 3"),
)


def made_up(*claims: Claim) -> Reproduction:
    return Reproduction([Part("Part", claims, (Beside("Beside", ("a", "b"), (("1", "2"),), "read it so"),))])


def test_a_page_and_json_tell_every_claim(tmp_path):
    found = made_up(*CLAIMS)
    html = write_reproduction(found, tmp_path / "r.html").read_text(encoding="utf-8")
    assert "holds &amp; &lt;is&gt; so" in html and "for this reason" in html and "read it so" in html
    assert "does not agree, as is known" in html and "✗ Not reproduced." in html and "src=" not in html
    plain = json.loads(write_reproduction_json(found, tmp_path / "r.json").read_text(encoding="utf-8"))
    assert plain["passed"] is False
    assert [claim["holds"] for claim in plain["parts"][0]["claims"]] == [True, False, False]
    assert plain["parts"][0]["tables"][0]["rows"] == [["1", "2"]]


def test_a_claim_that_is_known_not_to_agree_does_not_fail():
    assert made_up(*CLAIMS[:2]).passed and not made_up(*CLAIMS).passed
    assert made_up(*CLAIMS).verdict.endswith("1 should agree and do not: should be so.")


@pytest.mark.parametrize(("claims", "code"), [(CLAIMS[:2], 0), (CLAIMS, 1)])
def test_the_command_ends_with_1_if_a_claim_fails(tmp_path, monkeypatch, capsys, claims, code):
    monkeypatch.setattr(reproducing, "reproduce", lambda *_: made_up(*claims))
    monkeypatch.setattr("sys.argv", ["susp-mj", "reproduce", "--no-video", "--out", str(tmp_path / "o")])
    try:
        cli.main()
        ended = 0
    except SystemExit as leave:
        ended = leave.code or 0
    assert ended == code
    assert {file.name for file in (tmp_path / "o").iterdir()} == {"reproduce.html", "reproduce.json"}
    assert "for this reason" in capsys.readouterr().out
