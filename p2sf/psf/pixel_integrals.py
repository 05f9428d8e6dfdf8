"""PSFs as the light on square pixels where samples farther apart than λ/(4 NA) would miss what lies between them.

See handbook 6.6.
"""

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from math import inf

import numpy as np

from p2sf.errors import GeometryError, SamplingError
from p2sf.figures.pixel_light import LARGEST, FineGrid, critical_pixel_um, fine_grid
from p2sf.figures.psf_data import Figure, Later, PsfFigures
from p2sf.io.record import describe
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.messages import Message
from p2sf.parameters import check_samples
from p2sf.psf.methods import AUTO, REFERENCE, SPHERICAL, USUAL, PsfOptions, method_of, render, whole_pixel_um
from p2sf.psf.picture import FRINGES_OF_SPHERES
from p2sf.psf.result import Psf
from p2sf.pupil.fit import level_rays, levels_for
from p2sf.pupil.vignetting import pupil_nodes
from p2sf.raytrace.exit_sphere import exit_sphere
from p2sf.raytrace.field_geometry import cone
from p2sf.raytrace.pencil import pencil, rays_through
from p2sf.setting import Setup

RAYS = 24, 96  # radii × directions for the share of light in a window


def critical_pixel_of_spheres(lens: Lens, source: Source) -> float:
    """Return the largest pitch for spherical waves, fine near the pupil however slow the lens; inf of none."""
    sphere = exit_sphere(lens, source)
    if sphere is None:
        return inf
    xi, eta, _ = level_rays(levels_for(lens)[0])
    rays = sphere.seen_from(pencil(lens, source, xi, eta).arrived)[0]
    spread = float(np.hypot(rays.fx, rays.fy).max(initial=0.0))
    return 1 / (4 * FRINGES_OF_SPHERES * spread) if spread else inf  # where no ray arrives, the sum says so


def integrate(
    render_at: Callable[[int, float], Psf],
    pixels: int,
    pixel_um: float,
    finest_um: float,
    wanted: bool | None = None,
    estimate: Callable[[Psf], Figure] | None = None,
) -> Psf:
    """Return the PSF of ``render_at(samples, µm)`` as light per pixel or as its samples.

    ``wanted``: light per pixel (True), samples (False) or, if None, light where the pitch exceeds ``finest_um`` and
    that takes at most LARGEST samples a side. Raises SamplingError if light is requested and takes more. If samples are
    too far apart to give a share of the light, it is taken from the light per pixel, when it is read; ``estimate`` is
    what a warning takes in its place.
    """
    check_samples(pixels, pixel_um)
    grid = fine_grid(pixels, pixel_um, finest_um, narrow_too=bool(wanted))
    if wanted and grid is None:
        raise SamplingError(
            "the light on {pixels} pixels of {pixel_um:g} µm takes more than {most} samples a side; give fewer or "
            "smaller pixels, or {parameter} False",
            pixels=pixels,
            pixel_um=pixel_um,
            most=LARGEST,
            parameter="integrated",
        )
    if grid is None:
        return render_at(pixels, pixel_um)
    if wanted is False:
        points = render_at(pixels, pixel_um)
        if points.figures.energy is not None:
            return points
        guess = None if estimate is None else partial(estimate, points)
        share = Later(lambda: _light_on_pixels(render_at, grid).energy, guess)
        return points.with_figures(energy=share)
    return _light_on_pixels(render_at, grid)


def _light_on_pixels(render_at: Callable[[int, float], Psf], grid: FineGrid) -> Psf:
    """Return the PSF as light per pixel, from the samples of a grid."""
    fine = render_at(grid.side, grid.pitch_um)
    light = grid.light(fine.values)
    share = light.sum((-2, -1))  # of the light in the finer window, which may be a little larger

    return replace(
        fine.with_figures(energy=partial(_part_of_light, fine.figures, share if share.ndim else float(share))),
        values=light / share[..., None, None],
        pixel_um=grid.pixel_um,
        sampling=Message(
            "{sampling}; {across:.3g} × {across:.3g} samples per pixel", sampling=fine.sampling, across=grid.per_pixel
        ),
        error=None,
        integrated=True,
        sum_over_peak=None if fine.sum_over_peak is None else fine.sum_over_peak * share / grid.per_pixel**2,
    )


