"""Random roughness of a runway, of a given spectrum, in two tracks.

ISO 8608: the displacement has the one-sided spectral density G(n) = G_0 (n/n_0)^(-2)
over the spatial frequency n, n_0 = 0.1 1/m, with G_0 of 16, 64, 256, 1024 ... ·10⁻⁶ m³
for the classes A, B, C, D ... (geometric means).

Two tracks at a distance B on a surface that is rough alike in all directions have the
coherence γ(n) = 2π n B K_1(2π n B): the cross spectrum of such a surface, whose
two-dimensional spectrum falls with the third power, by Basset's integral. Long waves
lift both tracks, short ones each alone.
"""

import numpy as np
import numpy.typing as npt

from systems.runway.runway_profile import MeasuredProfile
from systems.tools.checks import require

Float64 = npt.NDArray[np.float64]

ISO_8608 = {name: 16e-6 * 4.0**i for i, name in enumerate("ABCDEFGH")}
"""G_0 of the classes, m³."""

_REFERENCE = 0.1  # 1/m
_POINTS = 10  # to the shortest wave


def rough_tracks(
    intensity: float,
    *,
    seed: int,
    length: float,
    start: float = 0.0,
    wavelengths: tuple[float, float] = (1.0, 90.0),
    run_in: float = 10.0,
    track_spacing: float = 0.0,
) -> tuple[MeasuredProfile, MeasuredProfile]:
    """Left and right track, zero up to the start.

    Args:
        intensity: G_0, m³.
        seed: of the random phases; the same one gives the same runway.
        length: m, of the rough part.
        start: m, distance at which it begins.
        wavelengths: m, shortest and longest; what is shorter than about twice the
            footprint of a tire, the tire itself levels out.
        run_in: m, over which the roughness grows to its full size.
        track_spacing: m; 0 makes both tracks the same.

    Raises:
        ValueError: a value is out of range.
    """
    owner = "runway roughness"
    require(owner, "intensity", intensity, "m³", above=0.0)
    shortest, longest = wavelengths
    require(owner, "shortest wavelength", shortest, "m", above=0.0)
    require(owner, "longest wavelength", longest, "m", above=shortest)
    require(owner, "length", length, "m", above=2.0 * longest)
    require(owner, "run_in", run_in, "m", above=0.0, at_most=length)
    require(owner, "track_spacing", track_spacing, "m", at_least=0.0)
    count = int(np.ceil(_POINTS * length / shortest))
    frequency = np.fft.rfftfreq(count, length / count)
    inside = (frequency >= 1.0 / longest) & (frequency <= 1.0 / shortest)
    n = frequency[inside]
    amplitude = np.sqrt(2.0 * intensity * (n / _REFERENCE) ** -2.0 / length)
    turned = np.random.default_rng(seed).uniform(0.0, 2.0 * np.pi, (2, len(n)))
    common, own = np.exp(1j * turned)
    gamma = coherence(n, track_spacing)
    waves = (common, gamma * common + np.sqrt(1.0 - gamma**2) * own)
    distance = length / count * np.arange(count)
    grown = np.clip(distance / run_in, 0.0, 1.0)
    share = grown**2 * (3.0 - 2.0 * grown)
    left, right = (
        _profile(start + distance, share * _sum(inside, amplitude * wave, count))
        for wave in waves
    )
    return left, right


def coherence(n: Float64, spacing: float) -> Float64:
    """γ of two tracks at a distance (m) over spatial frequency (1/m)."""
    z = 2.0 * np.pi * np.asarray(n, dtype=float) * spacing
    # K_1(z) = ∫ exp(-z cosh t) cosh t dt from 0: the trapezoidal rule is exact to
    # rounding where the integrand ends.
    t = np.linspace(0.0, 12.0, 601)
    weight = np.full(len(t), t[1])
    weight[0] = 0.5 * t[1]
    small = np.maximum(z, 1e-3)[:, None]
    k1 = (np.exp(-small * np.cosh(t)) * np.cosh(t)) @ weight
    return np.where(z < 1e-3, 1.0, np.minimum(small[:, 0] * k1, 1.0))


def _sum(inside: npt.NDArray[np.bool_], waves: npt.NDArray, count: int) -> Float64:
    """Heights of waves a cos(2π n d + φ)."""
    spectrum = np.zeros(len(inside), dtype=complex)
    spectrum[inside] = 0.5 * count * waves
    return np.fft.irfft(spectrum, count)


def _profile(distance: Float64, height: Float64) -> MeasuredProfile:
    return MeasuredProfile(distance=distance.tolist(), height=height.tolist())
