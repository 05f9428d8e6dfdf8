"""What a database says about the truth of its PSFs, against sums over exact rays."""

import json
from dataclasses import replace

import numpy as np
import pytest

import p2sf
from p2sf.conventions import slope_from_degrees
from p2sf.database.accuracy import accuracy, build_by
from p2sf.database.build import build_database
from p2sf.database.files.npz import database_bytes, database_from_bytes
from p2sf.database.render import database_psf
from p2sf.database.space import Space
from p2sf.figures.compare import r_squared
from p2sf.lens.lens import with_f_number
from p2sf.lensfile.library import find_lens
from p2sf.psf.huygens import huygens_psf
from p2sf.psf.methods import whole_pixel_um
from p2sf.psf.prediction import ALLOWED

DOUBLE_GAUSS = with_f_number(find_lens("double_gauss_28"), 5.6)
WAVE = 0.55


def line(*fields_deg: float) -> Space:
    return Space(np.array([np.inf]), slope_from_degrees(np.array(fields_deg)), np.array([WAVE]))


@pytest.mark.parametrize(("field", "r2"), [(0.0, 0.999), (5.0, 0.982), (10.0, 0.874), (14.0, 0.758)])
def test_the_prediction_bounds_the_distance_from_exact_rays(field, r2):
    """Of six coefficients by a bound, up to a hundred times the error itself, which saturates; `auto` has little."""
    source = p2sf.Source(field_deg=field, wavelength_um=WAVE)
    pitch = whole_pixel_um(DOUBLE_GAUSS, source, 64)
    exact = huygens_psf(DOUBLE_GAUSS, source, 64, pitch)
    six, fits = (build_by(DOUBLE_GAUSS, line(field), method) for method in ("seidel", "auto"))
    error = 1 - r_squared(database_psf(six, source, 64, pitch).values, exact.values)
    assert 1 - error == pytest.approx(r2, abs=1e-3)
    assert error < accuracy(six, DOUBLE_GAUSS).worst < 100 * error
    assert fits.method == ("fitted" if field else "seidel")
    own = 1 - r_squared(database_psf(fits, source, 64, pitch).values, exact.values)
    assert own < accuracy(fits, DOUBLE_GAUSS).worst < ALLOWED


def test_the_worst_is_found_where_it_is():
    """Higher orders grow with the field: from 0 to 10° the last node is the worst, as alone; the median is less."""
    known = accuracy(build_database(DOUBLE_GAUSS, line(0, 5, 10)), DOUBLE_GAUSS)
    alone = accuracy(build_database(DOUBLE_GAUSS, line(10)), DOUBLE_GAUSS)
    assert known.worst == pytest.approx(alone.worst, rel=1e-9) and known.field_deg == pytest.approx(10)
    assert known.median < known.worst / 3
    assert known.worst > 1 and "worst" not in known.caution.values  # no number where the estimate has none
    assert known.caution.values["where"] == known.where
    assert replace(known, worst=ALLOWED / 2).caution is None


def test_six_coefficients_are_kept_where_they_are_enough():
    slow = with_f_number(find_lens("achromat_f6"), 30)
    assert build_by(slow, line(0, 0.5)).method == "seidel"
    assert accuracy(build_by(slow, line(0, 0.5)), slow).worst < ALLOWED
    assert build_by(DOUBLE_GAUSS, line(0, 5, 10), interpolant="table1").interpolant == "table1"


def test_a_file_states_it_and_an_older_one_lets_it_be_found():
    database = build_database(DOUBLE_GAUSS, line(0, 10))
    stored = database_from_bytes(database_bytes(database, DOUBLE_GAUSS), "a.npz")
    assert stored.meta["predicted_error"]["worst"] == accuracy(database, DOUBLE_GAUSS).worst
    older = replace(stored, meta={key: value for key, value in stored.meta.items() if key != "predicted_error"})
    assert older.accuracy.worst == pytest.approx(stored.accuracy.worst, rel=1e-9)
    json.dumps(stored.accuracy.record)


def test_the_library_warns_of_what_it_builds():
    lens = find_lens("double_gauss_28")
    with pytest.warns(p2sf.P2SFWarning, match="exact rays"):
        p2sf.build_database(lens, [np.inf], [0, 10], [550], method="seidel", f_number=5.6)
    assert p2sf.build_database(lens, [np.inf], [0, 10], [550], f_number=5.6).database.method == "fitted"
