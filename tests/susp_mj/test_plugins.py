"""Plugins: run once in a process, and one line where they fail."""

from __future__ import annotations

import sys
from importlib.metadata import EntryPoint

import pytest

from susp_mj import InputError, plugins
from susp_mj.plugins import load_installed, load_plugin, load_plugins

COUNT = """
import builtins
builtins.susp_mj_test_count = getattr(builtins, "susp_mj_test_count", 0) + 1
"""


def test_a_plugin_is_run_once_whoever_names_it(tmp_path):
    import builtins

    (tmp_path / "mine.py").write_text(COUNT)
    (tmp_path / "deeper").mkdir()
    load_plugins(["mine.py"], tmp_path / "case.toml")
    load_plugins(["../mine.py", "../mine.py"], tmp_path / "deeper" / "car.toml")
    assert builtins.susp_mj_test_count == 1


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (
            "from manoeuvres import Bump, register\nclass Odd(Bump):\n    kind: str = 'odd'\n    x: type(iter(''))\n"
            "register(Odd)\n",
            "case.toml: plugins.0: mine.py, line 5: PydanticSchemaGenerationError: ",
        ),
        (
            "from susp_mj.elements import LinearSpring, register\nclass Odd(LinearSpring):\n    kind: str = 'odd'\n"
            "    x: type(iter(''))\nregister(Odd)\n",
            "case.toml: plugins.0: mine.py, line 5: PydanticSchemaGenerationError: ",
        ),
        ("x = 1\n\n1 / 0\n", "case.toml: plugins.0: mine.py, line 3: ZeroDivisionError: division by zero"),
        ("x = 1\ny = = 2\n", "case.toml: plugins.0: mine.py, line 2: SyntaxError: invalid syntax"),
        ("import nothing_of_the_kind\n", "mine.py, line 1: ModuleNotFoundError: No module named 'nothing_of_the_kind'"),
        ("raise SystemExit(3)\n", "mine.py, line 1: SystemExit: 3"),
        ("def f():\n    raise ValueError('two\\nlines')\nf()\n", "mine.py, line 2: ValueError: two lines"),
        (
            "from typing import Literal\nfrom susp_mj.elements import LinearSpring, register\n"
            "class Mine(LinearSpring):\n    kind: Literal['table'] = 'table'\nregister(Mine)\n",
            "mine.py, line 5: kind 'table' of Mine is taken by TableSpring",
        ),
        (
            "from typing import Literal\nfrom manoeuvres import Bump, register\n"
            "class Mine(Bump):\n    kind: Literal['step'] = 'step'\nregister(Mine)\n",
            "mine.py, line 5: kind 'step' of Mine is taken by another manoeuvre",
        ),
    ],
)
def test_a_plugin_that_fails_is_one_line_with_its_place(tmp_path, text, expected):
    (tmp_path / "mine.py").write_text(text)
    known = set(sys.modules)
    with pytest.raises(InputError) as caught:
        load_plugins(["mine.py"], tmp_path / "case.toml")
    assert expected in str(caught.value)
    assert "\n" not in str(caught.value)
    assert not [name for name in set(sys.modules) - known if name.startswith("susp_mj_plugin")]


@pytest.mark.parametrize(
    ("names", "expected"),
    [
        (["none.py"], "case.toml: plugins.0: "),
        (["none.py"], "none.py: no such file"),
        ("mine.py", "case.toml: plugins: 'mine.py' is not allowed; give a list of Python files"),
        ([3], "case.toml: plugins: [3] is not allowed"),
        (["case.toml"], "case.toml: plugins.0: case.toml: is not a Python file (.py)"),
    ],
)
def test_what_is_no_plugin(tmp_path, names, expected):
    (tmp_path / "case.toml").write_text("")
    with pytest.raises(InputError) as caught:
        load_plugins(names, tmp_path / "case.toml")
    assert expected in str(caught.value)


def test_installed_plugins_are_entry_points(tmp_path, monkeypatch):
    (tmp_path / "installed_spring.py").write_text("seen = []\n")
    (tmp_path / "installed_mistake.py").write_text("1 / 0\n")
    monkeypatch.syspath_prepend(tmp_path)
    found = [EntryPoint("good", "installed_spring", plugins.GROUP)]
    monkeypatch.setattr(plugins, "entry_points", lambda group: found if group == plugins.GROUP else [])
    load_installed.cache_clear()
    load_installed()
    assert "installed_spring" in sys.modules
    found.append(EntryPoint("bad", "installed_mistake", plugins.GROUP))
    load_installed.cache_clear()
    with pytest.raises(InputError, match=r"installed plugin 'bad' \(installed_mistake\): ZeroDivisionError"):
        load_installed()
    load_installed.cache_clear()


def test_a_module_that_is_imported_already_is_not_run_again(tmp_path, monkeypatch):
    (tmp_path / "imported_before.py").write_text("if __name__ != 'imported_before':\n    raise ValueError\n")
    monkeypatch.syspath_prepend(tmp_path)
    __import__("imported_before")
    load_plugin(tmp_path / "imported_before.py")
