"""Page and file of a design cycle: every candidate, target and reason is there, in words as well as in colours."""

from __future__ import annotations

import json
import math
import re
from dataclasses import replace
from html import unescape
from xml.etree import ElementTree

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from evaluation.characteristics import characteristic
from evaluation.colours import COLOURS, LIFTED
from evaluation.pages.effects import HARDLY, change_text, effect, made_up_for
from evaluation.pages.verdict import write_verdict, write_verdict_json
from evaluation.plots.candidates import MOST, Cast, with_curves
from evaluation.plots.cycle import characteristic_plots, trade_off_plots
from evaluation.plots.cycle_runs import run_plots
from evaluation.story import Attempt, Finding, Influence, Story, TradeOff
from manoeuvres import (
    Bump,
    LateralForce,
    RampSteer,
    RoadStep,
    StepSteer,
    SuspensionRig,
    SweptSteer,
    VerticalSweep,
)
from susp_mj import simulate
from susp_mj.errors import InputError
from vehicles import load_vehicle
from vehicles.mjcf import build

from ..builders.runs import Bicycle, made_up

SVG = "{http://www.w3.org/2000/svg}"
EVIL = 'B "<img src=x onerror=window.broken=1>" & co'
STEPS = (0.01, 0.03, 0.05, 0.09)
RATIOS = {"rear.spring_ratio": {"ratio": 0.7}, "rear.damper_ratio": {"ratio": 0.8}}
SETS = {"A": "linear", EVIL: "nonlinear", "D": "nonlinear"}
"""Candidate -> set of the quarter car; C is not possible and has none."""


def found(step, target, value, unit="m", where="rear axle, ko", **more):
    inputs = {"x_max": "90 mm", "h <i>": "<10 mm>"}
    return Finding(step, target, where, "x_max - x", inputs, value, unit, words=f"{target} is missed", **more)


def findings(travel, lift):
    """What a candidate that gets to the checks is held against."""
    return (
        found("load range", "travel left <b>", travel, minimum=0.001, assumed=True, note="at the <stop>"),
        found("damping", "damping ratio", 0.25, "1", minimum=0.2, maximum=0.6),
        found("steps", "stop hits", 0.0, "1", maximum=0.0),
        found("steps", "overshoot", 0.1, "1", maximum=0.3),
        found("roll", "roll angle", 0.087, "rad", "ko, at 7 m/s²", minimum=0.083, maximum=0.092),
        found("tightening", "travel left rebound front", lift, "m", "full", minimum=0.001, note="fl at 9.8 s"),
        found("tightening", "lateral acceleration max", 7.2, "m/s²", "full", minimum=7.0),
        found("steering", "yaw rate overshoot", None if lift < 0 else 0.2, "1", "ko", maximum=0.35, note="diverges"),
    )


def attempt(name, parent, found, **more):
    values = {
        "front.frequency": (1.2, "Hz"),
        "rear.rebound_rate": (25000.0 + 1000 * len(name), "N/m"),
        "rear.ratio": ("1:2", ""),
        "rear.bar": (5000.0 if parent else 0.0, "N/m"),
    }
    changed = ("rear.rebound_rate",)
    return Attempt(name, f"because of {name}", parent, values, changed, found, **more)


def story(kept=True):
    """Four candidates: one discarded early, one at a check, one that is no spring, one kept unless told otherwise."""
    early = findings(-0.0005, 0.0)[:2]
    late, good = findings(0.03, -0.002), findings(0.03, 0.005)
    moves = Influence(
        late[5].key,
        "rear.rebound_rate",
        "+10 %",
        0.0021,
        "m",
        {late[1].key: (-0.01, "1"), "elsewhere: comfort": (0.1, "m/s²")},
    )
    impossible = replace(
        early[0], step="characteristics", target="possible", value=None, minimum=None, note="would pull"
    )
    attempts = (
        attempt("A", "", early, kept=False, reason="the springs stand on <their> stop"),
        attempt(EVIL, "A", late, kept=False, reason="the front left wheel & the stop", influences=(moves,)),
        attempt("C", EVIL, (impossible,), kept=False, reason="would pull with 30 N"),
        attempt("D", EVIL, good if kept else late, kept=kept, reason="" if kept else "the same again"),
    )
    curves = {
        name: [characteristic("rear axle", load_vehicle("chapter3", key, RATIOS).axle("rear"))]
        for name, key in SETS.items()
    }
    return Story(
        "Targets & <more>",
        "A made-up cycle.",
        "car of the tests",
        attempts,
        "D is kept." if kept else "The targets cannot be met: <too soft>.",
        (
            TradeOff("side slip gain", "1", ("1:2", "1:1"), (0.03, 0.031)),
            TradeOff("body acceleration", "m/s²", ("1:2", "1:1"), (4.0, 6.0)),
            TradeOff("never", "m", ("1:2", "1:1"), (None, None)),
        )
        if kept
        else (),
        curves,
        {"empty": {"rear": 4000.0}, "ko": {"rear": 4743.0}, "design": {"rear": 4744.0}},
        runs(),
        ("the rebound force <is> a default",),
        {"susp_mj": "1.2.3 <i>"},
    )


