"""Sets of PSFs on a sensor's pixels: pixel integrals by other roads, and files that other readers open."""

import csv
import shutil
import subprocess
from dataclasses import replace
from math import inf

import numpy as np
import pytest
from PIL import Image

from p2sf.conventions import slope_from_degrees
from p2sf.errors import Cancelled, ExportError, GeometryError, P2SFError, RequestError
from p2sf.export.psf_set import PixelGrid, PsfSet, SetAxes, psf_set
from p2sf.export.psf_set_files import table, write_psf_set
from p2sf.image.progress import Progress
from p2sf.lens.lens import with_f_number
from p2sf.lens.misalignment import displaced
from p2sf.lens.placement import Placement
from p2sf.lens.rim import Rim
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.paraxial.seidel import coefficients
from p2sf.pixel_kernels.frequency_grid import pupil_map
from p2sf.pixel_kernels.pixels import PixelWindow, part_filled_kernel, pixel_kernel
from p2sf.pixel_kernels.ray_spread import part_filled_rays, ray_spread
from p2sf.psf.methods import PsfOptions, render
from tests.support.tiers import in_tiers

LENS = with_f_number(find_lens("double_gauss_28"), 8.0)
WAVE_NM = 587.6
AXES = SetAxes((2000.0, 5000.0, 10000.0, 30000.0, inf), (0.0, 3.5, 7.0, 10.5, 14.0), (486.1, 587.6, 656.3))


@pytest.fixture(scope="module")
def found() -> PsfSet:
    return psf_set(LENS, AXES, PixelGrid(5.0, 0.8, 33))


def one(field_deg: float, grid: PixelGrid, depth_mm: float = inf, lens=LENS) -> PsfSet:
    return psf_set(lens, SetAxes((depth_mm,), (field_deg,), (WAVE_NM,)), grid)


@pytest.mark.parametrize("field", [0.0, 10.0])
@pytest.mark.parametrize(("fill", "inner"), [(1.0, 5), (0.36, 3)])
def test_a_pixel_receives_what_fine_samples_of_the_reference_add_up_to(field, fill, inner):
    """Each pixel cut into 5² samples of exact rays' waves, the inner ``inner``² of them sensitive.

    The fit's R² is 1 − 3e-5 here, and midpoints over 1.2 µm miss 1e-3 of an Airy disc of 11 µm; 3e-3 of the peak covers
    both. The reference's window holds all light but some 2 %, which its unit sum leaves out.
    """
    pixels, pitch = 41, 6.0
    shown = one(field, PixelGrid(pitch, fill, pixels)).values[0, 0, 0].astype(float)
    expected = sums_of_fine_samples(LENS, field, PixelGrid(pitch, fill, pixels), inner)
    inside = slice(4, -4)
    assert shown[inside, inside] == pytest.approx(expected[inside, inside], abs=0.03 * expected.max())
    assert np.abs(shown - expected)[inside, inside].mean() < 3e-3 * expected.max()


