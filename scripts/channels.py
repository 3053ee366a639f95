"""Channels of every shipped case, before and after a change of the code: ``record`` on each checkout, then ``compare``.

    python scripts/channels.py record before      # on one checkout
    python scripts/channels.py record after       # on the other
    python scripts/channels.py compare before after

Prints for each case whether all channels agree bit for bit, else the largest difference as a share of the range of its
quantity in that run, or of a small range where the quantity rests but for rounding; exits with 1 beyond a share of
1e-9, or where channels or numbers are missing or differ.
"""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parent.parent))

from susp_mj.run import Run

WITHIN = 1e-9
SMALL = {"N": 1.0, "N m": 1.0}
"""Range [SI] that counts at least, by unit; 0.1 for all others."""
CASES = Path(__file__).parent.parent / "design" / "cases"


def record(folder: Path) -> None:
    """Run every shipped case into a folder of its own below `folder`."""
    for case in sorted(CASES.glob("*.toml")):
        subprocess.run(
            [sys.executable, "-m", "design.cli", "run", case.stem, "--out", str(folder / case.stem)],
            check=True,
            stdout=subprocess.DEVNULL,
        )
        print(case.stem, flush=True)


def difference(before: Run, after: Run) -> tuple[float, str]:
    """Largest difference of two runs as a share of its channel's range, and the channel; infinite if channels lack."""
    if list(before) != list(after) or not np.array_equal(before.time, after.time):
        return np.inf, ", ".join(sorted(set(before) ^ set(after))) or "time"
    ranges: dict[str, float] = {}
    for channel in before.channels.values():
        least = ranges.get(channel.quantity, SMALL.get(channel.unit, 0.1))
        ranges[channel.quantity] = max(least, float(np.ptp(channel.values)))
    shares = {
        name: float(np.abs(after[name] - channel.values).max()) / ranges[channel.quantity]
        for name, channel in before.channels.items()
    }
    worst = max(shares, key=lambda name: shares[name], default="")
    return shares.get(worst, 0.0), worst


def numbers_of(folder: Path) -> list[dict[str, bool]]:
    """Names of the numbers of each configuration, and whether they have a value."""
    summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    return [{name: each["value"] is None for name, each in one["numbers"].items()} for one in summary["configurations"]]


def compare(before: Path, after: Path) -> bool:
    """Print the largest difference of every case; returns whether all lie within `WITHIN`."""
    good = True
    for case in sorted(path.name for path in before.iterdir() if path.is_dir()):
        runs = sorted(path.name for path in (before / case / "runs").glob("*.nc"))
        same = runs == sorted(path.name for path in (after / case / "runs").glob("*.nc"))
        found = [difference(*(Run.load(side / case / "runs" / name) for side in (before, after))) for name in runs]
        share, channel = max(found)
        same = same and numbers_of(before / case) == numbers_of(after / case)
        words = "bit for bit" if share == 0 else f"{share:.1e} of range ({channel})"
        print(f"{case:40} {words}{'' if same else '  DIFFERS'}")
        good = good and same and share <= WITHIN
    return good


if __name__ == "__main__":
    match sys.argv[1:]:
        case ["record", folder]:
            record(Path(folder))
        case ["compare", before, after]:
            sys.exit(0 if compare(Path(before), Path(after)) else 1)
        case _:
            sys.exit(__doc__)