def runs():
    """A step of the road, a tightened turn in which a wheel lifts, steps and sweeps of the steering wheel, a rig."""
    stepped = {f"step of {1000 * height:.0f} mm": {"rear axle, ko": _on_step(height)} for height in STEPS}
    soft, stiff = Bicycle(front_share=0.8, roll_gradient=0.016), Bicycle()
    ramp = RampSteer(limit="90 deg")
    return {
        **stepped,
        "tightening": {"full": {EVIL: soft.run(ramp), "D": stiff.run(ramp)}},
        "steering": {"ko": {"D": stiff.run(StepSteer())}},
        "sweep": {"ko": {"D": stiff.run(SweptSteer())}},
        "rig": {"ko": {"D": made_up(SuspensionRig(), np.arange(0, 1, 0.01))}},
    }


def _on_step(height):
    return {
        name: simulate(build(load_vehicle("chapter3", key), "quarter_2dof"), RoadStep(height=height, duration=1.0))
        for name, key in SETS.items()
    }


@pytest.fixture(scope="module")
def cycle():
    return story()


@pytest.fixture(scope="module")
def failed():
    return replace(story(kept=False), runs={}, curves={})


@pytest.fixture(scope="module")
def page(cycle, tmp_path_factory):
    return write_verdict(cycle, tmp_path_factory.mktemp("verdict") / "verdict.html")


@pytest.fixture(scope="module")
def figures(cycle):
    cast = Cast.of(cycle)
    sections = [characteristic_plots(cycle, cast), trade_off_plots(cycle, cast), *run_plots(cycle, cast).values()]
    return {f"{each.title}, {each.caption}": each for plots in sections for each in plots}


def figure(figures, title):
    return next(each for name, each in figures.items() if name.startswith(title))


def texts(svg):
    return [text.text or "" for text in ElementTree.fromstring(svg).iter(f"{SVG}text")]


def lines(svg, stroke):
    """Styles of the lines with a stroke colour; the samples of the legend, which nothing clips, are left out."""
    paths = [path.get("style", "") for path in ElementTree.fromstring(svg).iter(f"{SVG}path") if path.get("clip-path")]
    return [style for style in paths if f"stroke: {stroke}" in style and "fill: none" in style]


# ---- the page


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("width", [400, 1280])
def test_page_shows_everything_by_itself(cycle, page, figures, visit, scheme, width):
    seen = visit(page, scheme, width)
    images = seen.page.evaluate("[...document.images].map(image => image.complete && image.naturalWidth)")
    assert len(images) == len(figures) and all(images)
    assert seen.said == []
    assert [url for url in seen.asked if not url.startswith("data:")] == [page.as_uri()]
    assert seen.page.evaluate("document.documentElement.scrollWidth <= window.innerWidth")
    assert seen.page.title() == cycle.title and seen.page.evaluate("typeof window.broken") == "undefined"


@pytest.mark.parametrize("which", ["cycle", "failed"])
def test_every_candidate_target_and_reason_is_there(request, which, visit, tmp_path):
    told = replace(request.getfixturevalue(which), runs={}, curves={})
    seen = visit(write_verdict(told, tmp_path / "verdict.html")).page
    text = seen.evaluate("document.body.textContent")
    said = [told.title, told.description, told.vehicle, told.verdict, *told.notes, *told.made.values()]
    for each in told.attempts:
        said += [each.name, each.because, each.reason]
        for one in each.findings:
            said += [one.target, one.where, one.formula, one.note, one.band, *one.inputs, *one.inputs.values()]
    assert [each for each in said if each not in text] == []
    assert seen.locator("article").count() == len(told.attempts)
    assert seen.locator(".lights tbody tr:not(.group)").count() == len(told.rows)


def test_no_link_leads_away(page):
    html = page.read_text(encoding="utf-8")
    assert all(each.startswith(("#", "data:")) for each in re.findall(r'(?:href|src)="([^"]*)"', html))


