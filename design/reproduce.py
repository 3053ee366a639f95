"""Published results to reproduce: each claim of the thesis beside what comes out here."""

from __future__ import annotations

from collections.abc import Sequence

from evaluation.compare import Claim, Comparison, Configuration


def chapter3_claims(comparison: Comparison) -> Sequence[Claim]:
    """Claims of the thesis' chapter 3 on the three cases of the quarter car.

    The thesis reads its peaks off figures (11 and 7.5 m/s²); the exact figures come from an independent stiff solver
    (Radau, rtol 1e-7) run on the same equations.
    """
    linear, nonlinear, soft = comparison.configurations
    return (
        _peak("Linear: peak body acceleration (thesis, figure 3.4: 11 m/s²)", linear, 11.24),
        _contact("Linear: the wheel loses contact at about 0.3 s (thesis, figure 3.5)", linear, lost=True),
        _peak("Non-linear: peak body acceleration (thesis, figure 3.4: 7.5 m/s²)", nonlinear, 7.89),
        _contact("Non-linear: the wheel keeps contact (thesis, figure 3.5)", nonlinear, lost=False),
        _travel(linear, nonlinear),
        _peak("Linear, 1200 N s/m: lower peak (thesis, figure 3.8)", soft, 8.27),
        _contact("Linear, 1200 N s/m: the wheel keeps contact (thesis, figure 3.9)", soft, lost=False),
        _settles(linear, soft),
    )


def _value(configuration: Configuration, number: str) -> float:
    value = configuration.numbers[number].value
    return float("nan") if value is None else value


def _peak(text: str, configuration: Configuration, expected: float, tolerance: float = 0.05) -> Claim:
    peak = _value(configuration, "body_acceleration_max")
    return Claim(text, f"{expected:.2f} ± {tolerance:.2f} m/s²", f"{peak:.3f} m/s²", abs(peak - expected) <= tolerance)


def _contact(text: str, configuration: Configuration, *, lost: bool) -> Claim:
    instant = configuration.numbers["contact_loss_instant"].value
    least = _value(configuration, "wheel_load_min")
    result = f"kept, at least {least:.0f} N" if instant is None else f"lost at {instant:.3f} s"
    if not lost:
        return Claim(text, "kept", result, instant is None)
    return Claim(text, "lost at 0.3 ± 0.05 s", result, instant is not None and abs(instant - 0.3) <= 0.05)


def _travel(linear: Configuration, nonlinear: Configuration) -> Claim:
    travels = [1000 * _value(each, "travel_compression") for each in (linear, nonlinear)]
    return Claim(
        "Non-linear: more suspension travel than linear (thesis, figure 3.6)",
        "more",
        f"{travels[1]:.1f} mm against {travels[0]:.1f} mm",
        travels[1] > travels[0],
    )


def _settles(linear: Configuration, soft: Configuration) -> Claim:
    times = [_value(each, "settling_time") for each in (linear, soft)]
    return Claim(
        "Linear, 1200 N s/m: settles later than with 3000 N s/m (thesis, figures 3.8 to 3.10)",
        "later",
        f"{times[1]:.2f} s against {times[0]:.2f} s",
        times[1] > times[0],
    )