def _part_of_light(figures: PsfFigures, share: float | np.ndarray) -> Figure:
    energy: Figure = figures.value("energy")
    return None if energy is None else energy * share


def render_integrated(
    lens: Lens,
    source: Source,
    method: str = "auto",
    pixels: int = 64,
    pixel_um: float | None = None,
    options: PsfOptions = USUAL,
    wanted: bool | None = None,
) -> Psf:
    """Return the PSF of `methods.render` as light per pixel or as samples, by `integrate`; raises as both do.

    In a window too wide for a sum of waves the share of light is that of rays.
    """
    check_samples(pixels, pixel_um)
    derived = None if method == AUTO else method_of(method).of_reference
    if derived:  # fitted to what pixels see
        return derived(render_integrated(lens, source, REFERENCE, pixels, pixel_um, options, wanted))
    own = cone(lens, source)
    finest = float(critical_pixel_um(source.wavelength_um, max(own.na_x, own.na_y)))
    if method == SPHERICAL.name:
        finest = min(finest, critical_pixel_of_spheres(lens, source))
    settled = options.quality == "settled"

    def estimate(points: Psf) -> float | None:
        if not settled:
            return None
        width = points.values.shape[-1] * points.pixel_um
        rays = _share_of_rays(lens, source, points, options.clip)
        return None if rays is None else min(rays, airy_share(width, own.na, source.wavelength_um))

    psf = integrate(
        lambda count, pitch: render(lens, source, method, count, pitch, options),
        pixels,
        pixel_um or whole_pixel_um(lens, source, pixels, method),
        finest,
        wanted,
        estimate,
    )
    known, rays = psf.figures.energy, partial(_share_of_rays, lens, source, psf, options.clip)
    costly = (isinstance(known, Later) and known.costly) or (known is None and not settled)
    share = Later(lambda: rays() if psf.energy is None else psf.energy, partial(estimate, psf) if costly else None)
    return psf.with_figures(energy=share)


def render_setup(
    setup: Setup,
    method: str = AUTO,
    pixels: int = 64,
    pixel_um: float | None = None,
    options: PsfOptions = USUAL,
    wanted: bool | None = None,
) -> Psf:
    """Return `render_integrated` of a lens as it is set, with what it is of."""
    psf = render_integrated(setup.lens, setup.source, method, pixels, pixel_um, options, wanted)
    return replace(psf.with_figures(provenance=partial(describe, setup)), azimuth_deg=setup.source.azimuth_deg)


def airy_share(width_um: float, na: float, wavelength_um: float) -> float:
    """Return about what share of a perfect lens's light a square of this width holds, 0 below a wavelength or so.

    1 − J₀² − J₁² of the circle of its area (Rayleigh 1881) is 1 − 2/πv for large v (DLMF 10.17.3): within 0.03 from
    v = 2.5, where it is 0.75.
    """
    v = 2 * np.pi * na / wavelength_um * width_um / np.sqrt(np.pi)
    return float(max(0.0, 1 - 2 / (np.pi * v)))


def _share_of_rays(lens: Lens, source: Source, psf: Psf, clip: bool) -> float | None:
    """Return `light_of_rays`; None where no ray arrives, though six coefficients show a picture."""
    try:
        return light_of_rays(lens, source, psf, clip)
    except GeometryError:
        return None


def light_of_rays(lens: Lens, source: Source, psf: Psf, clip: bool) -> float:
    """Return the share of the rays' light that lands in the window of a PSF: the geometric limit of ``energy``."""
    nodes = pupil_nodes(lens, source, RAYS, clip, whole=False).unfolded()
    rays = rays_through(lens, source, nodes)
    light, across, up = rays.share * rays.light, rays.x_um / psf.pixel_um, rays.y_um / psf.pixel_um
    first, end = -(psf.values.shape[-1] // 2) - 0.5, (psf.values.shape[-1] + 1) // 2 - 0.5
    within = (first <= across) & (across <= end) & (first <= up) & (up <= end)
    return float(light[within].sum() / light.sum())
