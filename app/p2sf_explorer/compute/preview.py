"""The picture while a slider moves: PSF, window and pupil map from one trace of about eighty rays. No Qt in here."""

from dataclasses import dataclass, replace
from functools import lru_cache
from time import perf_counter

import numpy as np

from p2sf.conventions import UM_PER_MM
from p2sf.disc.basis import Terms
from p2sf.disc.disc_function import DiscFunction
from p2sf.disc.domain import ClearNodes
from p2sf.errors import GeometryError
from p2sf.lens.lens import Lens
from p2sf.messages import Message
from p2sf.psf.picture import psf_of_pupil
from p2sf.psf.result import Psf
from p2sf.psf.seidel import seidel_psf
from p2sf.pupil.clear_curves import CLIPPED
from p2sf.pupil.fit import FittedPencil, Level, fit, fit_rays, level_rays, levels, levels_for
from p2sf.pupil.plane_waves import Counts, disc_words, window_reach_um
from p2sf.pupil.seen_mask import mask_seen, with_slopes
from p2sf.pupil.wavefront_map import ORDERS, RAYS, WavefrontMap, map_of
from p2sf.raytrace.pencil import Rays, exit_radius, opd_on_sphere, pencil
from p2sf_explorer.compute.setup import ParaxialSetup

CLOSE, NEAR, FAR = 0.005, 0.02, 0.1  # RMS error in waves up to which 26 numbers do, 64 rays do, a fit does at all
TRIED = 2  # levels of fits to the first rays
MAP = "preview"  # the quality of the pupil map
EDGE = 16  # rays along the rim and along 0.7 of it, which show how far light reaches on the sensor


@dataclass(frozen=True)
class Preview:
    """Rays that all reached the sensor, at the level's points then at the edge; ``begun`` is a `perf_counter` time."""

    rays: Rays
    setup: ParaxialSetup
    begun: float


def preview(setup: ParaxialSetup, clip: bool = False) -> Preview | None:
    """Return the traced rays; None where one is lost, since a fit cannot describe an edge. Raises as `pencil` does."""
    begun = perf_counter()
    rays = pencil(setup.lens, setup.source, *points(first_level(setup.lens)), clip=clip)
    return Preview(rays, setup, begun) if rays.passed.all() else None


def first_level(lens: Lens) -> Level:
    """Return the size of the first fit to a lens, of which its rays are: 26 numbers where there is symmetry."""
    return levels("paraxial", lens.pupil_domain)[0]


@lru_cache(maxsize=2)
def points(level: Level) -> tuple[np.ndarray, np.ndarray]:
    """Return ξ and η of the level's rays, then of those at the edge."""
    xi, eta, _ = level_rays(level)
    edge = edge_points()
    return np.append(xi, edge[0]), np.append(eta, edge[1])


@lru_cache(maxsize=1)
def edge_points() -> np.ndarray:
    """Return ξ and η of rays all around the rim, and on 0.7 of it, (2, rays)."""
    turn = np.linspace(0, 2 * np.pi, EDGE, endpoint=False)
    edge = np.stack([np.sin(turn), np.cos(turn)])
    return np.concatenate([edge, 0.7 * edge], axis=1)


def landing_um(rays: Rays) -> float:
    """Return how far from the chief ray the farthest of the last, the edge's, rays lands, in x or y, µm."""
    reach = np.abs(np.stack([rays.dx, rays.dy])[:, -2 * EDGE :])
    return UM_PER_MM * float(np.nanmax(reach)) if np.isfinite(reach).any() else 0.0


def preview_psf(traced: Preview, pixels: int, pixel_um: float, fitted: FittedPencil | None = None) -> Psf:
    """Return the PSF of the fit, float32, ``fitted`` where given; of exact rays where it misses more than `FAR`."""
    fitted, setup = fitted or best_fit(traced), traced.setup
    if fitted.error_waves > FAR:
        from p2sf.psf.methods import PsfOptions, render

        return render(setup.lens, setup.source, "traced", pixels, pixel_um, PsfOptions("preview"))
    psf = psf_of_pupil(fitted, (pixels, pixel_um), "preview")
    return replace(psf, seconds=perf_counter() - traced.begun)


