"""Low-pass filters without phase: the channel frequency classes of SAE J211, or a Butterworth filter."""

from __future__ import annotations

import re
from dataclasses import dataclass

import numpy as np

from susp_mj.errors import InputError
from susp_mj.units import to_si

CLASSES = (60, 180, 600, 1000)
"""Channel frequency classes (CFC) of SAE J211."""
_CFC = re.compile(r"^CFC\s*(\d+)$", re.IGNORECASE)
_BUTTERWORTH = re.compile(r"^Butterworth\s+(\d+)\s*,\s*(.+)$", re.IGNORECASE)


@dataclass(frozen=True)
class LowPass:
    """A Butterworth filter run forwards and backwards, so that it delays nothing.

    Attributes:
        name: as a reader knows it, with its -3 dB frequency.
        order: of one run.
        corner: frequency at which one run has -3 dB [Hz].
    """

    name: str
    order: int
    corner: float

    def __call__(self, values: np.ndarray, step: float) -> np.ndarray:
        """Filtered values of evenly spaced ones, `step` [s] apart.

        Raises:
            InputError: they are too far apart for the filter, or too few.
        """
        from scipy.signal import butter, sosfiltfilt

        if self.corner * step >= 0.5:
            raise InputError(
                f"{self.name} needs samples less than {500 / self.corner:.3g} ms apart; these are {1e3 * step:.4g} ms",
                key="filter",
            )
        sections = np.asarray(butter(self.order, self.corner, fs=1 / step, output="sos"))
        edge = 3 * (2 * len(sections) + 1)
        if len(values) <= edge:
            raise InputError(f"{self.name} needs more than {edge} samples; these are {len(values)}", key="filter")
        return sosfiltfilt(sections, values)


def filter_of(text: str) -> LowPass | None:
    """The filter that a text names: ``CFC 60``, or ``Butterworth 2, 10 Hz``; None of an empty one.

    The order is that of one run; the frequency has -3 dB after both: one run's is ``f/(sqrt(2) - 1)^(1/2n)``. SAE J211
    sets the corner of one run at 2.0775 CFC with order 2, which is -3 dB at 5/3 CFC after both.

    >>> filter_of("CFC 60")
    LowPass(name='CFC 60 (SAE J211, -3 dB at 100 Hz)', order=2, corner=124.65)

    Raises:
        ValueError: it names none.
    """
    if not text:
        return None
    if match := _CFC.match(text.strip()):
        number = int(match[1])
        if number not in CLASSES:
            raise ValueError(f"no class {number}; choose CFC {', CFC '.join(map(str, CLASSES))}")
        return LowPass(f"CFC {number} (SAE J211, -3 dB at {number * 5 / 3:.0f} Hz)", 2, 2.0775 * number)
    if match := _BUTTERWORTH.match(text.strip()):
        order, frequency = int(match[1]), to_si(match[2], "Hz")
        if not 1 <= order <= 8 or frequency <= 0:
            raise ValueError(f"'{text}' is not allowed; the order is 1 to 8, the frequency positive")
        name = f"Butterworth of order {order} forwards and backwards, -3 dB at {frequency:g} Hz"
        return LowPass(name, order, frequency / (np.sqrt(2) - 1) ** (1 / (2 * order)))
    raise ValueError(f"'{text}' is no filter; write 'CFC 60' or 'Butterworth 2, 10 Hz'")