def test_a_light_says_in_a_sign_and_a_word_what_its_colour_says(cycle, page, visit):
    rows = visit(page).page.evaluate(
        """[...document.querySelectorAll(".lights tbody tr:not(.group)")].map(row =>
            [...row.querySelectorAll("td:not(.band)")].map(cell =>
                [cell.className, cell.querySelector("b").textContent, cell.querySelector(".hidden").textContent]))"""
    )
    shown = {"good": ["✓", "met"], "bad": ["✗", "missed"], "skipped": ["–", "not reached"]}
    for key, cells in zip(cycle.rows, rows, strict=True):
        assert all(shown[mark] == said for mark, *said in cells)
        held = [next((one for one in each.findings if one.key == key), None) for each in cycle.attempts]
        assert [mark for mark, *_ in cells] == [
            "skipped" if one is None else "good" if one.passed else "bad" for one in held
        ]


def test_defaults_are_marked_and_values_stand_with_margin_in_engineers_units(page, visit):
    row = visit(page).page.locator(".lights tbody tr", has_text="travel left <b>").first.inner_text()
    assert "default" in row and "at least 1.0 mm" in row and "−0.5 mm" in row and "−1.5 mm" in row and "+29.0 mm" in row


def test_a_kept_candidate_is_told_with_its_knobs_and_a_failure_is_told_as_one(page, failed, visit, tmp_path):
    kept = visit(page).page
    assert kept.locator(".verdict .good").inner_text().startswith("✓ Kept.")
    assert "26.00 kN/m" in kept.locator("section", has_text="What is kept").first.inner_text()
    lost = visit(write_verdict(failed, tmp_path / "verdict.html")).page
    assert lost.locator(".verdict .bad").inner_text() == f"✗ Not met. {failed.verdict}"
    assert lost.locator("text=What is kept").count() == 0 and lost.locator("img").count() == 0


def test_a_candidate_tells_what_it_changes_and_what_follows(cycle, page, visit):
    articles = visit(page).page.locator("article")
    text = articles.nth(1).inner_text()
    assert "From A: because of" in text and f"rear rebound rate 26.00 kN/m → {25 + len(EVIL)}.00 kN/m" in text
    assert "With it change" in text and "rear bar 0.00 kN/m → 5.00 kN/m" in text
    assert "→" not in articles.nth(0).inner_text(), "it has no parent"


def test_a_knob_tells_what_it_moves_and_whether_that_helps(page, visit):
    row = visit(page).page.locator("article").nth(1).locator("tr", has_text="rear rebound rate +10 %").inner_text()
    assert "+2.1 mm" in row and "70 %" in row, "2.1 of 3 mm"
    assert "▲ helps" in row and re.search(r"damping ratio, rear axle, ko −0.01 ▼ hurts", row)
    assert re.search(r"comfort \+0.10 m/s²\s*$", row), "nothing is asked of it"


def test_steps_fold_out_and_paper_shows_them_all(page, visit):
    seen = visit(page).page
    visible = "[...document.querySelectorAll('details .table')].map(each => each.checkVisibility())"
    assert not any(seen.evaluate(visible))
    seen.emulate_media(media="print")
    assert all(seen.evaluate(visible))


def test_many_candidates_scroll_inside_their_table_and_fit_on_paper(cycle, visit, tmp_path):
    many = [replace(each, name=f"{each.name} {i}") for i in range(10) for each in cycle.attempts[:3]]
    path = write_verdict(replace(cycle, attempts=many, runs={}, curves={}), tmp_path / "verdict.html")
    seen = visit(path, width=400).page
    seen.evaluate("document.querySelector('.lights').scrollTo(900, 200)")
    table, corner = seen.locator(".lights").bounding_box(), seen.locator(".lights thead th").first.bounding_box()
    assert corner["x"] == pytest.approx(table["x"], abs=2) and corner["y"] == pytest.approx(table["y"], abs=2)
    assert seen.evaluate("document.documentElement.scrollWidth <= window.innerWidth")
    printed = visit(path, width=690, media="print").page
    assert printed.evaluate("document.documentElement.scrollWidth <= window.innerWidth")


def test_users_text_is_escaped(page):
    html = page.read_text(encoding="utf-8")
    assert "<img src=x" not in html and "&lt;img src=x" in html and "travel left <b>" not in html
    assert EVIL in unescape(html)


def test_films_stand_at_the_end(cycle, failed, tmp_path):
    film = tmp_path / "ghost.mp4"
    film.write_bytes(b"\0" * 100)
    html = write_verdict(failed, tmp_path / "verdict.html", [film]).read_text(encoding="utf-8")
    assert html.index("<h2>Film</h2>") < html.index('src="data:video/mp4;base64,AAAA')
    with pytest.raises(InputError, match=r"gone\.mp4: cannot be read"):
        write_verdict(failed, tmp_path / "other.html", [tmp_path / "gone.mp4"])


