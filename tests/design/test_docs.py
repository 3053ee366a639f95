"""The documentation's code runs, and what it points to exists."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]


def python_of(page: Path) -> str:
    return "\n".join(re.findall(r"```python\n(.*?)```", page.read_text(), re.DOTALL))


@pytest.mark.parametrize("page", [page for page in PAGES if python_of(page)], ids=lambda page: page.name)
def test_python_in_the_documentation_runs(page, tmp_path):
    program = tmp_path / "page.py"
    program.write_text(python_of(page))
    result = subprocess.run(
        [sys.executable, str(program)], capture_output=True, text=True, cwd=tmp_path, timeout=300, check=False
    )
    assert result.returncode == 0, result.stderr


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_links_lead_somewhere(page):
    for target in re.findall(r"\]\(([^)#]+)\)", page.read_text()):
        assert target.startswith("http") or (page.parent / target).exists(), target


def test_the_case_file_in_the_readme_runs(tmp_path):
    from design.case import load_case
    from design.running import run_case

    (text,) = re.findall(r"```toml\n(.*?)```", (ROOT / "README.md").read_text(), re.DOTALL)
    path = tmp_path / "readme.toml"
    path.write_text(text)
    comparison = run_case(*load_case(path))
    assert [each.name for each in comparison.configurations] == ["as it is", "1:3"]


def test_the_targets_file_of_the_guide_is_one(tmp_path):
    from design.cycle.candidate import Layout
    from design.cycle.targets import load_targets

    (text,) = re.findall(r"```toml\n(.*?)```", (ROOT / "docs" / "design_cycle.md").read_text(), re.DOTALL)
    path = tmp_path / "guide.toml"
    path.write_text(text)
    layout = Layout.open(*load_targets(path))
    assert layout.proposed("A").turned["rear.bar"] == 5000.0


def test_cited_sources_exist():
    known = set(re.findall(r"^@\w+\{(\w+),", (ROOT / "docs" / "references.bib").read_text(), re.MULTILINE))
    for page in PAGES:
        for key in re.findall(r"\[([a-z]+\d{4})\]", page.read_text()):
            assert key in known, f"{page.name}: {key}"
