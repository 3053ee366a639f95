"""A user's own `vehicles.py`, `manoeuvres.py`, `evaluation.py` or `design.py` beside a script hides our package of that
name. That is only wrong if something of ours is then missed, and who misses it is told why in one line."""

from __future__ import annotations

import sys
from importlib.util import find_spec
from pathlib import Path
from types import TracebackType

PACKAGES = ("vehicles", "manoeuvres", "evaluation", "design")
_HOME = Path(__file__).resolve().parent.parent


def hiding() -> dict[str, str]:
    """The files and folders that hide a package of ours, by the package's name."""
    found = {}
    for name in PACKAGES:
        spec = find_spec(name)
        places = [] if spec is None else [*(spec.submodule_search_locations or ()), spec.origin or ""]
        if places and _HOME not in Path(places[0]).resolve().parents:
            found[name] = places[0]
    return found


def explained(error: BaseException) -> str | None:
    """Why an import failed, in one line; None if no file hides what is missed."""
    name = (error.name or "").partition(".")[0] if isinstance(error, ImportError) else ""
    file = hiding().get(name)
    return None if file is None else f"{file} hides the package '{name}' of susp_mj; rename it"


def explain_uncaught() -> None:
    """Let an uncaught error of an import be that one line, if anything of ours is hidden."""
    if hiding() and sys.excepthook is sys.__excepthook__:
        sys.excepthook = _hook


def _hook(kind: type[BaseException], error: BaseException, traceback: TracebackType | None) -> None:
    text = explained(error)
    if text is None:
        sys.__excepthook__(kind, error, traceback)
    else:
        print(f"error: {text}", file=sys.stderr)