def test_same_story_gives_the_same_bytes(cycle, page, tmp_path):
    assert write_verdict(cycle, tmp_path / "verdict.html").read_bytes() == page.read_bytes()


# ---- figures


def test_a_candidate_has_one_colour_in_all_figures_and_the_kept_one_the_widest_line(cycle, figures):
    assert Cast.of(cycle) == Cast(("A", EVIL, "D"), "D")
    for name, each in figures.items():
        drawn = [order for order, label in enumerate(("A", EVIL, "D, kept")) if label in texts(each.svg)]
        assert [order for order in range(len(COLOURS)) if lines(each.svg, COLOURS[order])] == drawn, name
        if len(drawn) > 1:
            widths = {
                order: float(re.search(r"stroke-width: ([\d.]+)", lines(each.svg, COLOURS[order])[0])[1])
                for order in drawn
            }
            assert max(widths, key=widths.__getitem__) == 2, name


def test_springs_and_dampers_are_drawn_at_the_wheel_and_at_the_component(figures):
    spring = texts(figure(figures, "Spring force at the wheel").svg)
    assert "empty 4.000 kN    " in spring and "ko, design 4.743 kN    " in spring, "loads of equal force share a label"
    for title in ("Damper force at the wheel", "Force of the spring itself", "Force of the damper itself"):
        assert figure(figures, title)
    assert {"empty", "ko, design"} <= set(texts(figure(figures, "Force of the spring itself").svg))


@pytest.mark.parametrize("count", [MOST, MOST + 5])
def test_of_many_candidates_the_first_the_last_discarded_and_the_kept_one_have_curves(cycle, count):
    attempts = [replace(cycle.attempts[0], name=str(i)) for i in range(count - 1)] + [cycle.attempts[-1]]
    many = replace(cycle, attempts=attempts, curves={each.name: cycle.curves["A"] for each in attempts})
    expected = [each.name for each in attempts] if count <= MOST else ["0", str(count - 2), "D"]
    assert with_curves(many) == expected


def test_steps_are_the_smallest_and_the_two_largest_with_the_hits_on_the_stops(figures):
    shown = [name.partition(",")[0] for name in figures if name.startswith("After a step")]
    assert shown == ["After a step of 10.0 mm", "After a step of 50.0 mm", "After a step of 90.0 mm"]
    largest = figure(figures, "After a step of 90.0 mm")
    assert "stop hits, marked ×: A" in largest.caption
    assert {"compression stop", "rebound stop", "asked of D: overshoot at most 0.3"} <= set(texts(largest.svg))
    assert "no stop is hit" in figure(figures, "After a step of 10.0 mm").caption
    assert "step of 90" not in figure(figures, "Body acceleration on a step").caption, "it reaches a stop"


def test_limits_stand_where_targets_are_held_against_a_turn(figures):
    roll = figure(figures, "Roll angle over lateral acceleration")
    assert "asked: 4.76 ° to 5.27 °" in texts(roll.svg) and "asked: at least 7.00 m/s²" in texts(roll.svg)
    travel = texts(figure(figures, "Travel of the inner wheels").svg)
    assert travel.count("asked: at least 1.0 mm") == 1 and "rebound stop" in travel, (
        "only the front axle's is asked for"
    )
    load = figure(figures, "Load of the inner wheels").svg
    assert f"stroke: {LIFTED}" in load and any(text.startswith("lifts at") for text in texts(load))
    assert "asked of D: overshoot at most 0.35" in texts(figure(figures, "Step steer over time").svg)


def test_figures_follow_from_what_a_run_is_and_not_from_a_name(cycle):
    cast = Cast.of(cycle)
    cycle = replace(cycle, runs={check: cycle.runs[check] for check in ("step of 10 mm", "tightening", "steering")})
    renamed = {
        f"check {i}": {place: {name: _renamed(run) for name, run in of_one.items()} for place, of_one in places.items()}
        for i, places in enumerate(cycle.runs.values())
    }
    before, after = run_plots(cycle, cast), run_plots(replace(cycle, runs=renamed), cast)
    assert [[each.title for each in plots] for plots in before.values()] == [
        [each.title for each in plots] for plots in after.values()
    ]


