"""Checks made before a plan is measured: wavelengths without glass data, blurs too wide."""

from math import isinf

import numpy as np

from p2sf.conventions import UM_PER_MM, depth_of
from p2sf.errors import GlassError, SamplingError
from p2sf.lens.lens import Lens
from p2sf.messages import Message
from p2sf.parameters import LARGEST_SIDE
from p2sf.pixel_kernels.pixels import half_widths, samples_each
from p2sf.pixel_kernels.pupil_stack import PupilStack
from p2sf.scene.planning.study import SAMPLINGS, Sampling, Study
from p2sf.scene.scene import Scene


def check_colours(lens: Lens, scene: Scene) -> None:
    """Raise GlassError, naming the wavelength, where a glass has no data for a wavelength of the scene.

    A plan may replace the wavelengths of a channel by fewer others, so a later error could name a wavelength that was
    not requested.
    """
    for channel in scene.channels:
        for medium in lens.media:
            try:
                medium.index(channel.wavelengths_um)
            except GlassError as error:
                raise GlassError("channel {channel}: {error}", channel=channel.label, error=error) from error


def check_blur(study: Study) -> None:
    """Raise SamplingError if the finest sampling that a plan may require exceeds the largest transform.

    Blurs are widest at one end of the depths, and the shortest wavelength needs the most samples.
    """
    pixel = study.scene.sensor.pixel_um
    halves, sides = transforms(*study.fitted(study.corners), pixel, SAMPLINGS[-1])
    widest = int(sides.argmax())
    if sides[widest] > LARGEST_SIDE:
        depth = depth_of(study.corners[widest].vergence)
        raise SamplingError(
            "points {depth} away blur over {size:.2g} mm, which takes {side}² "
            "samples of {most}² at most; bring the depths nearer to the focus or stop down",
            depth=Message("∞") if isinf(depth) else Message("{depth:.4g} mm", depth=depth),
            size=float(2 * halves[widest] + 1) * pixel / UM_PER_MM,
            side=int(sides[widest]),
            most=LARGEST_SIDE,
        )


def transforms(
    pupils: PupilStack, shifts_mm: np.ndarray, pixel_um: float, sampling: Sampling
) -> tuple[np.ndarray, np.ndarray]:
    """Return half widths of kernels in pixels, and the sides of their transforms in samples, (pupils,) each."""
    fineness, margin = sampling
    halves = half_widths(pupils, pixel_um, np.hypot(*shifts_mm.T) * UM_PER_MM)
    sides = (2 * (halves + np.ceil(margin * halves)) + 1) * samples_each(pupils, pixel_um, fineness)
    return halves, sides
