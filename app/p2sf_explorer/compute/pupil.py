"""What the window shows of the wavefront over the pupil, and what it says blurs most. No Qt in here."""

from p2sf.messages import Message, Number
from p2sf.metrics.wavefront_map import WavefrontMap, map_of, samples_of_coefficients, samples_of_rays
from p2sf.paraxial.seidel import Coefficients
from p2sf_explorer.compute.setup import ParaxialSetup
from p2sf_explorer.state.scales import significant

ALIKE = 4.0  # of the variance: the focus of third order then is that of the rays up to a factor of two
LEAST_CAUSE = 0.2  # of the focus that a coefficient makes if it is named
SECOND = 0.2  # of the variance, from which on the second largest part is named
MARECHAL = 1 / 14**2  # waves²: a Strehl ratio of 0.8 (Born & Wolf 1999, §9.3)


def pupil_of(setup: ParaxialSetup, exact: bool, quality: str, clip: bool = False) -> WavefrontMap:
    """Return the wavefront that made the PSF: of the six coefficients for seidel, else of exact rays.

    The six coefficients know no rims. Raises GeometryError where no ray reaches the sensor.
    """
    if exact:
        return map_of(setup.lens, setup.source, samples_of_rays(setup.lens, setup.source, quality, clip), quality)
    kind = "what-if" if setup.altered else "six coefficients"
    return map_of(setup.lens, setup.source, samples_of_coefficients(setup.coefficients, quality), quality, kind)


def variance_parts(coefficients: Coefficients) -> dict[str, float]:
    """Return how the variance of the six coefficients' W (waves²) is to be laid to each of them; tilt is left out.

    Spherical beyond its best focus W40²/180, coma beyond its tilt W31²/72, astigmatism about its medial focus W22²/24,
    and all focus together (W40 + W20 + Wd + W22/2)²/12 (Mahajan 1991, table 2-1). What pushes the focus the way it is
    off shares that part, each by its size; what pulls against it has none.
    """
    w40, w31, w22, w20, wd = (float(getattr(coefficients, name)) for name in ("w40", "w31", "w22", "w20", "wd"))
    causes = {"w40": w40, "w20": w20 + w22 / 2, "wd": wd}
    focus = sum(causes.values())
    pushes = {name: max(0.0, cause * focus) for name, cause in causes.items()}
    whole = sum(pushes.values()) or 1.0
    shares = {name: focus**2 / 12 * push / whole for name, push in pushes.items()}
    return {"w40": w40**2 / 180 + shares["w40"], "w31": w31**2 / 72, "w22": w22**2 / 24} | {
        name: shares[name] for name in ("w20", "wd")
    }


def strongest(coefficients: Coefficients) -> str:
    """Return which of the six coefficients is to be changed first: the one that most of the variance is laid to."""
    parts = variance_parts(coefficients)
    return max(parts, key=parts.__getitem__)


def dominant(pupil: WavefrontMap, coefficients: Coefficients) -> Message:
    """Return what blurs most: an aberration and its share of the variance without piston and tilt (handbook 3.4).

    What refocusing would remove need not be a defocus: where the six coefficients account for it, those that make it
    are named.
    """
    if pupil.rms**2 < MARECHAL:
        return Message("Diffraction-limited: RMS {rms:.3f} λ", rms=pupil.rms)
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


def best_focus_um(c: Coefficients) -> float:
    """Return how far the sensor is from the focus that the six coefficients leave least variance in, µm.

    The parts of W40, W20 + Wd and W22 that are alike over the pupil are (W40 + W20 + Wd + W22/2)ρ² (Welford 1986, §7.7,
    for the depth 2n′λW/NA² of a defocus).
    """
    focus = float(c.w40 + c.w20 + c.wd + c.w22 / 2)
    return abs(2 * float(c.image_index) * float(c.wavelength_um) * focus / float(c.na) ** 2)


def focus_causes(coefficients: Coefficients, variance: float) -> tuple[str, ...]:
    """Return the coefficients that make this variance of focus, the largest first; none where they make another."""
    c = coefficients
    focus = float(c.w40 + c.w20 + c.wd + c.w22 / 2)
    if not 1 / ALIKE < focus**2 / 12 / variance < ALIKE:
        return ()
    pulls = {"W40": float(c.w40), "W20": float(c.w20), "Wd": float(c.wd), "W22": float(c.w22 / 2)}
    found = [name for name, pull in pulls.items() if pull / focus > LEAST_CAUSE]
    return tuple(sorted(found, key=lambda name: -pulls[name] / focus))
