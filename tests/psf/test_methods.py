"""Every method behind one function, a choice that keeps its tolerance, and the measured trade-off."""

import inspect
import json
import re
from dataclasses import replace
from io import BytesIO
from math import inf
from pathlib import Path
from typing import get_args

import numpy as np
import pytest

import p2sf
from p2sf import api
from p2sf.disc.mask import PupilMask
from p2sf.errors import GeometryError, RequestError, SamplingError
from p2sf.figures.compare import flatness_of, r_squared
from p2sf.lens.lens import Aperture, with_aim, with_f_number, with_mask, with_sensor
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.paraxial.first_order import image_distance
from p2sf.paraxial.wavefront import wavefront
from p2sf.psf import choosing, cost, methods
from p2sf.psf.choosing import QUICK_LEVELS, REASONS, Choice, choose
from p2sf.psf.huygens import huygens_psf
from p2sf.psf.methods import NAMES, PsfOptions, PsfRequest, render
from p2sf.psf.pixel_integrals import render_integrated
from p2sf.psf.prediction import CAUTION, predicted_error, residual_for, seidel_sigma
from p2sf.pupil import smooth_pupil
from p2sf.pupil.cost import SAMPLE_SECONDS
from p2sf.pupil.fit import level_rays
from p2sf.studies.tradeoff import draw, error, front, table, to_json, tradeoff
from tests.long.method_choice import Trial, summary, trials
from tests.support.lenses.shaped_lenses import ODD, singlet
from tests.support.rays.made_rays import made_rays
from tests.support.rays.pencils import double_gauss
from tests.support.reference import case, huygens_rows
from tests.support.waves import waves


def off_axis():
    row, stored, _ = huygens_rows("double_gauss_28")[2]
    return *case("double_gauss_28", row), row["pixel_um"], stored


@pytest.mark.parametrize("method", NAMES)
def test_every_method_returns_the_same_kind_of_psf(method):
    lens, source, pixel, _ = off_axis()
    psf = render(lens, source, method, 32, pixel)
    assert psf.method == method and psf.values.shape == (32, 32) and psf.pixel_um == pixel
    assert psf.values.sum() == pytest.approx(1)
    assert psf.strehl is None if method == "gaussian" else 0 < psf.strehl <= 1


@pytest.mark.parametrize(("waves_off", "frequency_off"), [(0.0, 2e-3), (0.01, 0.0), (0.01, -2e-3)])
def test_six_coefficients_miss_by_their_phase_and_by_where_diffraction_takes_their_frequency(waves_off, frequency_off):
    """Rays that land at x = 0 and are the six coefficients' own, but for a step of phase and a miss of frequency."""
    c, points = waves(0.3, -0.2, 0.1, 0.0, 0.0, 0.4), level_rays(QUICK_LEVELS[0])
    xi, eta, weight = points
    scale, side = float(c.reduced_slope) / float(c.wavelength_um), np.where(xi > np.median(xi), 1.0, -1.0)
    off = waves_off * side + 0.7  # a constant phase is no error
    zero = 0 * xi
    rays = made_rays(off - wavefront(c, xi, eta), scale * xi + frequency_off, scale * eta, zero, zero)
    own = side[: weight.size]
    wanted = np.hypot(waves_off * np.sqrt(1 - (weight @ own) ** 2), frequency_off * 5.0)
    assert seidel_sigma(c, rays, points, 5.0) == pytest.approx(wanted, rel=1e-12)


def test_methods_rank_by_accuracy():
    lens, source, pixel, stored = off_axis()
    score = {m: r_squared(render(lens, source, m, 32, pixel).values, stored) for m in NAMES}
    assert score["seidel"] == pytest.approx(-0.599, abs=0.002)
    assert score["seidel"] < score["gaussian"] < 0.998 < score["fitted"] < score["traced"] <= score["huygens"]


@pytest.mark.parametrize("method", ["seidel", "fitted", "traced", "huygens"])
def test_quality_passes_through(method):
    lens, source, pixel, _ = off_axis()
    preview, settled = (render(lens, source, method, 32, pixel, PsfOptions(q)) for q in ("preview", "settled"))
    assert preview.error is None and settled.error is not None
    # The preview of six coefficients is a 128² grid with a hard edge: 4e-2 of the light here.
    assert r_squared(preview.values, settled.values) > (0.9 if method == "seidel" else 0.9999)


def nearer_the_axis():
    """Return the lens at 11°, where plane waves suffice."""
    lens, source, _, _ = off_axis()
    return lens, replace(source, field_slope=0.2)


def test_auto_takes_the_method_that_choose_names():
    lens, source = nearer_the_axis()
    made = render(lens, source, options=PsfOptions(min_r2=0.99))
    assert choose(lens, source, 0.99).method == "traced" == made.method
    slow = replace(lens, aperture=Aperture("stop_semi_diameter", 1.0))
    assert choose(slow, replace(source, field_slope=0.0), 0.99).method == "seidel"


