"""A user's file of the name of one of our packages: one line for who misses ours, nothing for who does not."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
SCRIPTS = {
    "vehicles": "import susp_mj\nfrom vehicles import load_vehicle\n",
    "manoeuvres": "from susp_mj import simulate\nfrom manoeuvres import Bump\n",
    "evaluation": "import manoeuvres\nfrom evaluation.compare import Comparison\n",
    "design": "from vehicles import load_vehicle\nfrom design.case import load_case\n",
}


def python(*arguments: str, cwd: Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, *arguments],
        capture_output=True,
        text=True,
        cwd=cwd,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
        timeout=120,
        check=False,
    )


@pytest.mark.parametrize("name", SCRIPTS)
@pytest.mark.parametrize("folder", [False, True])
def test_who_misses_a_hidden_package_is_told_in_one_line(tmp_path, name, folder):
    place = tmp_path / name / "__init__.py" if folder else tmp_path / f"{name}.py"
    place.parent.mkdir(exist_ok=True)
    place.write_text("mine = 1\n")
    (tmp_path / "script.py").write_text(SCRIPTS[name])
    done = python("script.py", cwd=tmp_path)
    assert done.returncode == 1
    hides = place.parent if folder else place
    assert done.stderr == f"error: {hides} hides the package '{name}' of susp_mj; rename it\n"


def test_who_uses_only_his_own_file_is_left_alone(tmp_path):
    (tmp_path / "design.py").write_text("mine = 1\n")
    (tmp_path / "script.py").write_text("import vehicles\nfrom design import mine\nimport no_such_module\n")
    done = python("script.py", cwd=tmp_path)
    assert done.returncode == 1
    assert done.stderr.strip().endswith("ModuleNotFoundError: No module named 'no_such_module'")
    assert "hides" not in done.stderr


@pytest.mark.parametrize("name", ["vehicles", "manoeuvres", "evaluation"])
def test_the_command_line_says_so_too(tmp_path, name):
    (tmp_path / f"{name}.py").write_text("mine = 1\n")
    done = python("-m", "design.cli", "run", "chapter3", "--out", "out", cwd=tmp_path)
    assert done.returncode in (1, 2)
    assert done.stderr == f"error: {tmp_path / name}.py hides the package '{name}' of susp_mj; rename it\n"
