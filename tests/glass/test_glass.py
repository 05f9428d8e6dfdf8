"""Glass: the makers' indices, their ranges, and the errors for names that nobody or several makers sell."""

import pickle
import time
from dataclasses import replace

import mpmath
import numpy as np
import pytest

from p2sf.errors import GlassError
from p2sf.glass.catalogue import _label_with_index, find_entry, glasses_by_maker
from p2sf.glass.dispersion import FORMULAS, LINES_UM, refractive_index, through_neighbours
from p2sf.glass.media import (
    AIR,
    Medium,
    TabulatedIndex,
    catalogue_glass,
    model_glass,
    parse_medium,
)
from p2sf.glass.pages import DATA, LONGEST_TABLE, GlassPage, Kind, _heads_and_text, page, page_names
from p2sf.lensfile.library import find_lens
from p2sf.paraxial.first_order import cardinal_points
from tests.long.collect_pages import lines
from tests.support.interpreter import loaded_by
from tests.support.reference import LENSES, prescriptions, reference

F, D, C = LINES_UM["F"], LINES_UM["d"], LINES_UM["C"]


@pytest.mark.parametrize("name", LENSES)
def test_catalogue_gives_the_witness_indices(name):
    """The witness read its indices from coefficients in float32, 6e-8 relative: measured 1.3e-8 in the index."""
    written = ["air", *(row["medium"] or "air" for row in prescriptions()[name]["surfaces"])]
    for nm, listed in reference(name)["indices"].items():
        found = [float(parse_medium(medium).index(float(nm) / 1000)) for medium in written]
        np.testing.assert_allclose(found, listed, rtol=2e-8)


# What the data sheets print, to their last digit.
@pytest.mark.parametrize(
    ("glass", "nd", "vd"),
    [("SCHOTT N-BK7", 1.51680, 64.17), ("SCHOTT F2", 1.62004, 36.37), ("OHARA S-LAH79", 2.00330, 28.27)],
)
def test_data_sheet_values(glass, nd, vd):
    medium = catalogue_glass(glass)
    assert float(medium.index(D)) == pytest.approx(nd, abs=5e-6)
    assert (medium.index(D) - 1) / (medium.index(F) - medium.index(C)) == pytest.approx(vd, abs=6e-3)


@pytest.mark.parametrize("medium", ["SCHOTT N-SF11", "HOYA BAC4", "LZOS LF5", 1.5, {"nd": 1.5168, "vd": 64.17}])
def test_arrays_keep_their_shape_and_agree_with_scalars(medium):
    medium, waves = parse_medium(medium), np.linspace(0.42, 0.68, 6).reshape(2, 1, 3)
    together = medium.index(waves)
    assert together.shape == waves.shape and together.dtype == float
    alone = [float(medium.index(w)) for w in waves.ravel()]
    np.testing.assert_allclose(together.ravel(), alone, rtol=1e-15)  # the last bit: numpy's and libm's power


def test_every_formula_of_the_catalogue_evaluates():
    """The first page of each of the nine formulas and of a table: n is positive and finite all over its range."""
    first: dict[str, GlassPage] = {}
    for name in page_names():
        first.setdefault(page(name).kind, page(name))
    assert set(FORMULAS) | set(Kind) == set(first)
    for found in (first[kind] for kind in (*FORMULAS, Kind.TABLE)):
        n = refractive_index(found, np.linspace(*found.range_um, 50))
        assert np.all(np.isfinite(n)) and np.all(n > 0)


# Formula 2, of the data sheet, and 3, of the maker's former ones.
WRITTEN = {
    "specs/SCHOTT-optical/F2": "0 1.34533359 0.00997743871 0.209073176 0.0470450767 0.937357162 111.886764",
    "specs/HIKARI-optical/SK16": "2.592001 -0.01540969 2 0.0102268 -2 0.001581559 -4 -0.0001877149 -6 1.012515e-05 -8",
}


@pytest.mark.parametrize(("name", "written"), WRITTEN.items())
def test_coefficients_have_the_digits_of_the_data_sheet(name, written):
    """In 30-digit arithmetic from the printed decimals; float32 coefficients miss by 1e-8."""
    first, *rest = map(mpmath.mpf, written.split())
    pairs = list(zip(rest[::2], rest[1::2], strict=True))
    with mpmath.workdps(30):
        w = mpmath.mpf("0.55")
        poles = 1 + first + sum(b * w**2 / (w**2 - c) for b, c in pairs)
        exact = mpmath.sqrt(poles if name.endswith("F2") else first + sum(a * w**e for a, e in pairs))
    found = float(parse_medium(name).index(0.55))
    assert found == pytest.approx(float(exact), rel=4e-16)  # two roundings


