"""`p2sf tolerance`: which tolerance hurts, and what share of built lenses meets a specification."""

from collections.abc import Sequence
from pathlib import Path
from typing import Annotated, Any, Literal

import numpy as np
from cyclopts import Parameter

from p2sf.cli.cautions import open_lens
from p2sf.cli.options import AS_IN_THE_FILE, Asked, Json, LensName
from p2sf.cli.screen import field_text, print_json, print_table, warn
from p2sf.errors import RequestError
from p2sf.lens.source import Source
from p2sf.parameters import check_positive, check_whole
from p2sf.setting import Setup, set_up
from p2sf.tolerance.builds import SUMMED_RMS, Builds, by_form, simulate
from p2sf.tolerance.criteria import CRITERIA, LARGE_IS_GOOD, Criterion, harms, of_worst_field, share_within
from p2sf.tolerance.differentials import Differentials, differentials, usual_sources
from p2sf.tolerance.errors_of_build import UNITS, Tolerance, usual_tolerances
from p2sf.tolerance.files import back_focus, read_tolerances, with_compensators
from p2sf.tolerance.single import INVALID, form_errors, sensitivities

COLUMNS: dict[Criterion, str] = {
    "rms_waves": "adds to the worst RMS, waves",
    "strehl": "takes from the least Strehl ratio",
    "mtf": "takes from the least contrast",
    "boresight_um": "moves the image by, µm",
}
WORST: dict[Criterion, str] = {
    "rms_waves": "RMS at most, waves",
    "strehl": "Strehl ratio at least",
    "mtf": "contrast at least",
    "boresight_um": "shift of the image at most, µm",
}
MOST_BUILDS, SHOWN = 1_000_000, 12
NOTICED = 0.01  # of the largest harm: errors of the form below that are not told
STREHL = f"Strehl ratio: of the peak, as p2sf psf tells it; 0 beyond an RMS of {SUMMED_RMS:g} waves."
LARGEST_SEED = 2**63 - 1
PERCENTILES = 10, 50, 90

GradeOption = Annotated[Literal["commercial", "precision", "high"], Parameter(help="Usual tolerances of this grade.")]
SetFile = Annotated[Path | None, Parameter("--set", negative="", help="Tolerances of one's own, a file in TOML.")]
BuildsOption = Annotated[int, Parameter(help="How many lenses are built at random.")]
RmsLimit = Annotated[
    float | None, Parameter(help="A good lens has at most this RMS wavefront at every field, waves.", negative="")
]
StrehlLimit = Annotated[
    float | None, Parameter(help="A good lens has at least this Strehl ratio at every field.", negative="")
]
MtfLimit = Annotated[
    float | None, Parameter(help="A good lens has at least this contrast at every field.", negative="")
]
ShiftLimit = Annotated[
    float | None, Parameter(help="The image of a good lens is shifted by at most this at every field, µm.", negative="")
]
By = Annotated[Criterion, Parameter(help="What errors are sorted by.")]
Frequency = Annotated[float, Parameter(help="Of the contrast, cycles per mm on the sensor.", negative="")]
Seed = Annotated[int, Parameter(help="Another number draws other lenses.")]


def tolerance(
    lens: LensName,
    /,
    *,
    request: Asked = AS_IN_THE_FILE,
    grade: GradeOption = "precision",
    own: SetFile = None,
    builds: BuildsOption = 10_000,
    rms_waves: RmsLimit = None,
    strehl: StrehlLimit = None,
    mtf: MtfLimit = None,
    boresight_um: ShiftLimit = None,
    criterion: By = "rms_waves",
    frequency_per_mm: Frequency = 10.0,
    seed: Seed = 0,
    as_json: Json = False,
) -> None:
    """Show which errors hurt most, and the yield of lenses built at random with the back focus set; fields in turn."""
    check_whole("builds", builds, 1, MOST_BUILDS)
    check_whole("seed", seed, 0, LARGEST_SEED)
    given: dict[Criterion, float | None] = {"rms_waves": rms_waves, "strehl": strehl, "mtf": mtf}
    given["boresight_um"] = boresight_um
    for name, value in given.items():
        if value is not None and not 0 <= value < np.inf:
            raise RequestError("{parameter} is {value}; give a number, 0 or more", parameter=name, value=value)
        if value is not None and name in LARGE_IS_GOOD and value > 1:
            raise RequestError(
                "{parameter} is {value:g}; give a number from {low:g} to {high:g}",
                parameter=name,
                value=value,
                low=0,
                high=1,
            )
    check_positive("frequency_per_mm", frequency_per_mm)
    limits = {name: value for name, value in given.items() if value is not None}
    setup = set_up(open_lens(lens), request)
    if own is None:
        listed: tuple[Tolerance, ...] = usual_tolerances(setup.lens, grade)
        compensators: tuple[Tolerance, ...] = (back_focus(setup.lens),)
    else:
        listed, compensators = read_tolerances(own, setup.lens, grade)
    tolerances, places = with_compensators(listed, compensators)
    one_field = request.field_deg is not None or request.field_x_deg is not None
    sources = (setup.source,) if one_field else usual_sources(setup.lens, setup.source)
    known = differentials(setup.lens, sources, tolerances)
    wanted = frequency_per_mm if criterion == "mtf" or "mtf" in limits else None
    alone, form = (one(known, places, wanted) for one in (sensitivities, by_form))
    found = simulate(known, builds, places, seed, wanted)
    record = record_of(known, places, (alone, form), found, limits, criterion)
    if as_json:
        return print_json(record)
    warn(setup.stop.warning)
    return show(setup, known.sources, record)


