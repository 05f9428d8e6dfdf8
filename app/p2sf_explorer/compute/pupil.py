"""What the window shows of the wavefront over the pupil, and what it says blurs most. No Qt in here."""

from p2sf.messages import Message, Number
from p2sf.paraxial.balance import best_focus_um, focus_causes
from p2sf.paraxial.seidel import Coefficients
from p2sf.pupil.wavefront_map import WavefrontMap, map_of, wavefront_of_coefficients, wavefront_of_rays
from p2sf_explorer.compute.setup import ParaxialSetup
from p2sf_explorer.state.scales import significant

SECOND = 0.2  # of the variance, from which on the second largest part is named
MARECHAL = 1 / 14**2  # waves²: a Strehl ratio of 0.8 (Born & Wolf 1999, §9.3)


def pupil_of(setup: ParaxialSetup, exact: bool, quality: str, clip: bool = False) -> WavefrontMap:
    """Return the wavefront that made the PSF: of the six coefficients for seidel, else of exact rays.

    The six coefficients know no rims. Raises GeometryError where no ray reaches the sensor.
    """
    if exact:
        waves, clear = wavefront_of_rays(setup.lens, setup.source, quality, clip)
        return map_of(setup.lens, setup.source, waves, quality, clear)
    kind, waves = (
        "what-if" if setup.altered else "six coefficients",
        wavefront_of_coefficients(setup.coefficients, quality),
    )
    return map_of(setup.lens, setup.source, waves, quality, kind=kind)


def written_rms(pupil: WavefrontMap) -> Number:
    """Return the RMS in waves to two digits, as caption and sentence say it."""
    return Number(significant(pupil.rms, 2))


def dominant(pupil: WavefrontMap, coefficients: Coefficients) -> Message:
    """Return what blurs most: an aberration and its share of the variance without piston and tilt (handbook 3.4).

    What refocusing would remove need not be a defocus: where the six coefficients account for it, those that make it
    are named.
    """
    if pupil.rms**2 < MARECHAL:
        return Message("Diffraction-limited: RMS {rms} λ", rms=written_rms(pupil))
    total = sum(pupil.parts.values()) + pupil.rest
    name = max(pupil.parts, key=pupil.parts.__getitem__)
    percent, term = 100 * pupil.parts[name] / total, Message(name)
    if name == "defocus":
        causes = focus_causes(coefficients, pupil.parts[name])
        if causes:
            sentence = "The best focus is about {shift} µm away: defocus by {causes}, {percent:.0f} % of variance"
            shift = Number(significant(best_focus_um(coefficients), 2))
            return Message(sentence, percent=percent, causes=causes, shift=shift)
        return Message("Refocusing would remove {percent:.0f} % of the wavefront variance", percent=percent)
    other, more = _second(pupil, coefficients, name)
    values = {"term": term, "percent": percent}
    if more < SECOND * total:
        if percent > 50:
            return Message("Mostly {term}: {percent:.0f} % of the wavefront variance", **values)
        return Message("Mainly {term}: {percent:.0f} % of the wavefront variance", **values)
    values |= {"other": other, "more": 100 * more / total}
    if percent > 50:
        return Message("Mostly {term}: {percent:.0f} % of the wavefront variance; {other}: {more:.0f} %", **values)
    return Message("Mainly {term}: {percent:.0f} % of the wavefront variance; {other}: {more:.0f} %", **values)


def _second(pupil: WavefrontMap, coefficients: Coefficients, first: str) -> tuple[Message, float]:
    """Return what blurs most but ``first``, and its variance, waves²; of defocus the coefficients that make it too."""
    others = {name: part for name, part in pupil.parts.items() if name != first}
    name = max(others, key=others.__getitem__)
    causes = focus_causes(coefficients, others[name]) if name == "defocus" and others[name] else ()
    if causes:
        return Message("defocus by {causes}", causes=causes), others[name]
    return Message(name), others[name]
