"""The claims of the paper (Pieroni et al. 2015), each judged by what is measured here."""

from dataclasses import dataclass

import numpy as np

from p2sf.conventions import NM_PER_UM, UM_PER_MM, slope_from_degrees
from p2sf.database.build import build_exact
from p2sf.database.space import Space
from p2sf.figures.compare import r_squared
from p2sf.lens.lens import Lens, with_aim, with_f_number, with_sensor
from p2sf.lens.source import Source
from p2sf.paraxial.pupils import find_stop
from p2sf.paraxial.seidel import coefficients
from p2sf.psf.huygens import huygens_psf
from p2sf.psf.seidel import seidel_psf
from p2sf.spans import depth_nodes

HOLDS, FAILS = "reproduced", "not reproduced"
CONSTANT = 1.2  # growth of a stage's time that still counts as almost none: the scatter of timings on a busy machine
GOOD = 0.9  # R² that counts as a good picture
FAIR = 0.8  # R² that counts as good for a Gaussian, which has no rings
NODES = 20, 20, 31  # depths, fields, wavelengths: 12 400 PSFs; the paper names no number
WAVES = -20.0, -10.0, -5.0, 0.0, 5.0, 10.0, 20.0
LIMIT = 10.0  # waves of defocus
F_NUMBERS = 3.0, 5.6, 8.0
DEFOCUS_PIXELS = 64
STAGES = ("SIF", "qSIF", "SVF")


@dataclass(frozen=True)
class PaperClaim:
    """One claim of the paper, what is measured of it in words and as ``figures``, and the verdict."""

    claim: str
    measured: str
    verdict: str
    figures: dict


def stage_growth(timing: list[dict]) -> dict[str, float]:
    """Return by what factor each stage's time grows from the fewest elements to the most, along a fitted line."""
    count = np.array([row["elements"] for row in timing], dtype=float)
    growth = {}
    for stage in STAGES:
        slope, start = np.polyfit(count, [row[stage] for row in timing], 1)
        growth[stage] = float((start + slope * count.max()) / (start + slope * count.min()))
    return growth


def time_claim(timing: list[dict]) -> PaperClaim:
    """Judge that the number of elements hardly changes the time of SIF and SVF, and lengthens that of qSIF."""
    growth, most = stage_growth(timing), max(row["elements"] for row in timing)
    grown = ", ".join(f"{stage} × {factor:.2f}" for stage, factor in growth.items())
    measured = f"from 1 element to {most}: {grown}; each surface adds its terms to the sums"
    holds = max(growth["SIF"], growth["SVF"]) <= CONSTANT < growth["qSIF"]
    claim = "the time of SIF and SVF is almost constant with the number of elements, that of qSIF increases"
    return PaperClaim(claim, measured, HOLDS if holds else FAILS, growth)


def memory_claim(lens: Lens, wavelength_nm: float, pixels: int) -> PaperClaim:
    """Judge that coefficients take a small part of the memory of the 12 400 PSFs they stand for."""
    slopes = slope_from_degrees(np.linspace(0, lens.widest_field_deg, NODES[1]))
    space = Space(depth_nodes(1e3, count=NODES[0]), np.asarray(slopes), np.linspace(0.45, 0.68, NODES[2]))
    depth, slope, wavelength = space.axes
    found = coefficients(lens, depth, slope, wavelength)
    six = sum(
        np.broadcast_to(getattr(found, w), space.shape).size * 8 for w in ("w40", "w31", "w22", "w20", "w11", "wd")
    )
    one = coefficients(lens, np.inf, 0.0, wavelength_nm / NM_PER_UM)
    psfs = seidel_psf(one, pixels, 1.0).values.nbytes * int(np.prod(NODES))
    exact = build_exact(lens, space, find_stop(lens, np.inf, lens.reference_wavelength_um)).series.nbytes
    figures = {"psf_bytes": psfs, "coefficient_bytes": six, "exact_bytes": exact, "ratio": psfs / six}
    measured = (
        f"{int(np.prod(NODES)):,} PSFs of {pixels} × {pixels}: {psfs / 1e6:.0f} MB; six coefficients each: "
        f"{six / 1e3:.0f} kB, {psfs / six:.0f} times less; the exact polynomials: {exact / 1e3:.1f} kB"
    ).replace(",", " ", 1)
    return PaperClaim(
        "parameters take less memory than the PSFs they describe", measured, HOLDS if psfs > six else FAILS, figures
    )


