"""AGF catalogues: the thirteen formulas, wrapped lines, damaged entries, and their precedence."""

import numpy as np
import pytest

from p2sf.errors import GlassError, LensFileError
from p2sf.glass.media import catalogue_glass
from p2sf.lensfile.agf import Catalogue, FormulaGlass, read_agf, refractive_index
from p2sf.lensfile.importing import import_lens
from tests.support.lenses.lens_files import FOLDER, read, text_of

N_BK7 = (1.03961212, 0.00600069867, 0.231792344, 0.0200179144, 1.01046945, 103.560653)
DOUBLET = "doublet.zmx"


def own():
    return read_agf(FOLDER / "own.agf")


def test_sellmeier_1_is_the_makers_own_table():
    """Schott's six coefficients; the built-in table keeps them in float32, hence 1e-7."""
    waves = np.linspace(0.4, 0.7, 7)
    assert refractive_index(2, N_BK7, waves) == pytest.approx(catalogue_glass("SCHOTT N-BK7").index(waves), abs=1e-7)


# Each formula with coefficients that say n² or n at λ = 1 µm and λ = 0.5 µm in whole numbers, worked by hand.
BY_HAND = {
    1: ((1, 2, 3, 4, 5, 6), 21, 1 + 0.5 + 12 + 64 + 320 + 1536),
    2: ((3, 0.2, 0, 1, 0, 1), 1 + 3 / 0.8, 1 + 0.75 / 0.05),
    4: ((1, 3, 0.5, 2, 2), 2 + 3 / 0.75 - 2 / 3, None),  # λ = 0.5 is the pole
    6: ((1, 0.5, 1, 0.5, 1, 0.5, 1, 0.5), 9, 1 - 4),
    7: ((2, 3, 0.5, 1), 2 + 6 - 1, 2 - 12 - 0.25),
    8: ((2, 3, 0.5, 1), 2 + 6 - 1, 2 - 3 - 0.25),
    9: ((2, 3, 0.5, 1, 0.5), 2 + 6 + 2, 2 - 3 - 1),
    10: ((1, 2, 3, 4, 5, 6, 7, 8), 36, 1 + 0.5 + 12 + 64 + 320 + 1536 + 7168 + 32768),
    11: ((1, 0.5, 1, 0.5, 1, 0.5, 1, 0.5, 1, 0.5), 11, 1 - 5),
    12: ((1, 2, 3, 4, 5, 6, 7, 8), 36, 1 + 0.5 + 12 + 64 + 320 + 1536 + 7 / 16 + 8 / 64),
    13: ((1, 2, 3, 4, 5, 6, 7, 8, 9), 45, 1 + 0.5 + 3 / 16 + 16 + 80 + 384 + 7 * 256 + 8 * 1024 + 9 * 4096),
}


@pytest.mark.parametrize("formula", BY_HAND)
def test_squared_formulas_by_hand(formula):
    coefficients, at_1, at_half = BY_HAND[formula]
    assert refractive_index(formula, coefficients, 1.0) == pytest.approx(np.sqrt(at_1), rel=1e-14)
    if at_half is not None and at_half > 0:
        assert refractive_index(formula, coefficients, 0.5) == pytest.approx(np.sqrt(at_half), rel=1e-14)
    elif at_half is not None:
        assert np.isnan(refractive_index(formula, coefficients, 0.5))


def test_direct_formulas_by_hand():
    pole = 1 / (1 - 0.028)
    herzberger = 1 + 2 * pole + 3 * pole**2 + 4 + 5 + 6
    assert refractive_index(3, (1, 2, 3, 4, 5, 6), 1.0) == pytest.approx(herzberger, rel=1e-14)
    assert refractive_index(5, (1, 2, 3), 0.25) == pytest.approx(1 + 8 + 3 * 128, rel=1e-14)  # 0.25^-3.5 = 128


def test_a_glass_outside_its_range_or_without_a_real_index():
    glass = FormulaGlass("X", 2, N_BK7, (0.4, 0.7))
    with pytest.raises(GlassError, match="outside the data of X, 400 to 700 nm"):
        glass.index(0.8)
    with pytest.raises(GlassError, match="gives no real index"):
        FormulaGlass("X", 1, (-2.0,), (0.4, 0.7)).index(0.5)


def test_wrapped_coefficients_are_joined():
    assert own().glasses["HOUSE1"].coefficients[:6] == N_BK7


def test_a_catalogue_the_file_names_beats_the_built_in_table():
    named = ("GCAT SCHOTT", "GCAT OWN SCHOTT")
    assert float(read(DOUBLET, named, catalogues=[own()]).lens.surfaces[0].medium.index(0.55)) == pytest.approx(1.6)
    unnamed = read(DOUBLET, catalogues=[own()]).lens.surfaces[0].medium
    assert unnamed == catalogue_glass("SCHOTT N-BK7")


def test_the_order_of_the_file_counts():
    found = read(DOUBLET, ("GCAT SCHOTT", "GCAT SCHOTT OWN"), ("N-BK7", "HOUSE1"), catalogues=[own()])
    assert found.lens.surfaces[0].medium.name == "HOUSE1"


@pytest.mark.parametrize(("order", "index"), [("ONE TWO", 1.6), ("TWO ONE", 1.7)])
def test_of_two_catalogues_the_one_the_file_names_first_counts(order, index):
    catalogues = [
        Catalogue(name, f"{name}.agf", {"N-BK7": FormulaGlass("N-BK7", 5, (n,), (0.3, 2.0))})
        for name, n in (("TWO", 1.7), ("ONE", 1.6))
    ]
    lens = read(DOUBLET, ("GCAT SCHOTT", f"GCAT {order} SCHOTT"), catalogues=catalogues).lens
    assert float(lens.surfaces[0].medium.index(0.55)) == pytest.approx(index)


def test_a_glass_that_contradicts_its_own_name_line_is_not_used():
    with pytest.raises(LensFileError, match=r"DAMAGED .* has nd 1\.60000 by its coefficients and 1\.70000"):
        read(DOUBLET, ("GCAT SCHOTT", "GCAT OWN"), ("N-BK7", "DAMAGED"), catalogues=[own()])


def test_catalogues_beside_the_lens_are_at_hand(tmp_path):
    (tmp_path / "own.agf").write_text((FOLDER / "own.agf").read_text())
    (tmp_path / "broken.agf").write_text("NM\n")
    (tmp_path / "lens.zmx").write_text(
        text_of(DOUBLET).replace("GCAT SCHOTT", "GCAT OWN SCHOTT").replace("N-BK7", "HOUSE1")
    )
    found = import_lens(tmp_path / "lens.zmx")
    assert found.lens.surfaces[0].medium.name == "HOUSE1" and "own.agf with 3 glasses" in found.report.text


BAD = {
    "NM X\n": "a glass needs a name and a formula number",
    "NM X 14\nCD 1\nLD 0.3 1\n": "formula 14; only 1 to 13 exist",
    "NM X 2\nLD 0.3 1\n": "no coefficients",
    "NM X 2\nCD 1 2 x\nLD 0.3 1\n": 'coefficient "x" is not a number',
    "NM X 2\nCD 1\n": "no wavelength range",
    "NM X 2\nCD 1\nLD 1 0.3\n": "the glass's range is 1 to 0.3",
    "CC nothing\n": "no glass",
}


@pytest.mark.parametrize("content", BAD)
def test_what_a_catalogue_is_refused_for(content, tmp_path):
    (tmp_path / "bad.agf").write_text(content)
    with pytest.raises(LensFileError, match=BAD[content]) as caught:
        read_agf(tmp_path / "bad.agf")
    assert caught.value.line
