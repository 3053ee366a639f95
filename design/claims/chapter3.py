"""Claims of chapter 3: the quarter car with a linear and a non-linear suspension over a bump."""

from __future__ import annotations

from collections.abc import Sequence

from evaluation.compare import Claim, Comparison, Configuration


def chapter3_claims(comparison: Comparison) -> Sequence[Claim]:
    """Claims of the thesis' chapter 3 on the three cases of the quarter car.

    The thesis reads its peaks off figures (11 and 7.5 m/s²); the exact figures come from an independent stiff solver
    (Radau, rtol 1e-7) run on the same equations.
    """
    if comparison.failures:
        return [Claim(f"{each.name} runs", "a run", each.reason, holds=False) for each in comparison.failures]
    linear, nonlinear, soft = comparison.configurations
    return (
        _peak("Linear: peak body acceleration", "figure 3.4", linear, 11.24, read=11.0),
        _contact("Linear: the wheel loses contact at about 0.3 s", "figure 3.5", linear, lost=True),
        _peak("Non-linear: peak body acceleration", "figure 3.4", nonlinear, 7.89, read=7.5),
        _contact("Non-linear: the wheel keeps contact", "figure 3.5", nonlinear, lost=False),
        _travel(linear, nonlinear),
        _lower(linear, soft),
        _peak("Linear, 1200 N s/m: peak body acceleration", "figure 3.8, without a figure", soft, 8.27),
        _contact("Linear, 1200 N s/m: the wheel keeps contact", "figure 3.9", soft, lost=False),
        _settles(linear, soft),
    )


def _value(configuration: Configuration, number: str) -> float:
    value = configuration.numbers[number].value
    return float("nan") if value is None else value


def _peak(
    text: str,
    source: str,
    configuration: Configuration,
    expected: float,
    *,
    read: float | None = None,
    tolerance: float = 0.05,
) -> Claim:
    """Peak acceleration against the independent solver; what the thesis reads off its figure stands beside it."""
    peak = _value(configuration, "body_acceleration_max")
    result = f"{peak:.3f} m/s²"
    wanted = f"{expected:.2f} ± {tolerance:.2f} m/s² (independent solver)"
    if read is not None:
        wanted += f"; thesis reads {read:g}"
        result += f", {100 * (peak / read - 1):+.0f} % on the reading"
    return Claim(text, wanted, result, abs(peak - expected) <= tolerance, source)


def _lower(linear: Configuration, soft: Configuration) -> Claim:
    peaks = [_value(each, "body_acceleration_max") for each in (linear, soft)]
    return Claim(
        "Linear, 1200 N s/m: lower peak acceleration than with 3000 N s/m",
        "lower",
        f"{peaks[1]:.2f} m/s² against {peaks[0]:.2f} m/s²",
        peaks[1] < peaks[0],
        "figure 3.8",
    )


def _contact(text: str, source: str, configuration: Configuration, *, lost: bool) -> Claim:
    instant = configuration.numbers["contact_loss_instant"].value
    least = _value(configuration, "wheel_load_min")
    result = f"kept, at least {least:.0f} N" if instant is None else f"lost at {instant:.3f} s"
    if not lost:
        return Claim(text, "kept", result, instant is None, source)
    holds = instant is not None and abs(instant - 0.3) <= 0.05
    return Claim(text, "lost at 0.3 ± 0.05 s", result, holds, source)


def _travel(linear: Configuration, nonlinear: Configuration) -> Claim:
    travels = [1000 * _value(each, "travel_compression") for each in (linear, nonlinear)]
    return Claim(
        "Non-linear: more suspension travel than linear",
        "more",
        f"{travels[1]:.1f} mm against {travels[0]:.1f} mm",
        travels[1] > travels[0],
        "figure 3.6",
    )


def _settles(linear: Configuration, soft: Configuration) -> Claim:
    times = [_value(each, "settling_time") for each in (linear, soft)]
    return Claim(
        "Linear, 1200 N s/m: settles later than with 3000 N s/m",
        "later",
        f"{times[1]:.2f} s against {times[0]:.2f} s",
        times[1] > times[0],
        "figures 3.8 to 3.10",
    )
