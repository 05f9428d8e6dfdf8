"""Options of `p2sf psf`: how a PSF is computed and sampled, and which PSFs a set holds."""

from dataclasses import dataclass
from typing import Annotated, Literal

from cyclopts import Parameter

from p2sf.api import Method
from p2sf.errors import RequestError, SamplingError
from p2sf.messages import ParameterName
from p2sf.parameters import check_samples
from p2sf.psf.methods import AUTO, SEIDEL, PsfOptions, by_six


@dataclass(frozen=True)
class SetOptions:
    """Which PSFs a set holds: numbers and ranges LOW:HIGH:COUNT, separated by commas.

    Attributes
    ----------
    depths_mm
        Object distances from the first vertex, mm; a range is even in 1/depth, and HIGH may be inf.
    fields_deg
        Chief-ray angles at the entrance pupil, degrees.
    wavelengths_nm
        Wavelengths, nm.
    fill_factor
        Of a set: the share of a pixel's area that is sensitive, a square in its middle; 1 when not given.
    """

    depths_mm: str | None = None
    fields_deg: str | None = None
    wavelengths_nm: str | None = None
    fill_factor: float | None = None

    @property
    def asked(self) -> bool:
        """Return whether a set is asked for."""
        return any((self.depths_mm, self.fields_deg, self.wavelengths_nm))

    def check_one(self) -> None:
        """Raise RequestError for what only a set has."""
        if self.fill_factor:
            raise RequestError(
                "{parameter} is for a set of PSFs; give {depths}, {fields} or {wavelengths} too, or leave it out",
                parameter="fill_factor",
                depths=ParameterName("depths_mm"),
                fields=ParameterName("fields_deg"),
                wavelengths=ParameterName("wavelengths_nm"),
            )


ONE = SetOptions()


@dataclass(frozen=True)
class Picture:
    """How a PSF is computed and sampled.

    Attributes
    ----------
    method
        How the PSF is computed; auto takes the cheapest method that holds this R².
    min_r2
        Least R² against the exact reference that auto accepts.
    sampling
        How the six coefficients become a PSF: matrix DFT of any size, or zero-padded FFT of even sizes.
    pixels
        Samples along each side; 64 when not given, of a set 65, with the chief ray on the middle one.
    pixel_um
        Distance between samples, µm; one that holds the PSF when not given.
    clip
        Stop rays at every clear semi-diameter.
    """

    method: Method | None = None
    min_r2: Annotated[float, Parameter(name=("--min-r2", "--tolerance"))] = 0.99
    sampling: Literal["fft", "mdft"] | None = None
    pixels: int | None = None
    pixel_um: float | None = None
    clip: bool = False

    def __post_init__(self) -> None:
        check_samples(self.pixels, self.pixel_um, least=2)
        if not 0 < self.min_r2 < 1:
            raise RequestError(
                "{parameter} is {value:g}; give an R² between 0 and 1, such as 0.99",
                parameter="min_r2",
                value=self.min_r2,
            )
        if self.sampling and self.method and not by_six(self.method):
            raise RequestError(
                "{parameter} is {value}, which samples Seidel coefficients and not {method} {name}; "
                "leave one of the two out",
                parameter="sampling",
                value=self.sampling,
                method=ParameterName("method"),
                name=self.method,
            )
        if self.sampling == "fft" and self.side % 2:
            raise SamplingError(
                "{parameter} is {value}, and {sampling} fft needs an even size; give {even} or choose {sampling} mdft",
                parameter="pixels",
                value=self.side,
                even=self.side + 1,
                sampling=ParameterName("sampling"),
            )

    @property
    def side(self) -> int:
        """Return how many samples one PSF has along each side."""
        return self.pixels or 64

    @property
    def seidel(self) -> bool:
        """Return whether the six coefficients are asked for."""
        return by_six(self.method or AUTO) or self.sampling is not None

    @property
    def described_by(self) -> str:
        """Return the method that describes the pupil: six coefficients also where a sampling of theirs is asked for."""
        return SEIDEL.name if self.seidel else self.method or AUTO

    @property
    def options(self) -> PsfOptions:
        """Return how its PSF is made."""
        return PsfOptions(min_r2=self.min_r2, clip=self.clip, sampling=self.sampling or "mdft")


USUAL = Picture()