def sums_of_fine_samples(lens, field: float, grid: PixelGrid, inner: int = 5, clip: bool = False) -> np.ndarray:
    """Return pixels as sums of the inner of 5² samples each of exact rays' waves, over all light of their window."""
    pixels = grid.pixels
    source = Source(inf, float(slope_from_degrees(field)), WAVE_NM / 1000)
    fine = render(lens, source, "traced", 5 * pixels + 1, grid.pixel_um / 5, PsfOptions(clip=clip)).values
    fine = fine[: 5 * pixels, : 5 * pixels]
    middle = (5 * pixels + 1) // 2  # the chief ray's sample
    start = middle - 2 - 5 * (pixels // 2)
    cells = fine[start : start + 5 * pixels, start : start + 5 * pixels]
    cells = np.pad(cells, ((0, 5 * pixels - len(cells)),) * 2).reshape(pixels, 5, pixels, 5)
    edge = (5 - inner) // 2
    return cells[:, edge : 5 - edge, :, edge : 5 - edge].sum((1, 3)) / fine.sum()


SKEW = displaced(LENS, 3, 5, Placement(decentre_x=0.15, decentre_y=0.3, tilt_x_deg=0.1))
NARROW = replace(SKEW.surfaces[0], semi_diameter=11.5)
SQUARE = replace(SKEW.surfaces[0], semi_diameter=12.0, rim=Rim((-0.5, 0.0), (10.5, 12.0)))


@pytest.mark.parametrize(
    ("field", "front", "clip"), in_tiers([(0, None, False), (10, NARROW, True), (10, SQUARE, True)], [(0, None, False)])
)
def test_a_set_of_a_misaligned_lens_is_of_its_own_rays(field, front, clip):
    """Mirrored either way it would differ by 5 to 90 % of the peak; 3 % is for midpoints, as above."""
    lens = SKEW if front is None else replace(SKEW, surfaces=(front, *SKEW.surfaces[1:]))
    grid = PixelGrid(6.0, 1.0, 41)
    found = psf_set(lens, SetAxes((inf,), (field,), (WAVE_NM,)), grid, clip)
    shown, expected = found.values[0, 0, 0], sums_of_fine_samples(lens, field, grid, clip=clip)
    assert found.methods.item() == "fitted"
    for mirror in (slice(None, None, -1), (slice(None), slice(None, None, -1))):
        assert np.abs(shown[mirror] - expected).max() > 0.05 * expected.max()
    assert shown == pytest.approx(expected, abs=0.03 * expected.max())


def test_a_blur_of_rays_of_a_misaligned_lens_is_mirrored_where_the_lens_is():
    """A lens decentred by +x and by −x are mirror images; neither blur is that of the lens between them."""
    lens = find_lens("double_gauss_28")
    grid = PixelGrid(20.0, 1.0, 81)
    right, left, aligned = (
        one(5.0, grid, depth_mm=600.0, lens=displaced(lens, 3, 5, Placement(decentre_x=by))) for by in (0.5, -0.5, 0.0)
    )
    assert {x.methods.item() for x in (right, left, aligned)} == {"rays"}
    assert right.chief_x_mm.item() == pytest.approx(-left.chief_x_mm.item()) != 0 == aligned.chief_x_mm.item()
    a, b, c = (x.values[0, 0, 0] for x in (right, left, aligned))
    assert np.abs(a - b[:, ::-1]).sum() < 1e-3 < 0.01 < min(np.abs(a - a[:, ::-1]).sum(), np.abs(a - c).sum())


@pytest.mark.parametrize("field", [0.0, 12.0])
def test_whole_pixels_are_those_of_the_picture_s_kernels(field):
    """Kernels of a window of another size and with other samples are the same.

    Wings that wrap around at the edge of a transform change single pixels by 3e-3 of the peak.
    """
    source = Source(inf, float(slope_from_degrees(field)), WAVE_NM / 1000)
    pupil = pupil_map(LENS, source, "fitted")
    shown = one(field, PixelGrid(5.0, 1.0, 41)).values[0, 0, 0]
    other = pixel_kernel(pupil, 0.0, PixelWindow(60, 5.0, 15))[::-1]
    other = other[40:-40, 40:-40]
    assert shown == pytest.approx(other, abs=4e-3 * float(other.max()))


def test_all_light_lands_on_pixels_without_gaps_and_its_fill_factor_on_others():
    """Squares that tile the plane lose nothing; of a blur of many pixels the sensitive part receives its area."""
    pupil = pupil_map(LENS, Source(inf, float(slope_from_degrees(12.0)), WAVE_NM / 1000), "fitted")
    assert part_filled_kernel(pupil, PixelWindow(30, 5.0, 3), 1.0).sum() == pytest.approx(1.0, abs=1e-5)
    assert 0.99 < one(12.0, PixelGrid(5.0)).captured < one(12.0, PixelGrid(5.0, 1.0, 201)).captured < 1.0
    half, whole = (one(14.0, PixelGrid(2.0, part), depth_mm=4000.0).captured for part in (0.5, 1.0))
    assert half / whole == pytest.approx(0.5, abs=2e-3)
    assert one(0.0, PixelGrid(5.0, 0.8, 1)).captured == one(0.0, PixelGrid(5.0, 0.8, 9)).values[0, 0, 0, 4, 4]


def test_a_blur_too_wide_for_waves_is_of_rays_and_keeps_its_light():
    wide = one(0.0, PixelGrid(4.0, 0.6, 301), depth_mm=600.0, lens=find_lens("double_gauss_28"))
    assert wide.methods.item() == "rays" and np.isnan(wide.error.item())
    whole = one(0.0, PixelGrid(40.0, 0.6), depth_mm=600.0, lens=find_lens("double_gauss_28"))
    assert whole.captured.item() == pytest.approx(0.6, abs=0.01)
    inner = whole.values[0, 0, 0]
    middle, half = len(inner) // 2, 150 * 4 // 40  # 301 pixels of 4 µm are 30 of 40 µm
    part = inner[middle - half : middle + half + 1, middle - half : middle + half + 1].sum()
    assert wide.captured.item() == pytest.approx(part, rel=0.05)


@pytest.mark.slow
def test_the_chief_ray_is_where_six_coefficients_put_it_but_for_distortion(found):
    """Near the axis distortion is below 1e-3 of the image height, and 14° has the 0.04 % of a Double Gauss."""
    for d, depth in enumerate(AXES.depths_mm):
        for f, field in enumerate(AXES.fields_deg):
            six = coefficients(LENS, depth, float(slope_from_degrees(field)), 0.5876)
            assert found.chief_mm[d, f, 1] == pytest.approx(float(six.image_height), rel=0.02, abs=1e-9)
    assert (found.collected[:, 0] == 1).all() and (np.diff(found.collected, axis=1) < 0).all()


def test_rows_run_along_the_field():
    """At f/3 and 12° the PSF of this lens is far from symmetric along the field; `render` has rows +y."""
    lens = find_lens("double_gauss_28")
    mine = one(12.0, PixelGrid(4.0, 1.0, 65), lens=lens).values[0, 0, 0]
    other = render(lens, Source(inf, float(slope_from_degrees(12.0)), 0.5876), "traced", 65, 4.0).values
    other, mine = other / other.sum(), mine / mine.sum()
    assert np.abs(mine - other).sum() < 0.5 * np.abs(mine[::-1] - other).sum()


def test_numpy_reopens_the_set(found, tmp_path):
    write_psf_set(found, tmp_path / "set.npz")
    with np.load(tmp_path / "set.npz") as file:
        assert file["psf"].shape == (5, 5, 3, 33, 33)
        np.testing.assert_array_equal(file["psf"], found.values)
        assert (float(file["pixel_um"]), float(file["fill_factor"])) == (5.0, 0.8)
        assert tuple(file["depth_mm"]) == AXES.depths_mm and tuple(file["wavelength_nm"]) == AXES.wavelengths_nm
        np.testing.assert_array_equal(file["chief_mm"], found.chief_mm)
        np.testing.assert_allclose(file["captured"], file["psf"].sum((-2, -1)), rtol=1e-5)


@pytest.mark.slow
@pytest.mark.skipif(not shutil.which("octave"), reason="octave is not installed")
def test_octave_reopens_the_set(found, tmp_path):
    path = write_psf_set(found, tmp_path / "set.mat")
    script = (
        f"s = load('{path}'); printf('%d ', size(s.psf)); printf('%.17g ', s.pixel_um, s.fill_factor, "
        "s.depth_mm(5), s.chief_mm(2, 5, 1), s.psf(2, 5, 1, 17, 18)); printf('%s', s.method{1, 1, 1});"
    )
    done = subprocess.run(["octave", "--eval", script], capture_output=True, text=True, timeout=120, check=True)
    *numbers, method = done.stdout.split()
    figures = found.chief_mm[1, 4, 0], found.values[1, 4, 0, 16, 17]
    assert [float(x) for x in numbers] == pytest.approx([5, 5, 3, 33, 33, 5.0, 0.8, inf, *figures])
    assert method == "fitted"


def test_imagej_s_keys_give_the_pitch_and_the_order(found, tmp_path):
    """Read by Pillow, which did not write it: ImageJ takes the pitch from XResolution, the unit from its own text."""
    path = write_psf_set(found, tmp_path / "set.tif")
    with Image.open(path) as file:
        text = dict(line.split("=", 1) for line in str(file.tag_v2[270]).split("\n") if "=" in line)
        assert "ImageJ" in text and text["unit"] in ("um", "\\u00B5m", "micron")
        assert (text["channels"], text["slices"], text["frames"]) == ("3", "5", "5")
        assert 1 / float(file.tag_v2[282]) == pytest.approx(5.0) == 1 / float(file.tag_v2[283])
        first = np.asarray(file)
    np.testing.assert_array_equal(first[::-1], found.values[0, 0, 0])  # Pillow turns row 0, the lowest, down
    tifffile = pytest.importorskip("tifffile")
    with tifffile.TiffFile(path) as file:
        np.testing.assert_array_equal(file.asarray(), found.values)
        assert file.imagej_metadata["Labels"][0] == "depth 2000 mm, field 0 deg, 486.1 nm"


def test_fits_and_csv_hold_the_same_figures(found, tmp_path):
    fits = pytest.importorskip("astropy.io.fits")
    with fits.open(write_psf_set(found, tmp_path / "set.fits")) as file:
        np.testing.assert_array_equal(file[0].data, found.values)
        assert (file[0].header["CDELT1"], file[0].header["CRPIX1"]) == (5.0, 17)
        chief = np.array(file["FIGURES"].data["chief_mm"])
    np.testing.assert_allclose(chief.reshape(5, 5, 3), found.chief_mm)
    with write_psf_set(found, tmp_path / "set.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    assert len(rows) == 75 and rows[-1]["depth_mm"] == "inf" and rows[-1]["method"] == "fitted"
    assert [float(row["captured"]) for row in rows] == pytest.approx(found.captured.ravel())
    assert list(rows[0]) == table(found)[0]


def test_progress_is_told_and_a_cancelled_set_is_none():
    told: list[float] = []
    psf_set(LENS, SetAxes((inf,), (0.0, 7.0), (WAVE_NM,)), PixelGrid(5.0, 1.0, 9), watch=Progress(told.append))
    assert told == pytest.approx([0.25, 0.5, 0.75, 1.0])
    with pytest.raises(Cancelled):
        psf_set(LENS, AXES, PixelGrid(5.0), watch=Progress(cancelled=lambda: True))


@pytest.mark.parametrize(
    ("grid", "why"),
    [((0.0,), "pixel_um is 0"), ((4.0, 0.0), "fill factor"), ((4.0, 1.2), "fill factor"), ((4.0, 1.0, 0), "1 to 1024")],
)
def test_a_grid_that_cannot_be_is_refused(grid, why):
    with pytest.raises(P2SFError, match=why):
        PixelGrid(*grid)


def test_an_empty_axis_and_an_unknown_ending_are_refused(found, tmp_path):
    with pytest.raises(RequestError, match="at least"):
        SetAxes((inf,), (), (WAVE_NM,))
    with pytest.raises(ExportError, match="ending"):
        write_psf_set(found, tmp_path / "set.xls")


def test_a_point_whose_rays_all_stop_is_named_by_its_field():
    with pytest.raises(GeometryError) as caught:
        psf_set(find_lens("telephoto"), SetAxes((inf,), (60.0,), (587.6,)), PixelGrid(4.0))
    assert caught.value.message.values["where"].values["field"] == pytest.approx(60.0)


@pytest.mark.parametrize("half", [1, 4])
def test_light_of_rays_on_whole_pixels_is_that_of_the_rays_that_land_there(half):
    """Of a blur of 0.2 mm; cells at the edge of the square are taken whole or not at all."""
    rays = ray_spread(find_lens("double_gauss_28"), Source(600.0, 0.0, WAVE_NM / 1000))
    edge = (half + 0.5) * 12.0
    inside = (np.abs(rays.x_um) < edge) & (np.abs(rays.y_um) < edge)
    share = len(rays.sides) * float(rays.light[inside].sum())
    assert part_filled_rays(rays, half, 12.0, 1.0).sum() == pytest.approx(share, rel=0.02) and share < 0.9
