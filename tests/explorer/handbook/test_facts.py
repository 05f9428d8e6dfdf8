"""The numbers that the theory states are those of the code."""

import re

import numpy as np
import pytest

from p2sf.database.exact import LENGTHS, NUMBERS
from p2sf.lens.lens import with_aim
from p2sf.lens.shape_types import SHAPES
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.lensfile.toml.surface import ENTRIES
from p2sf.paraxial.seidel import coefficients
from p2sf.psf.prediction import residual_for
from p2sf.pupil.fit import LEVELS, RESIDUAL_WAVES
from p2sf.raytrace.pencil import pencil
from p2sf_explorer.handbook.pages import page

THEORY = " ".join(page("theory").split())


def stated(pattern: str) -> tuple[float, ...]:
    """Return the numbers in the one place of the theory that reads like this."""
    (found,) = re.findall(pattern, THEORY)
    return tuple(map(float, (found,) if isinstance(found, str) else found))


def test_the_rays_and_numbers_of_the_first_two_fits():
    first, second = LEVELS[:2]
    numbers, rays, more = stated(r"first level has (\d+) numbers from (\d+) rays, the second (\d+) from the same")
    assert (numbers, rays, more) == (first.numbers, first.rays, second.numbers)
    assert first.rays == second.rays
    assert stated(r"\| (\d+) and more \|") == (first.rays,)


def test_the_residual_of_a_fit_and_the_tolerance_where_it_begins_to_fall():
    mantissa, exponent, tolerance = stated(
        r"leaves more than \$([\d.]+)\\cdot10\^\{(-?\d+)\}\$ waves.*?tolerance above about ([\d.]+)"
    )
    limit = mantissa * 10**exponent
    assert limit == pytest.approx(RESIDUAL_WAVES, rel=1e-12)
    assert residual_for(tolerance) == RESIDUAL_WAVES
    assert residual_for(tolerance + 5e-4) < RESIDUAL_WAVES  # "about": three digits are printed


def test_the_numbers_of_the_exact_database_are_counted_whole():
    assert stated(r"These (\d+) numbers per wavelength") == (NUMBERS,)
    counts = stated(r"have (\d), (\d), (\d), (\d) \(\$p\$\) and (\d) numbers")
    assert counts == tuple(LENGTHS[name] for name in ("w40", "w31", "w22", "petzval", "w11"))
    chief, pupil, index = stated(r"last height and slope \((\d)\).*?pupil \((\d)\).*?image space \((\d)\)")
    assert chief == LENGTHS["chief_y"] + LENGTHS["chief_nu"]
    assert (pupil, index) == (LENGTHS["pupil"], LENGTHS["image_index"])
    assert sum(counts) + LENGTHS["nu"] + LENGTHS["y"] + chief + pupil + index == NUMBERS


def test_how_far_the_pupil_is_squeezed_off_axis():
    """Differences of the direction cosines of rays next to the chief ray, over the paraxial slope."""
    lens = with_aim(find_lens("double_gauss_28"), "paraxial")
    degrees, wavelength_nm, across, along = stated(
        r"Double Gauss at (\d+)°, infinity and ([\d.]+) nm, to ([\d.]+) of the .*? and to ([\d.]+) along it"
    )
    source = Source(field_deg=degrees, wavelength_nm=wavelength_nm)
    near = 1e-3  # of the pupil's radius
    rays = pencil(lens, source, np.array([near, -near, 0, 0]), np.array([0, 0, near, -near]))
    slope = float(coefficients(lens, source.depth_mm, source.field_slope, source.wavelength_um).reduced_slope)
    scale = float(rays.index) / (2 * near * slope)
    squeezed = (scale * (rays.kx[0] - rays.kx[1]), scale * (rays.ky[2] - rays.ky[3]))
    assert squeezed == pytest.approx((across, along), abs=6e-4)  # three digits are printed


def test_the_page_of_lens_files_names_every_key_of_a_surface_and_every_shape():
    text = page("lens_files")
    missing = [name for name in (*(entry.key for entry in ENTRIES), *SHAPES) if name not in text]
    assert not missing
