"""The picture while a slider moves is near the exact one, by as few numbers as do, and says by how many."""

import pytest

from p2sf.figures.compare import r_squared
from p2sf.psf.methods import render
from p2sf.psf.picture import psf_of_pupil
from p2sf.pupil.fit import fit
from p2sf_explorer.compute import preview as quick
from p2sf_explorer.compute.method import window_um
from p2sf_explorer.compute.preview import best_fit, preview_psf
from p2sf_explorer.compute.setup import default_state, paraxial_setup
from p2sf_explorer.state.state import change

PIXELS = 64


def moving(lens, **changes):
    """Return what moves, its window, and the exact picture in it."""
    setup = paraxial_setup(change(default_state(lens), aim="paraxial", **changes))  # 26 numbers and more, no weights
    made = quick.preview(setup)
    window = PIXELS, window_um(setup) / PIXELS
    return made, window, render(setup.lens, setup.source, "traced", *window).values


@pytest.mark.parametrize(("shift", "few"), [(0.0, 0.9), (-100.0, 0.95)])
def test_where_few_numbers_are_wrong_more_are_taken(shift, few):
    made, window, exact = moving("petzval", f_number=1.6, field_deg=0.0, sensor_shift_um=shift)
    alone = psf_of_pupil(fit(made.setup.lens, made.setup.source, 26), window, "preview")
    assert r_squared(alone.values, exact) < few
    shown = preview_psf(made, *window)
    assert (shown.method, shown.numbers) == ("fitted", 46)
    assert r_squared(shown.values, exact) > 0.999  # a residual below 0.02 λ leaves (2π·0.02)² = 0.016 at most


def test_where_few_numbers_do_no_more_are_taken():
    made, window, exact = moving("double_gauss_28")
    shown = preview_psf(made, *window)
    assert shown.numbers == 26
    assert r_squared(shown.values, exact) > 0.999


def test_where_no_fit_comes_near_exact_rays_make_the_picture(monkeypatch):
    made, window, exact = moving("tessar")
    monkeypatch.setattr(quick, "FAR", 0.0)
    shown = preview_psf(made, *window)
    assert shown.method == "traced"
    assert r_squared(shown.values, exact) > 0.999


def test_a_fit_of_more_rays_is_left_where_one_of_them_is_lost(monkeypatch):
    made = quick.preview(
        paraxial_setup(change(default_state("telephoto"), aim="paraxial", f_number=4.5, field_deg=0.0))
    )
    assert best_fit(made).numbers == 72

    def lost(*_, **__):
        raise quick.GeometryError("lost")

    monkeypatch.setattr(quick, "fit", lost)
    assert best_fit(made).numbers == 46
