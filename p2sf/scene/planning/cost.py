"""Cost of a plan from counts; the constants are medians measured on one core of an ordinary 2020s computer."""

from dataclasses import dataclass
from math import ceil, log2

PUPIL_SECONDS = {"seidel": 1e-3, "fitted": 1.8e-3}  # rays, fit and change of variables, per wavelength and height
TERM_SECONDS = 3e-5  # additionally for each coefficient of the fit beyond 26
ALONE_SECONDS, TOGETHER_SECONDS = 6e-4, 1e-4  # of any kernel: rotation of its pupil, summation; alone, among many
SAMPLE_SECONDS = 5e-9  # per sample of a transform and binary digit of its side
PIXEL_SECONDS = 3.2e-9  # the same for the convolutions, forward and inverse
BYTES = 4


@dataclass(frozen=True)
class Work:
    """Amount of work: ``kernels`` of single wavelengths, each by a ``side``² transform; patches and pixels.

    ``each_seconds``: of any kernel in addition to its transform. ``pupil_seconds``: of all fits of pupils together.
    ``half``: pixels on either side of the centre of a kernel.
    """

    kernels: float
    side: float
    each_seconds: float
    pupil_seconds: float
    half: int
    rows: int
    columns: int
    channels: int
    nodes: tuple[int, int]
    layers: int


@dataclass(frozen=True)
class Cost:
    """Predicted seconds on one core, for the kernels and for one picture, and bytes at the peak."""

    kernel_seconds: float
    picture_seconds: float
    memory_bytes: float

    @property
    def seconds(self) -> float:
        """Return seconds for kernels and one picture together."""
        return self.kernel_seconds + self.picture_seconds


def pupil_seconds(method: str, numbers: int) -> float:
    """Return the seconds for one pupil by its own rays."""
    return PUPIL_SECONDS[method] + TERM_SECONDS * max(0, numbers - 26)


def predicted_cost(work: Work) -> Cost:
    """Return the cost of an amount of work."""
    kernel = work.each_seconds + SAMPLE_SECONDS * work.side**2 * log2(max(work.side, 2))
    patch = [_support(n, count) + 2 * work.half for n, count in zip((work.rows, work.columns), work.nodes, strict=True)]
    area = patch[0] * patch[1]
    patches = work.nodes[0] * work.nodes[1] * work.channels * work.layers
    picture = patches * area * log2(max(area, 2)) * PIXEL_SECONDS
    held = work.rows * work.columns * work.channels * (3 + 2 * (work.layers > 1)) + 8 * area * work.channels
    kernels = work.nodes[0] * work.nodes[1] * work.channels * work.layers * (2 * work.half + 1) ** 2
    return Cost(work.pupil_seconds + work.kernels * kernel, picture, BYTES * (held + kernels) + 8 * 3 * work.side**2)


def _support(pixels: int, count: int) -> int:
    """Return the widest window's width in pixels."""
    return pixels if count <= 2 else min(pixels, 2 * ceil(pixels / (count - 1)))