def record_of(
    known: Differentials,
    places: tuple[int, ...],
    single: tuple[Builds, Builds],
    found: Builds,
    limits: dict[Criterion, float],
    criterion: Criterion = "rms_waves",
) -> dict[str, Any]:
    """Return all that is known, as JSON has it; errors by how much worse they make the worst field.

    ``single``: one error at a time, by exact rays and by the form. Figures of errors that lose rays are None.
    """
    alone, form = single
    worst, adds = alone.rms_waves.max(1), harms(alone, "rms_waves", places)
    harm, excess = harms(alone, criterion, places), form_errors(form, alone, criterion, places)
    rows: list[dict[str, Any]] = []
    for number, one in enumerate(known.tolerances):
        if number in places:
            continue
        where = {"kind": one.kind, "first": one.piece[0], "last": one.piece[1]}
        size = {"amount": one.amount, "unit": UNITS[one.kind]}
        both = {
            "rms_waves": [_finite_or_none(one) for one in worst[2 * number : 2 * number + 2]],
            "adds_waves": _finite_or_none(adds[number]),
        }
        rows.append(
            {
                **where,
                **size,
                **both,
                "harm": _finite_or_none(harm[number]),
                "form_error": _finite_or_none(excess[number]),
            }
        )
    rows.sort(key=lambda row: -np.inf if row["harm"] is None else -row["harm"])
    values = of_worst_field(found, criterion)
    rms, strehl = found.rms_waves.max(1), found.strehl.min(1)
    share, error = share_within(found, limits)
    return {
        "fields_deg": [source.field_deg for source in known.sources],
        "azimuths_deg": [source.azimuth_deg for source in known.sources],
        "nominal": {"rms_waves": alone.rms_waves[-1].tolist(), "strehl": alone.strehl[-1].tolist()},
        "designed": {name: float(of_worst_field(alone, name)[-1]) for name in ("rms_waves", "strehl", criterion)},
        "criterion": criterion,
        "strehl_is": STREHL,
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
            | {criterion: float(np.percentile(values, 100 - p if criterion in LARGE_IS_GOOD else p))}
            for p in PERCENTILES
        },
        "within": {**{name: limits.get(name) for name in CRITERIA}, "share": share, "standard_error": error},
    }


def _finite_or_none(value: float) -> float | None:
    return float(value) if np.isfinite(value) else None


def show(setup: Setup, sources: Sequence[Source], record: dict[str, Any]) -> None:
    """Print what hurts most, and the yield."""
    fields = ", ".join(map(field_text, sources))
    lens = setup.prescription
    title = f"{lens.title or lens.name}: fields {fields}, {setup.source.wavelength_um * 1000:.7g} nm"
    columns = ("error", "±", "", COLUMNS[record["criterion"]])
    # To three digits, as the sums of exact rays are good for.
    rows = [(_name(row), row["amount"], row["unit"], _digits(row["harm"])) for row in record["errors"][:SHOWN]]
    print_table(title, columns, rows)
    more = len(record["errors"]) - SHOWN
    if more > 0:
        print(f"and {more} more, which add less\n")
    _show_doubts(record["errors"])
    shown = [name for name in WORST if name in record["designed"]]
    figures = [("as designed", *(record["designed"][name] for name in shown))]
    figures += [(f"{p} % of the builds", *(one[name] for name in shown)) for p, one in record["percentiles"].items()]
    print_table(
        f"{record['builds']} builds, errors anywhere within their tolerances: what their worst field has",
        ("builds", *(WORST[name] for name in shown)),
        figures,
    )
    if "strehl" in record["designed"]:
        print(STREHL)
    within = record["within"]
    asked = {"RMS ≤": within["rms_waves"], "Strehl ratio ≥": within["strehl"], "contrast ≥": within["mtf"]}
    asked["µm of the image's shift ≤"] = within["boresight_um"]
    words = " and ".join(f"{name} {value:g}" for name, value in asked.items() if value is not None)
    if words:
        print(f"{100 * within['share']:.2f} % ± {100 * within['standard_error']:.2f} % keep {words} in all fields")


def _digits(value: float | None) -> float | str:
    return "rays are lost" if value is None else float(f"{value:.3g}")


def _show_doubts(rows: Sequence[dict[str, Any]]) -> None:
    """Print which errors lose rays, and which ones the quadratic form of the builds does not describe."""
    most = max((abs(row["harm"]) for row in rows if row["harm"] is not None), default=0.0)
    lost = [_name(row) for row in rows if row["harm"] is None]
    if lost:
        print(f"Rays are lost at ± the tolerance of: {', '.join(lost)}. There is no figure; do not trust the builds.")
    off = [
        f"{_name(row)} ({row['form_error'] / row['harm']:+.0%})"
        for row in rows
        if row["harm"] and abs(row["form_error"]) > max(INVALID * abs(row["harm"]), NOTICED * most)
    ]
    if off:
        print(f"Figures are of exact rays; builds are drawn by a quadratic form, which is off for: {', '.join(off)}")


def _name(row: dict[str, Any]) -> str:
    what = row["kind"].replace("irregularity_45", "irregularity at 45°").replace("_", " ")
    where = f"surface {row['first']}" if row["first"] == row["last"] else f"surfaces {row['first']} to {row['last']}"
    return f"{what} of {where}" if what != "thickness" else f"thickness behind {where}"
