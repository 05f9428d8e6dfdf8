"""Every picture of a matrix is the one that its point has by itself, made on another way."""

from dataclasses import replace

import numpy as np
import pytest

import p2sf
from p2sf.figures.compare import r_squared
from p2sf.figures.window import radius_of_energy
from p2sf.psf.huygens import huygens_psf
from p2sf.psf.methods import PsfOptions, render
from p2sf_explorer.compute.framing import light_rings
from p2sf_explorer.compute.live import Live, live, with_views
from p2sf_explorer.compute.matrix import pictures
from p2sf_explorer.compute.matrix.pictures import HELD, matrix, previews, settle
from p2sf_explorer.compute.matrix.points import matrix_request, nearest
from p2sf_explorer.compute.matrix.tiles import figures, peaks, scales, worst
from p2sf_explorer.compute.sampled import in_window
from p2sf_explorer.compute.setup import default_state, paraxial_setup
from p2sf_explorer.compute.views import rays
from p2sf_explorer.state.panels import REGISTRY, view_of
from p2sf_explorer.state.state import change, new_state
from tests.support.waves import rms_about_plane

TRIPLET = change(default_state("cooke_triplet"), f_number=8.0)
SHAPES = ("wavelength_nm", "depth_mm", "sensor_shift_um")


def request_of(state, **entries):
    return matrix_request(live(change(state, **entries), "preview"))


def worked(request):
    told = []
    return settle(request, lambda: False, lambda share, tiles: told.append((share, tiles))), told


def each(request, tiles):
    rows = zip(request.states, tiles, strict=True)
    return [pair for states, line in rows for pair in zip(states, line, strict=True)]


@pytest.mark.parametrize("across", SHAPES)
def test_a_preview_traced_with_others_is_the_one_traced_alone(across):
    request = request_of(TRIPLET, matrix_across=across, depth_mm=3000.0, focus_mm=3000.0)
    for state, tile in each(request, previews(request)):
        light = tile.content
        window = 128, light.width_um / 128
        alone = in_window(state, window, False)
        values = light.values / light.values.sum()
        # Both sum one fit in float32; the rays differ by the rounding of Newton's steps.
        assert np.abs(values - alone.values).max() < 2e-5 * alone.values.max()
        assert tile.error == pytest.approx(alone.predicted_error, rel=1e-2) and not tile.settled


@pytest.mark.parametrize("method", ["auto", "seidel", "fitted", "traced"])
def test_a_settled_picture_is_that_of_the_library(method):
    request = request_of(TRIPLET, method=method, matrix_rows=2, matrix_columns=2)
    tiles, told = worked(request)
    assert [share for share, _ in told] == [0.25, 0.5, 0.75, 1.0]
    for state, tile in each(request, tiles):
        setup = paraxial_setup(state)
        count = tile.content.values.shape[0]
        window = count, tile.content.width_um / count
        psf = render(setup.lens, setup.source, method, *window, PsfOptions(min_r2=state.optics.tolerance))
        values = tile.content.values * window[1] ** 2
        energy = 1.0 if psf.energy is None else psf.energy
        np.testing.assert_allclose(values, psf.values * energy, rtol=1e-6, atol=1e-9 * psf.values.max())
        assert tile.settled and (method == "auto" or tile.method == method)
        assert tile.error == pytest.approx(psf.predicted_error, rel=1e-12)  # rounding of what the window holds


def test_previews_keep_the_r_squared_that_they_are_predicted():
    request = request_of(TRIPLET, matrix_rows=2, matrix_columns=2)
    for state, tile in each(request, previews(request)):
        setup, width = paraxial_setup(state), tile.content.width_um
        reference = huygens_psf(setup.lens, setup.source, 128, width / 128, rtol=None)
        values = tile.content.values / tile.content.values.sum()
        assert 1 - r_squared(values, reference.values) <= tile.error


@pytest.mark.parametrize("what", ["spot", "ray_fan", "opd_fan"])
@pytest.mark.parametrize("across", SHAPES)
def test_rays_are_those_of_the_single_panel(what, across):
    view = {"spot": rays.spots, "ray_fan": rays.ray_errors, "opd_fan": rays.path_errors}[what]
    request = request_of(TRIPLET, matrix_what=what, matrix_across=across, depth_mm=3000.0)
    for state, tile in each(request, previews(request, "settled")):
        alone = view(live(state)).found
        if what == "spot":
            assert tile.content.points == pytest.approx(rays.landing_points(alone), abs=1e-6)  # µm
            assert str(tile.figure) == f"RMS {float(alone.rms_um):.3g} µm" or "0" in str(tile.figure)
        else:
            for name in ("sagittal", "tangential"):
                assert tile.content.curves[name] == pytest.approx(getattr(alone, name), abs=1e-6, nan_ok=True)


