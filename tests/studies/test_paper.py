"""The paper's figures: what they claim, measured, and that they come out as whole files."""

import json
from io import BytesIO

import pytest

from p2sf.cli import main
from p2sf.figures.compare import r_squared
from p2sf.lens.lens import AIMS, with_aim, with_f_number, with_sensor
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.paraxial.seidel import coefficients
from p2sf.psf.fitted import fitted_psf
from p2sf.psf.huygens import huygens_psf
from p2sf.studies.paper import draw_accuracy, draw_timing, elements, fidelity, paper_figures, stage_times
from p2sf.studies.paper_claims import (
    FAILS,
    HOLDS,
    STAGES,
    defocus_claim,
    defocus_r_squared,
    gaussian_claim,
    memory_claim,
    off_axis_claim,
    speed_claim,
    stage_growth,
    time_claim,
)

# By an independent witness with the paraxial pupil at 656.27 nm; catalogue glass and 656.3 nm change them by 2e-3.
SEIDEL = {0.0: 0.997, 10.0: 0.751, 14.0: -0.599}
CLAIM = {"claim": "Six suffice", "measured": "as it is", "verdict": FAILS, "figures": {}}
FITTED = 0.994  # the bound for 26 numbers


@pytest.mark.parametrize("field_deg", SEIDEL)
def test_seidel_fails_off_axis_and_the_fit_does_not(field_deg):
    rows = {aim: fidelity(with_aim(find_lens("double_gauss_28"), aim), field_deg) for aim in AIMS}
    assert [row["aim"] for row in rows.values()] == list(AIMS)
    assert rows["paraxial"]["r_squared"]["seidel"] == pytest.approx(SEIDEL[field_deg], abs=3e-3)
    for row in rows.values():
        keeps_its_promises(row)


def keeps_its_promises(row):
    scores = row["r_squared"]
    assert FITTED < scores["fitted, 26 numbers"] < scores["fitted, 46 numbers"] <= 1
    assert scores["traced"] > 0.9999 and scores["gaussian"] < 0.9
    assert row["reference_tolerance"] < 1e-3


@pytest.mark.parametrize(
    ("name", "count"), [("double_gauss_28", 6), ("cooke_triplet", 3), ("landscape", 1), ("relay", 4)]
)
def test_refracting_elements_are_counted(name, count):
    assert elements(find_lens(name)) == count


def made_up():
    scores = {"gaussian": 0.8, "seidel": -0.6, "fitted, 26 numbers": 0.99, "fitted, 46 numbers": 0.999, "traced": 1.0}
    seconds = {"seidel": 1e-3, "huygens": 0.1}
    rows = [{"aim": aim, "field_deg": f, "r_squared": scores, "seconds": seconds} for aim in AIMS for f in (0.0, 14.0)]
    timing = [{"lens": "a", "elements": 3, **dict.fromkeys(STAGES, 1e-5)}]
    return {"lens": "a", "wavelength_nm": 656.3, "pixels": 32, "window_um": 22.12, "accuracy": rows, "timing": timing}


def test_a_pupil_that_is_unstable_off_axis_is_told_as_it_is():
    claim = off_axis_claim(made_up()["accuracy"])
    assert "-0.600 at 14°" in claim.measured and "≥ 0.9900" in claim.measured and claim.verdict == FAILS
    steady = [{**row, "r_squared": {**row["r_squared"], "seidel": 0.95}} for row in made_up()["accuracy"]]
    assert off_axis_claim(steady).verdict == HOLDS


@pytest.mark.parametrize(
    ("per_element", "verdict"),
    [((0.0, 0.1, 0.02), HOLDS), ((0.0, 0.1, 0.1), FAILS), ((0.1, 0.1, 0.0), FAILS), ((0.0, 0.0, 0.0), FAILS)],
)
def test_growing_times_are_told_from_constant_ones(per_element, verdict):
    """Times of 1 + per_element·(elements − 1), from 1 to 8 elements: the fitted line meets them."""
    growing = dict(zip(STAGES, per_element, strict=True))
    timing = [
        {"elements": n, **{stage: 1e-5 * (1 + each * (n - 1)) for stage, each in growing.items()}}
        for n in (1, 1, 3, 4, 6, 8)
    ]
    claim = time_claim(timing)
    assert claim.verdict == verdict
    for stage, each in growing.items():
        assert stage_growth(timing)[stage] == pytest.approx(1 + 7 * each) and f"{1 + 7 * each:.2f}" in claim.measured


def test_a_gaussian_is_judged_by_what_it_loses_off_the_axis():
    rows = [{"field_deg": f, "r_squared": {"gaussian": r}} for f, r in ((0.0, 0.85), (10.0, 0.6), (14.0, 0.1))]
    assert gaussian_claim(rows).verdict == HOLDS and "0.100 at 14°" in gaussian_claim(rows).measured
    assert gaussian_claim([rows[0], {**rows[0], "field_deg": 14.0}]).verdict == FAILS
    assert gaussian_claim(rows[::-1]).verdict == FAILS


