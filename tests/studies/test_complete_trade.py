"""The complete trade: measures by plain formulas, files, fronts and the command."""

import json
from dataclasses import replace

import numpy as np
import pytest

from p2sf.errors import RequestError
from p2sf.figures.compare import r_squared, relative_l2
from p2sf.lensfile.library import find_lens
from p2sf.studies.complete_trade import (
    LensTrade,
    Row,
    SpaceWords,
    Spread,
    load_trades,
    record,
    save_trades,
    shipped_trades,
    trades_of,
)
from p2sf.studies.sampling import sampling_map
from p2sf.studies.trade_fronts import batch_us, equal_bytes, error, front, nbytes, within
from tests.benchmarks import complete_trade as study
from tests.benchmarks.complete_trade import kept_or_compared, measure_representation, truth_of
from tests.benchmarks.representations.representation import Representation
from tests.benchmarks.representations.space import SpacePoints


def blur(sigma, count=4):
    axis = np.arange(-16, 16)
    picture = np.exp(-(axis**2 + axis[:, None] ** 2) / (2 * sigma**2))
    return np.array([picture / picture.sum()] * count)


def points(count=4):
    return SpacePoints(np.full(count, 1e3), np.zeros(count), np.full(count, 0.5), np.zeros((count, 3)))


def made(pictures):
    return Representation("PSF grid", "none", 3, 12, 0.0, lambda some: pictures[: len(some)])


def test_a_perfect_representation_has_no_error():
    row = measure_representation(made(blur(4.0)), truth_of(points(), blur(4.0)))
    for errors in (row.one_less_r2, row.relative_l2, row.mtf, row.r80):
        assert errors.worst == 0
    assert row.batch_us > 0 and row.single_us > 0 and row.points == 4 and row.nbytes == 12


def test_errors_are_those_of_plain_formulas():
    """Gaussians of σ 4 and 4.4: R80 in their ratio, contrast exp(−2π²σ²ν²), R² and L2 by the library's functions."""
    wide, narrow = blur(4.4), blur(4.0)
    row = measure_representation(made(wide), truth_of(points(), narrow))
    assert row.r80.median == pytest.approx(0.1, abs=0.01)
    frequency = np.arange(17) / 32
    contrast = [np.exp(-2 * (np.pi * sigma * frequency) ** 2) for sigma in (4.4, 4.0)]
    assert row.mtf.median == pytest.approx(np.abs(contrast[0] - contrast[1]).max(), abs=2e-3)
    assert row.one_less_r2.median == pytest.approx(1 - r_squared(wide[0], narrow[0]))
    assert row.relative_l2.median == pytest.approx(relative_l2(wide[0], narrow[0]))


def test_the_worst_point_is_named_and_most_keep_the_rest():
    pictures = np.concatenate([blur(4.0, 19), blur(6.0, 1)])
    place = replace(points(20), depth_mm=np.arange(20) + 1.0)
    row = measure_representation(made(pictures), truth_of(place, blur(4.0, 20)))
    assert row.worst_at[0] == 20 and row.relative_l2.worst > 0.1 and row.relative_l2.median == 0
    assert row.worst_at[2] == pytest.approx(500)


def row_of(family, size, microseconds, l2):
    spread = Spread(l2, l2, l2)
    return Row(family, "", 1, size, 0.0, microseconds, 1.0, spread, spread, spread, spread, (1.0, 0.0, 500.0), 1)


ROWS = (
    row_of("PCA", 1000, 5.0, 0.3),
    row_of("fitted 46", 900, 50.0, 0.01),
    row_of("PCA", 20000, 6.0, 0.05),
    row_of("fitted 26", 400, 40.0, 0.02),
    row_of("seidel", 500, 3.0, 0.4),
)


SPACE = SpaceWords(None, 1e3, 1e6, (0.0, 20.0), (480.0, 650.0), 64, 2.0, 3)
TRADE = LensTrade("lens", "A lens", SPACE, 1e-7, ROWS, ((20.0, ROWS[:1]),), (), 12.0)


