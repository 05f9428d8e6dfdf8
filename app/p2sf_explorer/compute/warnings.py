"""What a person must know about the picture, as messages. No Qt in here."""

from collections.abc import Iterator
from functools import lru_cache
from math import isinf, isnan

import numpy as np

from p2sf.lens.lens import Lens, message_if_misaligned
from p2sf.messages import Message, Number
from p2sf.paraxial.balance import strongest
from p2sf.paraxial.lens_checks import lens_checks
from p2sf.paraxial.wavefront import wavefront
from p2sf.pupil.wavefront_map import WavefrontMap, disc
from p2sf.raytrace.trace import out_of_order
from p2sf_explorer.compute.layout import RayPath
from p2sf_explorer.compute.setup import ParaxialSetup
from p2sf_explorer.state.panels import REGISTRY, REMAINS
from p2sf_explorer.state.scales import significant

OF_THE_ALIGNED = Message(
    "Six coefficients are those of the aligned lens, without its tilts, decentres and irregularities; choose auto, "
    "fitted or traced to see what these do."
)
DEFOCUS_LIMIT = 10.0  # waves; Pieroni et al. 2015 consider PSFs of less, "in focus and quasi-in-focus"
TOGETHER = Message("bring focus and source together to see waves")
NEARER = Message("stop down or go nearer the axis to see waves")
SMALLER = Message("stop down to see waves")
FACTOR, MANY_WAVES, DISC = 2.0, 20.0, 24  # between two peaks to valley, the larger one, samples across the pupil
WIDE_DEG, FAST_NA = 25.0, 0.30  # tan and sin differ by 10 % at 25°; an NA of 0.3 is f/1.7


def warnings(
    setup: ParaxialSetup, pupil: WavefrontMap | None, rays: tuple[RayPath, ...] = (), geometric: bool = False
) -> tuple[Message, ...]:
    """Return the sentences that hold for this setup, most important first.

    ``pupil``: the wavefront of exact rays, None where six coefficients make the picture; ``rays``: those drawn;
    ``geometric``: the picture is the density of rays.
    """
    found = (
        _by_hand(setup),
        message_if_misaligned(setup.lens, OF_THE_ALIGNED) if pupil is None and not setup.altered else None,
        _image_at_infinity(setup),
        _blur_warning(setup) if geometric else None,
        _loss_warning(sum(ray.lost for ray in rays)),
        _crossing_warning(setup.lens, rays),
        None if pupil else _defocus(setup),
        None if pupil else _paraxial(setup),
        _not_paraxial(setup, pupil) if pupil else None,
        _narrower_rim(setup),
        *_lens_faults(setup.lens),
    )
    return tuple(message for message in found if message)


def without_alterations(found: tuple[Message, ...], setup: ParaxialSetup) -> tuple[Message, ...]:
    """Return the sentences without the one that coefficients are altered, which answers what is seen in a star."""
    return tuple(message for message in found if message != _by_hand(setup))


@lru_cache(maxsize=16)
def _lens_faults(lens: Lens) -> tuple[Message, ...]:
    """Return what no workshop could make: the first fault, and how many there are."""
    return tuple(_first_of(lens_checks(lens)))


def _first_of(faults: tuple[Message, ...]) -> Iterator[Message]:
    if faults:
        yield Message("{fault}.", fault=faults[0])
    if len(faults) > 1:
        yield Message("This lens has {count} such faults; p2sf info lists them all.", count=len(faults))


def _narrower_rim(setup: ParaxialSetup) -> Message | None:
    warning = setup.stop.warning
    return Message("{warning}.", warning=warning) if warning else None


def _by_hand(setup: ParaxialSetup) -> Message | None:
    if not setup.altered:
        return None
    panels = tuple(Message(entry.title) for entry in REGISTRY if entry.by_hand == REMAINS)
    return Message("What-if: coefficients altered by hand; of the lens itself remain: {panels}.", panels=panels)


def _image_at_infinity(setup: ParaxialSetup) -> Message | None:
    if not isinf(float(setup.coefficients.image_distance)):
        return None
    return Message("The object lies in the front focal plane, so its image is at infinity; move the source.")


def _blur_warning(setup: ParaxialSetup) -> Message:
    return Message(
        "The blur is so large that the picture is ray density, no diffraction; {remedy}.", remedy=remedy(setup)
    )


def remedy(setup: ParaxialSetup) -> Message:
    """Return what brings waves back into view, after what blurs most."""
    if strongest(setup.coefficients) == "wd":
        return TOGETHER
    return NEARER if setup.source.field_slope else SMALLER


def _loss_warning(count: int) -> Message | None:
    if not count:
        return None
    if count == 1:
        return Message(
            "One of the drawn rays does not pass (it misses a surface, or is totally reflected); less light arrives "
            "than the picture assumes."
        )
    return Message(
        "{count} of the drawn rays do not pass (they miss a surface, or are totally reflected); less light arrives "
        "than the picture assumes.",
        count=count,
    )


def _crossing_warning(lens: Lens, rays: tuple[RayPath, ...]) -> Message | None:
    met = [ray.z[1 : len(lens.surfaces) + 1] for ray in rays]
    whole = [z for z in met if len(z) == len(lens.surfaces)]
    together = [np.stack(whole, axis=-1)] if whole else []
    found = (out_of_order(lens, z) for z in (*together, *(z for z in met if len(z) < len(lens.surfaces))))
    warning = next((message for message in found if message), None)
    return Message("{warning}.", warning=warning) if warning else None


def _defocus(setup: ParaxialSetup) -> Message | None:
    waves = float(setup.coefficients.wd)
    if isnan(waves) or abs(waves) < DEFOCUS_LIMIT:
        return None
    return Message(
        "Defocus is {waves} λ, beyond the 10 λ that the paper considers; bring focus or source nearer, or stop down.",
        waves=Number(significant(waves, 3)),
    )


def _not_paraxial(setup: ParaxialSetup, pupil: WavefrontMap) -> Message | None:
    """Return why coefficients and pupil show different waves."""
    xi, eta, inside = disc(DISC)
    six = float(np.ptp(np.asarray(wavefront(setup.coefficients, xi, eta))[inside]))
    exact = pupil.peak_to_valley
    if not max(six, exact) > max(MANY_WAVES, FACTOR * min(six, exact)):
        return None
    return Message(
        "Exact rays have {exact} λ from peak to valley, the six coefficients {six} λ: these are paraxial, and the rays "
        "are too steep for that here; pupil and PSF are of exact rays.",
        exact=Number(significant(exact, 3)),
        six=Number(significant(six, 3)),
    )


def _paraxial(setup: ParaxialSetup) -> Message | None:
    angle = abs(float(np.rad2deg(np.arctan(setup.source.field_slope))))
    na = float(setup.coefficients.na)
    if angle > WIDE_DEG:
        return Message(
            "A field of {angle:.0f}° is far outside the paraxial range, where six coefficients only sketch the PSF; "
            "choose fitted or traced.",
            angle=angle,
        )
    if na > FAST_NA:
        return Message(
            "An aperture of NA {na:.2f} is far outside the paraxial range, where six coefficients only sketch the "
            "PSF; choose fitted or traced.",
            na=na,
        )
    return None
