"""The first-order panel against a paraxial trace written out here: signs that fit each other, for every lens."""

from math import inf, isinf

import numpy as np
import pytest

from p2sf.lens.lens import indices
from p2sf.lensfile.library import shipped_lenses
from p2sf_explorer.compute.live import live
from p2sf_explorer.compute.setup import default_state
from p2sf_explorer.compute.views.first_order import pupil_rows, source_rows
from p2sf_explorer.state.state import change
from tests.support.tiers import in_tiers


def traced(lens, wavelength, y, u, first=0, last=None):
    """Return height at and slope behind the last surface of a ray given before surface ``first``, by y–u tracing."""
    index = indices(lens, wavelength)
    last = len(lens.surfaces) if last is None else last
    for k in range(first, last):
        s = lens.surfaces[k]
        u = (index[k] * u - y * s.curvature * (index[k + 1] - index[k])) / index[k + 1]
        if k + 1 < last:
            y = y + u * s.thickness
    return y, u


def numbers(rows):
    return {name: message.values.get("value") for name, message, _ in rows}


@pytest.mark.parametrize("name", in_tiers(sorted(set(shipped_lenses()) - {"diffractive_singlet"})))  # `traced` refracts
@pytest.mark.parametrize("depth", [None, 2000.0])
def test_heights_magnification_aperture_and_pupils_fit_each_other(name, depth):
    state = change(default_state(name), field_deg=1.0)
    depth = depth or (state.optics.depth_mm if not isinf(state.optics.depth_mm) else 600.0)
    if name == "relay" and depth == 2000.0:
        depth = 120.0  # it images near objects only
    answer = live(change(state, depth_mm=depth, method="seidel"), "preview")
    lens, wavelength, setup = answer.setup.lens, answer.setup.source.wavelength_um, answer.setup
    index = indices(lens, wavelength)
    shown = numbers(source_rows(answer))
    object_y = shown["Object height"]
    # The chief ray from the object point through the centre of the entrance pupil, then to sensor and image.
    entrance = float(setup.pupils.entrance_from_first)
    slope = -object_y / (depth + entrance)
    assert slope == pytest.approx(np.tan(np.deg2rad(1.0)), rel=1e-12)
    y, u = traced(lens, wavelength, object_y + slope * depth, slope)
    assert y + u * lens.sensor_mm == pytest.approx(shown["Image height"], rel=1e-9, abs=1e-12)
    image = shown["Paraxial image"]
    # The axial ray tells the place of the image and, by the sine of its slopes, the magnification nu/(n'u').
    axial_y, axial_u = traced(lens, wavelength, depth * 1e-3, 1e-3)
    assert image == pytest.approx(-axial_y / axial_u, rel=1e-9)
    assert shown["Magnification"] == pytest.approx(index[0] * 1e-3 / (index[-1] * axial_u), rel=1e-9)
    assert y + u * image == pytest.approx(shown["Magnification"] * object_y, rel=1e-9)
    assert answer.layout.source[1] == object_y and answer.layout.image[1] == pytest.approx(y + u * image, rel=1e-9)
    aperture = numbers(pupil_rows(answer))
    stop = int(setup.stop.surface)
    rim_y, _ = traced(lens, wavelength, depth * 1e-3, 1e-3, last=stop)
    na = abs(index[-1] * axial_u * float(setup.stop.semi_diameter) / rim_y)
    assert aperture["Numerical aperture"] == pytest.approx(na, rel=1e-9)
    # H = n(ūy − uȳ) at the object is −n·u·y_object, and at the image −n'u'·y_image (Welford 1986, §2.6).
    marginal = 1e-3 * float(setup.stop.semi_diameter) / abs(rim_y) * np.sign(depth + entrance)
    assert aperture["Lagrange invariant"] == pytest.approx(-index[0] * marginal * object_y, rel=1e-9)
    assert -index[-1] * marginal * axial_u / 1e-3 * (y + u * image) == pytest.approx(aperture["Lagrange invariant"])


@pytest.mark.slow
def test_the_relay_inverts_and_says_so_everywhere():
    answer = live(change(default_state("relay"), field_deg=1.0, method="seidel"))
    shown = numbers(source_rows(answer))
    assert shown["Magnification"] == pytest.approx(-1, abs=0.01)
    assert shown["Object height"] > 0 > shown["Image height"]
    assert answer.layout.source[1] > 0 > answer.layout.image[1]


def test_an_object_at_infinity_has_no_height():
    answer = live(change(default_state("double_gauss_28"), depth_mm=inf, method="seidel"))
    assert numbers(source_rows(answer))["Object height"] is None and answer.layout.source is None


def test_the_control_and_the_panel_show_one_object_height(window):
    window.store.update(lens="relay", depth_mm=94.0, field_deg=1.0, tab="first_order")
    note = window.controls.rows["field_deg"].note.text()
    assert note.startswith("object 28.") and "image −28." in note
