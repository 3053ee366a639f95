"""Report, summary and sheet: opened in a real browser, strict JSON, and nothing half-written."""

from __future__ import annotations

import json
import re
from dataclasses import replace

import numpy as np
import pytest

from evaluation.characteristics import ElementNote, characteristic
from evaluation.compare import Claim
from evaluation.display import number_text, quantity_text
from evaluation.numbers import Criterion, Number
from evaluation.pages.page import LARGEST_VIDEO
from evaluation.pages.report import write_report
from evaluation.pages.sheet import write_sheet
from evaluation.pages.summary import write_summary
from evaluation.plots.drawing import draw
from susp_mj.errors import InputError
from vehicles import load_vehicle

from ..builders.comparisons import SETS, compare

CRITERIA = {
    "body_acceleration_max": Criterion(None, 8.0),
    "wheel_load_min": Criterion(500.0, None),
    "overshoot": Criterion(0.0, 0.3),
}
CLAIMS = (
    Claim("Peak of the linear suspension, chapter 3", "11.24 ± 0.05 m/s²", "11.24 m/s²", True),
    Claim("The non-linear one halves it", "5.6 m/s²", "7.89 m/s²", False),
)
TITLE = "<script>window.broken = 1</script> & co"


@pytest.fixture(scope="module")
def comparison():
    return compare(title=TITLE, criteria=CRITERIA, claims=CLAIMS)


@pytest.fixture(scope="module")
def plots(comparison):
    return draw(comparison)


@pytest.fixture(scope="module")
def report(comparison, plots, tmp_path_factory):
    return write_report(comparison, tmp_path_factory.mktemp("report") / "report.html", plots=plots)


@pytest.fixture(scope="module")
def sheet(tmp_path_factory):
    sets = {
        name: [characteristic("rear axle", load_vehicle("chapter3", key).axle("rear"))] for key, name in SETS.items()
    }
    return write_sheet(
        f"Sheet {TITLE}", sets, tmp_path_factory.mktemp("sheet") / "sheet.html", {"vehicle": "chapter3 <i>"}
    )


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("width", [360, 800, 1400])
@pytest.mark.parametrize("which", ["report", "sheet"])
def test_page_shows_everything_by_itself(request, visit, plots, which, scheme, width):
    path = request.getfixturevalue(which)
    seen = visit(path, scheme, width)
    images = seen.page.evaluate("[...document.images].map(image => image.complete && image.naturalWidth)")
    assert len(images) == (len(plots) if which == "report" else 4) and all(images)
    assert seen.said == []
    assert [url for url in seen.asked if not url.startswith("data:")] == [path.as_uri()]
    assert seen.page.evaluate("document.documentElement.scrollWidth <= window.innerWidth")
    assert seen.page.title() == (TITLE if which == "report" else f"Sheet {TITLE}")
    assert seen.page.evaluate("typeof window.broken") == "undefined"


def test_page_and_its_plots_are_dark_in_the_dark_and_light_on_paper(report, visit):
    """Mean brightness of what is really painted, of the page's corner and inside a plot."""
    for scheme, media, dark in (("light", "screen", False), ("dark", "screen", True), ("dark", "print", False)):
        page = visit(report, scheme, media=media).page
        plot = page.locator("figure img").first
        assert (_brightness(plot.screenshot()) < 90) == dark, (scheme, media)
        assert (_brightness(page.screenshot(clip={"x": 0, "y": 0, "width": 20, "height": 20})) < 90) == dark


def _brightness(png: bytes) -> float:
    import io

    from PIL import Image

    return float(np.median(np.asarray(Image.open(io.BytesIO(png)).convert("L"))))


def test_report_says_what_failed_and_what_holds(report, visit):
    page = visit(report).page
    verdict = page.locator(".verdict").inner_text()
    assert "1 of 2 published statements holds" in verdict and "Not reproduced" in verdict
    assert "linear fails 3 of 3; non-linear fails 1 of 3" in verdict
    rows = dict(
        page.evaluate(
            "[...document.querySelectorAll('tbody tr')].map(row => [row.firstElementChild.innerText, row.innerText])"
        )
    )
    assert "✓ holds" in rows["Peak of the linear suspension, chapter 3"]
    assert "✗ does not hold" in rows["The non-linear one halves it"]


