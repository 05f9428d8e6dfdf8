"""The `huygens` method, the reference: each traced ray is a plane wave at the sensor, and all are summed directly.

The nodes are Gauss–Legendre radii times uniform directions, so that no pixelated edge slows the convergence; their
count rises until two successive PSFs agree. Clear apertures (`vignetting`) end each radius at the rim it meets.

See handbook 5.5.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import lru_cache
from time import perf_counter
from typing import Literal

import numpy as np

from p2sf.conventions import centred_axis
from p2sf.errors import Cancelled, GeometryError, SamplingError
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.messages import Message
from p2sf.psf.plane_waves import Origin, counts_for, disc_words, psf_from_intensity, pupil_amplitude, resolved
from p2sf.psf.prediction import EDGE_ERROR
from p2sf.psf.result import Psf
from p2sf.pupil.mask_nodes import ClearNodes
from p2sf.pupil.quadrature import SETTLED_TOLERANCE, disc_nodes
from p2sf.pupil.transform import sum_plane_waves
from p2sf.raytrace.fit import FittedPencil, fit
from p2sf.raytrace.pencil import Pencil, pencil
from p2sf.raytrace.ray_field import RayData, ray_data, steepness
from p2sf.raytrace.seen_mask import with_slopes
from p2sf.raytrace.vignetting import pencil_blur, pupil_nodes, radiometric
from p2sf.threads import for_each, one_blas_thread

BLOCK = 8192  # rays traced at a time: few enough for a second-level cache and to check for cancellation every few ms
TOGETHER = BLOCK // 2  # plane waves that one thread sums at a time
GROWTH = 1.3
MOST_NODES = 2**22
PROBE = 12, 36
LIVE = 72, 180  # as many rays as a 128² grid has in the half disc

Amplitude = Literal["area", "radiometric"]
Window = tuple[int, float]
"""Pixels on a side, µm per pixel."""
Counts = tuple[int, int]
"""Radial and angular node counts of the whole disc."""
PlaneWaves = tuple[np.ndarray, np.ndarray, np.ndarray]
"""Complex amplitudes, and frequencies in x and y, cycles per µm."""


@dataclass(frozen=True)
class Field:
    """A summed field (y, x) in units of the unaberrated peak, ∫|field|²dx in µm² (None if unresolved), rays lost."""

    values: np.ndarray
    blur_um2: float | None
    lost: int


@one_blas_thread
def huygens_psf(
    lens: Lens,
    source: Source,
    pixels: int,
    pixel_um: float,
    tolerance: float | None = SETTLED_TOLERANCE,
    progress: Callable[[float], None] | None = None,
    cancelled: Callable[[], bool] | None = None,
    clip: bool = False,
    amplitude: Amplitude = "area",
) -> Psf:
    """Return the reference PSF, its node count raised until two successive ones agree to ``tolerance``.

    The agreement reached (relative L2 in the window) is reported as the PSF's ``tolerance``, also where more nodes than
    are allowed would be needed; ``sampling`` says so. ``tolerance=None`` sums once, in float32, as many rays as a
    128² grid has or as the blur needs, for a preview of no guaranteed accuracy. ``progress`` is called with the
    fraction done; ``cancelled`` is called between blocks, and True ends the work with `Cancelled`. ``amplitude``
    "area" gives each ray the field of its cell's area in the entrance pupil, as other programs do; "radiometric" the
    root of that times the cell's area over direction cosines, which conserves the energy of each cell. Threads
    (`p2sf.threads`) share the rays, and the sum does not depend on their number. Raises
    GeometryError where the chief ray, or every ray, fails. Where other rays fail, the pupil ends there, and the
    radiometric amplitude is refused.
    """
    started = perf_counter()
    window = pixels, pixel_um
    pupil = fit(lens, source) if amplitude == "radiometric" else None
    if tolerance is None:
        found, counts = _once(lens, source, window, clip, _Watch(None, cancelled, live=True), pupil)
        sampling = _sampling(lens, counts, found, clip, Message("one pass in float32"))
        error = EDGE_ERROR if clip or not all_reach(lens, source) else SETTLED_TOLERANCE**2
        made = Origin("huygens", 0, _nodes(counts), sampling, started, None, error)
    else:
        watch = _Watch(progress, cancelled)
        found, counts, reached, rays = _settle(lens, source, window, clip, tolerance, watch, pupil)
        short = Message("not converged: agrees to {reached:.1e} only", reached=reached)
        sampling = _sampling(lens, counts, found, clip, None if reached <= tolerance else short)
        made = Origin("huygens", 0, rays, sampling, started, reached, reached**2)
    intensity = found.values.real**2 + found.values.imag**2
    return psf_from_intensity(intensity, pixel_um, source.wavelength_um, found.blur_um2, made)


def _once(
    lens: Lens, source: Source, window: Window, clip: bool, watch: "_Watch", pupil: FittedPencil | None
) -> tuple[Field, Counts]:
    """Return the field of one pass in float32: as many rays as a 128² grid, more where the blur needs more."""
    needed = first_counts(lens, source, window, clip)
    counts = LIVE if needed[0] <= LIVE[0] and needed[1] <= LIVE[1] else needed
    return huygens_field(lens, source, counts, window, clip, watch, pupil), counts


def _settle(
    lens: Lens,
    source: Source,
    window: Window,
    clip: bool,
    tolerance: float,
    watch: "_Watch",
    pupil: FittedPencil | None,
) -> tuple[Field, Counts, float, int]:
    """Return (field, counts, agreement, rays traced) once two successive node counts agree."""
    counts = first_counts(lens, source, window, clip)
    watch.expect(_nodes(counts) + _nodes(_raised(counts)))
    before, rays = huygens_field(lens, source, counts, window, clip, watch, pupil), _nodes(counts)
    while True:
        counts = _raised(counts)
        found = huygens_field(lens, source, counts, window, clip, watch, pupil)
        rays += _nodes(counts)
        reached = _distance(before.values, found.values)
        if reached <= tolerance or _nodes(_raised(counts)) > MOST_NODES:
            watch.finish()
            return found, counts, reached, rays
        before = found
        watch.expect(_nodes(_raised(counts)))


def _raised(counts: Counts) -> Counts:
    radial, angular = (2 * round(GROWTH * count / 2) for count in counts)
    return radial, angular


def _nodes(counts: Counts) -> int:
    return counts[0] * counts[1] // 2


def _distance(before: np.ndarray, after: np.ndarray) -> float:
    """Return the relative L2 distance of the intensities of two fields."""
    one, two = np.abs(before) ** 2, np.abs(after) ** 2
    return float(np.linalg.norm(one - two) / np.linalg.norm(two))


def first_counts(lens: Lens, source: Source, window: Window, clip: bool) -> Counts:
    """Return node counts that should carry the phase of a coarse pencil.

    Raises GeometryError where no ray passes, SamplingError where more than MOST_NODES nodes would be needed.
    """
    xi, eta = _probe(lens.misaligned)
    rays = _probing(lens, source)
    if not rays.passed.any():
        raise GeometryError("no ray but the chief ray reaches the sensor; stop the lens down or reduce the field")
    steep = with_slopes(steepness(ray_data(rays), xi, eta), lens.mask, source.wavelength_um)
    counts = counts_for(steep, *window)
    if _nodes(counts) > MOST_NODES:
        raise SamplingError(
            "this blur over {pixels} pixels of {pixel_um:g} µm needs {rays} rays; bring the sensor nearer to the "
            "image, stop down, or show a smaller window",
            pixels=window[0],
            pixel_um=window[1],
            rays=_nodes(counts),
        )
    radial, angular = (2 * -(-count // 2) for count in counts)
    return radial, angular


@lru_cache(maxsize=2)
def _probe(both: bool) -> tuple[np.ndarray, np.ndarray]:
    """Return pupil points (ξ, η) of the coarse pencil; they include the rim, where phases are steepest.

    ``both`` halves of the disc, or the half ξ > 0.
    """
    nodes, angle = disc_nodes(*PROBE), np.linspace(0, np.pi, PROBE[1])
    xi, eta = np.append(nodes.xi, np.sin(angle)), np.append(nodes.eta, np.cos(angle))
    return (np.append(xi, -xi), np.tile(eta, 2)) if both else (xi, eta)


def huygens_field(
    lens: Lens,
    source: Source,
    counts: Counts,
    window: Window,
    clip: bool,
    watch: "_Watch",
    pupil: FittedPencil | None = None,
) -> Field:
    """Return the field of one set of nodes; over a grid of samples the sum is a matrix product.

    ``pupil``: the fit that gives areas over direction cosines, for the radiometric amplitude.
    """
    nodes = _nodes_of(lens, source, counts, clip)
    blur = None if watch.live else pencil_blur(lens, source, nodes, pupil)
    axis, dtype = centred_axis(*window), np.float32 if watch.live else np.float64
    total: np.ndarray | float = 0.0
    lost, spread, area, light = 0, 0.0, 0.0, 0.0

    def waves() -> Iterator[PlaneWaves]:
        nonlocal lost, spread, area, light
        for first in range(0, nodes.xi.size, BLOCK):
            some = nodes.part(slice(first, first + BLOCK))
            data, share = _block(lens, source, some)
            weight = share * some.amplitude * data.weight
            if pupil is not None:
                weight = share * some.amplitude * radiometric(data.weight, pupil.jacobian(some.xi, some.eta))
            area, light = area + share.sum(), light + weight.sum()
            lost += int((share == 0).sum())
            spread = max(spread, float(np.hypot(data.fx, data.fy).max(initial=0)))
            phase = data.phase + some.path_um / source.wavelength_um
            columns = pupil_amplitude(weight, phase, dtype), data.fx.astype(dtype), data.fy.astype(dtype)
            for start in range(0, weight.size, TOGETHER):
                amplitude, fx, fy = (column[start : start + TOGETHER] for column in columns)
                yield amplitude, fx, fy

    def take(summed: tuple[np.ndarray, int]) -> None:
        nonlocal total
        total = total + summed[0]
        watch.advance(summed[1])

    # Rays are traced here, in turn; the products, nearly all of the work, by threads.
    for_each(lambda some: (sum_plane_waves(*some, axis, axis, nodes.even), some[0].size), waves(), take)
    # Light over area is the mean weight, exactly 1 for an evenly filled pupil.
    return Field(np.asarray(total) / (light / area), blur if resolved(spread, window[1]) else None, lost)


def _nodes_of(lens: Lens, source: Source, counts: Counts, clip: bool) -> ClearNodes:
    """Return nodes up to where rays end: at the pupil's rim, at clear apertures, or where they miss a surface."""
    return pupil_nodes(lens, source, counts, clip, whole=clip or all_reach(lens, source))