@pytest.mark.parametrize("quality", ["preview", "settled"])
def test_the_pupil_has_the_rms_of_the_rays(quality):
    """RMS over evenly spread rays of the library's OPD map, another set of rays than the panel's fit has."""
    request = request_of(TRIPLET, matrix_what="pupil", matrix_rows=2, matrix_columns=2)
    tiles = previews(request) if quality == "preview" else worked(request)[0]
    for state, tile in each(request, tiles):
        setup = paraxial_setup(state)
        xi, eta, inside = p2sf.raytrace.pencil.pupil_grid(96)
        waves = p2sf.raytrace.pencil.opd_map(setup.lens, setup.source, 96)[inside]
        rms = rms_about_plane(waves, xi[inside], eta[inside])
        assert float(str(tile.figure.values["rms"])) == pytest.approx(
            rms, rel=0.01, abs=2e-3
        )  # three digits; 96² cells
        inside = np.isfinite(tile.content.values)
        assert float(tile.content.values[inside].std()) == pytest.approx(
            waves.std(), rel=0.1, abs=5e-3
        )  # a pixel wider


@pytest.mark.parametrize("obscuration", [0.0, 0.35])
def test_contrast_is_that_of_the_library(obscuration):
    request = request_of(TRIPLET, matrix_what="mtf", matrix_rows=2, matrix_columns=2, obscuration=obscuration)
    assert matrix(live(change(TRIPLET, matrix_what="mtf"))).found.tiles is None, "it takes longer than a frame"
    for state, tile in each(request, worked(request)[0]):
        setup, x = paraxial_setup(state), tile.content.x
        source = p2sf.Source(field_deg=state.optics.field_deg, wavelength_nm=state.optics.wavelength_nm)
        alone = p2sf.Camera(setup.lens).at(source).mtf(x)
        assert tile.content.curves["tangential"] == pytest.approx(alone.tangential, abs=1e-9)
        assert tile.content.curves["sagittal"] == pytest.approx(alone.sagittal, abs=1e-9)


def test_a_perfect_pupil_has_a_strehl_ratio_of_one():
    request = request_of(new_state(method="seidel", free_pupil=True))
    for tiles in (previews(request), worked(request)[0]):
        assert {float(str(figure.values["value"])) for row in figures(tiles) for figure in row} == {1.0}
        assert {figure.template for row in figures(tiles) for figure in row} == {"Strehl {value}"}


@pytest.mark.parametrize("fields_deg", [(0.0, 1.0), (0.0, 14.0)])
def test_one_quantity_stands_below_all_pictures(fields_deg):
    """At f/8 the Double Gauss is sharp near the axis, and not at 14°: beside a blurred picture all state a radius."""
    request = request_of(default_state("double_gauss_28"), f_number=8.0, matrix_fields_deg=fields_deg, matrix_columns=2)
    for tiles in (previews(request), worked(request)[0]):
        ratios = [tile.strehl is not None for row in tiles for tile in row]
        assert any(ratios) and all(ratios) == (fields_deg[-1] < 14)
        words = {figure.template.split()[0] for row in figures(tiles) for figure in row}
        assert words == ({"Strehl"} if all(ratios) else {"R80"})


@pytest.mark.parametrize("field_deg", [0.0, 10.0, 14.0])
def test_the_radius_of_a_moving_picture_is_that_of_the_settled_one(field_deg):
    psf = in_window(change(default_state("double_gauss_28"), field_deg=field_deg), (128, 300 / 128), False)
    assert light_rings(psf.values, psf.pixel_um).radius_of(HELD) == pytest.approx(
        float(radius_of_energy(psf, HELD)), abs=psf.pixel_um
    )


def test_a_point_without_a_picture_says_why_and_leaves_the_others():
    """At 70° the chief ray misses the triplet: the rays of the others are traced one by one then."""
    request = request_of(TRIPLET, matrix_fields_deg=(0.0, 20.0, 70.0))
    whole = request_of(TRIPLET, matrix_fields_deg=(0.0, 20.0))
    found, other = previews(request), previews(whole)
    assert all(tile.content is None and "chief ray" in str(tile.why) for tile in found[2])
    for mine, theirs in zip(found[:2], other, strict=True):
        for a, b in zip(mine, theirs, strict=True):
            assert np.abs(a.content.values - b.content.values).max() < 2e-5 * b.content.values.max()


def test_one_scale_is_the_largest_of_all():
    request = request_of(TRIPLET, matrix_shared=False)
    tiles = previews(request)
    own, shared = scales("psf", tiles, False), scales("psf", tiles, True)
    assert len({size for row in own for size in row}) > 1
    assert {size for row in shared for size in row} == {max(size for row in own for size in row)}
    widths = {tile.content.width_um for row in previews(replace(request, shared=True)) for tile in row}
    assert len(widths) == 1 and min(widths) >= max(size for row in own for size in row), "and all windows hold it"
    bright = peaks(tiles, True)
    assert {peak for row in bright for peak in row} == {
        max(tile.content.painted.max() for row in tiles for tile in row)
    }
    assert worst(tiles) == max(tile.error for row in tiles for tile in row)