def test_criteria_are_told_in_words_and_in_colour(report, visit):
    page = visit(report).page
    cells = page.evaluate(
        """[...document.querySelectorAll("th[title='body_acceleration_max']")][0].parentElement.innerText"""
    )
    assert "at most 8.00 m/s²" in cells and "✗ fail" in cells and "✓ pass" in cells and "11.24 m/s²" in cells
    colour = "element => getComputedStyle(element).color"
    assert page.locator("span.good").first.evaluate(colour) != page.locator("span.bad").first.evaluate(colour)


def test_numbers_are_in_engineers_units_and_missing_ones_have_a_footnote(comparison, report):
    html = report.read_text(encoding="utf-8")
    numbers = comparison.configurations[1].numbers
    assert numbers["overshoot"].value is None
    assert f"{1000 * numbers['travel_compression'].value:.1f}<small>" in html
    assert "–<sup>a</sup>" in html and "the body returns to its initial height" in html
    assert not re.search(r">\s*(None|nan|inf)\b", html)


def test_equations_of_the_elements_in_use_are_given_once(report, visit):
    headings = visit(report).page.locator(".equations h3").all_inner_texts()
    assert headings == [
        "Linear spring",
        "Constant-frequency spring",
        "Stops",
        "Zoned damper",
        "Damper with rubber mount and friction",
        "Linkage friction",
        "Tyre spring",
    ]


def test_an_element_of_the_users_own_is_described_by_its_docstring(comparison, plots, tmp_path):
    first = comparison.configurations[0]
    note = ElementNote(
        "spring", "air_bag", "An air bag: ``F < p A``.\n\nMore of it.\n\nAttributes:\n    area: concealed."
    )
    changed = replace(first, characteristics=[replace(first.characteristics[0], elements=(note,))])
    html = write_report(replace(comparison, outcomes=[changed]), tmp_path / "r.html", plots=plots).read_text(
        encoding="utf-8"
    )
    assert (
        "<h3>Spring: air bag</h3>" in html
        and "F &lt; p A" in html
        and "More of it." in html
        and "concealed" not in html
    )


def test_user_text_is_escaped_everywhere(comparison, plots, tmp_path):
    evil = '"><img src=x onerror=alert(1)>'
    first = comparison.configurations[0]
    numbers = {
        **first.numbers,
        "settling_time": Number(None, "s", evil),
        "body_acceleration_rms": Number(1.0, "m/s²", evil),
    }
    changed = replace(comparison, title=evil, description=evil, claims=(Claim(evil, evil, evil, True),))
    changed = replace(changed, outcomes=[replace(first, name=evil, title=evil, numbers=numbers)])
    html = write_report(changed, tmp_path / "r.html", plots=plots).read_text(encoding="utf-8")
    assert "<img src=x" not in html and "&lt;img src=x" in html


def test_same_comparison_gives_the_same_bytes(comparison, report, tmp_path):
    again = write_report(comparison, tmp_path / "report.html")
    assert again.read_bytes() == report.read_bytes()


def test_a_case_without_criteria_and_claims_gives_no_verdict(comparison, plots, tmp_path):
    html = write_report(replace(comparison, criteria={}, claims=()), tmp_path / "r.html", plots=plots).read_text(
        encoding="utf-8"
    )
    assert "No verdict." in html and "Claim beside result" not in html and "<h2>Criteria</h2>" not in html


def test_small_videos_are_inside_and_large_ones_linked(comparison, plots, tmp_path):
    small, large = tmp_path / "small.mp4", tmp_path / "large one.mp4"
    small.write_bytes(b"\0" * 1000)
    with large.open("wb") as file:
        file.truncate(LARGEST_VIDEO + 1)
    html = write_report(comparison, tmp_path / "r.html", [small, large], plots=plots).read_text(encoding="utf-8")
    assert '<video controls loop muted playsinline src="data:video/mp4;base64,AAAA' in html
    assert '<a href="large%20one.mp4">large one.mp4</a>' in html
    with pytest.raises(InputError, match=r"gone\.mp4: cannot be read"):
        write_report(comparison, tmp_path / "other.html", [tmp_path / "gone.mp4"], plots=plots)
    assert not (tmp_path / "other.html").exists()


