"""What the handbook of version 0.2 imports can be imported still, with a warning that names the new place."""

import sys
from importlib import import_module

import numpy as np
import pytest

import p2sf
from p2sf.io.record import psf_from
from p2sf.psf.result import facts


@pytest.mark.parametrize(
    ("module", "name", "place"),
    [
        ("p2sf.measure.frame_terms", "lens_optics", "p2sf.measure.fitting.frame_terms"),
    ],
)
def test_former_modules(module, name, place, monkeypatch):
    monkeypatch.delitem(sys.modules, module, raising=False)
    with pytest.warns(DeprecationWarning, match=place):
        former = import_module(module)
    assert getattr(former, name) is getattr(import_module(place), name)


def test_former_functions(monkeypatch):
    from p2sf.measure import measurement

    monkeypatch.setattr(measurement, "measure_frame", lambda *given: given)
    with pytest.warns(DeprecationWarning, match="measure_frame"):
        frames, optics, asked, *_ = measurement.measured("frames", "optics", lens=None, singly=False)
    assert (frames, optics, asked.singly, asked.lens) == ("frames", "optics", False, None)
    with pytest.raises(AttributeError):
        _ = measurement.measurred


def test_former_parameters_and_fields():
    lens, sensor = p2sf.load_lens("landscape"), p2sf.Sensor(6, 8, 60.0)
    with pytest.warns(DeprecationWarning, match="min_r2"):
        psf = p2sf.render(lens, tolerance=0.5, pixels=8)
    with pytest.warns(DeprecationWarning, match="error"):
        assert psf.tolerance == psf.error
    with pytest.warns(DeprecationWarning, match="min_psnr_db"):
        assert p2sf.Scene(sensor, tolerance=36.0, measure="psnr") == p2sf.Scene(sensor, min_psnr_db=36.0)
    with pytest.warns(DeprecationWarning, match="limit"):
        assert p2sf.Scene(sensor, rtol=0.2).tolerance == 0.2
    with pytest.warns(DeprecationWarning, match="basis"):
        assert p2sf.zernike(lens, terms=4).order == "noll"
    with pytest.warns(DeprecationWarning, match="fields_deg"):
        rows = p2sf.tradeoff(lens, [3.0], [5000.0], methods="seidel", pixels=8)
    assert (rows[0].field_deg, rows[0].depth_mm) == (3.0, 5000.0)
    with pytest.warns(DeprecationWarning, match="stop"):
        assert p2sf.render(lens, aim="real", pixels=8).method == p2sf.render(lens, aim="stop", pixels=8).method


def test_a_file_with_a_former_field_is_read():
    known = facts(p2sf.render(p2sf.load_lens("landscape"), method="seidel", pixels=8))
    del known["error"]
    assert psf_from(np.ones((8, 8)), known | {"tolerance": 1e-4}).error == 1e-4
