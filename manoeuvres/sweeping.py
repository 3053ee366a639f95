"""Sine sweep: a sine whose frequency rises, exponentially or linearly, over the length of a run."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from susp_mj.manoeuvre import ValueAndRate


@dataclass(frozen=True)
class Sweep:
    """A sine whose frequency rises from f0 to f1 within T; it fades in over the first period.

    Exponential: ``f(t) = f0 (f1/f0)^(t/T)``, phase ``2 pi f0 T/ln(f1/f0) ((f1/f0)^(t/T) - 1)``;
    linear: ``f(t) = f0 + (f1 - f0) t/T``, phase ``2 pi (f0 t + (f1 - f0) t²/(2 T))``.

    Attributes:
        start_frequency, end_frequency: f0 and f1 [Hz].
        duration: T [s].
        linear: whether the frequency rises linearly.

    Source: the exponential sweep after A. Farina, AES Convention 108 (2000), 5093.
    """

    start_frequency: float
    end_frequency: float
    duration: float
    linear: bool = False

    def frequency(self, time: np.ndarray) -> np.ndarray:
        """Momentary frequency [Hz]."""
        if self.linear:
            return self.start_frequency + (self.end_frequency - self.start_frequency) * time / self.duration
        return self.start_frequency * (self.end_frequency / self.start_frequency) ** (time / self.duration)

    def phase(self, time: np.ndarray) -> np.ndarray:
        """Phase [rad], the integral of the frequency."""
        if self.linear:
            growth = (self.end_frequency - self.start_frequency) / self.duration
            return 2 * np.pi * (self.start_frequency + growth * time / 2) * time
        ratio = self.end_frequency / self.start_frequency
        return 2 * np.pi * self.start_frequency * self.duration / np.log(ratio) * (ratio ** (time / self.duration) - 1)

    def sine(self, time: np.ndarray) -> ValueAndRate:
        """The sweep with amplitude 1, faded in, and its rate."""
        phase, fade, fade_rate = self.phase(time), *self.fade(time)
        return fade * np.sin(phase), fade * 2 * np.pi * self.frequency(time) * np.cos(phase) + fade_rate * np.sin(phase)

    def fade(self, time: np.ndarray) -> ValueAndRate:
        """Half a cosine from 0 to 1 within the first period."""
        progress = np.clip(time * self.start_frequency, 0.0, 1.0)
        return (1 - np.cos(np.pi * progress)) / 2, np.pi / 2 * self.start_frequency * np.sin(np.pi * progress)

    def record(self, time: np.ndarray) -> dict[str, np.ndarray]:
        """Phase and frequency, to keep with the run."""
        return {"excitation_phase": self.phase(time), "excitation_frequency": self.frequency(time)}
