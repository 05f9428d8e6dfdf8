"""The scene: depths, part of the field, colours and tolerance."""

from dataclasses import dataclass, fields
from math import inf, isfinite, log10, sqrt

import numpy as np

from p2sf.arguments import check_fields
from p2sf.camera import AimChoice, Request, Settings, set_up
from p2sf.conventions import NM_PER_UM, vergence
from p2sf.errors import RequestError
from p2sf.lens.lens import Lens
from p2sf.messages import Alternatives, Message
from p2sf.parameters import check_aim, check_reach
from p2sf.scene.sensor import Sensor

NAMES = {"red": Message("red"), "green": Message("green"), "blue": Message("blue")}
MEASURES = "relative", "r2", "mtf", "psnr"
TIGHTEST = 3e-3  # relative error: polynomial fits of a pupil do not achieve less
LOOSEST = 0.9  # relative error: beyond 1 a kernel of zeros would suffice
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

    ``tolerance`` is the relative L2 error of a pixel's kernel. With ``measure`` "r2" it is the smallest R²; with "mtf"
    the RMS error of the MTF over all spatial frequencies that the pixels resolve; with "psnr" the smallest peak
    signal-to-noise ratio in dB of a picture of white noise between black and white. Pictures with most of their light
    at low frequencies have smaller errors.

    ``focus_mm``, ``f_number``, ``zoom``, ``focus_position`` and ``aim`` are as in `p2sf.Camera`; None leaves them as
    the lens file has them. With ``clip`` the rims of all surfaces clip rays. ``depth_map`` names a picture of depths,
    mm.
    """

    sensor: Sensor
    channels: tuple[Channel, ...] = RGB
    near_mm: float = inf
    far_mm: float = inf
    tolerance: float = 0.05
    measure: str = "relative"
    focus_mm: float | None = None
    f_number: float | None = None
    aim: AimChoice | None = None
    zoom: float | str | None = None
    focus_position: float | str | None = None
    clip: bool = False
    depth_map: str | None = None
    name: str = "scene"

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
        if self.measure not in MEASURES:
            raise RequestError(
                'the tolerance is measured as "{measure}"; choose {choices}',
                measure=self.measure,
                choices=Alternatives(MEASURES),
            )
        if self.measure == "psnr" and not self.tolerance > 0:
            raise RequestError(
                "the tolerance is {tolerance:g} dB; give the least peak signal-to-noise ratio, a positive number",
                tolerance=self.tolerance,
            )
        if self.measure != "psnr" and not 0 < self.tolerance < 1:
            raise RequestError(
                "the tolerance is {tolerance:g}; give a number between 0 and 1", tolerance=self.tolerance
            )
        if self.relative_tolerance < TIGHTEST:
            raise RequestError(
                "the tolerance of {tolerance:g} ({measure}) is tighter than the {least:g} relative error "
                "that polynomial pupils can promise; loosen it or render single PSFs with {parameter} huygens",
                parameter="method",
                tolerance=self.tolerance,
                measure=self.measure,
                least=TIGHTEST,
            )
        check_aim("aim", self.aim)
        if not self.channels:
            raise RequestError("the scene has no channel; give at least one")

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
        sum, the peak being 1.
        """
        if self.measure == "relative":
            return self.tolerance
        if self.measure == "r2":
            return sqrt(1 - self.tolerance)
        absolute = self.tolerance if self.measure == "mtf" else 10 ** (-self.tolerance / 20) / WHITE
        return min(absolute / norm, LOOSEST)

    def measured(self, relative: float, norm: float) -> float:
        """Return a relative error in the measure of the tolerance, for kernels as in `relative_error`."""
        if self.measure == "relative":
            return relative
        if self.measure == "r2":
            return 1 - relative**2
        return relative * norm if self.measure == "mtf" else -20 * log10(max(relative * norm * WHITE, 1e-12))

    def vergences(self, count: int) -> np.ndarray:
        """Return ``count`` vergences (1/mm) from far to near, the middle for one."""
        far, near = vergence(self.far_mm), vergence(self.near_mm)
        return np.array([(far + near) / 2]) if count == 1 else np.linspace(far, near, count)

    def camera(self, lens: Lens) -> Lens:
        """Return the lens with the scene's focus and f-number."""
        return set_up(lens, self.request).lens

    @property
    def request(self) -> Request:
        """Return the settings of the camera."""
        return Request(**{name: getattr(self, name) for name in CAMERA_PARAMETERS})


CAMERA_PARAMETERS = tuple(part.name for part in fields(Scene) if part.name in {own.name for own in fields(Settings)})
"""What of a camera a scene states."""
