"""What the handbook of version 0.2 imports can be imported still, with a warning that names the new place."""

import sys
from importlib import import_module

import pytest


@pytest.mark.parametrize(
    ("module", "name", "place"),
    [
        ("p2sf.request", "Request", "p2sf.camera"),
        ("p2sf.request", "set_up", "p2sf.camera"),
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
