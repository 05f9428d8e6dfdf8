"""Databases of lenses with a mask in the stop: the coefficients are those of the disc, the PSFs those of the mask."""

import json
from dataclasses import replace
from itertools import product

import numpy as np
import pytest

import p2sf
from p2sf.conventions import centred_axis
from p2sf.database.build import INTERPOLANTS, build_database
from p2sf.database.files.npz import database_bytes, database_from_bytes, same_database
from p2sf.database.files.packing import MARK
from p2sf.database.files.provenance import Stored, provenance
from p2sf.database.files.sealed import seal, unseal
from p2sf.database.fitted_build import build_fitted
from p2sf.database.parts import KINDS
from p2sf.database.render import Sampling, database_psf, render_source
from p2sf.database.space import Space
from p2sf.disc.mask import PupilMap, PupilMask
from p2sf.disc.mask_nodes import mask_nodes
from p2sf.errors import DatabaseError, ExportError
from p2sf.export.iset import write_iset
from p2sf.lens.lens import with_mask
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.paraxial.seidel import coefficients
from p2sf.paraxial.wavefront import wavefront
from p2sf.psf.fitted import fitted_psf
from p2sf.psf.methods import render
from p2sf.psf.seidel import seidel_psf
from p2sf.spans import depth_nodes
from tests.support.waves import relative_l2

LENS = find_lens("double_gauss_28")
SPACE = Space(depth_nodes(20000, count=4), np.tan(np.deg2rad([0, 2, 4])), np.array([0.5, 0.55, 0.6]))
RING = PupilMask(obscuration=0.4)
IRIS = PupilMask(obscuration=0.2, blades=5, roundness=0.3, blade_angle_deg=10)
MASKS = (
    RING,
    IRIS,
    PupilMask(obscuration=0.3, vanes=3, vane_width=0.03, vane_angle_deg=20),
    PupilMask(cubic_um=0.5, apodisation=0.8),
    PupilMask(
        zernike_um=(0, 0, 0, 0, 0.05), amplitude_map=PupilMap.sampled(lambda xi, eta: 0.6 + 0.4 * np.sin(2 * xi))
    ),
)
AZIMUTHS = 0.0, 53.0


@pytest.mark.parametrize("mask", MASKS, ids=repr)
@pytest.mark.parametrize("interpolant", INTERPOLANTS)
def test_at_a_node_it_renders_what_the_method_does(mask, interpolant):
    """The coefficients agree to 1e-11, so do the PSFs; in the other interpolants a node is a node, too."""
    lens = with_mask(LENS, mask)
    database = build_database(lens, SPACE, interpolant)
    stored = Stored(database, provenance(database, lens))
    for azimuth in AZIMUTHS:
        source = Source(float(SPACE.depths_mm[1]), float(SPACE.field_slopes[2]), 0.55, azimuth_deg=azimuth)
        looked, direct = stored.psf(source, 32, 1.2, integrated=False), render(lens, source, "seidel", 32, 1.2)
        assert relative_l2(looked.values, direct.values) < 1e-10
        assert looked.strehl == pytest.approx(direct.strehl, rel=1e-10)
        assert looked.energy == pytest.approx(direct.energy, rel=1e-10)
        assert looked.azimuth_deg == azimuth


@pytest.mark.parametrize("interpolant", INTERPOLANTS)
def test_the_mask_changes_no_coefficient(interpolant):
    point = (60000.0, 0.03, 0.53)
    masked, plain = (build_database(lens, SPACE, interpolant) for lens in (with_mask(LENS, IRIS), LENS))
    for kind in KINDS:
        assert getattr(masked.coefficients(*point), kind) == getattr(plain.coefficients(*point), kind)
    assert masked.errors == plain.errors


