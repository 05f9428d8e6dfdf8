"""Pupils kept of a lens are those of rays through the stop of every scene, whatever its f-number."""

import numpy as np
import pytest

from p2sf.conventions import depth_of
from p2sf.disc.mask import PupilMask
from p2sf.errors import GeometryError
from p2sf.files import cache
from p2sf.lens.lens import with_f_number, with_mask
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.pixel_kernels.frequency_grid import fits_of, pupils_of
from p2sf.pixel_kernels.pixels import PixelWindow, pixel_kernels
from p2sf.pixel_kernels.pupil_stack import with_reach
from p2sf.pupil.fit import levels_for
from p2sf.scene.planning import lens_pupils as kept
from p2sf.scene.planning.adaptive_table import kernel_errors
from p2sf.scene.planning.plan import plan
from p2sf.scene.planning.study import Study, distance
from p2sf.scene.scene import Channel, Scene
from p2sf.scene.sensor import Sensor

GREEN = (Channel("green", (530.0, 560.0), (1.0, 1.0)),)
SCENE = Scene(Sensor(96, 128, 9.0), GREEN, 15000.0, 25000.0, 0.1, focus_mm=20000.0, f_number=4.0)


@pytest.fixture(autouse=True)
def forgotten():
    kept._table.cache_clear()
    yield
    kept._table.cache_clear()


def rays(lens, slopes, vergences, waves):
    sources = [Source(depth_of(v), s, w) for s, v, w in zip(slopes, vergences, waves, strict=True)]
    level = levels_for(lens)[2]
    forms, landed = fits_of(lens, sources, level)
    return pupils_of(lens, sources, forms, level), landed


@pytest.mark.parametrize("mask", [PupilMask(), PupilMask(obscuration=0.4)], ids=["open", "ring"])
@pytest.mark.parametrize("f_number", [4.3, 5.5])
def test_kernels_from_kept_pupils_are_those_of_own_rays(f_number, mask):
    """By pixels, which share nothing with the comparison of polynomials; both within the tables' 1e-3 an axis."""
    lens = with_mask(with_f_number(find_lens("double_gauss_28"), f_number), mask)
    slopes, vergences, waves = np.array([0.0, 0.05, 0.11]), np.array([0.0, 1e-5, 2e-5]), np.array([0.5, 0.55, 0.6])
    found, there = kept.lens_pupils(lens, 0.12, (0.0, 2e-5), (0.5, 0.6)).between(slopes, vergences, waves)
    found = with_reach(found)
    true, landed = rays(lens, slopes, vergences, waves)
    window, angles = PixelWindow(40, 2.0, 6), np.zeros(3)
    kernels = [pixel_kernels(pupils, angles, window, np.zeros((3, 2))) for pupils in (found, true)]
    apart = [distance(one, two) for one, two in zip(*kernels, strict=True)]
    assert max(apart) < 3e-3
    bounds = kernel_errors(found, true, 1000 * (there - landed))
    assert max(bounds) < 4e-3
    assert np.abs(there - landed).max() < 1e-5


def test_the_bound_of_a_kernels_error_is_no_less_than_the_error():
    """Pupils of slightly other fields, depths and colours, some far apart: rendered on fine pixels."""
    lens = with_f_number(find_lens("double_gauss_28"), 4.0)
    slopes, vergences, waves = np.full(4, 0.1), np.full(4, 1e-5), np.full(4, 0.55)
    true, _ = rays(lens, slopes, vergences, waves)
    off = np.array([[3e-4, 0, 0, 1e-3], [0, 3e-7, 0, 0], [0, 0, 3e-4, 0]])
    other, _ = rays(lens, *(np.array([slopes, vergences, waves]) + off))
    window, angles = PixelWindow(40, 1.5, 6), np.zeros(4)
    one, two = (pixel_kernels(pupils, angles, window, np.zeros((4, 2))) for pupils in (other, true))
    apart = np.array([distance(a, b) for a, b in zip(one, two, strict=True)])
    bound = kernel_errors(other, true, np.zeros((4, 2)))
    assert (apart > 1e-4).all() and (apart <= bound).all() and (bound <= 10 * apart).all()


