"""Spectra of a point of light: black bodies, daylight, equal energy, lines."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from p2sf.conventions import NM_PER_UM, UM_PER_MM
from p2sf.errors import RequestError
from p2sf.messages import Alternatives, Message

SECOND_RADIATION_MM_K = 14.387768775  # c₂ = hc/k (CODATA 2018, exact since the SI of 2019)
KELVIN = (300.0, 1e6)  # a colder body emits no visible light
NM = (100.0, 20000.0)
EXAMPLES = Alternatives(("d65", "equal", "planck:5600 (kelvin)", "lines:486,588,656 (nm)"))
WORDS = str(Message("{examples}", examples=EXAMPLES))
D65_NM = np.arange(380.0, 781.0, 10.0)
# CIE standard illuminant D65, relative spectral power every 10 nm from 380 nm (ISO/CIE 11664-2:2022, table 1).
D65 = np.array([
    49.9755, 54.6482, 82.7549, 91.486, 93.4318, 86.6823, 104.865, 117.008, 117.812, 114.861, 115.923, 108.811,
    109.354, 107.802, 104.79, 107.689, 104.405, 104.046, 100.0, 96.3342, 95.788, 88.6856, 90.0062, 89.5991,
    87.6987, 83.2886, 83.6992, 80.0268, 80.2146, 82.2778, 78.2842, 69.7213, 71.6091, 74.349, 61.604, 69.8856,
    75.087, 63.5927, 46.4182, 66.8054, 63.3828,
])  # fmt: skip


@dataclass(frozen=True)
class Spectrum:
    """One of `KINDS`: ``numbers`` are the kelvin of "planck", the nm of "lines", else none.

    ``weights`` are how bright the lines are to one another; without them all are equally bright.
    """

    kind: str
    numbers: tuple[float, ...] = ()
    weights: tuple[float, ...] = ()

    def __post_init__(self) -> None:
        if self.kind not in KINDS:
            raise RequestError('the spectrum "{kind}" is unknown; choose {examples}', kind=self.kind, examples=EXAMPLES)
        _check(self.kind, self.numbers)
        if self.weights and not (len(self.weights) == len(self.numbers) and min(self.weights) >= 0 < max(self.weights)):
            raise RequestError(
                "the spectral lines are as bright as {weights:g}; give numbers that are not negative, as in "
                "lines:486@0.5,588",
                weights=self.weights,
            )

    @property
    def name(self) -> str:
        """Return the spectrum as `spectrum_of` reads it."""
        weights = [f"@{weight:g}" for weight in self.weights] or [""] * len(self.numbers)
        listed = ",".join(f"{number:g}{weight}" for number, weight in zip(self.numbers, weights, strict=True))
        return f"{self.kind}:{listed}".rstrip(":")


def spectrum_of(text: str) -> Spectrum:
    """Return the spectrum of a name such as "d65", "planck:5600" or "lines:486,588,656"; RequestError."""
    kind, _, rest = str(text).strip().lower().partition(":")
    try:
        parts = [part.partition("@") for part in rest.split(",")] if rest else []
        numbers = tuple(float(number) for number, _, _ in parts)
        weighted = tuple(float(weight) if at else 1.0 for _, at, weight in parts)
        return Spectrum(kind, numbers, weighted if "@" in rest else ())
    except RequestError:
        raise
    except ValueError:
        raise RequestError(
            'the spectrum "{text}" contains "{rest}", which is not a list of numbers; write {examples}',
            text=str(text),
            rest=rest,
            examples=EXAMPLES,
        ) from None


def _check(kind: str, numbers: tuple[float, ...]) -> None:
    if kind in ("d65", "equal") and numbers:
        raise RequestError(
            'the spectrum "{kind}" takes no number, but has {number:g}; write {examples}',
            kind=kind,
            number=numbers[0],
            examples=EXAMPLES,
        )
    if kind == "planck" and not (len(numbers) == 1 and KELVIN[0] <= numbers[0] <= KELVIN[1]):
        raise RequestError(
            "the black body has {given:g} K; give one temperature from {least:g} to {most:g} K, as in planck:5600",
            given=numbers or Message("no"),
            least=KELVIN[0],
            most=KELVIN[1],
        )
    if kind == "lines" and not (numbers and all(NM[0] <= n <= NM[1] for n in numbers)):
        raise RequestError(
            "the spectral lines are {given:g} nm; "
            "give wavelengths from {least:g} to {most:g} nm, as in lines:486,588,656",
            given=numbers or Message("none"),
            least=NM[0],
            most=NM[1],
        )


def relative_power(spectrum: Spectrum, wavelength_um: ArrayLike) -> np.ndarray:
    """Return the power per wavelength of a continuous spectrum, 1 at 560 nm, shape of the wavelengths (µm).

    Raises RequestError for lines, which have no power per wavelength.
    """
    if spectrum.kind == "lines":
        raise RequestError("spectral lines have no power per wavelength; take their wavelengths one by one")
    wavelength = np.asarray(wavelength_um, dtype=float)
    if spectrum.kind == "planck":
        return black_body(wavelength, spectrum.numbers[0])
    return daylight(wavelength) if spectrum.kind == "d65" else np.ones_like(wavelength)


def black_body(wavelength_um: ArrayLike, kelvin: float) -> np.ndarray:
    """Return Planck's law per wavelength, λ⁻⁵/(exp(c₂/λT) − 1), over its value at 560 nm (Planck 1901)."""
    exponent = SECOND_RADIATION_MM_K * UM_PER_MM / (np.asarray(wavelength_um, dtype=float) * kelvin)
    known = SECOND_RADIATION_MM_K * UM_PER_MM / (0.56 * kelvin)
    # exp(known − exponent), since a quotient of two exponentials overflows for a cold body.
    ratio = np.exp(known - exponent) * np.expm1(-known) / np.expm1(-exponent)
    power: np.ndarray = (0.56 / np.asarray(wavelength_um)) ** 5 * ratio
    return power


def daylight(wavelength_um: ArrayLike) -> np.ndarray:
    """Return D65 per wavelength, 1 at 560 nm, interpolated linearly between the table's values and 0 beyond them."""
    return np.interp(np.asarray(wavelength_um) * NM_PER_UM, D65_NM, D65 / 100, left=0.0, right=0.0)


KINDS = ("d65", "equal", "planck", "lines")
