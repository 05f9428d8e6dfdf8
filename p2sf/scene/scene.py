"""The scene: depths, part of the field, colours and tolerance."""

from dataclasses import dataclass, fields, replace
from itertools import pairwise
from math import inf, isfinite, log10, sqrt

import numpy as np
from numpy.typing import ArrayLike

from p2sf.arguments import check_fields, real_array
from p2sf.conventions import NM_PER_UM, vergence
from p2sf.errors import RequestError
from p2sf.lens.lens import Lens
from p2sf.messages import Alternatives, Message, ParameterName
from p2sf.parameters import check_aim, check_between, check_reach
from p2sf.scene.depth_gaps import (
    Gaps,
    check_depths,
    depth_parts,
    ends_and_gaps,
    nearest_occupied,
    occupied_intervals,
)
from p2sf.scene.sensor import Sensor
from p2sf.setting import AimChoice, Request, Settings, set_up

NAMES = {"red": Message("red"), "green": Message("green"), "blue": Message("blue")}
LIMITS = {"rtol": "relative", "min_r2": "r2", "mtf_error": "mtf", "min_psnr_db": "psnr", "tail_error": "hdr"}
"""Numbers that state the tolerable error, and how each measures it."""
USUAL_RTOL = 0.05
TIGHTEST = 3e-3  # relative error: polynomial fits of a pupil do not achieve less
LOOSEST = 0.9  # relative error: beyond 1 a kernel of zeros would suffice
NOISE_PART = 1 / 3  # of the sensor's noise: as much error, added in squares, makes 5 % more of it
DIMMEST, MOST_LIGHT = 1e-9, 1e9
WHITE = 0.5  # the largest standard deviation of numbers from 0 to 1: half of them are 0 (Popoviciu 1935)


@dataclass(frozen=True)
class Channel:
    """One colour of the sensor: wavelengths in nm and their shares of its light."""

    name: str
    wavelengths_nm: tuple[float, ...]
    weights: tuple[float, ...]

    def __post_init__(self) -> None:
        check_fields(self)
        if not self.wavelengths_nm or len(self.wavelengths_nm) != len(self.weights):
            raise RequestError(
                "channel {channel} has {waves} wavelengths and {weights} weights; give as many of both, at least one",
                channel=self.label,
                waves=len(self.wavelengths_nm),
                weights=len(self.weights),
            )
        if not all(isfinite(w) and w > 0 for w in (*self.wavelengths_nm, *self.weights)):
            raise RequestError(
                "channel {channel} has a wavelength or weight that is not positive; correct it", channel=self.label
            )

    @property
    def label(self) -> Message | str:
        """Return the name for messages: common colours are translated, other names stay unchanged."""
        return NAMES.get(self.name, self.name)

    @property
    def wavelengths_um(self) -> np.ndarray:
        """Return the wavelengths in µm."""
        return np.array(self.wavelengths_nm) / NM_PER_UM

    @property
    def shares(self) -> np.ndarray:
        """Return the weights with unit sum."""
        return np.array(self.weights) / sum(self.weights)


RGB = (
    Channel("red", (590.0, 620.0, 650.0), (1.0, 2.0, 1.0)),
    Channel("green", (510.0, 540.0, 570.0), (1.0, 2.0, 1.0)),
    Channel("blue", (440.0, 465.0, 490.0), (1.0, 2.0, 1.0)),
)


