"""`p2sf tolerance`: which tolerance hurts, and what share of built lenses meets a specification."""

from pathlib import Path
from typing import Annotated, Any, Literal

import numpy as np
from cyclopts import Parameter

from p2sf.cli.options import AS_IN_THE_FILE, Asked, Json, LensName, Whole, check_whole
from p2sf.cli.screen import print_json, print_table, warn
from p2sf.errors import RequestError
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.request import Setup, set_up
from p2sf.tolerance import Builds, Differentials, differentials, sensitivities, simulate, usual_tolerances
from p2sf.tolerance.errors_of_build import UNITS, Tolerance
from p2sf.tolerance.files import back_focus, read_tolerances, with_compensators

FIELDS = 0.0, 0.7, 1.0  # of the lens's largest field
MOST_BUILDS, SHOWN = 1_000_000, 12
PERCENTILES = 10, 50, 90

GradeOption = Annotated[Literal["commercial", "precision", "high"], Parameter(help="Usual tolerances of this grade.")]
SetFile = Annotated[Path | None, Parameter("--set", negative="", help="Tolerances of one's own, a file in TOML.")]
BuildsOption = Annotated[Whole, Parameter(help="How many lenses are built at random.")]
Limit = Annotated[float | None, Parameter(help="What every field of a good lens keeps.", negative="")]
Seed = Annotated[Whole, Parameter(help="Another number draws other lenses.")]


def tolerance(
    lens: LensName,
    /,
    *,
    request: Asked = AS_IN_THE_FILE,
    grade: GradeOption = "precision",
    own: SetFile = None,
    builds: BuildsOption = 10_000,
    rms_waves: Limit = None,
    strehl: Limit = None,
    seed: Seed = 0,
    as_json: Json = False,
) -> None:
    """Show which errors hurt most, and the yield of lenses built at random with the back focus set; fields in turn."""
    check_whole("builds", builds, 1, MOST_BUILDS)
    for name, value in (("rms_waves", rms_waves), ("strehl", strehl)):
        if value is not None and not 0 <= value < np.inf:
            raise RequestError("{parameter} is {value}; give a number, 0 or more", parameter=name, value=value)
    setup = set_up(find_lens(lens), request)
    if own is None:
        listed: tuple[Tolerance, ...] = usual_tolerances(setup.lens, grade)
        compensators: tuple[Tolerance, ...] = (back_focus(setup.lens),)
    else:
        listed, compensators = read_tolerances(own, setup.lens, grade)
    tolerances, places = with_compensators(listed, compensators)
    given = request.field_deg is not None or request.field_x_deg is not None
    known = differentials(setup.lens, sources_of(setup, given), tolerances)
    alone, found = sensitivities(known, places), simulate(known, builds, places, seed)
    record = record_of(known, places, alone, found, (rms_waves, strehl))
    if as_json:
        return print_json(record)
    warn(setup.stop.warning)
    return show(setup, record)


def sources_of(setup: Setup, given: bool) -> tuple[Source, ...]:
    """Return the field asked for, or else axis, seven tenths and edge of the lens's."""
    source, top = setup.source, max(setup.lens.fields_deg, key=abs)
    if given or not top:
        return (source,)
    shares = [Source(source.depth_mm, field_deg=share * top, wavelength_um=source.wavelength_um) for share in FIELDS]
    return tuple(shares)


def record_of(
    known: Differentials,
    places: tuple[int, ...],
    alone: Builds,
    found: Builds,
    limits: tuple[float | None, float | None],
) -> dict[str, Any]:
    """Return all that is known, as JSON has it; errors by how much they add to the RMS of the worst field."""
    worst, nominal = alone.rms_waves.max(1), float(alone.rms_waves[-1].max())
    rows = []
    for number, one in enumerate(known.tolerances):
        if number in places:
            continue
        both = worst[2 * number : 2 * number + 2]
        rows.append(
            {
                "kind": one.kind,
                "first": one.piece[0],
                "last": one.piece[1],
                "amount": one.amount,
                "unit": UNITS[one.kind],
            }
            | {"rms_waves": both.tolist(), "adds_waves": float(both.max()) - nominal}
        )
    rows.sort(key=lambda row: -row["adds_waves"])
    rms, strehl = found.rms_waves.max(1), found.strehl.min(1)
    share, error = found.share_within(*limits)
    return {
        "fields_deg": [source.field_deg for source in known.sources],
        "nominal": {"rms_waves": alone.rms_waves[-1].tolist(), "strehl": alone.strehl[-1].tolist()},
        "errors": rows,
        "compensators": [
            {
                "kind": known.tolerances[k].kind,
                "first": known.tolerances[k].first,
                "rms": float(found.errors[:, k].std()),
            }
            for k in places
        ],
        "builds": len(found.errors),
        "percentiles": {
            str(p): {"rms_waves": float(np.percentile(rms, p)), "strehl": float(np.percentile(strehl, 100 - p))}
            for p in PERCENTILES
        },
        "within": {"rms_waves": limits[0], "strehl": limits[1], "share": share, "standard_error": error},
    }


def show(setup: Setup, record: dict[str, Any]) -> None:
    """Print what hurts most, and the yield."""
    fields = ", ".join(f"{field:.4g}°" for field in record["fields_deg"])
    lens = setup.prescription
    title = f"{lens.title or lens.name}: fields {fields}, {setup.source.wavelength_um * 1000:.7g} nm"
    columns = ("error", "±", "", "adds to the worst RMS, waves")
    rows = [(_name(row), row["amount"], row["unit"], row["adds_waves"]) for row in record["errors"][:SHOWN]]
    print_table(title, columns, rows)
    more = len(record["errors"]) - SHOWN
    if more > 0:
        print(f"and {more} more, which add less\n")
    nominal = record["nominal"]
    figures = [("as designed", max(nominal["rms_waves"]), min(nominal["strehl"]))]
    figures += [(f"{p} % of the builds", one["rms_waves"], one["strehl"]) for p, one in record["percentiles"].items()]
    print_table(
        f"{record['builds']} builds, errors anywhere within their tolerances",
        ("at most, at least", "RMS of the worst field, waves", "least Strehl ratio"),
        figures,
    )
    within = record["within"]
    asked = {"RMS ≤": within["rms_waves"], "Strehl ratio ≥": within["strehl"]}
    limits = " and ".join(f"{name} {value:g}" for name, value in asked.items() if value is not None)
    if limits:
        print(f"{100 * within['share']:.2f} % ± {100 * within['standard_error']:.2f} % keep {limits} in all fields")


def _name(row: dict[str, Any]) -> str:
    what = row["kind"].replace("_", " ")
    where = f"surface {row['first']}" if row["first"] == row["last"] else f"surfaces {row['first']} to {row['last']}"
    return f"{what} of {where}" if what != "thickness" else f"thickness behind {where}"