def test_tighter_tolerances_cost_more_and_promise_more():
    lens, source = nearer_the_axis()
    chosen = [choose(lens, source, t) for t in (0.9, 0.99, 0.999, 0.99999, 1 - 1e-7)]
    assert [c.method for c in chosen] == ["traced", "traced", "spherical", "spherical", "spherical"]
    assert not any(c.numbers for c in chosen)
    errors = [c.predicted_error for c in chosen]
    assert all(error <= 1 - t for error, t in zip(errors, (0.9, 0.99, 0.999, 0.99999, 1 - 1e-7), strict=True))
    assert errors == sorted(errors, reverse=True)
    assert all("1 − R²" in str(c.reason) for c in chosen)


def test_a_fit_is_taken_where_it_spares_rays(monkeypatch):
    """Behind a mask `traced` takes a ray for every node; of a clear pupil both take the rays of one coarse pencil."""
    lens, source = nearer_the_axis()
    rays: list[int] = []

    def counted(trace):
        def traced(lens, source, xi, eta, **more):
            rays.append(len(xi))
            return trace(lens, source, xi, eta, **more)

        return traced

    for module in (smooth_pupil, choosing):
        monkeypatch.setattr(module, "pencil", counted(module.pencil))
    assert choose(lens, replace(source, field_slope=0.201), 0.99).method == "traced" and rays == [252]
    rays.clear()
    masked = choose(with_mask(lens, PupilMask(obscuration=0.3)), source, 0.99)
    assert masked.method == "fitted" and masked.numbers == 26 and masked.seidel_error > masked.allowed_error


def test_a_fast_petzval_is_traced():
    lens, source = case("petzval", huygens_rows("petzval")[1][0])
    choice = choose(lens, source, 0.99)
    assert choice.method == "traced" and choice.lost_rays == 0 and choice.tried_rays == 252
    assert choice.allowed_error < choice.seidel_error and choice.fitted_error is None
    assert choose(lens, source, 0.999).method == "spherical"  # plane waves of so wide a blur are not known to keep it


def test_the_promise_holds_in_a_window_that_is_nearly_flat():
    """It shows the middle of the peak, where R² compares errors with a tenth of the light; seidel left 0.105 of it."""
    lens = with_f_number(find_lens("achromat_f6"), 4.858109721474289)
    source = Source(field_deg=3.836275262, wavelength_nm=1930.533442)
    found = render(lens, source, "auto", 32, 0.5993852477512274, PsfOptions(min_r2=0.9))
    reference = render(lens, source, "spherical", 32, 0.5993852477512274)
    assert 1 - r_squared(found.values, reference.values) <= found.predicted_error <= 0.1
    flat, dark = np.array([0.9, 1.1, 1.0, 1.0]), np.array([1.0, -1.0, 0.0, 0.0])
    assert flatness_of(flat) == pytest.approx(4.02 / 0.02) and flatness_of(dark) == 1 == flatness_of(np.ones(1))


TRIED = {"tried_rays": 64, "allowed_error": 0.01}


@pytest.mark.parametrize(
    ("choice", "reason"),
    [
        (Choice("seidel", 2e-3, 6, **TRIED), "six coefficients keep 1 − R² ≤ 2.0e-03, where 1.0e-02 is allowed"),
        (
            Choice("fitted", 3e-3, 26, **TRIED, seidel_error=1.4),
            "26 fitted numbers keep 1 − R² ≤ 3.0e-03, where 1.0e-02 is allowed and six coefficients would leave more",
        ),
        (
            Choice("traced", 5e-5, 0, **TRIED, fitted_error=0.02, fitted_numbers=46),
            "exact rays, since 46 fitted numbers leave 1 − R² ≤ 2.0e-02 only",
        ),
        (
            Choice("traced", 5e-5, 0, **TRIED, seidel_error=41.0),
            "exact rays, which cost a single picture no more than a fit, where six coefficients may leave "
            "1 − R² = 1.0e+00",
        ),
        (
            Choice("huygens", 1e-8, 0, lost_rays=7, **TRIED),
            "the reference itself, since 7 of 64 rays are lost, and a smooth pupil does not describe that",
        ),
    ],
    ids=lambda value: getattr(value, "method", ""),
)
def test_a_choice_gives_its_reason(choice, reason):
    assert str(choice.reason) == reason


@pytest.mark.slow
def test_choose_never_picks_a_method_below_the_tolerance(capsys):
    outcomes = list(trials(12, seed=2, most_seconds=2.0))
    with capsys.disabled():
        print("\n" + summary(outcomes))
    assert not [outcome for outcome in outcomes if isinstance(outcome, Trial) and outcome.wrong]


