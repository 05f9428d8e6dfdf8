"""`p2sf tradeoff`: one table, one picture, one JSON, and refusals before the work."""

import csv
import json
from math import inf

import pytest

import p2sf
import p2sf.studies.tradeoff as module
from p2sf.cli import main
from p2sf.figures.compare import Errors
from p2sf.lensfile.library import find_lens
from p2sf.messages import Message

SMALL = ("tradeoff", "landscape", "--fields-deg", "0", "--pixels", "16")


def test_the_json_has_every_method_with_its_errors_and_costs(capsys):
    assert main([*SMALL, "--json"]) == 0
    rows = json.loads(capsys.readouterr().out)
    assert {row["method"] for row in rows} == {"gaussian", "seidel", "fitted", "traced", "huygens", "spherical", "auto"}
    for row in rows:
        assert row["depth_mm"] is None and row["field_deg"] == 0
        assert row["seconds"] > 0 and row["bytes"] > 0 and row["errors"]["r_squared"] <= 1
    # f/16 on axis is where six coefficients are as good as exact rays
    assert next(row for row in rows if row["method"] == "seidel")["errors"]["r_squared"] > 0.9999


def made(method, field, r_squared, seconds, quality="settled", choice="", mtf_error=0.0):
    errors = Errors(r_squared, 0.1, None, 1.0, 2.0, 3.0)
    return module.MethodCost(
        method, quality, choice or method, "huygens", "stop", inf, field, 550.0, errors, mtf_error, 6, 64, seconds,
        None, 1500, Message(""), None,
    )  # fmt: skip


def test_the_advice_is_the_fastest_that_suffices_everywhere():
    """By hand: seidel fails at 10°, fitted at R² 0.999; nothing keeps the last, and auto is no method of its own."""
    rows = [
        *(made("seidel", field, r2, 1e-3) for field, r2 in ((0, 0.9999), (10, 0.5))),
        *(made("fitted", field, r2, s) for field, r2, s in ((0, 0.9985, 2e-3), (10, 0.995, 4e-3))),
        *(made("traced", field, 0.9995, 8e-3) for field in (0, 10)),
        *(made("auto", field, 0.9995, 1e-4, choice="traced") for field in (0, 10)),
    ]
    found = module.advice(rows, (0.99, 0.999, 0.9999))
    assert [(one.method, one.seconds) for one in found] == [
        ("fitted", pytest.approx(3e-3)),
        ("traced", pytest.approx(8e-3)),
        (None, inf),
    ]
    first, own, many = module.in_words(rows)
    assert "R² ≥ 0.99 take fitted, 3 ms a PSF" in first and "all 2 points" in first
    assert own.startswith("auto took traced") and many.startswith("10 000 PSFs one by one take 30 s")


def test_the_csv_holds_numbers_with_units(tmp_path, capsys):
    """An unbounded depth is inf, 1 − R² is not written in words, and every head with a dimension has its unit."""
    path = tmp_path / "trade.csv"
    assert main([*SMALL, "--methods", "auto", "seidel", "--pixel-um", "0.9", "--points", "-o", str(path)]) == 0
    rows = list(csv.DictReader(path.read_text().splitlines()))
    assert {row["method"] for row in rows} == {"auto", "seidel"} and {row["reference"] for row in rows} == {"huygens"}
    for row in rows:
        numbers = {head: float(value) for head, value in list(row.items())[5:] if value}
        assert numbers["depth_mm"] == inf and numbers["r_squared"] > 0.999 and numbers["cpu_ms"] > 0
        assert ("choosing_ms" in numbers) == (row["method"] == "auto")
        taken = p2sf.render(
            find_lens("landscape"), p2sf.Source(wavelength_nm=numbers["wavelength_nm"]), row["choice"], pixels=16,
            pixel_um=0.9, quality=row["quality"], integrated=False,
        )  # fmt: skip
        assert numbers["rays"] == taken.rays and not taken.integrated
    assert "for R² ≥ 0.99 take" in capsys.readouterr().out


@pytest.mark.slow
def test_the_narrowest_rim_can_be_the_stop(tmp_path, capsys):
    """A front rim narrower than the named stop: by auto it is the stop, the bundle is smaller and the blur too."""
    path = tmp_path / "narrow.toml"
    rows = ("radius = 50.0\nthickness = 4.0\nglass = 1.5\nsemi_diameter = 2.0", "radius = -50.0\nthickness = 47.0")
    head = "stop_surface = 2\n\n[aperture]\nstop_semi_diameter = 5.0\n"
    path.write_text(head + "".join(f"\n[[surface]]\n{row}\n" for row in rows))
    common = ("tradeoff", path, "--fields-deg", "0", "--pixels", "16", "--json")
    found = {}
    for stop in ("file", "auto"):
        assert main([*map(str, common), "--stop", stop]) == 0
        found[stop] = json.loads(capsys.readouterr().out)
    of_seidel = {stop: next(row for row in found[stop] if row["method"] == "seidel") for stop in found}
    by_file, by_auto = (of_seidel[stop]["errors"]["r_squared"] for stop in ("file", "auto"))
    assert by_auto > by_file + 1e-4


def test_a_database_takes_the_narrowest_rim_too(answer, tmp_path):
    common = ("database", "build", "double_gauss_28", "--depths-mm", "inf", "--wavelengths-nm", 550, "-o")
    assert answer(*common, tmp_path / "d.npz", "--stop", "auto")["bytes"] > 0


@pytest.mark.slow
@pytest.mark.parametrize("ending", ["json", "csv", "png"])
def test_the_result_is_written_by_its_ending(tmp_path, capsys, ending):
    path = tmp_path / f"trade.{ending}"
    assert main([*SMALL, "-o", str(path)]) == 0
    start = path.read_bytes()[:6]
    assert start.startswith({"json": b"[", "csv": b"method", "png": b"\x89PNG"}[ending])
    assert "against exact rays" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["-o", "x.bmp"], '".bmp" is unknown'),
        (["--fields-deg", "90"], "--fields-deg has 90°"),
        (["--fields-deg"], "--fields-deg has no number"),
        (["--depths-mm"], "--depths-mm has no number"),
        (["--wavelengths-nm"], "--wavelengths-nm has no number"),
        (["--pixels", "32.5"], '"32.5" is no whole number'),
        (["--depths-mm", "0"], "--depths-mm has 0"),
        (["--wavelengths-nm", "-5"], "--wavelengths-nm has -5"),
        (["--wavelengths-nm", "50"], "nm"),
        (["--pixels", "4"], "--pixels is 4"),
    ],
)
def test_what_cannot_be_is_one_sentence(arguments, said, capsys):
    assert main(["tradeoff", "landscape", *arguments]) == 2
    error = capsys.readouterr().err
    assert said in error and error.count("\n") == 1


def test_no_method_is_timed_at_its_first_call(monkeypatch):

    called, timed = [], []
    made, clock = module.Point.picture, module._time_call
    monkeypatch.setattr(module.Point, "picture", lambda *given: called.append(given[1:3]) or made(*given))
    monkeypatch.setattr(module, "_time_call", lambda once: timed.append(tuple(called)) or clock(once))
    module.tradeoff(find_lens("landscape"), fields_deg=(0.0,), methods=("gaussian", "seidel"), pixels=16)
    assert {("gaussian", "settled"), ("seidel", "preview"), ("seidel", "settled")} <= set(timed[0])