def test_stops_share_what_is_kept(monkeypatch):
    fits = []
    fit = kept._fit
    monkeypatch.setattr(kept, "_fit", lambda *given: fits.append(given) or fit(*given))
    lens = find_lens("double_gauss_28")
    for f_number in (5.0, 5.3, 5.6):
        kept.lens_pupils(with_f_number(lens, f_number), 0.1, (0.0, 1e-6), (0.5, 0.6))
    assert len(fits) == 1
    kept.lens_pupils(with_f_number(lens, 11.0), 0.1, (0.0, 1e-6), (0.5, 0.6))
    assert len(fits) == 2


def test_a_plan_is_the_same_from_new_pupils_from_memory_and_from_disk(tmp_path, monkeypatch):
    monkeypatch.setenv(cache.VARIABLE, str(tmp_path))
    lens = find_lens("double_gauss_28")
    made = [plan(lens, SCENE), plan(lens, SCENE)]
    assert len(list(tmp_path.iterdir())) == 1
    kept._table.cache_clear()
    monkeypatch.setattr(kept, "_fit", lambda *_: pytest.fail("fitted again"))
    made.append(plan(lens, SCENE))
    assert len({one.predicted_error for one in made}) == 1
    for one in made:
        np.testing.assert_array_equal(one.table.rows, made[0].table.rows)


@pytest.mark.parametrize("damage", ["rows", "axis", "number"])
def test_what_is_not_a_table_of_this_lens_is_not_used(tmp_path, monkeypatch, damage):
    """Whole archives with other contents: of another size, without an axis, and one that rays at the corners refute."""
    monkeypatch.setenv(cache.VARIABLE, str(tmp_path))
    lens, fresh = find_lens("double_gauss_28"), Study(SCENE.camera(find_lens("double_gauss_28")), SCENE)
    assert fresh.kept is not None and fresh.kept.error < 5e-3
    (path,) = tmp_path.iterdir()
    arrays = cache.read_cached(path.stem)
    if damage == "rows":
        arrays["rows"] = arrays["rows"][:, :-1]
    elif damage == "axis":
        del arrays["axis_1"]
    else:
        arrays["rows"][:, 3] += 0.05  # waves, of a term of the phase
    cache.write_cached(path.stem, arrays)
    kept._table.cache_clear()
    study = Study(SCENE.camera(lens), SCENE)
    assert (study.kept is None) == (damage == "number")
    assert plan(lens, SCENE).meets


def test_that_a_lens_has_no_table_is_kept(tmp_path, monkeypatch):
    monkeypatch.setenv(cache.VARIABLE, str(tmp_path))
    monkeypatch.setattr(kept, "adaptive_table", lambda *_: (None, 0.0))
    lens = find_lens("tessar")
    assert kept.lens_pupils(lens, 0.1, (0.0, 1e-6), (0.5, 0.6)) is None
    monkeypatch.setattr(kept, "_fit", lambda *_: pytest.fail("fitted again"))
    kept._table.cache_clear()
    assert kept.lens_pupils(lens, 0.1, (0.0, 1e-6), (0.5, 0.6)) is None
    kept._table.cache_clear()


def test_light_that_is_not_visible_and_fields_that_no_ray_reaches_are_not_kept():
    lens = find_lens("double_gauss_28")
    assert kept.lens_pupils(lens, 0.1, (0.0, 1e-6), (0.5, 0.9)) is None
    assert kept.lens_pupils(lens, 50.0, (0.0, 1e-6), (0.5, 0.6)) is None
    narrow = kept.lens_pupils(lens, 0.1, (0.0, 1e-6), (0.5, 0.6))
    with pytest.raises(GeometryError):
        narrow.between(np.array([5.0]), np.array([0.0]), np.array([0.55]))
