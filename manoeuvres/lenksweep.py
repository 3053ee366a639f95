"""Lenksweep: the thesis' name of the manoeuvre `swept_steer`, as a script; it is implemented there."""

from __future__ import annotations

if __name__ == "__main__":
    from design.cli import manoeuvre_script

    manoeuvre_script("swept_steer")
