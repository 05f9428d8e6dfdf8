"""`p2sf zernike`: the exact wavefront as Zernike terms."""

import csv
import io
from pathlib import Path
from typing import Annotated, Any

from cyclopts import Parameter

from p2sf.cli.cautions import open_lens
from p2sf.cli.options import AS_IN_THE_FILE, Asked, Json, LensName, Output, check_output
from p2sf.cli.screen import FILLED, Row, heading, print_json, print_table, warn
from p2sf.cli.spots import Clip
from p2sf.disc.zernike_terms import ZernikeOrder
from p2sf.files.writing import write_beside
from p2sf.io.record import csv_head, describe
from p2sf.pupil.zernike_fit import USUAL_TERMS, ZernikeFit, zernike_fit
from p2sf.setting import set_up

Basis = Annotated[ZernikeOrder, Parameter(help="Noll's order, waves RMS, or the Fringe order, peak waves.")]
Terms = Annotated[int, Parameter(help="How many terms, from the first.")]
COLUMNS = ("term", "n", "m", "name", "waves", "share of variance")


def zernike(
    lens: LensName,
    /,
    *,
    request: Asked = AS_IN_THE_FILE,
    basis: Basis = "noll",
    terms: Terms = USUAL_TERMS,
    clip: Clip = False,
    output: Output = None,
    as_json: Json = False,
) -> None:
    """Decompose the exact wavefront of one source into Zernike terms; write them as .csv.

    Shares are of the variance without piston and tilt, which do not blur. Where rims or lost rays leave part of the
    pupil, the terms are made orthogonal over that part (Gram–Schmidt).
    """
    check_output(output, (".csv",), lens)
    setup = set_up(open_lens(lens), request)
    found = zernike_fit(setup.lens, setup.source, basis, terms, clip)
    if output:
        write_csv(found, describe(setup), output)
    if as_json:
        file = None if output is None else str(output)
        return print_json({"file": file, "aim": setup.lens.aim, **record(found)})
    warn(setup.stop.warning)
    rows: list[Row] = [(t["term"], t["n"], t["m"], t["name"], t["waves"], t["share"]) for t in record(found)["terms"]]
    print_table(heading(setup), COLUMNS, rows)
    figures = (
        ("RMS", found.rms, "waves"),
        ("RMS with tilt", found.rms_with_tilt, "waves"),
        ("RMS of what these terms leave", found.residual, "waves"),
        ("terms are orthogonal over", over(found), ""),
    )
    return print_table(f"\nRays fill {FILLED[setup.lens.aim]}", ("wavefront", "value", "unit"), figures)


def over(found: ZernikeFit) -> str:
    """Return in words which part of the pupil the terms are orthogonal over."""
    if found.clear == 1.0:
        return "the whole pupil"
    return f"the {100 * found.clear:.1f} % of the pupil that passes light (Gram–Schmidt)"


def record(found: ZernikeFit) -> dict[str, Any]:
    """Return the terms and the figures as JSON names them."""
    rows = zip(found.terms, found.waves.tolist(), found.share.tolist(), strict=True)
    return {
        "basis": found.basis,
        "unit": "waves RMS" if found.basis == "noll" else "waves peak",
        "rms": found.rms,
        "rms_with_tilt": found.rms_with_tilt,
        "residual_rms": found.residual,
        "clear_share_of_pupil": found.clear,
        "gram_schmidt": found.clear < 1.0,
        "rays": found.rays,
        "terms": [
            {"term": term.number, "n": term.n, "m": term.m, "name": term.name, "waves": waves, "share": share}
            for term, waves, share in rows
        ],
    }


def write_csv(found: ZernikeFit, about: dict[str, Any], output: Path) -> None:
    """Write the terms, one row each, with m negative for sin |m|θ, θ from +x, behind what they are of; ExportError."""
    text = io.StringIO()
    figures = {name: value for name, value in record(found).items() if name != "terms"}
    text.write(csv_head({**about, "zernike": figures}))
    rows = csv.DictWriter(text, ("term", "n", "m", "name", "waves", "share"), lineterminator="\n")
    rows.writeheader()
    rows.writerows(record(found)["terms"])
    write_beside(output, lambda handle: handle.write(text.getvalue().encode()))
