"""What is read and written again is the same lens: TOML exactly, .zmx and ISET .json as far as they can say it."""

from dataclasses import replace

import numpy as np
import pytest

from p2sf.disc.mask import PupilMask
from p2sf.errors import LensFileError
from p2sf.glass.media import ConstantIndex, ModelGlass, TabulatedIndex, catalogue_glass
from p2sf.lens.lens import Aperture, Lens, Surface
from p2sf.lens.placement import Placement
from p2sf.lens.rim import Rim
from p2sf.lens.shapes import Diffraction, RadialPolynomial
from p2sf.lens.source import Source
from p2sf.lensfile.agf import read_agf
from p2sf.lensfile.library import find_lens, load_lens, shipped_lenses
from p2sf.lensfile.toml.lens import lens_to_toml, parse_toml
from p2sf.lensfile.writing import lens_to_iset, write_lens
from p2sf.paraxial.first_order import abcd
from p2sf.paraxial.pupils import find_stop, stop_rim
from p2sf.paraxial.seidel import coefficients
from p2sf.raytrace.pencil import pencil
from tests.support.lenses.lens_files import FILES, FOLDER, read, text_of
from tests.support.lenses.shaped_lenses import EXTENDED, ODD, OTHER_PHASE, QCON, singlet


def with_own_glass() -> Lens:
    catalogue = read_agf(FOLDER / "own.agf")
    changes = (("GCAT SCHOTT", "GCAT OWN SCHOTT"), ("N-BK7", "HOUSE1"))
    return read("doublet.zmx", *changes, catalogues=[catalogue]).lens


LENSES = {
    **{name: lambda name=name: find_lens(name) for name in shipped_lenses()},
    **{name: lambda name=name: load_lens(FOLDER / name, accept_substitutes=True) for name in FILES},
    "own glass": with_own_glass,
}


@pytest.mark.parametrize("name", LENSES)
def test_toml_gives_the_identical_lens(name):
    lens = LENSES[name]()
    again = parse_toml(lens_to_toml(lens), "again.toml")
    assert again == lens and lens_to_toml(again) == lens_to_toml(lens)


def has_line_in_zemax(lens: Lens) -> bool:
    return not any(isinstance(medium, TabulatedIndex) for medium in lens.media)


def assert_same_mask(one: PupilMask, other: PupilMask) -> None:
    """Compare two masks; an obscuration is written as a radius, a product with the stop's rim, hence 1e-14."""
    assert one.obscuration == pytest.approx(other.obscuration, rel=1e-14)
    assert replace(one, obscuration=0.0) == replace(other, obscuration=0.0)


@pytest.mark.parametrize("name", LENSES)
def test_zmx_is_the_same_lens_to_this_reader(name, tmp_path):
    """1/(1/radius) may differ in the last digit, hence 1e-13 on matrices of up to 12 surfaces."""
    lens, path = LENSES[name](), tmp_path / "out.zmx"
    if not has_line_in_zemax(lens):
        with pytest.raises(LensFileError, match="has no line in a Zemax file"):
            write_lens(lens, path)
        return
    write_lens(lens, path)
    again = load_lens(path)
    assert again.fields_deg == pytest.approx(lens.fields_deg, abs=1e-11)
    assert_same_mask(again.mask, lens.mask)
    assert again.wavelengths_nm == pytest.approx(lens.wavelengths_nm, rel=1e-12)
    wave = lens.reference_wavelength_um
    assert abcd(again, wave) == pytest.approx(abcd(lens, wave), rel=1e-13, abs=1e-13)
    assert stop_rim(again) == pytest.approx(stop_rim(lens), rel=1e-12)
    assert int(find_stop(again).surface) == int(find_stop(lens).surface)
    if any(surface.before or surface.after for surface in lens.surfaces):
        return  # a break is a surface of its own in Zemax
    for new, old in zip(again.surfaces, lens.surfaces, strict=True):
        assert (new.conic, new.aspheric, new.thickness) == (old.conic, old.aspheric, old.thickness)