def preview_of_coefficients(setup: ParaxialSetup, window: tuple[int, float], quality: str = "preview") -> Psf:
    """Return the PSF of the six coefficients behind the mask in the lens's stop."""
    return seidel_psf(setup.coefficients, *window, quality, mask=mask_seen(setup.lens, setup.source))


def best_fit(traced: Preview, first: FittedPencil | None = None) -> FittedPencil:
    """Return the smallest fit of small error: ``first``, or where `first_fit` does not suffice one to more rays."""
    fitted = first or first_fit(traced)
    if fitted.error_waves <= NEAR:
        return fitted
    try:
        larger = fit(traced.setup.lens, traced.setup.source, residual_waves=NEAR, first=TRIED)
        return replace(larger, rays=larger.rays + fitted.rays)
    except GeometryError:  # one of the rays more is lost
        return fitted


def first_fit(traced: Preview) -> FittedPencil:
    """Return the fit to the rays that are traced: of 26 numbers, or where these miss much of 46."""
    first, second = levels_for(traced.setup.lens)[:TRIED]
    count = level_rays(first)[0].size
    own = traced.rays.part(slice(count))
    fitted = fit_rays(own, first, count)
    if fitted.error_waves > CLOSE:
        fitted = fit_rays(own, second, count, fitted.steepness)
    lens, source = traced.setup.lens, traced.setup.source
    mask, wavelength = mask_seen(lens, source), float(source.wavelength_um)
    if mask.clear:
        return fitted
    steep = with_slopes(fitted.steepness, mask, wavelength)
    return replace(fitted, mask=mask, wavelength_um=wavelength, steepness=steep)


def clipped_psf(traced: Preview, pixels: int, pixel_um: float) -> Psf:
    """Return the PSF of the fit to all rays, summed over the nodes whose own rays pass the rims.

    A yes or no at each node makes a ragged edge, good enough while it moves. Raises GeometryError where none passes.
    """
    fitted, setup = best_fit(traced), traced.setup

    def passing(counts: Counts) -> ClearNodes:
        nodes = fitted.nodes(counts)
        passed = pencil(setup.lens, setup.source, nodes.xi, nodes.eta, clip=True).passed
        if not passed.any():
            raise GeometryError(CLIPPED)
        return replace(nodes, weight=np.where(passed, nodes.weight, 0.0))

    psf = psf_of_pupil(replace(fitted, nodes_of=passing), (pixels, pixel_um), "preview")
    counts = fitted.counts(window_reach_um(pixels, pixel_um), "preview")
    return replace(
        psf.with_figures(energy=None, predicted_error=None),
        rays=fitted.rays + fitted.nodes(counts).xi.size,
        sampling=Message("{nodes}, those that the rims let pass", nodes=disc_words(counts)),
        seconds=perf_counter() - traced.begun,
    )


def preview_pupil(traced: Preview) -> WavefrontMap:
    """Return the displayed wavefront over the pupil: the terms that fit that of the level's rays."""
    setup = traced.setup
    waves = opd_on_sphere(traced.rays, exit_radius(setup.lens, setup.source, traced.rays, setup.stop))
    level = first_level(setup.lens)
    function = DiscFunction((_through(level) @ waves)[None], RAYS[MAP], (False,), level.basis.domain)
    return map_of(setup.lens, setup.source, function, MAP)


@lru_cache(maxsize=2)
def _through(level: Level) -> np.ndarray:
    """Return the matrix from the rays' waves to those at nodes over the disc, by least squares, (nodes, rays)."""
    domain = level.basis.domain
    terms, nodes = Terms(ORDERS[MAP], domain.parities(False)), domain.nodes(RAYS[MAP])
    return terms.values(nodes.xi, nodes.eta).T @ np.linalg.pinv(terms.values(*points(level)).T)
