"""One RMS of the wavefront on every road: without piston and tilt, over the pupil in force."""

import numpy as np
import pytest
from matplotlib.figure import Figure
from numpy.polynomial.legendre import leggauss

import p2sf
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.raytrace.pencil import displayed_opd
from p2sf.tolerance.differentials import differentials
from p2sf.tolerance.files import back_focus
from p2sf.tolerance.single import sensitivities
from p2sf_explorer.compare.comparison import difference
from p2sf_explorer.compute.autofocus import best_shift_um
from p2sf_explorer.compute.live import live
from p2sf_explorer.compute.matrix.pictures import settle
from p2sf_explorer.compute.matrix.points import matrix_request
from p2sf_explorer.compute.pupil import pupil_of
from p2sf_explorer.compute.setup import paraxial_setup
from p2sf_explorer.compute.views.zernike import zernike
from p2sf_explorer.lessons.measures import MEASURES
from p2sf_explorer.notebook_widget import draw_pupil
from p2sf_explorer.panels.zernike import figures
from p2sf_explorer.state.state import change, new_state
from tests.support.waves import rms_about_plane

TELEPHOTO = {"lens": "telephoto", "field_deg": 7.0}  # whose wavefront has as much tilt as anything else


def polar(radii: int = 30, directions: int = 60):
    """Return ξ, η and shares of a Gauss rule over the disc, of other points than the program's."""
    node, weight = leggauss(radii)
    rho, angle = np.sqrt((1 + node) / 2), 2 * np.pi * (np.arange(directions) + 0.25) / directions
    share = np.repeat(weight, directions) / (2 * directions)
    return np.outer(rho, np.sin(angle)).ravel(), np.outer(rho, np.cos(angle)).ravel(), share


def own_sums(state):
    """Return the RMS without tilt and with it, by a sum over exact rays."""
    setup, (xi, eta, share) = paraxial_setup(state), polar()
    waves = displayed_opd(setup.lens, setup.source, xi, eta)
    return rms_about_plane(waves, xi, eta, share), float(np.sqrt(share @ (waves - share @ waves) ** 2))


def test_every_road_has_the_rms_without_tilt(answer):
    state = new_state(**TELEPHOTO)
    rms, tilted = own_sums(state)
    assert tilted > 1.2 * rms
    shown, library = live(state), p2sf.Camera(p2sf.load_lens("telephoto")).at(p2sf.Source(field_deg=7)).zernike()
    fit, written = zernike(shown).found.fits["noll"], answer("zernike", "telephoto", "--field-deg", "7")
    roads = {
        "pupil": shown.pupil.rms,
        "panel Zernike": fit.rms,
        "library": library.rms,
        "command line": written["rms"],
        "lessons": MEASURES["rms_waves"](state),
    }
    assert roads == pytest.approx(dict.fromkeys(roads, rms), rel=1e-5)
    assert live(state, "preview").pupil.rms == pytest.approx(rms, rel=1e-3)  # of a fit of order 8
    with_tilt = (fit.rms_with_tilt, library.rms_with_tilt, written["rms_with_tilt"])
    assert with_tilt == pytest.approx([tilted] * 3, rel=1e-5)
    figure = Figure()
    axes = figure.add_subplot()
    draw_pupil(figure, axes, shown)
    one = change(state, matrix_what="pupil", matrix_across="sensor_shift_um", matrix_shifts_um=(0.0, 50.0))
    one = change(one, matrix_fields_deg=(7.0, 3.0))
    request = matrix_request(live(one))
    tiles = settle(request, lambda: False, lambda share, tiles: None)
    for text in (axes.get_title(), figures(fit, "")[0], str(tiles[request.rows.index(7.0)][0].figure)):
        assert f"{rms:.3g}" in text


@pytest.mark.parametrize(("name", "field"), [("cooke_triplet", 14.0), ("double_gauss_28", 10.0), ("telephoto", 7.0)])
def test_tolerances_have_it_too(name, field):
    """Wide open, where the phase at the focus has another: 0.5 to 1.3 % off."""
    lens = find_lens(name)
    source = Source(field_deg=field)
    nominal = sensitivities(differentials(lens, [source], [back_focus(lens)])).rms_waves[-1, 0]
    xi, eta, share = polar()
    assert nominal == pytest.approx(rms_about_plane(displayed_opd(lens, source, xi, eta), xi, eta, share), rel=1e-6)


def test_a_difference_has_the_rms_of_what_differs():
    """Of one wave of defocus 1/√12, over the disc alone: maps go on a pixel beyond the rim, which would be 1 % more."""
    one, other = (new_state(free_pupil=True, added_waves=(0.4, 0.0, 0.0, 0.0, wd, 0.0)) for wd in (1.0, 0.0))
    minus = difference(live(one), live(other)).pupil
    assert minus.rms == pytest.approx(1 / np.sqrt(12), rel=2e-3)  # cells of a 384th, all or nothing at the rim


@pytest.mark.parametrize(
    "entries",
    [
        {"field_deg": 14.0},
        {"field_deg": 14.0, "clip": True},
        {"lens": "fast_gauss_f14", "field_deg": 15.0, "clip": True},
        {"lens": "cooke_triplet", "field_deg": 10.0, "errors": (("decentre_y", 3, 4, 0.2),)},
        {"lens": "cassegrain_f10", "field_deg": 0.2},
    ],
    ids=str,
)
def test_autofocus_finds_the_smallest_rms_that_the_pupil_shows(entries):
    """On either side, by a tenth of a wave of defocus, the RMS that the window shows is larger, and the same."""
    state = new_state(**entries)
    best = best_shift_um(state)
    setup = paraxial_setup(state)
    step = 0.1 * 2 * setup.source.wavelength_um / float(setup.coefficients.na) ** 2
    less, least, more = (
        pupil_of(paraxial_setup(change(state, sensor_shift_um=best + by)), True, "settled", state.optics.clip).rms
        for by in (-step, 0.0, step)
    )
    assert least < min(less, more)
    # The RMS squared is quadratic in the shift: a focus off by a fifth of the step would tilt it by 4/5 of its rise.
    assert abs(more**2 - less**2) < 0.2 * (more**2 + less**2 - 2 * least**2)
