"""The lens as data: what cannot be a lens is refused with its place, value and remedy."""

import copy
import os
import pickle
import subprocess
import sys
from dataclasses import FrozenInstanceError, replace
from math import inf, nan
from pathlib import Path

import numpy as np
import pytest

from p2sf.conventions import angle_from_axis
from p2sf.errors import GeometryError
from p2sf.glass.media import ConstantIndex, TabulatedIndex
from p2sf.lens.lens import Aperture, Lens, Surface, indices, with_f_number, with_sensor
from p2sf.lensfile.library import find_lens

ROOT = Path(__file__).parents[2]
RIM = Aperture("stop_semi_diameter", 2.0)
LENS = Lens((Surface(50.0, 4.0, ConstantIndex(1.5)), Surface(-50.0, 48.0)), RIM, 1)


@pytest.mark.parametrize(
    ("surface", "words"),
    [
        (Surface(radius=0.0), "surface 2: radius 0.0 mm; write inf"),
        (Surface(radius=-1e-300), "surface 2: radius -1e-300 mm; write inf"),
        (Surface(radius=nan), "surface 2: radius nan mm; write inf"),
        (Surface(thickness=inf), "surface 2: thickness inf mm; give"),
        (Surface(thickness=nan), "surface 2: thickness nan mm; give"),
        (Surface(semi_diameter=0.0), "surface 2: semi-diameter 0.0 mm; give"),
        (Surface(semi_diameter=nan), "surface 2: semi-diameter nan mm; give"),
        (Surface(conic=inf), "surface 2: conic or aspheric coefficient is not finite"),
        (Surface(aspheric=(1e-6, nan)), "surface 2: conic or aspheric coefficient is not finite"),
    ],
)
def test_a_surface_that_cannot_be_is_named(surface, words):
    with pytest.raises(GeometryError) as caught:
        Lens((LENS.surfaces[0], surface), RIM, 1)
    assert words in str(caught.value)


@pytest.mark.parametrize("stop", [0, 3, -1])
def test_a_stop_that_is_not_there_is_named(stop):
    with pytest.raises(GeometryError, match=f"stop surface {stop} does not exist; the lens has surfaces 1 to 2"):
        replace(LENS, stop_surface=stop)


@pytest.mark.parametrize("value", [0.0, -1.0, inf, nan])
def test_an_aperture_is_positive_and_finite(value):
    with pytest.raises(GeometryError, match=r"aperture f_number is \S+; give a positive number"):
        with_f_number(LENS, value)


@pytest.mark.parametrize(
    ("wavelengths", "words"),
    [
        ((), "no wavelengths; give at least one"),
        ((0.0,), "wavelengths are 0.0 nm; give positive numbers"),
        ((500.0, -1.0), "wavelengths are 500.0, -1.0 nm; give positive numbers"),
    ],
)
def test_wavelengths_are_positive(wavelengths, words):
    with pytest.raises(GeometryError, match=words):
        replace(LENS, wavelengths_nm=wavelengths)


def test_a_lens_needs_a_surface():
    with pytest.raises(GeometryError, match="no surfaces"):
        Lens((), RIM)


def test_the_middle_wavelength_is_the_reference():
    lens = replace(LENS, wavelengths_nm=(700.0, 400.0, 550.0))
    assert lens.reference_wavelength_um == 0.55
    assert replace(LENS, wavelengths_nm=(500.0, 600.0)).reference_wavelength_um == 0.6


def test_a_changed_lens_is_another_lens():
    moved, opened = with_sensor(LENS, 3), with_f_number(LENS, 8)
    assert (moved.sensor_mm, LENS.sensor_mm) == (3.0, 48.0)
    assert with_sensor(LENS, 48.0) is LENS
    assert moved.surfaces[0] == LENS.surfaces[0] and moved.surfaces[1].radius == -50.0
    assert opened.aperture == Aperture("f_number", 8.0) and LENS.aperture == RIM
    with pytest.raises(FrozenInstanceError):
        LENS.name = "other"


def test_indices_come_in_the_order_light_meets_them():
    glass = TabulatedIndex((0.4, 0.6), (1.6, 1.5))
    lens = replace(LENS, surfaces=(Surface(50.0, 4.0, glass), *LENS.surfaces[1:]), object_medium=ConstantIndex(1.33))
    np.testing.assert_allclose(indices(lens, 0.5), [1.33, 1.55, 1.0])
    table = indices(lens, [[0.4, 0.5, 0.6]])
    assert table.shape == (3, 1, 3)
    np.testing.assert_allclose(table[1, 0], [1.6, 1.55, 1.5])


def test_a_lens_from_another_process_is_found_where_an_equal_one_is_kept():
    """Texts hash otherwise in each process, so a hash that travelled along would not be this one's."""
    code = """
import pickle, sys
from p2sf.lensfile.library import find_lens
lens = find_lens("tessar")
hash(lens), lens.curvatures, lens.media
sys.stdout.buffer.write(pickle.dumps(lens))
"""
    environment = {**os.environ, "PYTHONHASHSEED": "12345"}
    sent = subprocess.run([sys.executable, "-c", code], capture_output=True, check=True, cwd=ROOT, env=environment)
    here, came = find_lens("tessar"), pickle.loads(sent.stdout)
    assert came == here and {here: "kept"}.get(came) == "kept"
    assert copy.deepcopy(came) == copy.copy(came) == here


@pytest.mark.parametrize(("x_deg", "y_deg"), [(0.0, -20.0), (30.0, 0.0), (30.0, -20.0), (5.0, 60.0)])
def test_a_field_of_two_angles_is_as_far_from_the_axis_as_its_direction(x_deg, y_deg):
    direction = np.array([np.tan(np.deg2rad(x_deg)), np.tan(np.deg2rad(y_deg)), 1.0])
    angle = np.arccos(direction[2] / np.linalg.norm(direction))
    assert angle_from_axis(x_deg, y_deg) == pytest.approx(np.rad2deg(angle))
