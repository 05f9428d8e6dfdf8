"""`p2sf tradeoff`: one table, one picture, one JSON, and refusals before the work."""

import json

import pytest

import p2sf.studies.tradeoff as module
from p2sf.cli import main
from p2sf.lensfile.library import find_lens

SMALL = ("tradeoff", "landscape", "--fields-deg", "0", "--pixels", "16")


def test_the_json_has_every_method_with_its_errors_and_costs(capsys):
    assert main([*SMALL, "--json"]) == 0
    rows = json.loads(capsys.readouterr().out)
    assert {row["method"] for row in rows} == {"gaussian", "seidel", "fitted", "traced", "huygens", "spherical"}
    for row in rows:
        assert row["depth_mm"] is None and row["field_deg"] == 0
        assert row["seconds"] > 0 and row["bytes"] > 0 and row["errors"]["r_squared"] <= 1
    # f/16 on axis is where six coefficients are as good as exact rays
    assert next(row for row in rows if row["method"] == "seidel")["errors"]["r_squared"] > 0.9999


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


def test_no_method_is_timed_at_its_first_call(monkeypatch):

    called, timed = [], []
    made, clock = module._point_of_trade, module._time_call
    monkeypatch.setattr(module, "_point_of_trade", lambda *given: called.append(given[-2:]) or made(*given))
    monkeypatch.setattr(module, "_time_call", lambda once: timed.append(tuple(called)) or clock(once))
    module.tradeoff(find_lens("landscape"), fields_deg=(0.0,), methods=("gaussian", "seidel"), pixels=16)
    assert {("gaussian", "settled"), ("seidel", "preview"), ("seidel", "settled")} <= set(timed[0])