@lru_cache(maxsize=16)
def all_reach(lens: Lens, source: Source) -> bool:
    """Return whether rays all over the pupil, its rim included, reach the sensor, whatever the clear apertures."""
    return bool(_probing(lens, source).passed.all())


@lru_cache(maxsize=4)
def _probing(lens: Lens, source: Source) -> Pencil:
    """Return the coarse pencil, which says both how steep the phase is and whether all rays reach the sensor."""
    return pencil(lens, source, *_probe(lens.misaligned))


def _block(lens: Lens, source: Source, nodes: ClearNodes) -> tuple[RayData, np.ndarray]:
    rays = pencil(lens, source, nodes.xi, nodes.eta)
    data, weight = ray_data(rays), nodes.weight
    if rays.passed.all():
        return data, weight
    columns = (np.where(rays.passed, column, 0.0) for column in vars(data).values())
    return RayData(*columns), np.where(rays.passed, weight, 0.0)


def _sampling(lens: Lens, counts: Counts, found: Field, clip: bool, convergence: Message | None) -> Message:
    """Return in words what was summed, and how it converged."""
    parts = [disc_words(counts)]
    if clip:
        parts.append(Message("clipped by the clear semi-diameters"))
    if lens.aim == "stop":
        parts.append(Message("aimed at the real stop"))
    if found.lost:
        parts.append(Message("{lost} rays lost", lost=found.lost))
    if convergence is not None:
        parts.append(convergence)
    return Message("{parts}", parts=tuple(parts))


class _Watch:
    """Reports progress, and ends the work where the caller cancels it."""

    def __init__(
        self,
        progress: Callable[[float], None] | None = None,
        cancelled: Callable[[], bool] | None = None,
        live: bool = False,
    ) -> None:
        self.progress, self.cancelled, self.live = progress, cancelled, live
        self.finished, self.expected = 0, 0

    def expect(self, nodes: int) -> None:
        """Add work to come."""
        self.expected += nodes

    def advance(self, nodes: int) -> None:
        """Add work done; raise Cancelled where the caller has cancelled it."""
        self.finished += nodes
        if self.cancelled and self.cancelled():
            raise Cancelled("the reference was cancelled before it was done")
        if self.progress and self.expected:
            self.progress(min(self.finished / self.expected, 0.99))

    def finish(self) -> None:
        """Report that all is done."""
        if self.progress:
            self.progress(1.0)
