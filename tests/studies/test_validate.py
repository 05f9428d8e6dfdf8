"""Published figures: every one agrees or says what it waits for, a wrong one is red, and the handbook has the table."""

import json
from dataclasses import replace

import numpy as np
import pytest

from p2sf.cli import main
from p2sf.lens.lens import with_aim
from p2sf.studies import validate
from p2sf.studies.listings import edges, hubble, singlet
from p2sf.studies.validate import (
    AGREES,
    DIFFERS,
    EXPLAINED,
    KINDS,
    MEASURES,
    compare,
    groups,
    lens_of,
    listed_figures,
    markdown,
    markdown_of_groups,
    published_figures,
    validation,
)
from p2sf_explorer.handbook.pages import page

FIGURES = {f"{figure.lens}, {figure.quantity}, {figure.source}": figure for figure in published_figures()}
OPTICSTUDIO = [figure for figure in published_figures() if figure.source.startswith("Ansys") and figure.measure]


@pytest.mark.parametrize("name", FIGURES)
def test_a_published_figure_agrees_or_waits(name):
    figure, row = FIGURES[name], compare(FIGURES[name])
    assert figure.kind in KINDS and figure.why and (figure.measure in MEASURES) != bool(figure.waits_for)
    assert row.verdict == (f"waits for {figure.waits_for}" if figure.waits_for else AGREES), row


def test_the_figures_asked_for_are_in_the_table():
    assert [figure.value for figure in OPTICSTUDIO if not figure.file] == [49.99978307143194, 0.2364, 1.2182]
    telescope = [figure.value for figure in OPTICSTUDIO if figure.file]
    assert telescope == [0.098, 0.691, 1.8841, 0.214, 1.5983, 0.044, 1.6847, 0.073]
    assert sum(figure.kind == "paper" for figure in published_figures()) == 4


@pytest.mark.slow
@pytest.mark.parametrize("figure", OPTICSTUDIO, ids=lambda figure: figure.quantity)
def test_a_wrong_figure_is_red(figure):
    assert compare(replace(figure, value=figure.value + 3 * figure.tolerance)).verdict == DIFFERS


def test_the_focal_length_has_double_precision():
    """Indices in 32 bits give 49.999785002 mm, two million tolerances away."""
    assert abs(compare(OPTICSTUDIO[0]).difference) < 1e-13


def test_the_filling_of_the_pupil_tells():
    """Through the real stop the wavefront at 14° has 1.205 waves: the figure was made in the paraxial pupil."""
    figure = next(figure for figure in OPTICSTUDIO if figure.value == 1.2182)
    stop = MEASURES[figure.measure](figure, with_aim(lens_of(figure), "stop"))
    assert stop == pytest.approx(1.205, abs=1e-3) and lens_of(figure).aim == "paraxial"


def test_the_command_fails_where_a_figure_differs(capsys, monkeypatch):
    rows = (
        compare(OPTICSTUDIO[0]),
        compare(replace(OPTICSTUDIO[0], value=50.0)),
        compare(FIGURES[next(reversed(FIGURES))]),
    )
    monkeypatch.setattr(validate, "validation", lambda: rows)
    assert main(["validate"]) == 1 and DIFFERS in capsys.readouterr().out
    assert main(["validate", "--json"]) == 1
    found = json.loads(capsys.readouterr().out)
    assert not found["agree"] and [figure["verdict"] for figure in found["figures"]] == [AGREES, DIFFERS, AGREES]
    monkeypatch.setattr(validate, "validation", lambda: rows[:1])
    assert main(["validate"]) == 0


@pytest.mark.slow
def test_every_number_of_the_listings_agrees_or_is_explained():
    rows = listed_figures()
    assert all(row.published.tolerance > 0 for row in rows)
    assert len(rows) > 700 and {row.verdict for row in rows} == {AGREES, EXPLAINED}
    # Of the terms, maps, rays and pictures that a listing can state exactly, none needs an explanation.
    exact = "axis", "skew", "rays", "Huygens PSFs", "wavefront maps", "Fringe terms", "ray fans", "cardinal points"
    told = [one for one in groups(rows) if any(word in one.name for word in exact)]
    assert sum(one.rows for one in told) > 450 and {one.verdict for one in told} == {AGREES}


def test_rays_on_a_curved_image_agree_to_the_last_digit():
    """OpticStudio's rays of a telescope whose image is curved, and what it makes of them."""
    rows = [validate.comparison_of(row) for row in hubble.rows()]
    verdicts = {f"{row.published.group}, {row.published.quantity}": row.verdict for row in rows}
    assert DIFFERS not in verdicts.values() and list(verdicts.values()).count(EXPLAINED) == 4
    assert all(row.published.explained for row in rows if row.verdict == EXPLAINED)


def test_a_number_listed_as_almost_nothing_can_be_written(capsys, monkeypatch):
    """A figure's digits follow from its tolerance, which is half a unit of the last one printed: of 1e-10, 5e-11."""
    row = validate.comparison_of(next(row for row in singlet.rows() if row.quantity == "object space NA"))
    monkeypatch.setattr(validate, "validation", lambda: (row,))
    assert main(["validate", "--all"]) == 0
    written = capsys.readouterr().out
    assert "0.00000000010" in written and "5e-11" in written


def test_an_explanation_covers_no_more_than_it_says():
    row = next(row for row in hubble.rows() if row.explained)
    assert validate.comparison_of(row).verdict == EXPLAINED
    assert validate.comparison_of(replace(row, ours=row.listed + 1.01 * row.within)).verdict == DIFFERS
    assert validate.comparison_of(replace(row, explained="")).verdict == DIFFERS


@pytest.mark.slow
def test_the_handbook_has_the_tables():
    """`python -c "from p2sf.studies.validate import *; print(markdown(validation()))"` writes one of them."""
    rows = validation()
    assert markdown(rows) in page("numerics") and markdown_of_groups(rows) in page("numerics")


def test_the_contrast_of_a_clear_disc_is_the_area_that_two_discs_share():
    """Circles of radius 1 whose middles are 2s apart, counted on a grid: a cell of 1/500 on the edges is 1e-3."""
    line = np.linspace(-1, 1, 1001)
    for share in (0.0, 0.2, 0.5, 0.9, 1.0, 1.3):
        across = np.hypot(*np.meshgrid(line - share, line)) <= 1
        both = across & (np.hypot(*np.meshgrid(line + share, line)) <= 1)
        found = singlet.diffraction_limit(np.array([share * 100.0]), 10.0)
        assert found[0] == pytest.approx(both.sum() / (np.hypot(*np.meshgrid(line, line)) <= 1).sum(), abs=2e-3)


def test_the_plane_of_the_stop_of_a_listed_lens_is_flat():
    for name in edges.numbers_of("edges"):
        lens = edges.lens_of(name)
        assert lens.surfaces[lens.stop_surface - 1].vertex_curvature == 0.0
