"""A photo with depth through a lens that moves: all of its pixels, coarsely, with the error expected. No Qt."""

from dataclasses import replace
from time import perf_counter

import numpy as np

from p2sf.conventions import UM_PER_MM
from p2sf.errors import GeometryError
from p2sf.image.components import KernelNodes
from p2sf.image.focus_pull import MOVING, KeptPicture, focused_picture, keep
from p2sf.image.kernel_octaves import Setting, setting
from p2sf.image.lattice import Lattice
from p2sf.image.preview import MOST_RESIDUAL, WAVE_COUNTS, plan_by_waves
from p2sf.image.progress import Progress
from p2sf.image.slabs import LEVELS
from p2sf.messages import Message
from p2sf.pixel_kernels.pixels import half_widths, samples_each
from p2sf.pixel_kernels.sensor_points import SensorMap
from p2sf.scene.sensor import Sensor
from p2sf_explorer.compute.views.depths import ONE_DISTANCE, depth_map
from p2sf_explorer.compute.views.image import (
    MOST_SAMPLES,
    TOO_LARGE,
    TOO_WIDE,
    UNMEASURED,
    ImageRequest,
    ImageResult,
    PsfsByDepth,
    coarse,
    frame_notes,
    moved_in,
    scene_of,
)
from p2sf_explorer.compute.views.photos import change_time, scene_values

MOST_MOVED_PX = 1.0  # of a kept picture, before it is cut again


class Keeper:
    """The picture that is kept from one setting of a lens to the next, one at a time; for one thread.

    Nothing of a lens is kept, but for its distortion, which is compared with that of the next.
    """

    def __init__(self) -> None:
        self._key: tuple[object, ...] = ()
        self._kept: KeptPicture | None = None
        self._seen: tuple[SensorMap, Sensor] | None = None

    def kept(self, request: ImageRequest, values: np.ndarray, made: Setting) -> tuple[KeptPicture, float]:
        """Return what is kept of a picture, and how far the lens moves its pixels, where it is not cut again."""
        scene = made.study.scene
        stamps = change_time(request.photo), change_time(request.depths.source)
        key = (request.photo, request.depths, *stamps, request.shape, scene.near_mm, scene.far_mm)
        now = made.seen, scene.sensor
        if self._kept is not None and self._seen is not None and key == self._key:
            moved = moved_px(*self._seen, *now)
            if moved <= MOST_MOVED_PX:
                return self._kept, moved
        self._kept = None  # before the next is made: one is kept
        self._kept = keep(values, depth_map(request.depths, request.photo, request.shape), made)
        self._key, self._seen = key, now
        return self._kept, 0.0


def moved_px(before: SensorMap, its: Sensor, now: SensorMap, sensor: Sensor) -> float:
    """Return how far apart two settings of a lens put any part of a picture, pixels at most."""
    places = [
        seen.ideal_mm(
            *np.meshgrid(own.x_mm(np.linspace(0, own.columns - 1, 9)), own.y_mm(np.linspace(0, own.rows - 1, 9)))
        )
        for seen, own in ((before, its), (now, sensor))
    ]
    (x, y), (across, up) = (
        [(axis - centre) / own.pixel_mm for axis, centre in zip(at, own.centre_mm, strict=True)]
        for at, own in zip(places, (its, sensor), strict=True)
    )
    return float(np.hypot(across - x, up - y).max())


def moving(request: ImageRequest, watch: Progress | None = None, keeper: Keeper | None = None) -> ImageResult:
    """Return the picture with all of its pixels and depths, as a lens that moves shows it, with the error expected.

    What need not be computed again is in the ``keeper``. Where pupils have no polynomials, the coarse picture by rays.
    """
    begun = perf_counter()
    values, scene = scene_values(request.photo, request.shape), scene_of(request)
    camera = scene.camera(request.lens)
    try:
        made = setting(camera, scene, MOVING)
        kept, moved = (keeper or Keeper()).kept(request, values, made)
        found = focused_picture(kept, made, moved)
    except GeometryError:
        return replace(coarse(replace(request, depths=ONE_DISTANCE), watch), question=request)
    lattices, vergences = psfs_by_depth(found.kernels, made)
    depths = depth_map(request.depths, request.photo, request.shape)
    count = Message("{count} PSFs", count=int(np.prod(found.kernels.kernels.shape[:4])))
    cut = frame_notes(request.photo, request.shape)
    plan, why_not = plan_by_waves(camera, scene), no_plan_of(made)
    frame = ((Message("Frame"), cut[1]),) if cut else ()
    off = Message("RMS at most {error:.2g} of white, as expected from the response of its PSFs", error=found.error)
    return ImageResult(
        question=request,
        before=values,
        after=found.values,
        quality="coarse",
        plan=plan,
        lattice=lattices[0],
        seconds=perf_counter() - begun,
        headline=count,
        notes=(*frame, *moved_in(request, plan), (Message("Coarse"), UNMEASURED[why_not]), (Message("Error"), off)),
        cut=cut[0] if cut else None,
        no_plan=why_not,
        error=found.error,
        psfs=None if depths is None else PsfsByDepth(lattices, vergences, depths),
    )


def no_plan_of(made: Setting) -> Message | None:
    """Return why a plan is not worth its time, as `image.no_plan`, from pupils that are there."""
    study, pixel = made.study, made.study.scene.sensor.pixel_um
    wave = made.colours[len(made.colours) // 2].wavelengths_um[0]
    (near, _), (far, shifts) = (made.table.at(*at, study.ends[0], wave) for at in (study.area.near, study.area.far))
    if 2 * float(near.radius[0]) * pixel > MOST_SAMPLES:
        return TOO_LARGE
    half = half_widths(far, pixel, UM_PER_MM * np.hypot(*shifts.T))
    side = float(((2 * half + 1) * samples_each(far, pixel))[0])
    too_wide = side > WAVE_COUNTS[-1][0] or study.residual(study.levels[0]) > MOST_RESIDUAL
    return TOO_WIDE if too_wide and not study.lens.mask.phased else None


def psfs_by_depth(nodes: KernelNodes, made: Setting) -> tuple[tuple[Lattice, ...], np.ndarray]:
    """Return the PSFs of a moving picture, at its own pixels, and their vergences, 1/mm."""
    times = made.times
    rows, columns = ((n + 0.5) * times - 0.5 for n in (nodes.row_nodes, nodes.column_nodes))
    far, near = made.study.scene.vergences(2)
    depths = far + nodes.depths / (LEVELS - 1) * (near - far)
    by_depth = np.moveaxis(nodes.kernels, 0, 3)
    lattices = tuple(Lattice(rows, columns, [list(line) for line in at]) for at in by_depth)
    return lattices, depths
