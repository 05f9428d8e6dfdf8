"""CODE V files that this program writes: read again, they have the same rays, also through tilts and folds."""

from dataclasses import replace

import numpy as np
import pytest

from p2sf.errors import LensFileError
from p2sf.glass.media import catalogue_glass, model_glass
from p2sf.lens.lens import Surface, indices, with_aim
from p2sf.lens.misalignment import displaced, folding
from p2sf.lens.placement import Placement
from p2sf.lens.positions import without_positions
from p2sf.lens.rim import Rim
from p2sf.lens.shapes import Qbfs, RadialPolynomial
from p2sf.lens.source import Source
from p2sf.lensfile.formats.codev_writing import lens_to_seq
from p2sf.lensfile.library import find_lens, load_lens, shipped_lenses
from p2sf.lensfile.writing import write_lens
from p2sf.paraxial.first_order import abcd
from p2sf.paraxial.pupils import find_stop, stop_rim
from p2sf.raytrace.pencil import pencil
from p2sf.raytrace.trace import trace
from tests.support.lenses.mirrors import mirror
from tests.support.lenses.misaligned import random_system
from tests.support.lenses.shaped_lenses import EXTENDED, ODD, OTHER_PHASE, QCON, singlet


def again(lens, folder):
    write_lens(lens, folder / "out.seq")
    return load_lens(folder / "out.seq")


@pytest.mark.parametrize("name", shipped_lenses())
def test_a_shipped_lens_is_the_same_to_this_reader(name, tmp_path):
    """Indices too: 1/(1/radius) may differ in the last digit, hence 1e-13 on matrices of up to some 20 surfaces."""
    lens = without_positions(find_lens(name))
    read = again(lens, tmp_path)
    assert read.fields_deg == pytest.approx(lens.fields_deg, abs=1e-11)
    assert sorted(read.wavelengths_nm) == pytest.approx(sorted(lens.wavelengths_nm), rel=1e-12)
    for nm in lens.wavelengths_nm:
        assert indices(read, nm / 1000) == pytest.approx(indices(lens, nm / 1000), rel=1e-14)
        assert abcd(read, nm / 1000) == pytest.approx(abcd(lens, nm / 1000), rel=1e-12, abs=1e-13)
    assert read.mask.obscuration == pytest.approx(lens.mask.obscuration, rel=1e-14)
    assert stop_rim(read) == pytest.approx(stop_rim(lens), rel=1e-12)
    assert int(find_stop(read).surface) == int(find_stop(lens).surface)
    for new, old in zip(read.surfaces, lens.surfaces, strict=True):
        assert (new.conic, new.thickness, new.inner_radius) == (old.conic, old.thickness, old.inner_radius)


@pytest.mark.parametrize("seed", range(24))
def test_any_misaligned_system_has_the_same_rays(seed, tmp_path):
    """Tilts and decentres in both orders about any pivot, and folds; 1e-11 mm: the roundings of angles taken anew."""
    lens = random_system(seed)
    read = again(lens, tmp_path)
    starts = np.array([[0.0, 0.0, -2.0], [1.0, -1.5, -2.0]])
    one, two = (trace(each, starts, [0.01, 0.02, 1.0], 0.5876) for each in (lens, read))
    assert (one.status == two.status).all()
    good = one.status == 0
    assert two.points[-1][good] == pytest.approx(one.points[-1][good], abs=1e-11)
    assert two.cosines[good] == pytest.approx(one.cosines[good], abs=1e-13)
    assert two.path[good] == pytest.approx(one.path[good], rel=1e-13)