def test_a_fit_takes_the_numbers_that_the_tolerance_asks_for():
    lens, source, pixel, _ = off_axis()
    coarse, fine = (render(lens, source, "fitted", 32, pixel, PsfOptions(min_r2=t)) for t in (0.99, 0.9999))
    assert (coarse.numbers, fine.numbers) == (26, 46)
    assert predicted_error(residual_for(0.9999), "fitted") == pytest.approx(1e-4)


@pytest.mark.parametrize("method", NAMES)
def test_every_method_predicts_at_least_the_error_it_makes(method):
    lens, source, pixel, _ = off_axis()
    made, reference = render(lens, source, method, 64, pixel), huygens_psf(lens, source, 64, pixel)
    if method == "spherical":
        assert made.predicted_error < 0.1 * CAUTION < made.plane_wave_error  # of the whole PSF; here is its core
        return
    assert made.predicted_error >= 1 - r_squared(made.values, reference.values) - 1e-12  # round-off of R²
    own = made.predicted_error / flatness_of(made.values)  # of the whole PSF
    assert method == "fitted" or (own > CAUTION) == (method in ("seidel", "gaussian"))


@pytest.mark.slow
def test_a_fit_that_fails_near_total_reflection_says_so():
    """No polynomial follows a phase of unbounded slope; the sum of the fit itself is as exact as ever."""
    lens = with_aim(
        with_f_number(find_lens("tessar"), 150.0), "paraxial"
    )  # so far off, no ray reaches the stop's centre
    source = Source(inf, np.tan(np.deg2rad(37.3555)), 0.5876)
    made = render(lens, source, "fitted", 64, 30.0)
    reference = huygens_psf(lens, source, 64, 30.0, None)
    assert 1 - r_squared(made.values, reference.values) > 1e-4 >= made.error
    assert made.predicted_error > CAUTION


@pytest.mark.slow
def test_six_coefficients_promise_nothing_where_rays_are_lost():
    lens = with_aim(with_f_number(find_lens("double_gauss_28"), 2.8), "paraxial")  # the stop's own rays all arrive
    source = Source(inf, np.tan(np.deg2rad(34.0)), 0.5876)
    assert render(lens, source, "seidel", 32, 100.0).predicted_error == inf


def test_rims_clip_whatever_describes_the_pupil():
    lens, source, pixel, _ = off_axis()
    exact = render(lens, source, "huygens", 32, pixel, PsfOptions(clip=True))
    found = {name: render(lens, source, name, 32, pixel, PsfOptions(clip=True)) for name in ("seidel", "fitted")}
    fitted = found["fitted"]
    assert 1 - r_squared(fitted.values, exact.values) < max(fitted.predicted_error, 1e-4)
    assert fitted.strehl == pytest.approx(exact.strehl, rel=0.02) and fitted.energy == pytest.approx(exact.energy, 0.01)
    for name, psf in found.items():
        whole = render(lens, source, name, 32, pixel)
        assert psf.method == name and 1 - r_squared(psf.values, whole.values) > 1e-3
        on_axis = replace(source, field_slope=0.0)
        same = [render(lens, on_axis, name, 32, pixel, PsfOptions(clip=clip)).values for clip in (True, False)]
        assert 1 - r_squared(*same) < 1e-6
    choice = choose(lens, source, clip=True)
    assert 0 < choice.lost_rays < choice.tried_rays == 252
    auto = render(lens, source, "auto", 32, pixel, PsfOptions(clip=True))
    reference = render(lens, source, "spherical", 32, pixel, PsfOptions(clip=True))
    assert auto.method == "spherical" and r_squared(auto.values, reference.values) > 0.99


def test_unknown_methods_and_qualities_and_bad_tolerances_are_refused():
    lens, source, pixel, _ = off_axis()
    with pytest.raises(RequestError, match="choose auto, gaussian, seidel"):
        render(lens, source, "magic", 32, pixel)
    with pytest.raises(SamplingError, match="settled"):
        render(lens, source, "traced", 32, pixel, PsfOptions("quick"))
    with pytest.raises(RequestError, match="below 1"):
        choose(lens, source, 1.0)
    with pytest.raises(GeometryError, match="chief ray"):
        choose(lens, Source(inf, 5.0, 0.6562725), 0.99)


@pytest.mark.slow
def test_the_trade_is_one_table_one_picture_and_one_json():
    lens = replace(double_gauss(), fields_deg=(0.0, 14.0))
    rows = tradeoff(lens, pixels=16)
    assert {row.method for row in rows} == {methods.AUTO, *NAMES} and {row.field_deg for row in rows} == {0.0, 14.0}
    plain = json.loads(to_json(rows))
    assert len(plain) == len(rows) and plain[0]["depth_mm"] is None
    assert all(row.seconds > 0 and row.bytes > 0 for row in rows)
    lines = table(rows)
    assert len(lines) == len(rows) + 1 and len({len(line) for line in lines}) == 1
    picture = BytesIO()
    draw(picture, rows, "Double Gauss")
    assert picture.getvalue().startswith(b"\x89PNG")
    best = front(rows)
    assert [r.seconds for r in best] == sorted(r.seconds for r in best)
    assert np.all(np.diff([error(r) for r in best]) < 0)


