"""Glasses of makers' catalogues: their pages have the indices of the AGF formulas, and files find them by name."""

import numpy as np
import pytest

from p2sf.glass.catalogue import glasses_by_maker
from p2sf.glass.dispersion import LINES_UM, refractive_index
from p2sf.glass.media import catalogue_glass
from p2sf.glass.pages import CATALOGUES, GlassPage, page_names
from p2sf.lensfile import agf
from p2sf.lensfile.glass_lookup import GlassSources, resolve
from p2sf.lensfile.raw import RawGlass
from tests.long import collect_agf

COEFFICIENTS = {
    3: (1.5, 0.004, 1e-5, -2e-4, 1e-5, -1e-6),
    4: (0.2, 1.05, 0.1, -0.02, 9.0),
    5: (1.5, 0.008, 2e-4),
    7: (2.3, 0.01, 0.012, 0.009),
    8: (1.2, 1.05, 0.012, 0.009),
    9: (1.3, 0.9, 0.01, 0.8, 110.0),
}


@pytest.mark.parametrize("formula", range(1, 14))
def test_a_page_has_the_index_of_every_agf_formula(formula):
    """To four roundings of a dozen sums; 0.4 to 1.5 µm."""
    usual = (1.04, 0.006, 0.23, 0.02, 1.01, 103.5, 0.01, 0.03, 1e-3, 90.0)
    small = (2.3, -0.01, 0.01, 3e-4, -1e-5, 1e-6, 2e-7, -1e-8, 1e-9)
    c = COEFFICIENTS.get(formula, usual if formula in collect_agf.RESONANCES else small)
    waves = np.linspace(0.4, 1.5, 12)
    kind, numbers = collect_agf.page_of(formula, c)
    expected = agf.refractive_index(formula, c, waves)
    assert np.isfinite(expected).all()
    np.testing.assert_allclose(refractive_index(GlassPage(kind, (0.4, 1.5), numbers), waves), expected, rtol=1e-15 * 4)


def test_an_unknown_formula_has_no_page():
    with pytest.raises(ValueError, match="14"):
        collect_agf.page_of(14, (1.0,))


# What data sheets print: Schott's of 1992 and 2001, Hoya's; LZOS's in its catalogue; a moulded glass.
@pytest.mark.parametrize(
    ("name", "makers", "nd", "vd"),
    [
        ("BK7", ("SCHOTT",), 1.51680, 64.17),
        ("SK16", ("OLD_SCHO",), 1.62041, 60.32),
        ("SF57", ("SCHOTT",), 1.84666, 23.83),
        ("LAK9", ("SCHOTT",), 1.69100, 54.71),
        ("B270", ("SCHOTT",), 1.52308, 58.57),
        ("FDS90", ("HOYA",), 1.84666, 23.78),
        ("LZ_K8", ("LZOS",), 1.51637, 63.84),  # a fit, where the maker's own table has 64.07
        ("L-LAM60_MOLD", ("RPO",), 1.7400, 49.2),
        ("J-BK7A", ("NIKON-HIKARI_2019",), 1.51680, 64.14),
    ],
)
def test_former_and_moulded_glasses_have_the_numbers_of_their_sheets(name, makers, nd, vd):
    """A moulded glass has 0.0034 less than its maker states; elsewhere the last digit, and 0.1 of an Abbe number."""
    medium = resolve(RawGlass(name, makers), GlassSources()).medium
    f_line, d_line, c_line = (float(medium.index(LINES_UM[line])) for line in "FdC")
    assert d_line == pytest.approx(nd, abs=6e-3 if "MOLD" in name else 2e-5)
    assert (d_line - 1) / (f_line - c_line) == pytest.approx(vd, abs=1.0 if "MOLD" in name else 0.1)


def test_names_of_corning_are_their_numbers():
    """B10-63 has nd 1.510 and vd 63, to the rounding of both; C79-80 is a silica, EagleXG a display's glass."""
    for label in set(glasses_by_maker()["CORNING"]) - {"CORNING C79-80", "CORNING EagleXG"}:
        letter, thousandths, abbe = label[8], int(label[9:11]), int(label[12:])
        nd, vd = agf.nd_and_vd(catalogue_glass(label))
        assert nd == pytest.approx(1.4 + 0.1 * "ABCDE".index(letter) + thousandths / 1000, abs=2e-3), label
        assert vd == pytest.approx(abbe, abs=0.8), label


def test_a_name_of_one_maker_only_needs_no_maker():
    found = resolve(RawGlass("PMMA"), GlassSources())
    assert found.choice is None and found.medium.label == "MISC PMMA"


def test_the_glass_that_a_file_may_mean_is_named_with_what_others_differ_by():
    """SF11 of Hikari differs from Schott's by up to 8e-5."""
    found = resolve(RawGlass("SF11"), GlassSources())
    assert found.medium.label == "SCHOTT SF11" and found.choice.values["other"] == "HIKARI SF11"
    differences = [found.choice.values[line] for line in ("f_line", "d_line", "c_line")]
    assert 1e-5 < max(map(abs, differences)) < 1e-4


def test_misprints_of_a_table_are_left_out():
    """CTK8 at 1529.6 nm and TK9 at 852.1 nm: a table that falls with the wavelength everywhere."""
    for name in ("LZOS CTK8", "LZOS TK9", "LZOS F8"):
        glass = catalogue_glass(name)
        assert np.all(np.diff(glass.index(np.linspace(0.4, 2.3, 400))) < 0)


def test_names_are_on_one_shelf_only():
    """What the database sells is not repeated, but for three glasses with a page that is worse and three misprints."""
    both: dict[str, set[str]] = {}
    for shelf, book, name in (each.split("/") for each in page_names()):
        both.setdefault(f"{book.split('-')[0]} {name}".upper(), set()).add(shelf)
    double = {name for name, shelves in both.items() if {CATALOGUES, "specs"} <= shelves}
    assert double == {"SCHOTT B270", "SCHOTT LF7", "SUMITA K-GIR79", "LZOS CTK8", "LZOS TK9", "LZOS F8"}