def test_a_decentred_surface_that_returns_and_a_fold_stay_one_surface_each(tmp_path):
    glass = catalogue_glass("SCHOTT N-BK7")
    lens = singlet({}, rim=3.0)
    element = displaced(
        replace(lens, surfaces=(*lens.surfaces[:1], Surface(40.0, 4.0, glass), Surface(-70.0, 50.0))),
        2,
        2,
        Placement(0.1, -0.2, 0.0, 1.5, -0.5, 0.2),
    )
    text = lens_to_seq(element)
    assert text.count("DAR") == 1 and text.count("\nS ") == 3
    assert again(element, tmp_path).surfaces[1].before == element.surfaces[1].before
    whole = mirror(-400.0, -200.0)
    fold = replace(whole, surfaces=(replace(whole.surfaces[0], **folding(Placement(tilt_x_deg=30.0))),))
    assert "BEN" in lens_to_seq(fold) and lens_to_seq(fold).count("\nS ") == len(fold.surfaces)


SHAPED = {
    "even": {"aspheric": (1e-6, -2e-9), "conic": -0.5},
    "odd": {"shape": ODD, "aspheric": (1e-6,)},
    "r²": {"shape": RadialPolynomial((0.0, 1e-3)), "aspheric": (1e-6, 2e-9)},
    "extended": {"shape": EXTENDED, "aspheric": (1e-6,)},
    "Qcon": {"shape": QCON},
    "r³⁰": {"aspheric": tuple(1e-5 * 9.0**-k for k in range(0, 28, 2))},
    "phase": {"aspheric": (1e-6,), "diffraction": OTHER_PHASE},
}


@pytest.mark.parametrize("kind", SHAPED)
def test_shapes_and_phases_have_the_same_rays(kind, tmp_path):
    """To the rounding of terms that are put together by the powers of a normalisation radius."""
    lens, eta = singlet(SHAPED[kind]), np.linspace(-1, 1, 9)
    read = again(lens, tmp_path)
    one, two = (pencil(each, Source(900.0, 0.05, 0.55), 0.3 * eta, eta) for each in (lens, read))
    assert one.passed.all() and one.path == pytest.approx(two.path, abs=1e-12)
    assert one.dy == pytest.approx(two.dy, abs=1e-12)


def test_rims_model_glasses_and_media_of_no_maker(tmp_path):
    media = model_glass(1.6, 40.0), find_lens("eye_navarro").surfaces[0].medium
    rows = (
        Surface(30.0, 3.0, media[0], semi_diameter=8.0, rim=Rim((0.5, -0.25))),
        Surface(-30.0, 5.0, media[1], rim=Rim((0.0, 0.0), (4.0, 3.0), 20.0)),
        Surface(-50.0, 40.0, semi_diameter=9.0, inner_radius=1.0),
    )
    lens = replace(singlet({}), surfaces=rows, wavelengths_nm=(486.1327, 587.5618, 656.2725))
    read = again(lens, tmp_path)
    assert [s.rim for s in read.surfaces] == [s.rim for s in rows]
    assert [s.inner_radius for s in read.surfaces] == [0.0, 0.0, 1.0]
    for nm in lens.wavelengths_nm:
        assert indices(read, nm / 1000) == pytest.approx(indices(lens, nm / 1000), rel=1e-14)


@pytest.mark.parametrize(
    ("surface", "words"),
    [
        ({"shape": Qbfs((1e-3,), 9.0)}, "surface 2: .* cannot express its shape;"),
        (
            {"radius": np.inf, "medium": catalogue_glass("SCHOTT N-BK7"), "ideal_focal_length": 50.0},
            "cannot express its ideal focal length;",
        ),
        ({"shape": RadialPolynomial((0.0,) * 31 + (1e-30,))}, r"surface 2 has a term in r\^32"),
    ],
)
def test_what_no_command_says_is_refused(surface, words):
    lens = singlet({})
    rows = (lens.surfaces[0], replace(lens.surfaces[1], **surface), lens.surfaces[2])
    with pytest.raises(LensFileError, match=f"{words}.* save as TOML"):
        lens_to_seq(replace(lens, surfaces=rows))


def test_rays_that_fill_the_paraxial_pupil_are_refused_and_not_turned_into_others():
    lens = find_lens("cooke_triplet")
    with pytest.raises(LensFileError) as refused:
        lens_to_seq(with_aim(lens, "paraxial"))
    assert refused.value.message.values == {"aim": "paraxial"} and "YAN" in lens_to_seq(with_aim(lens, "stop"))