def defocus_r_squared(lens: Lens, f_number: float, wavelength_um: float) -> dict[float, float]:
    """Return waves of defocus → R² of the six coefficients against the Huygens sum on the axis, whole blur in view."""
    lens = with_aim(with_f_number(lens, f_number), "paraxial")
    source = Source(wavelength_um=wavelength_um)
    here = coefficients(lens, source.depth_mm, 0.0, wavelength_um)
    na, scores = float(here.na), {}
    for waves in WAVES:
        moved = 2 * wavelength_um * (waves - float(here.wd)) / na**2 / UM_PER_MM  # Wd = NA²Δz/2λ in air
        shifted = with_sensor(lens, lens.sensor_mm + moved)
        radius = (2 * abs(waves) + 4) * wavelength_um / na  # of the geometric blur, and some rings
        window = DEFOCUS_PIXELS, 2.2 * radius / DEFOCUS_PIXELS
        six = coefficients(shifted, source.depth_mm, 0.0, wavelength_um)
        scores[waves] = r_squared(seidel_psf(six, *window).values, huygens_psf(shifted, source, *window).values)
    return scores


def defocus_claim(lens: Lens, wavelength_nm: float) -> PaperClaim:
    """Judge that PSFs of less than ten waves of defocus are described; twice as many are measured beside them."""
    table = {f: defocus_r_squared(lens, f, wavelength_nm / NM_PER_UM) for f in F_NUMBERS}
    within = {f: min(r for waves, r in scores.items() if abs(waves) <= LIMIT) for f, scores in table.items()}
    beyond = {f: min(r for waves, r in scores.items() if abs(waves) > LIMIT) for f, scores in table.items()}
    measured = "smallest R² within ±10 waves and at ±20 waves: " + "; ".join(
        f"f/{f:g} {within[f]:.3f} and {beyond[f]:.3f}" for f in F_NUMBERS
    )
    holds = all(score >= GOOD for score in within.values())
    reason = "" if holds else "; the aperture sets the limit, not the defocus"
    figures = {f"f/{f:g}": {f"{waves:g}": r for waves, r in scores.items()} for f, scores in table.items()}
    return PaperClaim(
        "PSFs of less than 10 waves of defocus are described", measured + reason, HOLDS if holds else FAILS, figures
    )


def gaussian_claim(accuracy: list[dict]) -> PaperClaim:
    """Judge that a Gaussian is good on the axis and becomes much worse off it; ``accuracy`` begins on the axis."""
    scores = {row["field_deg"]: row["r_squared"]["gaussian"] for row in accuracy}
    on_axis, *off_axis = scores.values()
    measured = "R² is " + ", ".join(f"{score:.3f} at {field:g}°" for field, score in scores.items())
    holds = on_axis >= FAIR and max(off_axis) < on_axis - 0.1
    claim = "a Gaussian fitted to the PSF is good on the axis and much worse off it"
    return PaperClaim(claim, measured, HOLDS if holds else FAILS, {f"{field:g}°": r for field, r in scores.items()})


def speed_claim(six_s: float, huygens_s: float) -> PaperClaim:
    """Judge that a PSF from its lens takes less than half a second; the paper's Huygens sum took minutes."""
    measured = f"{1e3 * six_s:.1f} ms, and {1e3 * huygens_s:.0f} ms for the Huygens sum here"
    claim = "a PSF takes less than 500 ms, the Huygens sum several minutes"
    return PaperClaim(
        claim, measured, HOLDS if six_s < 0.5 else FAILS, {"six_seconds": six_s, "huygens_seconds": huygens_s}
    )


def off_axis_claim(accuracy: list[dict]) -> PaperClaim:
    """Judge that six coefficients are stable off axis; say why where they are not."""
    six = {row["field_deg"]: row["r_squared"]["seidel"] for row in accuracy}
    scores = ", ".join(f"{score:.3f} at {field:g}°" for field, score in six.items())
    fitted = min(row["r_squared"]["fitted, 26 numbers"] for row in accuracy)
    measured = (
        f"R² against the converged Huygens sum is {scores}: six coefficients are exact to fourth order only and "
        "assume a circular pupil, while the real wavefront has higher orders and the real pupil, seen in the direction "
        f"cosines of image space, is squeezed; 26 numbers fitted to exact rays hold R² ≥ {fitted:.4f} at all fields"
    )
    verdict = HOLDS if min(six.values()) >= GOOD else FAILS
    return PaperClaim(
        "six coefficients are stable off axis", measured, verdict, {f"{field:g}°": r for field, r in six.items()}
    )
