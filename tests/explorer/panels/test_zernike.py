"""The Zernike panel shows the terms of the wavefront that makes the picture, in both orders."""

import csv
import io

import numpy as np
import pytest

from p2sf.disc.zernike_terms import zernike_terms, zernike_values
from p2sf.pupil.zernike_fit import zernike_fit
from p2sf.raytrace.pencil import displayed_opd, pencil, pupil_grid
from p2sf_explorer.compute.live import live
from p2sf_explorer.compute.views.zernike import rows, zernike
from p2sf_explorer.state.state import new_state
from p2sf_explorer.widgets.copying import data_of
from tests.support.tiers import in_tiers
from tests.support.windows.events import choose

TELEPHOTO = {"lens": "telephoto", "field_deg": 7.0, "aim": "paraxial", "method": "traced"}


@pytest.fixture
def panel(window):
    window.store.update(**TELEPHOTO, tab="zernike")
    return window.panels["zernike"]


@pytest.mark.parametrize("order", ["noll", "fringe"])
@pytest.mark.parametrize("clip", [False, True])
def test_the_terms_are_those_of_the_library(order, clip):
    answer = live(new_state(**TELEPHOTO, clip=clip))
    ours = zernike(answer).found.fits[order]
    theirs = zernike_fit(answer.setup.lens, answer.setup.source, order, 37, clip)
    # The library finds the corners of a clipped pupil; the window takes a thousandth of its rim.
    assert np.allclose(ours.rms_waves, theirs.rms_waves, rtol=0, atol=2e-4 if clip else 1e-6)
    assert ours.clear == pytest.approx(theirs.clear, abs=1e-3) and (ours.clear < 1) == clip


@pytest.mark.parametrize("quality", ["preview", "settled"])
@pytest.mark.parametrize("clip", [False, True])
def test_panel_headline_and_pupil_agree(quality, clip):
    answer = live(new_state(**TELEPHOTO, clip=clip), quality)
    fit = zernike(answer).found.fits["noll"]
    assert fit.rms == pytest.approx(answer.pupil.rms, rel=0.01)
    values = answer.dominant.values
    term = values["term"].template if "term" in values else "defocus"
    assert 100 * sum(fit.share[[t.name == term for t in fit.terms]]) == pytest.approx(values["percent"], abs=1)


MISALIGNED = (("decentre_x", 3, 4, 0.05), ("tilt_x", 1, 2, 0.05))


def terms_of_a_grid(setup, clip):
    """Return Noll's terms by least squares over exact rays on a square grid, and the share of rays that pass."""
    xi, eta, inside = pupil_grid(300)
    passed = pencil(setup.lens, setup.source, xi[inside], eta[inside], clip=clip).passed
    xi, eta = xi[inside][passed], eta[inside][passed]
    columns, lengths = np.linalg.qr(zernike_values(zernike_terms("noll", 37), xi, eta).T)
    waves = displayed_opd(setup.lens, setup.source, xi, eta)
    return (columns * np.sign(np.diag(lengths))).T @ waves / np.sqrt(xi.size), passed.mean()


@pytest.mark.parametrize("quality", ["preview", "settled"])
@pytest.mark.parametrize(
    ("name", "field", "clip"),
    in_tiers(
        [("telephoto", 7.0, False), ("double_gauss_28", 7.0, False), ("petzval", 7.0, True)],
        [("telephoto", 7.0, False)],
    ),
)
def test_terms_of_a_misaligned_lens_are_over_the_whole_pupil(name, field, clip, quality):
    answer = live(new_state(lens=name, field_deg=field, method="traced", clip=clip, errors=MISALIGNED), quality)
    fit = zernike(answer).found.fits["noll"]
    expected, passed = terms_of_a_grid(answer.setup, clip)
    assert fit.clear == pytest.approx(passed, abs=0.003) and (passed < 1) == clip
    assert np.abs(expected[[k for k, term in enumerate(fit.terms) if not term.even]]).max() > 0.01
    assert np.allclose(fit.rms_waves, expected, rtol=0, atol=0.01 * np.abs(expected).max() if clip else 2e-3)
    assert fit.rms == pytest.approx(answer.pupil.rms, rel=0.01 if clip else 1e-3)
    assert len(rows(fit)) == 37


def test_the_six_coefficients_and_waves_by_hand_have_their_own_terms():
    answer = live(new_state(free_pupil=True, added_waves=(0.0, 1.5, 0.0, 0.0, 0.0, 0.0)))
    fit = zernike(answer).found.fits["noll"]
    assert fit.waves[6] == pytest.approx(1.5 / (3 * np.sqrt(8)), abs=1e-12)  # ρ²η = Z7/(3√8) + Z3/3
    assert fit.waves[2] == pytest.approx(1.5 / 3, abs=1e-12) and fit.share[6] == pytest.approx(1)


def test_the_panel_shows_bars_table_and_figures(window, panel):
    fit = window.live.views["zernike"].found.fits["noll"]
    zero = float(panel.chart.to_pixels(0.0, 0.0)[1])
    per_wave = zero - float(panel.chart.to_pixels(0.0, 1.0)[1])
    shown = dict(panel.chart.bars())
    assert set(shown) == {t.number for t in fit.terms if t.even and t.n > 1}
    for number, room in shown.items():
        assert room.height() == pytest.approx(abs(fit.waves[number - 1]) * per_wave, abs=1e-6)
        assert panel.chart.area.top() <= room.top() and room.bottom() <= panel.chart.area.bottom() + 1e-6
    assert [row[0] for row in rows(fit)][:4] == ["piston", "tilt", "defocus", "astigmatism"]
    text = panel.widget.readout.text()
    assert "RMS 0.144 λ" in text and "0.201 λ with tilt" in text and "whole pupil" in text
    assert "Z4: 0.0782 λ · 29.6 %" in panel.table.values


def test_the_chooser_switches_the_order_and_its_unit(panel):
    choose(panel.order, "fringe")
    assert panel.chart.labels[1] == "peak, waves"
    assert any(value.startswith("Z8: −0.193") for value in panel.table.values)  # coma, √8 times Noll's −0.0685


def test_with_clip_the_panel_says_gram_schmidt(window, panel):
    window.store.update(clip=True)
    assert "Gram–Schmidt over 96 % of the pupil" in panel.widget.readout.text()


def test_all_terms_are_copied_as_csv(panel):
    table = list(csv.reader(io.StringIO(data_of(panel.widget))))
    assert table[0] == ["noll term", "n", "m", "name", "waves RMS", "share of variance"]
    assert [row[0] for row in table[1:]] == [str(number) for number in range(1, 38)]
    assert float(table[4][4]) == pytest.approx(0.0782, abs=1e-4) and float(table[4][5]) == pytest.approx(
        0.296, abs=1e-3
    )


def test_a_minus_b_is_the_difference_of_the_coefficients(window, panel):
    from p2sf_explorer.state.pinning import pin

    own = window.live.views["zernike"].found.fits["noll"].waves
    window.store.replace(pin(window.store.state))
    window.store.update(field_deg=5.0, shown="difference")
    found = window.live.views["zernike"].found.fits["noll"].waves
    other = zernike(live(new_state(**{**TELEPHOTO, "field_deg": 5.0}))).found.fits["noll"].waves
    assert found == pytest.approx(other - own, abs=1e-9)
