"""Judging a run by measurements: filtered alike, laid on each other, a band around their mean."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from susp_mj.errors import InputError
from susp_mj.run import Run
from susp_mj.signals import Signals

from ..channels import Found, channel_of
from .alignment import Trace, best_shift, correlation
from .crossing import points_for, values_at, width_for
from .filters import LowPass, filter_of
from .findings import Findings, Judgement, Shift, peak_errors
from .settings import CORRELATION, NONE, MeasuredSignal, Validation, in_si
from .standards import RECONSTRUCTED, STANDARDS

_FEWEST = 10
_GAP = 10.0


def judge(run: Run, measurements: Sequence[Signals], settings: Validation) -> Findings:
    """Judge a run by measurements of the same manoeuvre.

    With the mean m of the measurements and the simulated value s, at every instant or point

    ``|s - m| <= offset + gain |m| + along |ds/dx| + t s_m/sqrt(k)``

    must hold: a tolerance of the value, one of the abscissa, and the confidence interval of the mean of k measurements
    with their standard deviation s_m and Student's t for k - 1. Over time `gain` is a share of the largest ``|m|``.

    Raises:
        InputError: a column, channel or unit is not there, nothing overlaps, or the filter does not suit.
    """
    standard, low_pass = STANDARDS[settings.compared_by], filter_of(settings.filter)
    wanted = settings.signal or _alike(run, measurements[0], settings)
    compare = _crossed if standard.crossed else _over_time
    findings = compare(run, measurements, settings, wanted, low_pass)
    notes = (each for measurement in measurements for each in _gaps(measurement, settings, wanted))
    return replace(findings, notes=tuple(notes))


def _gaps(measurement: Signals, settings: Validation, wanted: Sequence[MeasuredSignal]) -> Iterator[str]:
    """Where a column that is used has a hole in its time, which the curve through its samples bridges."""
    across = (_over(settings),) if STANDARDS[settings.compared_by].crossed else ()
    times = {id(time): time for time in (measurement[_column(measurement, each)].time for each in (*across, *wanted))}
    for time in times.values():
        spacing = np.diff(time)
        widest = int(spacing.argmax())
        if spacing[widest] > _GAP * np.median(spacing):
            yield f"{measurement.source}: nothing was measured for {spacing[widest]:.3g} s after {time[widest]:.6g} s"


def _alike(run: Run, measurement: Signals, settings: Validation) -> tuple[MeasuredSignal, ...]:
    """Every column that is called like a channel of the run."""
    over = _over(settings).channel if STANDARDS[settings.compared_by].crossed else ""
    found = [name for name in measurement if name != over and _is_channel(run, name)]
    if not found:
        text = f"no column is called like a channel of the run (there are {', '.join(measurement)}); map them by"
        raise InputError(f"{text} [[validation.signal]]", source=measurement.source)
    return tuple(MeasuredSignal(channel=name) for name in found)


def _is_channel(run: Run, name: str) -> bool:
    try:
        channel_of(run, name)
    except InputError:
        return False
    return True


def _over(settings: Validation) -> MeasuredSignal:
    return settings.over or MeasuredSignal(channel="lateral_acceleration")


def _trace(measurement: Signals, signal: MeasuredSignal, found: Found, low_pass: LowPass | None) -> Trace:
    """A measured column in the channel's unit, evenly spaced by its own usual spacing, filtered."""
    from scipy.interpolate import PchipInterpolator

    column = _column(measurement, signal)
    values = measurement.si(column, found.unit, signal.unit) * signal.factor
    values = values - in_si(signal.subtract, found.unit, f"signal.{signal.channel}.subtract")
    time = measurement[column].time
    step = float(np.median(np.diff(time)))
    even = time[0] + step * np.arange(int(np.ptp(time) / step + 1e-6) + 1)
    return _filtered(Trace(even, PchipInterpolator(time, values)(even)), low_pass, measurement.source)


def _column(measurement: Signals, signal: MeasuredSignal) -> str:
    """Name of a signal's column: as given, or like the channel, with a space or a line after its station."""
    spellings = (signal.channel, "_".join(signal.channel.split()))
    return signal.column or next((each for each in spellings if each in measurement), signal.channel)


def _filtered(trace: Trace, low_pass: LowPass | None, source: str) -> Trace:
    if low_pass is None:
        return trace
    try:
        return Trace(trace.time, low_pass(trace.values, trace.step))
    except InputError as error:
        raise InputError(f"{error.message} ({source})", key=error.key, source="validation") from None


def _simulated(run: Run, found: Found, low_pass: LowPass | None) -> Trace:
    return _filtered(Trace(run.time, found.values), low_pass, "run")


