"""`p2sf tradeoff`: one table, one picture, one JSON, and refusals before the work."""

import json

import pytest

from p2sf.cli import main

SMALL = ("tradeoff", "landscape", "--fields-deg", "0", "--pixels", "16")


def test_the_json_has_every_method_with_its_errors_and_costs(capsys):
    assert main([*SMALL, "--json"]) == 0
    rows = json.loads(capsys.readouterr().out)
    assert {row["method"] for row in rows} == {"gaussian", "seidel", "fitted", "traced", "huygens"}
    for row in rows:
        assert row["depth_mm"] is None and row["field_deg"] == 0
        assert row["seconds"] > 0 and row["bytes"] > 0 and row["errors"]["r_squared"] <= 1
    # f/16 on axis is where six coefficients are as good as exact rays
    assert next(row for row in rows if row["method"] == "seidel")["errors"]["r_squared"] > 0.9999


@pytest.mark.parametrize("ending", ["json", "csv", "png"])
def test_the_result_is_written_by_its_ending(tmp_path, capsys, ending):
    path = tmp_path / f"trade.{ending}"
    assert main([*SMALL, "-o", str(path)]) == 0
    start = path.read_bytes()[:6]
    assert start.startswith({"json": b"[", "csv": b"method", "png": b"\x89PNG"}[ending])
    assert "against the Huygens sum" in capsys.readouterr().out


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
