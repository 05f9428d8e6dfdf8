"""A coarse picture shown immediately, while the planned one is computed."""

from collections.abc import Sequence
from dataclasses import replace
from math import inf

import numpy as np

from p2sf.choice import first_within
from p2sf.errors import GeometryError
from p2sf.image.binning import block_means, times_to_fit
from p2sf.image.form import Forming, form_image, plan_lattice
from p2sf.image.lattice import Lattice
from p2sf.image.progress import Progress
from p2sf.lens.lens import Lens
from p2sf.parameters import LARGEST_SIDE
from p2sf.pixel_kernels.channel import RAYS, Light, Recipe
from p2sf.pixel_kernels.pixels import samples_across
from p2sf.pixel_kernels.pupil_stack import PupilStack
from p2sf.pupil.fit import levels_for
from p2sf.scene.field_area import field_area
from p2sf.scene.planning.bounds import check_colours
from p2sf.scene.planning.cost import Cost
from p2sf.scene.planning.plan import Plan
from p2sf.scene.scene import Scene
from p2sf.scene.spectrum import reduce_spectrum
from p2sf.threads import one_blas_thread

LONGEST = 320  # pixels along the preview's longer side
BY_RAYS = Recipe(RAYS)
MOST_RESIDUAL = 0.5  # waves RMS: with a larger residual a fit describes the blur less well than rays do
# Numbers of kernels by samples along the side of a wave sum's transform, and by pixels along that of rays.
WAVE_COUNTS = ((800, (3, 3)), (1200, (2, 2)))
RAY_COUNTS = ((300, (3, 3)), (450, (2, 2)), (LARGEST_SIDE, (1, 1)))
UNKNOWN = Cost(0.0, 0.0, 0.0)


@one_blas_thread
def preview(lens: Lens, scene: Scene, values: np.ndarray, depth_mm: float | None = None) -> np.ndarray:
    """Return a coarse picture of the scene's far end or one depth, (rows, columns, channels), at most 320 pixels long.

    It uses `preview_plan` and averages pixels in blocks. Unlike for a plan, the error is not bounded.
    """
    camera = scene.camera(lens)
    check_colours(camera, scene)
    times, ideal = times_to_fit(scene.sensor, LONGEST), replace(scene.sensor, mosaic=None, full_well=None, read_noise=0)
    coarse = replace(scene, sensor=ideal.bin_pixels(times), depth_map=None)
    if depth_mm is not None:
        coarse = replace(coarse, near_mm=depth_mm, far_mm=depth_mm, gaps_mm=())
    planned = preview_plan(camera, coarse)
    lattice = preview_lattice(planned)
    return form_image(planned, block_means(values, times), how=Forming(spline=1), lattice=lattice)


def preview_plan(camera: Lens, scene: Scene) -> Plan:
    """Return a plan of a focused lens without any measurement, so that its error is unknown.

    One wavelength a channel, 3 × 3 places or fewer where kernels are wide, the smallest fit; rays in place of waves
    where the sum would take seconds, and where that fit does not describe the pencil.
    """
    planned = plan_by_waves(camera, scene)
    counts, part = _affordable(WAVE_COUNTS, wave_side(planned))
    if part <= 1:
        return replace(planned, counts=counts)
    if camera.mask.phased:  # which rays do not show
        return replace(planned, counts=(1, 1))
    by_rays = replace(planned, recipe=BY_RAYS)
    return replace(by_rays, counts=_affordable(RAY_COUNTS, 2 * _edge_half(by_rays)[1] + 1)[0])


def _affordable(limits: Sequence[tuple[int, tuple[int, int]]], side: float) -> tuple[tuple[int, int], float]:
    """Return the most kernels whose sides are that long, else the fewest; and which part of their limit that is."""
    return first_within(((counts, side / most) for most, counts in limits), 1.0)


def plan_by_waves(camera: Lens, scene: Scene) -> Plan:
    """Return `preview_plan` by waves at 3 × 3 places, however long it may take."""
    colours = tuple(reduce_spectrum(channel, 1) for channel in scene.channels)
    middle = colours[len(colours) // 2].wavelengths_um[0]
    recipe, counts = Recipe("fitted", levels_for(camera)[0].numbers), WAVE_COUNTS[0][1]
    depth = (float(scene.vergences(2)[0]),)
    return Plan(camera, scene, middle, recipe, colours, counts, depth, (), float("nan"), UNKNOWN, UNKNOWN)


def wave_side(planned: Plan) -> float:
    """Return the side in samples of a wave sum's transform in the corner, inf where a preview's fit does not hold."""
    try:
        light, half = _edge_half(planned)
    except GeometryError:  # rays are lost, or the pupil is too distorted for polynomials
        return inf
    if isinstance(light, PupilStack) and light.residual_waves > MOST_RESIDUAL:
        return inf
    return (2 * half + 1) * samples_across(light, planned.scene.sensor.pixel_um)


def preview_lattice(planned: Plan, watch: Progress | None = None) -> Lattice:
    """Return the kernels of a preview's plan, none of which extends beyond the picture."""
    sensor = planned.scene.sensor
    return plan_lattice(planned, planned.vergences[0], watch, max(sensor.rows, sensor.columns))


def _edge_half(planned: Plan) -> tuple[Light, int]:
    """Return the light of the farthest point in the middle channel, and the half width of its kernel."""
    kernels = planned.kernels(len(planned.colours) // 2, planned.vergences[0])
    x, y = field_area(kernels.seen.fields, planned.scene.sensor).far
    return kernels.lights(x, y)[0][0], int(kernels.points([x], [y]).half_widths()[0])