def test_a_lens_without_seidel_sums_is_rendered_by_rays_and_refused_by_the_six_coefficients():
    """A term in r³: `auto` fits or traces, the window is found from rays, and *seidel* names surface and term."""
    lens = singlet({"shape": ODD})
    lens = with_sensor(lens, float(image_distance(lens, np.inf, 0.55)))
    source = Source(field_slope=0.03, wavelength_um=0.55)
    choice = choose(lens, source)
    assert choice.method in ("fitted", "traced") and choice.seidel_error == np.inf
    true, quick = (render(lens, source, method, pixels=32) for method in ("huygens", "auto"))
    inside = true.values[2:-2, 2:-2].sum() / true.values.sum()
    assert true.pixel_um == quick.pixel_um and inside > 0.99, "no light at the edge of the window"
    assert r_squared(true.values, quick.values) > 0.99
    with pytest.raises(GeometryError, match="surface 2 has a term in r³"):
        render(lens, source, "seidel", pixels=32)


def test_every_text_that_lists_the_methods_names_all_of_them():
    """Docstrings of the library by what their signatures take; README and theory a row of a table for each."""
    for call in vars(api).values():
        own = inspect.unwrap(call) if inspect.isfunction(call) else None
        taken = inspect.signature(own).parameters.get("method") if own else None
        if taken is not None and taken.annotation in (api.Method, api.PupilMethod):
            stated = re.search(r"^    method : \{(.*)\}$", call.__doc__ or "", re.MULTILINE)
            assert stated is None or set(re.findall(r'"(\w+)"', stated[1])) == set(get_args(taken.annotation)), call
    root = Path(p2sf.__file__).parents[1]
    for path in ("README.md", "app/p2sf_explorer/handbook/theory.md"):
        text = root.joinpath(path).read_text("utf-8")
        table = text[text.index("| method | what describes one PSF |") :].split("\n\n")[0]
        assert tuple(re.findall(r"^\| `(\w+)` \|", table, re.MULTILINE)) == NAMES, path


def test_a_method_with_a_grid_of_its_own_says_what_it_costs(monkeypatch):
    """Whatever rays do: also where rims clip them, which makes the cost of other methods of rays unknown."""
    lens, source, pixel, _ = off_axis()
    grid = replace(methods.TRACED, name="own grid", nodes=lambda request: 128.0**2, node_seconds=1e-6)
    monkeypatch.setattr(methods, "METHODS", (*methods.METHODS, grid))
    asked = PsfRequest(lens, source, "own grid", (32, pixel), PsfOptions(clip=True))
    assert cost.node_count(asked, None) == 128.0**2 and cost.nodes_beyond(asked, None) == 0
    assert cost.predicted_seconds(asked, None) == pytest.approx(128**2 * 1e-6 + SAMPLE_SECONDS * 32**2)
    assert cost.predicted_seconds(replace(asked, method="traced"), None) == inf


def test_a_method_that_describes_no_pupil_makes_its_own_picture(monkeypatch):
    """Only one that is made from the reference's picture is taken from it."""
    lens, source, pixel, _ = off_axis()
    own = replace(methods.FITTED, name="own", over_frequency=None)
    monkeypatch.setattr(methods, "METHODS", (*methods.METHODS, own))
    made, fitted = (render_integrated(lens, source, method, 16, pixel) for method in ("own", "fitted"))
    assert np.array_equal(made.values, fitted.values)


def test_every_list_of_methods_names_those_there_are():
    """Types and defaults of the library and the command line are written out; the list of methods is what counts."""
    wanted = {methods.AUTO, *NAMES}
    assert set(get_args(api.Method)) == wanted
    assert set(inspect.signature(tradeoff).parameters["methods"].default) == wanted
    described = {method.name for method in methods.METHODS if method.over_frequency}
    assert set(get_args(api.PupilMethod)) == {methods.AUTO, *described}
    assert set(REASONS) == described  # those that `choose` takes


def test_the_reference_adds_to_what_plane_waves_miss_that_its_sum_settles_to_a_ten_thousandth():
    """1e-4 of the picture is 1e-8 of R²."""
    choice = choose(with_f_number(find_lens("petzval"), 2.8), Source(field_deg=14.0), 0.99997, clip=True)
    assert choice.method == "huygens"
    assert choice.predicted_error - choice.plane_wave_error == pytest.approx(1e-8, rel=1e-6)