def test_a_front_has_what_no_other_beats():
    assert front(ROWS, nbytes) == [ROWS[3], ROWS[1]]
    assert front(ROWS, batch_us) == [ROWS[4], ROWS[0], ROWS[2], ROWS[3], ROWS[1]]
    assert within(ROWS, nbytes, 450) == ROWS[3] and within(ROWS, nbytes, 100) is None


def test_who_is_ahead_at_equal_bytes():
    found = {one.budget: one for one in equal_bytes(TRADE, ("PCA",))}
    assert found[1024].ahead == pytest.approx(30) and found[65536].ahead == pytest.approx(5)
    assert found[1024].ours == ROWS[1] and found[1024].other == ROWS[0]


def test_a_file_of_trades_reads_as_it_was_written(tmp_path):
    trades = [TRADE, replace(TRADE, lens="other", refused=(("PCA", "why"),))]
    path = save_trades(tmp_path / "two.json", trades)
    assert load_trades(path) == trades == trades_of(json.loads(json.dumps(record(trades))))
    path.write_text("[1]")
    with pytest.raises(RequestError, match="holds no complete trade"):
        load_trades(path)


@pytest.fixture
def short(monkeypatch):
    """Leave one family that is made at once, at few points."""
    families = study._families
    monkeypatch.setattr(study, "_families", lambda *given: {"seidel": families(*given)["seidel"]})
    monkeypatch.setattr(study, "TESTED_QUICK", 4)


@pytest.mark.slow
def test_a_comparison_goes_on_from_what_it_kept(short, tmp_path):
    lens = find_lens("reverse_telephoto")
    found = kept_or_compared(lens, tmp_path, quick=True)
    assert found.lens == "reverse_telephoto" and found.space.pixels == 64 and found.truth_error < 1e-6
    assert {row.family for row in found.rows} == {"seidel", "traced", "huygens"}
    kept = kept_or_compared(lens, tmp_path, quick=True)
    assert record([kept]) == record([found]), "kept, times and all"
    seidel = next(row for row in kept.rows if row.family == "seidel")
    assert error(seidel) == seidel.relative_l2.median


def test_the_command_prints_and_writes_what_is_kept(answer, tmp_path, said):
    command = ("tradeoff", "tessar", "--complete")
    found = answer(*command)
    assert trades_of(found) == [shipped_trades()["tessar"]] and found["says"][0]["front_bytes"]
    for ending, start in ((".png", b"\x89PNG"), (".csv", b"lens;rep"), (".json", b'{"colum')):
        text = said(*command, "-o", tmp_path / f"x{ending}")
        assert (tmp_path / f"x{ending}").read_bytes().startswith(start)
    assert "One PSF alone" in text and "six coefficients" in text
    assert load_trades(tmp_path / "x.json") == [shipped_trades()["tessar"]]
    assert len(trades_of(answer("tradeoff", "--complete"))) == len(shipped_trades())


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ([], "no lens is named"),
        (["tessar", "--complete", "--sampling"], "two studies"),
        (["nowhere.zmx", "--complete"], "none of the lenses whose complete trade is kept"),
        (["--complete", "-o", "x.bmp"], '".bmp" is unknown'),
    ],
)
def test_what_does_not_go_together_is_one_sentence(arguments, said, refused):
    assert said in refused("tradeoff", *arguments)


def test_the_map_of_sample_counts(monkeypatch):
    """More pupil samples never hurt much, too few fold the blur into the window, and the program's rule keeps 5 %."""
    monkeypatch.setattr("p2sf.studies.sampling.NPSF", (16, 32, 48))
    monkeypatch.setattr("p2sf.studies.sampling.NPUPIL", (32, 64, 512, 1024))
    found = sampling_map(find_lens("double_gauss_28"))
    assert np.isnan(found.errors[0, 1]) and np.isnan(found.errors[1, 2]) and np.isfinite(found.errors[0, 0])
    assert found.errors[1, 1] > 0.3 > 0.02 > found.errors[2, 1] > found.errors[3, 1]
    assert 22 < found.critical < 23 and found.paper == (32, 64)
    assert all(m > n for n, m in zip(found.rule["preview"], found.rule["settled"], strict=True))
    assert found.rule["preview"][1] <= 512 < found.rule["settled"][1]