@pytest.mark.parametrize(
    ("model", "manoeuvre", "title"),
    [
        ("quarter_1dof", VerticalSweep(duration=5.0), "Amplification of the road"),
        ("quarter_1dof", Bump(duration=1.0), "Bump over time"),
        ("full_3dof", LateralForce(duration=1.0), "Lateral force over time"),
    ],
)
def test_other_runs_of_oscillation_models_are_drawn_as_well(cycle, model, manoeuvre, title):
    car = load_vehicle("chapter3") if model.startswith("quarter") else load_vehicle("s_class")
    run = simulate(build(car, model), manoeuvre)
    one = replace(cycle, runs={"check": {"rear axle, ko": {"D": run}}})
    plots = run_plots(one, Cast.of(one))["check"]
    assert plots[0].title == title and all(lines(each.svg, COLOURS[2]) for each in plots)


def _renamed(run):
    return replace(run, meta={**run.meta, "title": "x", "manoeuvre": {**run.meta["manoeuvre"], "kind": "x"}})


def test_a_check_without_a_figure_says_so(cycle, page):
    assert run_plots(replace(cycle, runs={"rig": cycle.runs["rig"]}), Cast.of(cycle)) == {"rig": []}
    assert "There is no figure for runs of this kind." in page.read_text(encoding="utf-8")


def test_trade_offs_leave_out_what_has_no_values_and_ring_the_kept_ratio(cycle, figures):
    panels = texts(figure(figures, "Responses over").svg)
    assert "side slip gain" in panels and "body acceleration" in panels and "never" not in panels
    assert {"1:2", "1:1"} <= set(texts(figure(figures, "The first two responses").svg))
    assert list(trade_off_plots(replace(cycle, trade_offs=()), Cast.of(cycle))) == []


# ---- what moves a target

NUMBER = st.floats(-10, 10)


@given(NUMBER, NUMBER, st.sampled_from(["minimum", "maximum"]), st.floats(-5, 5))
def test_a_move_helps_if_and_only_if_it_goes_towards_the_open_side(value, bound, side, change):
    moved = value + change
    one = found("s", "t", value, "1", **{side: bound})
    better = moved > value if side == "minimum" else moved < value
    assert effect(one, change) in ("helps" if better else "hurts", ""), "too small a move may do neither"
    share = made_up_for(one, change)
    if one.passed:
        assert share is None
    else:
        assert share is not None and share * abs(bound - value) == pytest.approx(
            abs(change) if better else -abs(change), abs=1e-9
        )


def test_nothing_is_said_of_a_move_without_value_or_band():
    assert (
        effect(None, 1.0) == effect(found("s", "t", None, minimum=1.0), 1.0) == effect(found("s", "t", 1.0), 1.0) == ""
    )
    assert made_up_for(found("s", "t", None, minimum=1.0), 1.0) is None
    assert change_text(1e-6, "m") == HARDLY and change_text(0.0, "m") == "+0.0 mm"


# ---- the file


def test_file_is_strict_json_and_the_same_each_time(cycle, tmp_path):
    odd = replace(cycle.attempts[0].findings[0], value=math.nan, maximum=math.inf)
    first = replace(cycle.attempts[0], findings=(odd, *cycle.attempts[0].findings[1:]))
    told = replace(cycle, attempts=(first, *cycle.attempts[1:]))

    def refuse(text):
        raise AssertionError(f"{text} is not JSON")

    path = write_verdict_json(told, tmp_path / "verdict.json")
    plain = json.loads(path.read_text(encoding="utf-8"), parse_constant=refuse)
    assert write_verdict_json(told, tmp_path / "again.json").read_bytes() == path.read_bytes()
    assert plain["kept"] == "D" and plain["verdict"] == told.verdict and "curves" not in plain and "runs" not in plain
    assert plain["attempts"][0]["findings"][0]["value"] is None
    for attempt_, entry in zip(told.attempts, plain["attempts"], strict=True):
        assert entry["name"] == attempt_.name and entry["reason"] == attempt_.reason
        assert [each["key"] for each in entry["findings"]] == [each.key for each in attempt_.findings]
        assert [each["passed"] for each in entry["findings"]] == [each.passed for each in attempt_.findings]
        assert all(bool(each["words"]) != each["passed"] for each in entry["findings"])
        assert entry["values"]["rear.bar"] == {"value": attempt_.values["rear.bar"][0], "unit": "N/m"}
    assert plain["attempts"][1]["influences"][0]["also"]["elsewhere: comfort"] == {"value": 0.1, "unit": "m/s²"}


@pytest.mark.parametrize("write", [write_verdict, write_verdict_json])
def test_a_place_that_cannot_be_written_is_one_line(failed, tmp_path, write):
    (tmp_path / "file").write_text("")
    with pytest.raises(InputError, match="cannot be written") as caught:
        write(failed, tmp_path / "file" / "out")
    assert "\n" not in str(caught.value)