def test_between_the_nodes_it_is_the_method_too():
    lens, source = with_mask(LENS, IRIS), Source(47000.0, 0.031, 0.537, azimuth_deg=-100.0)
    looked = database_psf(build_database(lens, SPACE), source, 32, 2.0)
    assert relative_l2(looked.values, render(lens, source, "seidel", 32, 2.0).values) < 1e-10
    linear = database_psf(build_database(lens, SPACE, "linear"), source, 32, 2.0)
    assert 1e-10 < relative_l2(linear.values, looked.values) < 0.05


@pytest.mark.parametrize("azimuth", [0.0, 53.0, -100.0])
def test_at_another_azimuth_the_mask_stays_and_the_wavefront_turns(azimuth):
    """From the definition in the sensor's own axes: the mask as it stands, W turned to where the field is."""
    lens = with_mask(LENS, IRIS)
    source = Source(float(SPACE.depths_mm[2]), float(SPACE.field_slopes[2]), 0.55, azimuth_deg=azimuth)
    six, nodes = coefficients(lens, source.depth_mm, source.field_slope, 0.55), mask_nodes(IRIS, 60, 160)
    sine, cosine = np.sin(np.deg2rad(azimuth)), np.cos(np.deg2rad(azimuth))
    across, along = nodes.xi * cosine - nodes.eta * sine, nodes.xi * sine + nodes.eta * cosine
    pupil = nodes.weight * np.exp(2j * np.pi * wavefront(six, across, along))
    axis, scale = centred_axis(24, 2.0), float(six.reduced_slope) / 0.55
    x, y = np.meshgrid(axis, axis)  # towards the right of the field, and along it
    on_sensor = x * cosine + y * sine, y * cosine - x * sine
    kernel = np.exp(
        -2j
        * np.pi
        * scale
        * sum(np.multiply.outer(a, b) for a, b in zip(on_sensor, (nodes.xi, nodes.eta), strict=True))
    )
    wanted = np.abs(kernel @ pupil) ** 2
    looked = database_psf(build_database(lens, SPACE), source, 24, 2.0)
    assert relative_l2(looked.values, wanted / wanted.sum()) < 1e-6  # of quadrature; turned wrongly it is 0.5


@pytest.mark.parametrize("mask", [RING, IRIS, MASKS[3]], ids=repr)
def test_a_fitted_database_renders_through_it(mask):
    lens = with_mask(LENS, mask)
    database = build_fitted(lens, Space([60000.0], [0.03, 0.05], [0.55]))
    assert database.errors["phase"] <= 1e-3
    for azimuth in AZIMUTHS:
        for slope in (0.03, 0.045):
            source = Source(60000.0, slope, 0.55, azimuth_deg=azimuth)
            looked = database_psf(database, source, 32, 1.5)
            direct = fitted_psf(lens, source, 32, 1.5, database.level.numbers)
            # An RMS phase error σ changes a PSF by some 2πσ: 0.6 % at the database's tolerance.
            assert relative_l2(looked.values, direct.values) < 6e-3


def test_at_a_node_a_fitted_database_is_the_fit():
    lens = with_mask(LENS, IRIS)
    database = build_fitted(lens, Space([60000.0], [0.03], [0.55]))
    source = Source(60000.0, 0.03, 0.55, azimuth_deg=25.0)
    direct = fitted_psf(lens, source, 32, 1.5, database.level.numbers)
    assert database.fit_at(source).mask == IRIS.turned(-25)
    # Phases agree to 1e-10 waves, by the rounding of paths of some 1e5.
    assert relative_l2(database_psf(database, source, 32, 1.5).values, direct.values) < 1e-8


def test_an_inverted_pupil_shows_the_mask_upside_down():
    """A relay's stop behind lenses: what is stored is what a field above the axis sees."""
    lens = find_lens("relay")
    lens = with_mask(replace(lens, stop_surface=len(lens.surfaces)), IRIS)
    space = Space([90.0, 110.0], [0.0, 0.03], [0.55])
    source = Source(110.0, 0.03, 0.55)
    assert build_database(lens, space).mask.turn_deg in (0.0, 180.0)
    looked = database_psf(build_database(lens, space), source, 32, 4.0)
    assert relative_l2(looked.values, render(lens, source, "seidel", 32, 4.0).values) < 1e-9


