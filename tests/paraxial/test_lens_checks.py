"""Lenses that can be computed but not made: `p2sf info` warns of them, and is silent about real ones."""

from dataclasses import replace
from math import inf

import pytest

from p2sf.cli import main
from p2sf.glass.media import ConstantIndex
from p2sf.lens.lens import Aperture, Lens, Surface
from p2sf.lens.shapes import Diffraction, Qbfs, Qcon, RadialPolynomial
from p2sf.lensfile.library import find_lens, shipped_lenses
from p2sf.paraxial.lens_checks import edge, lens_checks
from tests.support.lenses.mirrors import classical, mangin, telescope, two_mirrors

GLASS = ConstantIndex(1.5)
STOP = Surface(-40.0, 20.0)


def singlet(rim=5.0, stop=2.0, conic=0.0, glass=GLASS, stop_surface=1) -> Lens:
    surfaces = (Surface(10.0, 3.0, glass, conic, (), rim), Surface(-40.0, 20.0))
    return Lens(surfaces, Aperture("stop_semi_diameter", stop), stop_surface)


def reversed_glass() -> Lens:
    return replace(singlet(), surfaces=(Surface(10.0, -3.0, GLASS), Surface(-40.0, 20.0)))


@pytest.mark.parametrize("lens", [mangin(), two_mirrors(classical()), telescope()], ids=repr)
def test_negative_thicknesses_behind_mirrors_are_in_order(lens):
    assert lens_checks(lens) == ()


@pytest.mark.parametrize("name", shipped_lenses())
def test_the_shipped_lenses_pass_the_checks(name):
    """Except the relay, a drawing-board lens whose published rims reach beyond its spheres."""
    found = lens_checks(find_lens(name))
    assert len(found) == (4 if name == "relay" else 0), found


@pytest.mark.parametrize(
    ("lens", "words"),
    [
        (
            singlet(rim=10.001),
            "surface 1 has a clear semi-diameter of 10.001 mm, but with its radius of 10 mm it ends at 10 mm",
        ),
        (singlet(rim=5.1, conic=3.0), "ends at 5 mm"),
        (singlet(rim=12.0, stop=10.5), "the stop on surface 1 has a semi-diameter of 10.5 mm"),
        (reversed_glass(), "-3 mm"),
        (singlet(glass=ConstantIndex(1.0)), "every medium of this lens has the index 1, so no surface bends light"),
    ],
)
def test_an_impossible_lens_has_a_warning(lens, words):
    found = [str(warning) for warning in lens_checks(lens)]
    assert any(words in sentence for sentence in found), found
    assert all("; " in sentence for sentence in found)


def test_at_the_edge_itself_a_rim_is_possible():
    assert lens_checks(singlet(rim=10.0, stop=10.0)) == ()


def test_planes_parabolas_and_hyperbolas_never_end():
    assert edge(Surface()) == edge(Surface(10.0, conic=-1.0)) == edge(Surface(10.0, conic=-2.0)) == inf
    assert lens_checks(singlet(rim=100.0, conic=-1.0)) == ()


def test_info_warns_and_still_answers(tmp_path, capsys):
    path = tmp_path / "air.toml"
    head = "stop_surface = 1\n\n[aperture]\nstop_semi_diameter = 9\n\n"
    path.write_text(head + "[[surface]]\nradius = 4.0\nthickness = 90.0\n")
    assert main(["info", str(path)]) == 0
    output, error = capsys.readouterr()
    assert "effective focal length" in output
    assert error.count("warning: ") == error.count("\n") == 2


def test_rims_beyond_the_polynomials_of_forbes_and_a_kinoform_that_bends_without_glass():
    def warned(shape, rim):
        lens = replace(singlet(glass=GLASS), surfaces=(Surface(30.0, 3.0, GLASS, shape=shape, semi_diameter=rim), STOP))
        return [message.text() for message in lens_checks(lens)]

    for make in (Qbfs, Qcon):
        (words,) = warned(make((1e-3,), 8.0), 9.0)
        assert "surface 1 has a clear semi-diameter of 9 mm, beyond the normalisation radius of 8 mm" in words
        assert not warned(make((1e-3,), 8.0), 8.0)
    assert not warned(RadialPolynomial((0.0, 1e-3), 8.0), 9.0)
    flat = Lens((Surface(diffraction=Diffraction((-100.0,), 5.0), thickness=50.0),), Aperture("f_number", 10.0), 1)
    assert lens_checks(flat) == ()