def test_a_focal_length_agrees_with_other_programs():
    """OpticStudio and optiland: 49.99978307143194; here to a few roundings of fourteen refractions and transfers."""
    lens = find_lens("cooke_triplet")
    crown = catalogue_glass("HIKARI SK16")  # the former SK16, N-SK16's predecessor, as both programs have it
    surfaces = tuple(
        replace(surface, medium=crown) if surface.medium.label == "SCHOTT N-SK16" else surface
        for surface in lens.surfaces
    )
    length = cardinal_points(replace(lens, surfaces=surfaces), 0.55).effective_focal_length
    assert float(length) == pytest.approx(49.99978307143194, rel=1e-14)


@pytest.mark.parametrize(
    ("maker", "count"),
    [("SCHOTT", 367), ("OHARA", 417), ("HOYA", 410), ("CDGM", 341), ("SUMITA", 203), ("HIKARI", 381), ("LZOS", 105)],
)
def test_every_glass_of_a_maker_has_an_index(maker, count):
    """The numbers of glasses are those of the database and the catalogues; the indices those of a transparent solid."""
    labels = glasses_by_maker()[maker]
    assert len(labels) == count
    for label in labels:
        glass = catalogue_glass(label)
        assert 1.3 < float(glass.index(np.clip(0.55, *glass.range_um))) < 3.1  # an infrared glass at 0.85 µm


# Malitson 1963, Dodge 1984; Daimon and Masumura 2007 measured water against the air of the laboratory.
@pytest.mark.parametrize(
    ("name", "nd"),
    [
        ("main/CaF2/Malitson", 1.43385),
        ("main/MgF2/Dodge-o", 1.37774),
        ("main/Al2O3/Malitson-o", 1.76817),
        ("main/H2O/Daimon-20.0C", 1.33340),
        ("organic/poly_methyl_methacrylate/Sultanova", 1.49062),
        ("organic/polycarbonate/Sultanova", 1.58476),
    ],
)
def test_minerals_plastics_and_water(name, nd):
    assert float(parse_medium(name).index(D)) == pytest.approx(nd, abs=6e-6)


def test_the_data_are_read_quickly():
    """Read and split once, some 8 ms of processor time; then 20 µs a glass. Slack for a busy machine."""
    times = []
    for _ in range(5):
        start = time.process_time()
        _heads_and_text.__wrapped__()
        times.append(time.process_time() - start)
    assert min(times) < 0.03 and DATA.stat().st_size < 400_000


def test_the_file_is_made_from_the_database(tmp_path):
    """Kinds, digits, order and repeated rows of a small database; a formula that lacks a coefficient is passed over."""
    (tmp_path / "data").mkdir()
    parts = {
        "formula": "  - type: formula 2\n    wavelength_range: 0.3 2.5\n    coefficients: 0 1.03961212 0.00600069867\n",
        "absorbing": "  - type: tabulated k\n    data: |\n      0.3 1e-6\n",
        "table": "  - type: tabulated nk\n    data: |\n      0.5 1.50 0\n      0.4 1.6 0\n      0.5 1.7 0\n",
        "broken": "  - type: formula 2\n    wavelength_range: 0.3 2.5\n    coefficients: 0 1.0 0.006 2\n",
        "long": "  - type: tabulated n\n    data: |\n" + "".join(f"      {0.4 + k / 1000} 1.5\n" for k in range(401)),
    }
    catalogue = "- SHELF: {0}\n  content:\n  - DIVIDER: x\n  - BOOK: B\n    content:\n    - DIVIDER: y\n{1}"
    pages = "".join(f"    - PAGE: {name}\n      data: {name}.yml\n" for name in parts)
    text = catalogue.format("main", pages) + catalogue.format("specs", "    - PAGE: long\n      data: long.yml\n")
    (tmp_path / "catalog-nk.yml").write_text(f"- DIVIDER: z\n{text}")
    for name, part in parts.items():
        (tmp_path / "data" / f"{name}.yml").write_text(f"DATA:\n{part}")
    *short, thinned = lines(tmp_path)
    assert short == [
        "main/B/absorbing\tabsorption",
        "main/B/formula\t2\t0.3 2.5\t0 1.03961212 0.00600069867",
        "main/B/long\tleft out\t\t401",
        "main/B/table\ttable\t0.4 0.5\t1.6 1.50",
    ]
    kept = [float(w) for w in thinned.split("\t")[2].split()]
    assert len(kept) == LONGEST_TABLE and (kept[0], kept[-1]) == (0.4, 0.8)


