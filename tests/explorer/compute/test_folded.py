"""A plane mirror behind a lens turns the light back and changes nothing else, in no panel."""

from collections.abc import Mapping
from dataclasses import fields, is_dataclass

import numpy as np
import pytest

from p2sf.figures.psf_data import Later
from p2sf.lens.lens import Lens
from p2sf.lens.misalignment import displaced
from p2sf.lens.placement import Placement
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.lensfile.toml.lens import lens_to_toml
from p2sf.messages import Message
from p2sf.raytrace.pencil import pencil
from p2sf_explorer.compute.live import Live, live
from p2sf_explorer.compute.setup import default_state
from p2sf_explorer.state.panels import REGISTRY, view_of
from p2sf_explorer.state.state import change
from tests.support.lenses.mirrors import folded

SAME = (
    "psf profiles mtf matrix field_map colour spot ray_fan opd_fan zernike curves depth_of_field image database".split()
)
OTHER = {"lens", "prescription", "state", "request", "setup", "layout", "milliseconds", "seconds"}  # name the lens
# Sums over one more surface, in which 100 mm meet waves of 0.5 µm.
CLOSE = {"rtol": 1e-5, "atol": 1e-7}


def answer(lens: Lens, names: list[str], **changes: float | str) -> Live:
    views = {entry.key: view_of(entry) for entry in REGISTRY if entry.key in names}
    return live(change(default_state("lens", lens_to_toml(lens)), **changes), views=views)


def differences(one: object, two: object, place: str) -> list[str]:
    """Return where two answers differ by more than rounding, whatever they are made of."""
    if isinstance(one, Message) and isinstance(two, Message):
        return differences((one.template, one.values), (two.template, two.values), place)
    if isinstance(one, Later) and isinstance(two, Later):
        return differences(one(), two(), place)
    if type(one) is not type(two):
        return [f"{place}: {type(one)} and {type(two)}"]
    if isinstance(one, Mapping):
        parts = [(key, one[key], two.get(key)) for key in one if key not in OTHER]
    elif isinstance(one, list | tuple):
        parts = [(n, *pair) for n, pair in enumerate(zip(one, two, strict=True))]
    elif is_dataclass(one):
        names = [field.name for field in fields(one) if field.name not in OTHER]
        parts = [(name, getattr(one, name), getattr(two, name)) for name in names]
    elif isinstance(one, float | np.ndarray) and np.asarray(one).dtype.kind in "fc":
        scale = float(np.max(np.abs(one), where=np.isfinite(one), initial=1.0))
        same = np.allclose(one, two, CLOSE["rtol"], CLOSE["atol"] * scale, equal_nan=True)
        return [] if same else [f"{place}: {one} and {two}"]
    else:
        return [] if np.all(one == two) else [f"{place}: {one} and {two}"]
    return [found for name, a, b in parts for found in differences(a, b, f"{place}.{name}")]


@pytest.mark.parametrize("name", ["double_gauss_28", "reverse_telephoto"])
def test_a_mirror_behind_the_lens_changes_nothing_but_the_direction(name):
    lens = find_lens(name)
    where = {"depth_mm": 2100.0, "focus_mm": 1500.0, "field_deg": 7.0}  # no figure at a rounding tie
    names = [*SAME, "field", "chromatic", "through_focus", "solid"]
    before, after = (answer(each, names, **where) for each in (lens, folded(lens)))
    assert differences(before.psf, after.psf, "psf") == []
    assert differences(before.warnings, after.warnings, "warnings") == []
    for name in SAME:
        one, two = before.views[name], after.views[name]
        assert differences(one.found or one.question, two.found or two.question, name) == []
    # What lies behind the focus now lies on the other side of it.
    for name, curve in (("field", "real"), ("field", "third"), ("chromatic", "shift_um")):
        there, back = (np.asarray(getattr(each.views[name].found, curve)) for each in (before, after))
        np.testing.assert_allclose(back, -there, rtol=1e-6, atol=1e-6)
    assert after.views["chromatic"].found.depth_of_focus_um == pytest.approx(
        before.views["chromatic"].found.depth_of_focus_um
    )
    there, back = (np.array(each.views["through_focus"].question.shifts_um) for each in (before, after))
    np.testing.assert_allclose(back, -there[::-1])
    # The PSF rises from the sensor towards the light, and the wavefront stands before it.
    for each, towards in ((before, -1), (after, 1)):
        sensor = each.layout.drawing.sensor_z
        for mesh in (each.views["solid"].found.psf_surface.mesh, each.views["solid"].found.front.mesh):
            assert (towards * (mesh.points[:, 2] - sensor) > 0).all()


def test_the_dot_of_the_image_is_where_the_chief_ray_of_a_misaligned_lens_lands():
    moved = displaced(find_lens("cooke_triplet"), 3, 4, Placement(decentre_y=0.2))
    found = answer(moved, [], field_deg=7.0)
    z, y = found.layout.image
    chief = pencil(moved, Source(field_deg=7.0, wavelength_um=found.setup.source.wavelength_um), [0.0], [0.0])
    assert (z, y) == pytest.approx((moved.vertices[-1], chief.chief_um[1] / 1e3), abs=1e-9)  # rounding of 50 mm
