"""A region of the picture alone: the same as that part of the whole, by fewer kernels."""

from dataclasses import replace

import numpy as np
import pytest

import p2sf
from p2sf.errors import RequestError
from p2sf.image.form import form_image
from p2sf.image.region import Region, tiles
from p2sf.lensfile.library import find_lens
from p2sf.scene.planning.plan import plan
from p2sf.scene.scene import Channel, Scene
from p2sf.scene.sensor import Sensor
from tests.support.kernel_counts import counted_kernels

GREEN = (Channel("green", (540.0,), (1.0,)),)
PART = 30, 70, 60, 130


@pytest.fixture(scope="module")
def planned():
    scene = Scene(Sensor(120, 180, 20.0), GREEN, 4000.0, 8000.0, 0.1, focus_mm=6000.0, f_number=4.0)
    return plan(find_lens("double_gauss_28"), scene.at_depths(np.array([4000.0, 8000.0])))


@pytest.fixture(scope="module")
def picture():
    depth = np.where(np.arange(180) < 90, 4000.0, 8000.0) * np.ones((120, 1))
    return np.random.default_rng(0).random((120, 180, 1)).astype(np.float32), depth


@pytest.mark.parametrize("with_depth", [False, True])
def test_a_region_is_that_part_of_the_whole_picture(planned, picture, with_depth):
    values, depth = picture
    given = (values, depth) if with_depth else (values,)
    every = form_image(planned, *given)
    part = form_image(planned, *given, region=Region(*PART))
    top, bottom, left, right = PART
    assert part.shape == (40, 70, 1)
    assert part == pytest.approx(every[top:bottom, left:right], abs=2e-6)  # float32, by blocks of other sizes


def test_a_small_region_takes_fewer_kernels(planned, picture):
    dense = replace(planned, counts=(9, 13))
    with counted_kernels() as every:
        form_image(dense, *picture)
    with counted_kernels() as some:
        form_image(dense, *picture, region=Region(30, 50, 20, 40))
    assert 0 < sum(some) < 0.8 * sum(every)


def test_python_takes_rows_and_columns(planned, picture):
    top, bottom, left, right = PART
    part = p2sf.form_image(planned, *picture, region=list(PART))
    assert part == pytest.approx(p2sf.form_image(planned, *picture)[top:bottom, left:right], abs=2e-6)


@pytest.mark.parametrize(
    "part", [(0, 121, 0, 10), (5, 5, 0, 10), (-1, 10, 0, 10), (0, 10, 0.5, 10), (0, 10, 3), "rows", (None,) * 4]
)
def test_a_region_that_is_no_part_of_the_picture_is_refused(planned, picture, part):
    with pytest.raises(RequestError) as refused:
        p2sf.form_image(planned, *picture, region=part)
    assert refused.value.message.values["parameter"] == "region"


def test_tiles_cover_an_area_each_pixel_once():
    area, found = Region(-3, 40, 5, 99), np.zeros((43, 94), int)
    for tile in tiles(area, 20):
        assert max(tile.shape) <= 20
        found[tile.within(area)] += 1
    assert (found == 1).all()