def test_formulas_by_hand():
    """Numbers from a table of the literature: fused silica (Malitson 1965) and air at 15 °C (Ciddor 1996)."""
    assert float(parse_medium("main/SiO2/Malitson").index(D)) == pytest.approx(1.458464, abs=1e-6)
    assert float(parse_medium("other/air/Ciddor").index(D)) == pytest.approx(1.00027717, abs=1e-7)


def test_tables_are_read_between_their_points():
    """A dense flint sampled at LZOS's 31 wavelengths comes back to 1e-5; straight lines would miss by 8e-4."""
    points = np.array(page("specs/LZOS-optical/LF5").wavelengths_um)
    flint, waves = catalogue_glass("SCHOTT SF6"), np.linspace(0.4, 0.7, 301)
    points = points[points > 0.37]
    found = through_neighbours((points**-2)[::-1], flint.index(points)[::-1], waves**-2)
    assert np.abs(found - flint.index(waves)).max() < 1e-5
    assert np.abs(np.interp(waves, points, flint.index(points)) - flint.index(waves)).max() > 1e-4


@pytest.mark.parametrize(("nd", "vd"), [(1.5168, 64.17), (1.80518, 25.43), (1.43875, 94.93), (1.95906, 17.47)])
def test_model_glass_is_exact_in_nd_and_vd_and_falls_with_wavelength(nd, vd):
    glass = model_glass(nd, vd)
    assert float(glass.index(D)) == pytest.approx(nd, rel=1e-13)  # a 4×4 solve, condition about 1e3
    assert (glass.index(D) - 1) / (glass.index(F) - glass.index(C)) == pytest.approx(vd, rel=1e-10)
    assert np.all(np.diff(glass.index(np.linspace(*glass.range_um, 200))) < 0)


def test_model_glass_is_near_the_catalogue():
    """From 400 to 700 nm half of Schott's glasses lie within 3e-4 (measured 2e-4), all within 6e-3 (N-SF66)."""
    waves, errors = np.linspace(0.4, 0.7, 31), []
    optical = (name for name in page_names() if name.startswith("specs/SCHOTT-optical/"))
    for glass in map(parse_medium, optical):
        if glass.range_um[0] <= 0.4:
            nd, nf, nc = glass.index(np.array([D, F, C]))
            errors.append(np.abs(model_glass(nd, (nd - 1) / (nf - nc)).index(waves) - glass.index(waves)).max())
    assert len(errors) > 100 and np.median(errors) < 3e-4 and max(errors) < 6e-3


@pytest.mark.parametrize("written", ["SCHOTT N-BK7", "schott n-bk7", "Schott  N-BK7", " N-BK7 "])
def test_case_and_spaces_do_not_matter(written):
    assert parse_medium(written) == catalogue_glass("SCHOTT N-BK7")
    assert parse_medium(written).label == "SCHOTT N-BK7"


@pytest.mark.parametrize(
    "medium", ["SCHOTT N-BK7", 1.5, {"nd": 1.6, "vd": 40}, {"wavelengths_um": [0.4, 0.7], "n": [1.6, 1.5]}]
)
def test_media_are_values(medium):
    """Equal when written alike, usable as keys, and picklable for a worker process."""
    first, again = parse_medium(medium), pickle.loads(pickle.dumps(parse_medium(medium)))
    assert isinstance(first, Medium) and first == again and hash(first) == hash(again)