def test_summary_is_strict_json_even_with_values_that_json_lacks(comparison, tmp_path):
    first = comparison.configurations[0]
    odd = replace(first, numbers={**first.numbers, "settling_time": Number(float("nan"), "s")})
    extra = {"timings": {"simulate": np.float64(0.5)}, "limit": float("inf"), "counts": np.arange(2)}
    path = write_summary(replace(comparison, outcomes=[odd]), tmp_path / "summary.json", extra)

    def refuse(text):
        raise AssertionError(f"{text} is not JSON")

    summary = json.loads(path.read_text(encoding="utf-8"), parse_constant=refuse)
    assert list(summary) == ["title", "configurations", "claims", "passed", "timings", "limit", "counts"]
    assert (
        summary["title"] == TITLE
        and summary["passed"] is False
        and summary["limit"] is None
        and summary["counts"] == [0, 1]
    )
    entry = summary["configurations"][0]
    assert entry["configuration"] == "linear" and entry["model"] == "quarter_2dof"
    assert entry["numbers"]["body_acceleration_max"]["value"] == first.numbers["body_acceleration_max"].value
    assert entry["numbers"]["settling_time"]["value"] is None
    assert summary["claims"][0] == {
        "text": CLAIMS[0].text,
        "source": "",
        "expected": CLAIMS[0].expected,
        "result": CLAIMS[0].result,
        "holds": True,
        "known": False,
        "why": "",
    }


@pytest.mark.parametrize("write", [write_report, write_summary])
def test_a_place_that_cannot_be_written_is_one_line_and_leaves_nothing(comparison, tmp_path, write):
    (tmp_path / "file").write_text("")
    (tmp_path / "folder" / "inside").mkdir(parents=True)
    for place in (tmp_path / "file" / "out", tmp_path / "folder"):
        with pytest.raises(InputError, match="cannot be written") as caught:
            write(comparison, place)
        assert "\n" not in str(caught.value)
    assert sorted(path.name for path in tmp_path.rglob("*")) == ["file", "folder", "inside"]


def test_sheet_lists_the_key_values_of_every_set(sheet, visit):
    rows = visit(sheet).page.evaluate(
        "[...document.querySelectorAll('tbody tr')].map(row => [...row.children].map(cell => cell.innerText))"
    )
    table = {row[0]: row[1:] for row in rows}
    assert table["preload at KO"] == ["kN", "4.743", "4.743", "4.743"]
    assert table["natural frequency at KO"] == ["Hz", "1.20", "1.20", "1.20"]
    assert table["damper rate F/v at 0.05 m/s, compression"] == ["N s/m", "3000", "2000", "1200"]
    assert table["damper rate F/v at 0.05 m/s, rebound"] == ["N s/m", "3000", "4000", "1200"]
    stiffest = 4743 * np.exp((2 * np.pi * 1.2) ** 2 / 9.81 * 0.1) * (2 * np.pi * 1.2) ** 2 / 9.81 / 1000
    assert float(table["spring rate at the compression stop"][2]) == pytest.approx(stiffest, abs=0.01)
    critical = 2 * np.sqrt(4743 / 9.81 * (2 * np.pi * 1.2) ** 2 * 4743 / 9.81)
    assert float(table["damping ratio at KO"][1]) == pytest.approx(3000 / critical, abs=0.001)


@pytest.mark.parametrize(
    ("value", "unit", "text"),
    [
        (0.0851, "m", "85.1 mm"),
        (-0.0323, "m", "−32.3 mm"),
        (4743.0, "N", "4.743 kN"),
        (11.2416, "m/s²", "11.24 m/s²"),
        (27490.0, "N/m", "27.49 kN/m"),
        (3.0, "1", "3"),
        (0.1234567, "1", "0.123"),
        (-1e-9, "m", "0.0 mm"),
        (None, "s", "–"),
        (1.5, "V", "1.5 V"),
        (np.pi, "rad", "180.00 °"),
    ],
)
def test_values_are_shown_in_engineers_units(value, unit, text):
    assert quantity_text(value, unit) == text


def test_what_is_not_finite_is_shown_as_missing():
    assert number_text(float("nan"), "m") == "–"