SHAPED = {
    "ODDASPHE": {"shape": ODD, "aspheric": (1e-6,)},
    "EVENASPH": {"shape": RadialPolynomial((0.0, 1e-3)), "aspheric": (1e-6, 2e-9)},
    "XASPHERE": {"shape": EXTENDED, "aspheric": (1e-6,)},
    "XOSPHERE": {"shape": RadialPolynomial((0.01, 0.02, 0.03), 9.0), "aspheric": (1e-6, 2e-9)},
    "BINARY_2": {"aspheric": (1e-6,), "diffraction": OTHER_PHASE},
}
MORE = {"Qcon": {"shape": QCON}, "r³⁰": {"aspheric": tuple(1e-5 * 9.0**-k for k in range(0, 28, 2))}}


@pytest.mark.parametrize("kind", [*SHAPED, *MORE])
def test_zmx_holds_shapes_and_phases(kind, tmp_path):
    """The same rays, to the rounding of terms that are put together by the powers of a normalisation radius."""
    lens = singlet({**SHAPED, **MORE}[kind])
    write_lens(lens, tmp_path / "out.zmx")
    assert f"TYPE {kind if kind in SHAPED else 'XASPHERE'}\n" in (tmp_path / "out.zmx").read_text()
    again, eta = load_lens(tmp_path / "out.zmx"), np.linspace(-1, 1, 9)
    one, two = (pencil(each, Source(900.0, 0.05, 0.55), 0.3 * eta, eta) for each in (lens, again))
    assert one.passed.all() and one.path == pytest.approx(two.path, abs=1e-13)
    assert again.surfaces[1].diffraction == lens.surfaces[1].diffraction


def test_iset_gets_qcon_as_its_even_terms(tmp_path):
    lens = singlet({"shape": QCON, "conic": -0.5, "aspheric": (1e-6,)})
    write_lens(lens, tmp_path / "out.json")
    again = load_lens(tmp_path / "out.json").surfaces[1]
    r = np.linspace(0, 8, 20)
    assert again.shape is None and again.sag(0.0, r) == pytest.approx(
        lens.surfaces[1].sag(0.0, r), rel=1e-13, abs=1e-16
    )


GAUSSIAN = {"gaussian.seq", "gaussian_pupil.zmx"}  # masks that Zemax and CODE V have a line for
# mirrors, diffraction, tilts, ideal lenses
NOT_IN_ISET = {"mirrors.roa", "hybrid.seq", "diffractive_singlet", "tilted_fields.zmx", "lens_web.json", "commands.len"}
NOT_IN_ISET |= {*GAUSSIAN, "parabola_90.seq", "cassegrain_f10", "hubble", "maksutov", "schmidt_camera"}


@pytest.mark.parametrize("name", sorted({*LENSES} - NOT_IN_ISET))
def test_iset_is_the_same_lens_at_its_reference_wavelength(name, tmp_path):
    """A stop on a refracting surface becomes a plane at its vertex, which changes no Seidel sum."""
    lens, path = LENSES[name](), tmp_path / "out.json"
    write_lens(lens, path)
    again, wave = load_lens(path), lens.reference_wavelength_um
    at = {"depth_mm": 1e4, "field_slope": 0.05, "wavelength_um": wave}
    assert abcd(again, wave) == pytest.approx(abcd(lens, wave), rel=1e-12, abs=1e-12)
    assert stop_rim(again) == pytest.approx(stop_rim(lens), rel=1e-12)
    old, new = coefficients(lens, **at), coefficients(again, **at)
    for term in ("w40", "w31", "w22", "w20", "w11"):
        assert float(getattr(new, term)) == pytest.approx(float(getattr(old, term)), rel=1e-9, abs=1e-9), term