@pytest.mark.parametrize(
    ("written", "said"),
    [
        ("F2", ['"SCHOTT F2" (nd 1.62004', '"CDGM F2" (nd 1.612', "the one you mean"]),
        ("SCHOT N-BK7", ['"SCHOT N-BK7"', "did you mean", "SCHOTT N-BK7"]),
        ("N-BK8", ['"N-BK8"', "did you mean", "SCHOTT N-BK7"]),
        ("SCHOTT N-BK8", ["catalogue of SCHOTT", "did you mean SCHOTT N-BK7"]),
        ("BK9", ["did you mean"]),
        ("UNOBTAINIUM", ['"UNOBTAINIUM" is in no catalogue', "write maker and name", "vd ="]),
        ("main/SiO2/Nobody", ["main/SiO2/Nobody", "check shelf/book/page"]),
        ("main/Si/Franta-300K", ["main/Si/Franta-300K", "table of 4001 points", "wavelengths_um = […]"]),
        ("0.1", ["0.1", "between 0.5 and 6"]),
        (float("nan"), ["nan", "between 0.5 and 6"]),
        (True, ["True", "SCHOTT N-BK7"]),
        (None, ["None", "SCHOTT N-BK7"]),
        ({"nd": 1.5}, ["{'nd': 1.5}", "vd = 64.17"]),
        ({"nd": 0.5, "vd": 60}, ["nd is 0.5", "between 1 and 4"]),
        ({"nd": 1.5, "vd": 0}, ["vd is 0", "between 10 and 120"]),
        ({"nd": "1.5", "vd": 60}, ["'1.5'"]),
        ({"wavelengths_um": [0.4, 0.5], "n": [1.5]}, ["equally long"]),
        ({"wavelengths_um": 0.4, "n": 1.5}, ["two equally long lists"]),
        ({"wavelengths_um": [0.5, 0.4], "n": [1.5, 1.6]}, ["ascending"]),
    ],
)
def test_a_doubt_is_a_sentence(written, said):
    with pytest.raises(GlassError) as caught:
        parse_medium(written)
    message = str(caught.value)
    assert all(part in message for part in said), message
    assert "\n" not in message and ("; " in message)


def test_sellers_of_one_name_are_listed_as_data():
    with pytest.raises(GlassError) as caught:
        parse_medium("F2")
    sold = caught.value.message.values["glasses"]
    assert len(sold) > 1 and {item.values["glass"]: item.values["nd"] for item in sold}["SCHOTT F2"] == pytest.approx(
        1.62004, abs=5e-6
    )


@pytest.mark.parametrize("glass", ["SCHOTT N-BK7", {"nd": 1.5168, "vd": 64.17}])
@pytest.mark.parametrize("wavelength", [0.2, 5.0, np.array([0.5, 5.0]), np.nan, [0.5, np.nan]])
def test_no_index_is_made_up_outside_the_data(glass, wavelength):
    with pytest.raises(GlassError, match=r"nm is outside the data of .+ to .+ nm"):
        parse_medium(glass).index(wavelength)


def test_the_range_error_names_the_worst_wavelength():
    with pytest.raises(
        GlassError, match="wavelength 3000 nm is outside the data of SCHOTT N-BK7, 300 to 2500 nm"
    ) as caught:
        catalogue_glass("SCHOTT N-BK7").index([0.5, 3.0])
    assert caught.value.message.values["wavelength"] == pytest.approx(3000)


def test_ranges_are_closed_and_constants_have_none():
    glass = catalogue_glass("SCHOTT N-BK7")
    assert np.all(glass.index(glass.range_um) > 1.4) and AIR.range_um is None
    assert TabulatedIndex((0.4, 0.7), (1.6, 1.5)).range_um == (0.4, 0.7)
    assert glass.index(np.array([])).shape == (0,)


def test_importing_glass_opens_no_catalogue():
    loaded_by(
        "from p2sf.glass.media import model_glass; model_glass(1.5, 60).index(.5); "
        "from p2sf.glass.pages import _heads_and_text; assert not _heads_and_text.cache_info().currsize"
    )


def test_a_scalar_index_is_quick():
    """A lens of a dozen surfaces has 30 µs per slider step: 5 µs each, with slack for a busy machine (2 µs here)."""
    glass, wave, times = catalogue_glass("SCHOTT N-SSK2"), np.asarray(0.55), []
    for _ in range(50):
        start = time.process_time()
        for _ in range(100):
            glass.index(wave)
        times.append((time.process_time() - start) / 100)
    assert np.median(times) < 1e-5


@pytest.mark.parametrize(("name", "words"), [("N-BK7", "nd 1.5168"), ("IRG22", "")])
def test_a_glass_that_is_named_in_an_error_has_its_nd_if_it_is_known(name, words):
    said = str(_label_with_index(find_entry(name)))
    assert words in said and ("nd" in said) == bool(words)