@dataclass(frozen=True)
class Scene:
    """A scene: sensor, colours, depths (mm from the first vertex, inf allowed) and the tolerable error.

    One of four numbers says which error is tolerable: ``rtol``, the relative L2 error of a pixel's kernel, 0.05 where
    none is given; ``min_r2``, its least R²; ``mtf_error``, the RMS error of the MTF over all spatial frequencies that
    the pixels resolve; ``min_psnr_db``, the least peak signal-to-noise ratio, dB, of a picture of white noise between
    black and white. Pictures with most of their light at low frequencies have smaller errors. ``tail_error`` is the
    relative error of every kernel, and of the azimuthal mean of its faint light wherever that is at least 1e-6 of its
    peak within 200 Airy radii (`p2sf.figures.tails`), which pictures of very bright points need.

    ``focus_mm``, ``f_number``, ``zoom``, ``focus_position`` and ``aim`` are as in `p2sf.Camera`; None leaves them as
    the lens file has them. With ``clip`` the rims of all surfaces clip rays. ``depth_map`` names a picture of depths;
    ``map_meaning``: what its numbers mean (`p2sf.io.depth_files`). ``brightest``: the most light in the picture, 1
    being white, see `noise_floor`. ``gaps_mm``: between which depths, from near to far, nothing is, so that no kernels
    are needed there.
    """

    sensor: Sensor
    channels: tuple[Channel, ...] = RGB
    near_mm: float = inf
    far_mm: float = inf
    rtol: float | None = None
    min_r2: float | None = None
    mtf_error: float | None = None
    min_psnr_db: float | None = None
    tail_error: float | None = None
    focus_mm: float | None = None
    f_number: float | None = None
    aim: AimChoice | None = None
    zoom: float | str | None = None
    focus_position: float | str | None = None
    clip: bool = False
    depth_map: str | None = None
    name: str = "scene"
    gaps_mm: Gaps = ()
    brightest: float = 1.0
    map_meaning: str | None = None

    def __post_init__(self) -> None:
        check_fields(self)
        for name in ("near_mm", "far_mm", "focus_mm"):
            check_reach(name, getattr(self, name))
        if not 0 < self.near_mm <= self.far_mm:
            raise RequestError(
                "the scene reaches from {near:g} mm to {far:g} mm; give positive depths, the near one first",
                near=self.near_mm,
                far=self.far_mm,
            )
        self._check_gaps()
        check_between("brightest", self.brightest, DIMMEST, MOST_LIGHT)  # which the tolerance is divided by
        self._check_limit()
        check_aim("aim", self.aim)
        if not self.channels:
            raise RequestError("the scene has no channel; give at least one")
        if self.sensor.mosaic is not None and len(self.channels) != len(RGB):
            raise RequestError(
                "the mosaic {mosaic} needs red, green and blue, but the scene has {count} channels; change one of them",
                mosaic=self.sensor.mosaic,
                count=len(self.channels),
            )

    def _check_gaps(self) -> None:
        """Raise RequestError unless the gaps are pairs of depths in the scene's range, from near to far."""
        ends = [self.near_mm, *(end for gap in self.gaps_mm for end in gap), self.far_mm]
        pairs = all(len(gap) == 2 and gap[0] < gap[1] for gap in self.gaps_mm)
        if not pairs or any(not near <= far for near, far in pairwise(ends)):
            raise RequestError(
                "{parameter} is {gaps}; give pairs of depths in mm between {near:g} mm and {far:g} mm, from near to "
                "far, of which none overlap",
                parameter="gaps_mm",
                gaps=str(self.gaps_mm),
                near=self.near_mm,
                far=self.far_mm,
            )

    def _check_limit(self) -> None:
        """Raise RequestError for an error that cannot be asked for."""
        first, *others = [name for name in LIMITS if getattr(self, name) is not None] or ["rtol"]
        if others:
            raise RequestError(
                "{parameter} and {other} are both given; keep one of them", parameter=first, other=others[0]
            )
        if self.measure == "psnr" and not self.limit > 0:
            raise RequestError(
                "{parameter} is {value:g}; give the least peak signal-to-noise ratio, a positive number",
                parameter=first,
                value=self.limit,
            )
        if self.measure != "psnr" and not 0 < self.limit < 1:
            raise RequestError(
                "{parameter} is {value:g}; give a number between 0 and 1", parameter=first, value=self.limit
            )
        if self.relative_tolerance < TIGHTEST:
            raise RequestError(
                "{parameter} of {value:g} is tighter than the relative error of {least:g} that polynomial pupils can "
                "promise; loosen it or render single PSFs with {method} huygens",
                parameter=first,
                value=self.limit,
                least=TIGHTEST,
                method=ParameterName("method"),
            )

    @property
    def measure(self) -> str:
        """Return how the tolerable error is measured, "relative", "r2", "mtf" or "psnr", by which number states it."""
        return next((LIMITS[name] for name in LIMITS if getattr(self, name) is not None), "relative")

    @property
    def limit(self) -> float:
        """Return the number that states the tolerable error."""
        return next((value for name in LIMITS if (value := getattr(self, name)) is not None), USUAL_RTOL)

    @property
    def relative_tolerance(self) -> float:
        """Return the tolerance as relative L2 error of any kernel: `relative_error` of one on a single pixel."""
        return self.relative_error(1.0)

    def relative_error(self, norm: float) -> float:
        """Return the tolerance as relative L2 error of kernels of unit sum with a root sum of squares up to ``norm``.

        √(1 − R²), which is the same for a small kernel on a dark ground. By Parseval the mean square of the difference
        of two kernels' transforms, over all frequencies up to the pixels' own, is the sum of the squares of theirs, and
        no two complex numbers are nearer than their moduli: so the MTF's error is at most the relative error times
        ``norm``. Pixels of white noise are independent: the mean square error of its picture is its variance times that
        sum, the peak being 1. An error of pictures below `noise_floor` is tolerable in any case.
        """
        if self.measure in ("mtf", "hdr"):  # of kernels, not of pictures
            return self._stated_error(norm)
        return max(self._stated_error(norm), self.noise_floor)

    def _stated_error(self, norm: float) -> float:
        """Return the stated tolerance as `relative_error` has it, without regard to noise."""
        if self.measure in ("relative", "hdr"):
            return self.limit
        if self.measure == "r2":
            return sqrt(1 - self.limit)
        absolute = self.limit if self.measure == "mtf" else 10 ** (-self.limit / 20) / WHITE
        return min(absolute / norm, LOOSEST)

    @property
    def noise_floor(self) -> float:
        """Return the relative error of kernels that the sensor's noise hides, 0 for ideal pixels.

        Independent pixels of mean m up to the brightest light L have a variance of m(L − m) at most (Bhatia and Davis
        2000), and kernels of unit sum with an error of ε a picture with an RMS error of ε√(m(L − m)). Its noise has the
        variance σ²(m) ≥ σ²(L)·m/L, since that of shot noise grows with the light. So with ε = f·σ(L)/L the picture's
        error is at most f times its noise, whatever m.
        """
        return min(NOISE_PART * float(self.sensor.noise(self.brightest)) / self.brightest, LOOSEST)

    @property
    def noise_decides(self) -> bool:
        """Return whether the noise hides more than the stated tolerance allows, for a kernel on a single pixel."""
        return self.relative_error(1.0) > self._stated_error(1.0)

    def measured(self, relative: float, norm: float) -> float:
        """Return a relative error in the measure of the tolerance, for kernels as in `relative_error`."""
        if self.measure in ("relative", "hdr"):
            return relative
        if self.measure == "r2":
            return 1 - relative**2
        return relative * norm if self.measure == "mtf" else -20 * log10(max(relative * norm * WHITE, 1e-12))

    def vergences(self, count: int) -> np.ndarray:
        """Return ``count`` vergences (1/mm) from far to near, the middle for one."""
        far, near = vergence(self.far_mm), vergence(self.near_mm)
        return np.array([(far + near) / 2]) if count == 1 else np.linspace(far, near, count)

    def depth_parts(self, count: int) -> list[np.ndarray]:
        """Return depth nodes, 1/mm, from far to near, in parts with gaps between them, see `depth_gaps.depth_parts`.

        ``count`` nodes without gaps.
        """
        return depth_parts(self._intervals, count)

    def scan(self, count: int) -> np.ndarray:
        """Return at most ``count`` vergences (1/mm) from far to near at which depths occur, the ends among them."""
        return self.occupied(self.vergences(count))

    def occupied(self, vergences: np.ndarray) -> np.ndarray:
        """Return the nearest vergences at which depths occur, sorted, each once."""
        return nearest_occupied(self._intervals, vergences)

    def at_depths(self, depth_mm: ArrayLike) -> "Scene":
        """Return the scene with the depths of a map alone, mm, any shape.

        Those that are not positive do not count. RequestError for one not in the scene, and for what are no numbers.
        """
        depths = np.atleast_1d(real_array("depth_mm", depth_mm))
        self.check_depths(depths)
        if not (depths > 0).any():
            return self
        near, far, gaps = ends_and_gaps(depths)
        return replace(self, near_mm=near, far_mm=far, gaps_mm=gaps)

    def check_depths(self, depth_mm: np.ndarray) -> None:
        """Raise RequestError for a positive depth, mm, that is not in the scene."""
        check_depths(self._intervals, depth_mm)

    @property
    def _intervals(self) -> np.ndarray:
        return occupied_intervals(self.near_mm, self.far_mm, self.gaps_mm)

    def camera(self, lens: Lens) -> Lens:
        """Return the lens with the scene's focus and f-number."""
        return set_up(lens, self.request).lens

    @property
    def request(self) -> Request:
        """Return the settings of the camera."""
        return Request(**{name: getattr(self, name) for name in CAMERA_PARAMETERS})


def limit_of(measure: str, tolerance: float | None) -> dict[str, float | None]:
    """Return a tolerable error under the name of its measure; RequestError for an unknown measure."""
    name = next((name for name, each in LIMITS.items() if each == measure), None)
    if name is None:
        raise RequestError(
            'the tolerance is measured as "{measure}"; choose {choices}',
            measure=measure,
            choices=Alternatives(LIMITS.values()),
        )
    return {name: tolerance}


CAMERA_PARAMETERS = tuple(part.name for part in fields(Scene) if part.name in {own.name for own in fields(Settings)})
"""What of a camera a scene states."""