def test_iset_indices_over_the_spectrum():
    lens = find_lens("achromat_f6")
    again = read("triplet.json", (text_of("triplet.json"), lens_to_iset(lens, spectral=True))).lens
    waves = np.array([0.4, 0.55, 0.7])  # samples of the table, so nothing is interpolated
    for new, old in zip(again.media[-len(lens.media) :], lens.media, strict=True):
        assert new.index(waves) == pytest.approx(old.index(waves), rel=1e-14)


def test_own_glasses_travel_in_a_catalogue_beside_the_lens(tmp_path):
    lens = with_own_glass()
    write_lens(lens, tmp_path / "out.zmx")
    assert (tmp_path / "out.agf").exists()
    assert load_lens(tmp_path / "out.zmx").media == lens.media


def made_of(number, bare: bool) -> Lens:
    """Return a lens all of whose numbers were made by ``number``; ``bare`` leaves out what ISET cannot express."""
    x = [number(value) for value in (20.0, 3.5, 0.2, -0.5, 1e-6, 45.0, 1.5, 64.0)]
    radius, gap, small, conic, term, back, index, abbe = x
    before = () if bare else (Placement(small, conic, term, small, conic, gap),)
    rim, phase = (None, None) if bare else (Rim((small, conic), (gap, gap)), Diffraction((small, term), radius, gap))
    glasses = ModelGlass(index, abbe), ConstantIndex(index)
    front = Surface(radius, gap, glasses[0], conic, (term,), radius, diffraction=phase)
    rows = (
        front,
        Surface(-radius, small, glasses[1], semi_diameter=radius, before=before, rim=rim),
        Surface(back, back),
    )
    return Lens(rows, Aperture("stop_semi_diameter", gap), 3, fields_deg=(gap,), wavelengths_nm=(number(550.0),))


@pytest.mark.parametrize("ending", [".toml", ".zmx", ".seq", ".json"])
def test_numpy_numbers_are_written_as_plain_ones(ending, tmp_path):
    """Those of double precision in the same digits; single ones are rounded anew where a format has 1/radius."""
    texts = []
    for number in (float, np.float64, np.float32):
        write_lens(made_of(number, ending == ".json"), tmp_path / f"out{ending}")
        texts.append((tmp_path / f"out{ending}").read_text())
    assert texts[0] == texts[1] and "np." not in texts[2]


def test_an_ending_nobody_writes(tmp_path):
    with pytest.raises(LensFileError, match=r'ending "\.xyz" is none of \.toml, \.zmx, \.seq, \.json'):
        write_lens(find_lens("singlet_f6"), tmp_path / "lens.xyz")


def test_two_makers_of_one_name_do_not_become_one(tmp_path):
    """Hikari and Schott both sell a glass named SF5; a .zmx that names both makers could not tell which."""
    media = (catalogue_glass("SCHOTT SF5"), catalogue_glass("HIKARI SF5"))
    lens = Lens(tuple(Surface(50.0, 2.0, m, semi_diameter=5.0) for m in media), Aperture("f_number", 8.0), 1)
    with pytest.raises(LensFileError, match="shares its name with another maker's glass"):
        write_lens(lens, tmp_path / "lens.zmx")


@pytest.mark.parametrize("ending", ["zmx", "seq", "toml"])
def test_a_curved_sensor_is_kept(tmp_path, ending):
    lens = replace(find_lens("cooke_triplet"), sensor_radius=-40.0, sensor_conic=-0.7)
    path = tmp_path / f"lens.{ending}"
    write_lens(lens, path)
    again = load_lens(path)
    assert (again.sensor_radius, again.sensor_conic) == (-40.0, -0.7)


def test_a_curved_sensor_is_never_flattened(tmp_path):
    with pytest.raises(LensFileError) as caught:
        write_lens(replace(find_lens("cooke_triplet"), sensor_radius=-40.0), tmp_path / "lens.json")
    assert caught.value.message.values["ending"] == ".json"
