"""Cost of a plan from counts; the constants are medians measured on one core of an ordinary 2020s computer."""

from dataclasses import dataclass
from math import ceil, log2, prod

PUPIL_SECONDS = {"seidel": 1e-3, "fitted": 1.8e-3}  # rays, fit and change of variables, per wavelength and height
TERM_SECONDS = 3e-5  # additionally for each coefficient of the fit beyond 26
ALONE_SECONDS, TOGETHER_SECONDS = 6e-4, 1e-4  # of any kernel: rotation of its pupil, summation; alone, among many
SAMPLE_SECONDS = 5e-9  # per sample of a transform and binary digit of its side
PIXEL_SECONDS = 3.2e-9  # the same for the convolutions, forward and inverse
TRANSFORMS = 2  # pairs, forward and inverse, of a block with four corners
BLOCK = 256  # pixels along a block at most
TILE = 1024  # pixels a side of what is formed at a time: larger ones share more, and take more memory
HELD_PLANES = 20  # of tiles, by two threads
MOST_KERNELS = 2**26  # numbers of kernels that are kept
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
    blocks, area = _blocks(work)
    planes, layers = work.channels + (work.layers > 1), min(work.layers, 2)  # a pixel lies between two nodes of depth
    picture = TRANSFORMS * blocks * planes * layers * area * log2(area) * PIXEL_SECONDS
    tile = prod(min(TILE, n) + 2 * work.half for n in (work.rows, work.columns))
    held = 2 * work.rows * work.columns * (work.channels + (work.layers > 1)) + HELD_PLANES * tile * planes
    kernels = min(work.nodes[0] * work.nodes[1] * planes * work.layers * (2 * work.half + 1) ** 2, MOST_KERNELS)
    return Cost(work.pupil_seconds + work.kernels * kernel, picture, BYTES * (held + kernels) + 8 * 3 * work.side**2)


def _blocks(work: Work) -> tuple[int, float]:
    """Return how many blocks between nodes a picture is cut into, and the area of each with the width of a kernel."""
    counts = [max(n - 1, ceil(pixels / BLOCK)) for n, pixels in zip(work.nodes, (work.rows, work.columns), strict=True)]
    sides = (pixels / count + 2 * work.half for pixels, count in zip((work.rows, work.columns), counts, strict=True))
    return prod(counts), prod(sides)
