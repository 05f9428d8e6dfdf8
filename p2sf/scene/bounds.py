"""Checks made before a plan is measured, which takes minutes: wavelengths without glass data, blurs too wide."""

from math import ceil, isinf

from p2sf.conventions import UM_PER_MM
from p2sf.errors import GlassError, SamplingError
from p2sf.lens.lens import Lens
from p2sf.messages import Message
from p2sf.pixel_kernels.pixels import LARGEST_WINDOW, samples_across
from p2sf.scene.scene import Scene, depth_of
from p2sf.scene.study import SAMPLINGS, Study


def check_colours(lens: Lens, scene: Scene) -> None:
    """Raise GlassError, naming the wavelength, where a glass has no data for a wavelength of the scene.

    A plan may replace a channel's wavelengths by fewer others, so an error found later could name a wavelength that
    nobody asked for.
    """
    for channel in scene.channels:
        for medium in lens.media:
            try:
                medium.index(channel.wavelengths_um)
            except GlassError as error:
                raise GlassError("channel {channel}: {error}", channel=channel.label, error=error) from error


def check_blur(study: Study) -> None:
    """Raise SamplingError where the finest sampling that a plan may ask for exceeds the largest transform.

    Blurs are widest at one end of the depths, and the shortest wavelength needs the most samples.
    """
    wave = min(study.waves)
    for vergence in study.scene.vergences(2)[::-1]:
        for height in (study.nearest_mm, study.farthest_mm):
            side, size = finest_side(study, height, float(vergence), wave)
            if side > LARGEST_WINDOW:
                depth = depth_of(vergence)
                raise SamplingError(
                    "points {depth} away blur over {size:.2g} mm, which takes {side}² "
                    "samples of {most}² at most; bring the depths nearer to the focus or stop down",
                    depth=Message("∞") if isinf(depth) else Message("{depth:.4g} mm", depth=depth),
                    size=size / UM_PER_MM,
                    side=side,
                    most=LARGEST_WINDOW,
                )


def finest_side(study: Study, height_mm: float, vergence: float, wave: float) -> tuple[int, float]:
    """Return the side in samples of the finest transform at one place, and the blur's width in µm."""
    recipe, pixel = study.recipe(SAMPLINGS[-1]), study.scene.sensor.pixel_um
    kernels = study.kernels(recipe, study.colour_of(wave), vergence)
    half, (pupil, _) = kernels.half_width(height_mm), kernels.pupils(height_mm)[0]
    size = 2 * (half + ceil(recipe.margin * half)) + 1
    return size * samples_across(pupil, pixel, recipe.fineness), (2 * half + 1) * pixel
