"""Refusing at once a scene whose colours no glass knows or whose blur no transform holds; measuring takes minutes."""

from math import ceil, isinf

from p2sf.conventions import UM_PER_MM
from p2sf.errors import GlassError, SamplingError
from p2sf.lens.lens import Lens
from p2sf.pixel_kernels.pixels import LARGEST_WINDOW, samples_across
from p2sf.scene.scene import Scene, depth_of
from p2sf.scene.study import SAMPLINGS, Study


def refuse_colours(lens: Lens, scene: Scene) -> None:
    """Raise GlassError where a glass has no data for a wavelength of the scene, and name that.

    Fewer wavelengths stand for a channel later, and none of these may be one that a person gave.
    """
    for channel in scene.channels:
        for medium in lens.media:
            try:
                medium.index(channel.wavelengths_um)
            except GlassError as error:
                raise GlassError(f"channel {channel.name}: {error}") from error


def refuse_wide(study: Study) -> None:
    """Raise SamplingError unless the finest sampling of the widest blurs can be transformed, as planning will ask.

    Blurs are widest at one end of the depths, and have most samples in the bluest colour.
    """
    wave = min(study.waves)
    for vergence in study.scene.vergences(2)[::-1]:
        for height in (study.nearest_mm, study.farthest_mm):
            side, size = finest_side(study, height, float(vergence), wave)
            if side > LARGEST_WINDOW:
                depth = depth_of(vergence)
                away = "∞" if isinf(depth) else f"{depth:.4g} mm"
                raise SamplingError(
                    f"points {away} away blur over {size / UM_PER_MM:.2g} mm, which takes {side}² "
                    f"samples of {LARGEST_WINDOW}² at most; bring the depths nearer to the focus or stop down"
                )


def finest_side(study: Study, height_mm: float, vergence: float, wave: float) -> tuple[int, float]:
    """Return the side in samples of the finest transform at one place, and the blur's width in µm."""
    recipe, pixel = study.recipe(SAMPLINGS[-1]), study.scene.sensor.pixel_um
    kernels = study.kernels(recipe, study.colour_of(wave), vergence)
    half, (pupil, _) = kernels.half_width(height_mm), kernels.pupils(height_mm)[0]
    size = 2 * (half + ceil(recipe.margin * half)) + 1
    return size * samples_across(pupil, pixel, recipe.fineness), (2 * half + 1) * pixel