def test_what_moves_ends_the_work_between_two_pictures():
    request = request_of(TRIPLET, matrix_rows=2)
    told = []
    found = settle(request, lambda: len(told) >= 2, lambda share, tiles: told.append(share))
    assert len(told) == 2
    assert [tile.settled for row in found for tile in row] == [True, True, False, False, False, False]


def test_a_blur_of_many_waves_is_ray_density_and_says_so():
    request = request_of(default_state("double_gauss_28"), focus_mm=1000.0, matrix_rows=2, matrix_columns=2)
    for tiles in (previews(request), worked(request)[0]):
        for row in tiles:
            for tile in row:
                assert tile.method == "geometric" and tile.error is None and "R80" in str(tile.figure)


def test_rows_of_a_group_are_not_mixed():
    """Each source's rays of a common trace, field by field of the pencil."""
    request = request_of(TRIPLET)
    places = pictures._places(request)
    for place in pictures._trace_points(places, "psf", "preview"):
        lens = place.setup.lens
        alone = pictures.pencil(lens, place.setup.source, *pictures.points(pictures.first_level(lens)))
        for name in ("dx", "dy", "kx", "path", "launch", "light", "chief_y", "wavelength_um"):
            assert getattr(place.traced, name) == pytest.approx(getattr(alone, name), rel=1e-6, abs=1e-9), name
        assert place.traced.index == pytest.approx(alone.index)


def moved(before: Live, f_number: float) -> Live:
    """Return the answer of the next frame of a drag."""
    state = change(before.state, f_number=f_number)
    return live(state, "preview", {"matrix": matrix}, before.method, before=before.views)


def test_of_many_pictures_the_one_in_hand_is_renewed_in_each_frame_and_the_others_in_turn():
    """A frame renews two of fifteen; after fifteen frames each has been renewed, and is what it is by itself."""
    seen = live(new_state(matrix_rows=5, method="fitted", f_number=4.0, field_deg=0.0), "preview", {"matrix": matrix})
    row, column, _ = nearest(seen.views["matrix"].found.request, seen.state)
    renewed = set()
    for number in range(15):
        later = moved(seen, 4.1 + 0.1 * number)
        old, new = (np.array(each.views["matrix"].found.tiles, dtype=object) for each in (seen, later))
        changed = {tuple(at) for at in np.argwhere(old != new).tolist()}
        assert (row, column) in changed and len(changed) <= 2
        assert len(later.views["matrix"].found.waiting) >= 13
        renewed |= changed
        seen = later
    assert len(renewed) == 15
    alone, here = (
        tiles[row][column].content
        for tiles in (previews(seen.views["matrix"].found.request), seen.views["matrix"].found.tiles)
    )
    assert here.circle.radius_um == pytest.approx(alone.circle.radius_um, rel=0.03), "in a window of other samples"


def test_a_few_pictures_are_all_renewed_in_each_frame():
    seen = live(
        new_state(matrix_rows=2, matrix_columns=2, method="fitted", f_number=4.0), "preview", {"matrix": matrix}
    )
    later = moved(seen, 4.5)
    old, new = (np.array(each.views["matrix"].found.tiles, dtype=object) for each in (seen, later))
    assert (old != new).all() and not later.views["matrix"].found.waiting


@pytest.mark.parametrize(("name", "field_deg", "method"), [("cooke_triplet", 14.0, "auto"), ("tessar", 10.0, "seidel")])
def test_the_radius_of_a_state_is_that_of_profiles_and_library_and_that_of_a_window_is_named(name, field_deg, method):
    """Of all light by the pupil: samples of a window state 18.3 µm of the first, whose R80 is 18.5 µm."""
    shown = change(default_state(name), field_deg=field_deg, method=method)
    request = request_of(shown, matrix_fields_deg=(field_deg, 0.0), matrix_rows=2, matrix_columns=2)
    state, tile = each(request, worked(request)[0])[0]
    settled = tile.figure
    answer = live(state)
    profiles = with_views(answer, {"profiles": view_of(next(e for e in REGISTRY if e.key == "profiles"))}, 0.0)
    setup = paraxial_setup(state)
    library = (
        p2sf.Camera(setup.lens)
        .at(setup.source)
        .energy(method="seidel" if method == "seidel" else "traced")
        .radius_80_um
    )
    assert settled.template == "R80 {radius} µm" and float(str(settled.values["radius"])) == float(f"{library:.3g}")
    assert profiles.views["profiles"].found.radii_um[1] == pytest.approx(library, rel=1e-3)
    moving = previews(request)[0][0].figure
    assert "in view" in moving.template