@pytest.mark.parametrize("mask", [RING, IRIS, MASKS[3]], ids=repr)
def test_stacks_are_single_psfs(mask):
    database = build_database(with_mask(LENS, mask), SPACE)
    stack = render_source(database, SPACE.axes, Sampling(24, 2.0), np.float64)
    for place in product((0, 3), (0, 2), (1,)):
        point = (
            axis[k] for axis, k in zip((SPACE.depths_mm, SPACE.field_slopes, SPACE.wavelengths_um), place, strict=True)
        )
        six = coefficients(LENS, *point)
        one = seidel_psf(six, 24, 2.0, mask=mask)
        assert relative_l2(stack[place], one.values) < 2e-4  # each sum keeps 1e-4


@pytest.mark.slow
@pytest.mark.parametrize("mask", MASKS, ids=repr)
@pytest.mark.parametrize("build", [*INTERPOLANTS, "fitted"])
def test_a_file_holds_the_mask(mask, build):
    lens = with_mask(LENS, mask)
    database = (
        build_database(lens, SPACE, build) if build != "fitted" else build_fitted(lens, Space([6e4], [0.03], [0.55]))
    )
    raw = database_bytes(database, lens)
    stored = database_from_bytes(raw, "a.npz")
    assert stored.database.mask == mask and stored.lens.mask == mask
    assert ("azimuth" in stored.meta) != mask.round
    source = Source(6e4, 0.03, 0.55, azimuth_deg=25.0)
    assert np.array_equal(
        stored.psf(source, 8, 2.0, integrated=False).values, database_psf(database, source, 8, 2.0).values
    )
    assert same_database(raw, database_bytes(stored.database, lens))
    other = replace(database, mask=RING.turned(0)) if build != "fitted" else None
    assert other is None or mask == RING or not same_database(raw, database_bytes(other, lens))


def test_a_file_without_a_mask_is_read_by_older_versions_and_one_with_a_mask_refused_by_them():
    assert provenance_of(LENS)["schema"] == 1
    assert provenance_of(with_mask(LENS, RING))["schema"] == 2
    assert "mask" not in provenance_of(LENS)


def provenance_of(lens) -> dict:
    return database_from_bytes(database_bytes(build_database(lens, SPACE), lens), "a.npz").meta


@pytest.mark.parametrize(
    "damage", [{"vanes": "many"}, {"obscuration": 3}, {"hole": 1}, {"blades": 2}, "ring", {"turn_deg": None}]
)
def test_a_mask_that_cannot_be_is_refused_in_a_sentence(damage):
    lens = with_mask(LENS, RING)
    arrays = unseal(database_bytes(build_database(lens, SPACE), lens), MARK, "a.npz")
    arrays[MARK] = np.array(json.dumps({**json.loads(str(arrays[MARK])), "mask": damage}))
    with pytest.raises(DatabaseError, match=r"a\.npz lacks what a P2SF database holds"):
        database_from_bytes(seal(arrays), "a.npz")


def test_the_public_database_and_its_export(tmp_path):
    lens = p2sf.with_mask(p2sf.load_lens("double_gauss_28"), IRIS)
    stored = p2sf.build_database(lens, [20000, float("inf")], [0, 3], [550], method="seidel", path=tmp_path / "a.npz")
    again = p2sf.open_database(tmp_path / "a.npz")
    source = p2sf.Source(30000, field_deg=(1, 2), wavelength_nm=550)
    direct = p2sf.render(lens, source, method="seidel", pixels=16, pixel_um=2.0)
    for known in (stored, again):
        assert relative_l2(known.psf(source, 16, 2.0).values, direct.values) < 1e-10
    with pytest.raises(ExportError, match="mask in the stop is not round"):
        write_iset(again, tmp_path / "a.mat")