def _over_time(
    run: Run,
    measurements: Sequence[Signals],
    settings: Validation,
    wanted: Sequence[MeasuredSignal],
    low_pass: LowPass | None,
) -> Findings:
    found = [channel_of(run, each.channel) for each in wanted]
    simulated = [_simulated(run, each, low_pass) for each in found]
    traces = [
        [_trace(measurement, signal, channel, low_pass) for signal, channel in zip(wanted, found, strict=True)]
        for measurement in measurements
    ]
    shifts = tuple(
        _shift(simulated[0], own[0], measurement.source, settings)
        for measurement, own in zip(measurements, traces, strict=True)
    )
    judgements = []
    for i, (signal, channel) in enumerate(zip(wanted, found, strict=True)):
        moved = [own[i].shifted(shift.seconds) for own, shift in zip(traces, shifts, strict=True)]
        time = _shared(run.time, moved)
        values = np.array([np.interp(time, each.time, each.values) for each in moved])
        inside = np.interp(time, simulated[i].time, simulated[i].values)
        judgements.append(_judged(signal, channel, time, inside, values, settings, "s"))
    return Findings(STANDARDS[settings.compared_by], "", "s", _words(low_pass), shifts, tuple(judgements))


def _shift(simulated: Trace, measured: Trace, source: str, settings: Validation) -> Shift:
    if settings.shift == NONE:
        return Shift(source, 0.0)
    if settings.shift != CORRELATION:
        return Shift(source, in_si(settings.shift, "s", "shift"))
    seconds = best_shift(simulated, measured, settings.window)
    at_edge = abs(seconds) >= settings.window * (1 - 1e-9)
    note = "the best shift lies at the edge of the window: widen it, or give the shift" if at_edge else ""
    return Shift(source, seconds, correlation(simulated, measured, seconds), note)


def _shared(time: np.ndarray, measured: Sequence[Trace]) -> np.ndarray:
    """The run's records that lie within every measurement."""
    low, high = max(each.time[0] for each in measured), min(each.time[-1] for each in measured)
    shared = time[(time >= low) & (time <= high)]
    if len(shared) < _FEWEST:
        text = f"the run ({time[0]:g} to {time[-1]:g} s) and what was measured ({low:.4g} to {high:.4g} s)"
        raise InputError(f"{text} do not overlap", key="shift", source="validation")
    return shared


def _crossed(
    run: Run,
    measurements: Sequence[Signals],
    settings: Validation,
    wanted: Sequence[MeasuredSignal],
    low_pass: LowPass | None,
) -> Findings:
    over = _over(settings)
    abscissa = channel_of(run, over.channel)
    across = _simulated(run, abscissa, low_pass)
    measured = [_trace(each, over, abscissa, low_pass) for each in measurements]
    given = tuple(in_si(each, abscissa.unit, "at") for each in settings.at)
    points = points_for(given, [across, *measured])
    width = width_for(points, None if settings.within is None else in_si(settings.within, abscissa.unit, "within"))
    judgements = []
    for signal in wanted:
        channel = channel_of(run, signal.channel)
        inside = values_at(points, width, across, _simulated(run, channel, low_pass), "run")
        values = np.array(
            [
                values_at(points, width, x, _trace(each, signal, channel, low_pass), each.source)
                for each, x in zip(measurements, measured, strict=True)
            ]
        )
        judgements.append(_judged(signal, channel, points, inside, values, settings, abscissa.unit))
    standard = STANDARDS[settings.compared_by]
    return Findings(standard, over.channel, abscissa.unit, _words(low_pass), (), tuple(judgements))


def _words(low_pass: LowPass | None) -> str:
    return "none" if low_pass is None else low_pass.name


def _judged(
    signal: MeasuredSignal,
    channel: Found,
    abscissa: np.ndarray,
    simulated: np.ndarray,
    measured: np.ndarray,
    settings: Validation,
    along: str,
) -> Judgement:
    """The band around the mean of the measurements, and the errors of a channel."""
    standard = STANDARDS[settings.compared_by]
    usual = standard.tolerances.get(channel.quantity, standard.usual)
    allowed = usual if signal.tolerance is None else signal.tolerance.allowed(channel.unit, along)
    mean = measured.mean(axis=0)
    confidence = _confidence(measured, settings.confidence)
    share = np.abs(mean) if standard.crossed else np.full_like(mean, np.abs(mean).max())
    slope = np.abs(np.gradient(simulated, abscissa)) if len(abscissa) > 1 else np.zeros_like(mean)
    half = allowed.offset + allowed.gain * share + allowed.along * slope + confidence
    errors = peak_errors(simulated, measured, channel.unit, over_time=not standard.crossed)
    notes = (channel.note, "" if allowed.given else RECONSTRUCTED)
    return Judgement(
        signal.channel,
        channel.quantity,
        channel.unit,
        abscissa,
        simulated,
        measured,
        confidence,
        half,
        allowed,
        errors,
        tuple(note for note in notes if note),
    )


def _confidence(measured: np.ndarray, level: float) -> np.ndarray:
    """Half width of the confidence interval of the mean, ``t s/sqrt(k)``; zero of one measurement."""
    count = len(measured)
    if count < 2:
        return np.zeros(measured.shape[1])
    from scipy.stats import t

    return t.ppf((1 + level) / 2, count - 1) * measured.std(axis=0, ddof=1) / np.sqrt(count)