@pytest.mark.parametrize(("seconds", "verdict"), [(0.0015, HOLDS), (0.6, FAILS)])
def test_half_a_second_is_the_bound_of_one_psf(seconds, verdict):
    claim = speed_claim(seconds, 0.2)
    assert claim.verdict == verdict and f"{1e3 * seconds:.1f} ms" in claim.measured


def test_memory_is_that_of_the_arrays():
    """12 400 PSFs of 32² doubles, six doubles for each, and 23 numbers for each term over the wavelength."""
    claim = memory_claim(find_lens("double_gauss_28"), 656.3, 32)
    figures = claim.figures
    assert figures["psf_bytes"] == 12400 * 32 * 32 * 8 and figures["coefficient_bytes"] == 12400 * 6 * 8
    assert figures["exact_bytes"] % (23 * 8) == 0 and figures["exact_bytes"] <= 31 * 23 * 8
    assert claim.verdict == HOLDS and "12 400 PSFs" in claim.measured and "102 MB" in claim.measured


@pytest.mark.slow
def test_ten_waves_are_no_limit_where_the_aperture_is_small_and_not_reached_where_it_is_large():
    lens = find_lens("double_gauss_28")
    small, large = (defocus_r_squared(lens, f, 0.6563) for f in (8.0, 3.0))
    assert min(small.values()) > 0.99 and large[0.0] > 0.99 and large[-10.0] < 0
    assert defocus_claim(lens, 656.3).verdict == FAILS


def test_the_blur_of_many_waves_is_compared_soundly():
    """With the same windows 26 fitted numbers meet the Huygens sum: the six coefficients fail, not the sampling."""
    lens = with_aim(with_f_number(find_lens("double_gauss_28"), 3.0), "paraxial")
    source = Source(wavelength_um=0.6563)
    here = coefficients(lens, source.depth_mm, 0.0, 0.6563)
    shifted = with_sensor(lens, lens.sensor_mm - 2e-3 * 0.6563 * (10 + float(here.wd)) / float(here.na) ** 2)
    assert float(coefficients(shifted, source.depth_mm, 0.0, 0.6563).wd) == pytest.approx(-10)
    window = 64, 2.2 * 24 * 0.6563 / float(here.na) / 64
    fitted, reference = fitted_psf(shifted, source, *window, numbers=26), huygens_psf(shifted, source, *window)
    assert r_squared(fitted.values, reference.values) > 0.999


@pytest.mark.slow
def test_the_paper_is_judged_in_the_paraxial_pupil(monkeypatch):
    """Whatever fills the pupil by default, and though the six are made to suit the stop; all claims have a verdict."""
    aims = []
    monkeypatch.setattr("p2sf.studies.paper.shipped_lenses", lambda: ("landscape", "double_gauss_28"))
    monkeypatch.setattr("p2sf.studies.paper.find_lens", lambda name: with_aim(find_lens(name), "stop"))

    def recorded(lens, field):
        aims.append(lens.aim)
        row = made_up()["accuracy"][0]
        six = row["r_squared"] | ({"seidel": 0.95} if lens.aim == "stop" else {})
        return {**row, "aim": lens.aim, "field_deg": field, "r_squared": six}

    monkeypatch.setattr("p2sf.studies.paper.fidelity", recorded)
    claims = paper_figures()["claims"]
    assert aims == ["stop"] * 3 + ["paraxial"] * 3 and len(claims) == 6
    assert "-0.600 at 14°" in claims[-1]["measured"] and "0.950" not in claims[-1]["measured"]
    assert all(claim["verdict"] in (HOLDS, FAILS) and claim["figures"] for claim in claims)


@pytest.mark.parametrize("draw", [draw_timing, draw_accuracy])
def test_figures_are_png(draw):
    handle = BytesIO()
    draw(handle, made_up())
    assert handle.getvalue().startswith(b"\x89PNG") and len(handle.getvalue()) > 10_000


def test_stage_times_are_measured_for_every_stage():
    row = stage_times(find_lens("landscape"))
    assert all(0 < row[stage] < 1 for stage in STAGES)


def test_the_command_writes_three_files(tmp_path, capsys, monkeypatch):
    monkeypatch.setattr("p2sf.studies.paper.paper_figures", lambda: {**made_up(), "claims": [CLAIM]})
    assert main(["paper", "-o", str(tmp_path / "figures")]) == 0
    assert sorted(p.name for p in (tmp_path / "figures").iterdir()) == [
        "paper.json",
        "paper_accuracy.png",
        "paper_timing.png",
    ]
    assert json.loads((tmp_path / "figures" / "paper.json").read_text())["claims"] == [CLAIM]
    assert "Six suffice: not reproduced\n    as it is\n" in capsys.readouterr().out


def test_a_folder_that_cannot_be_made_is_one_sentence(tmp_path, capsys):
    (tmp_path / "file").write_text("")
    assert main(["paper", "-o", str(tmp_path / "file" / "below")]) == 2
    assert "choose another" in capsys.readouterr().err
