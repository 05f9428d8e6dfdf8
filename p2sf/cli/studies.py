"""`p2sf tradeoff`, `p2sf validate` and `p2sf paper`: what methods cost, and others' figures beside our own."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, BinaryIO

from cyclopts import Parameter

from p2sf.camera import Camera
from p2sf.cli.cautions import open_lens
from p2sf.cli.options import AS_IN_ITS_FILE, CameraFlags, Json, Output, check_output
from p2sf.cli.screen import print_json, print_table
from p2sf.errors import ExportError, RequestError
from p2sf.files.reasons import reason
from p2sf.files.writing import write_beside, write_json
from p2sf.parameters import check_whole

if TYPE_CHECKING:
    from p2sf.studies.tradeoff import MethodCost

Axis = list[float] | None
WRITTEN = (".json", ".csv", ".png")
Several = Parameter(consume_multiple=True, negative="")
Fields = Annotated[list[float] | None, Several, Parameter(help="Field angles, °; the file's when not given.")]
Depths = Annotated[
    list[float] | None,
    Several,
    Parameter(help="Object distances, mm, inf allowed; the lens's own when not given."),
]
Waves = Annotated[list[float] | None, Several, Parameter(help="Wavelengths, nm; the file's middle one when not given.")]
Pixels = Annotated[int, Parameter(help="Samples along each side of the compared window.")]
Pitch = Annotated[
    float | None, Parameter(help="Distance between samples, µm; one that shows the whole PSF if not given.")
]
Integrated = Annotated[
    bool | None,
    Parameter(negative="--points", help="The light on pixels, or points; as p2sf psf decides when not given."),
]
Methods = Annotated[
    list[str] | None, Several, Parameter(help="Methods to measure, auto among them; all of them when not given.")
]
Named = Annotated[str | None, Parameter(help="A lens file, or the name of a shipped lens (p2sf lenses lists them).")]
Complete = Annotated[
    bool,
    Parameter(
        negative="", help="What every representation of all PSFs of a shipped lens costs, or of each if none is named."
    ),
]
Every = Annotated[bool, Parameter("--all", negative="", help="Every number of the listings, not their groups only.")]
Sampling = Annotated[bool, Parameter(negative="", help="The error of the paper's FFT over NPUPIL and NPSF instead.")]

Samplings = Annotated[
    list[int] | None,
    Several,
    Parameter(
        help="Points along a side of the pupil's grid of OpticStudio's Huygens sum, a plain and the paper's FFT."
    ),
]


def tradeoff(
    lens: Named = None,
    /,
    *,
    methods: Methods = None,
    fields_deg: Fields = None,
    depths_mm: Depths = None,
    wavelengths_nm: Waves = None,
    camera: CameraFlags = AS_IN_ITS_FILE,
    pixels: Pixels = 64,
    pixel_um: Pitch = None,
    integrated: Integrated = None,
    complete: Complete = False,
    sampling: Sampling = False,
    samplings: Samplings = None,
    output: Output = None,
    as_json: Json = False,
) -> None:
    """Measure every method against the exact reference: errors, numbers, rays, time and memory; .json, .csv or .png.

    The stop auto is the narrowest rim for the first depth.
    """
    from p2sf.cli import trades
    from p2sf.studies import tradeoff

    trades.check_combination(complete, sampling, lens)
    if complete:
        return trades.complete(lens, output, as_json)
    if sampling or lens is None:
        return trades.sampling(lens, output, as_json)
    check_output(output, WRITTEN, lens)
    _check(pixels, fields_deg, depths_mm, wavelengths_nm)
    found = open_lens(lens)
    rows = tradeoff.tradeoff(
        found,
        depths_mm=depths_mm,
        fields_deg=fields_deg,
        wavelengths_nm=wavelengths_nm,
        methods=methods or tradeoff.EVERY,
        pixels=pixels,
        pixel_um=pixel_um,
        integrated=integrated,
        samplings=samplings or (),
        camera=Camera(**vars(camera)),
    )
    head, *lines = tradeoff.table(rows)
    title = f"{found.title or found.name}: each method against exact rays, {pixels} × {pixels} samples"
    if output:
        _write_tradeoff(output, rows, title)
    if as_json:
        return print(tradeoff.to_json(rows))
    print_table(title, head, lines)
    return print("", *tradeoff.in_words(rows), sep="\n")


def _check(pixels: int, fields_deg: Axis, depths_mm: Axis, wavelengths_nm: Axis) -> None:
    """Raise RequestError for what cannot be measured; call before the work."""
    check_whole("pixels", pixels, 8, 512)
    for field in fields_deg or ():
        if not abs(field) < 90:
            raise RequestError(
                "{parameter} has {value:g}°; give angles between −90 and 90°, both ends left out",
                parameter="fields_deg",
                value=field,
            )
    lengths = ("depths_mm", depths_mm), ("wavelengths_nm", wavelengths_nm)
    for name, values in (("fields_deg", fields_deg), *lengths):
        if values == []:
            raise RequestError("{parameter} has no number behind it; give one or more, or leave it out", parameter=name)
    for name, values in lengths:
        for value in values or ():
            if not value > 0:
                raise RequestError("{parameter} has {value:g}; give positive numbers", parameter=name, value=value)


def _write_tradeoff(output: Path, rows: list["MethodCost"], title: str) -> None:
    from p2sf.studies import tradeoff

    def write(handle: BinaryIO) -> None:
        match output.suffix.lower():
            case ".json":
                handle.write(tradeoff.to_json(rows).encode())
            case ".csv":
                handle.write(tradeoff.to_csv(rows).encode())
            case ".png":
                tradeoff.draw(handle, rows, title.replace(": ", "\n"))

    write_beside(output, write)


def validate(*, every: Every = False, as_json: Json = False) -> int:
    """Put this program's figures beside those that other programs and the paper's authors published.

    Numbers of other programs' listings are told by groups. The exit code is 1 where a figure differs unexplained.
    """
    from p2sf.studies import validate as study

    rows = study.validation()
    failed = sum(row.verdict == study.DIFFERS for row in rows)
    if as_json:
        print_json({"agree": failed == 0, "figures": [study.record(row) for row in rows]})
        return int(failed > 0)
    single = tuple(row for row in rows if every or not row.published.group)
    print_table("Published figures beside this program's own", study.COLUMNS, study.lines(single))
    if found := study.groups(rows):
        print_table("\nListings of other programs, number by number", study.GROUP_COLUMNS, study.group_lines(found))
    for why, count in study.explanations(rows).items():
        print(f"  {count} explained: {why}")
    print("\nA tolerance is")
    for why, tolerances in study.reasons(rows).items():
        print(f"  {tolerances}: {why}")
    explained = sum(row.verdict == study.EXPLAINED for row in rows)
    print(
        f"{len(rows)} figures, {explained} explained, {failed} differ unexplained, "
        f"{sum(row.ours is None for row in rows)} cannot be computed yet"
    )
    return int(failed > 0)


Folder = Annotated[Path, Parameter(["--output", "-o"], negative="", help="Folder for the figures, made if missing.")]


def paper(*, folder: Folder = Path("paper"), as_json: Json = False) -> None:
    """Redo the paper's figures and judge its claims: stage times, memory, defocus, R² against field; PNG and JSON."""
    from p2sf.studies.paper import draw_accuracy, draw_timing, paper_figures

    _make(folder)
    figures = paper_figures()
    write_json(folder / "paper.json", figures)
    write_beside(folder / "paper_timing.png", lambda handle: draw_timing(handle, figures))
    write_beside(folder / "paper_accuracy.png", lambda handle: draw_accuracy(handle, figures))
    if as_json:
        return print_json(figures)
    title = f"R² against the Huygens sum, {figures['lens']}, {figures['wavelength_nm']} nm"
    fields = tuple(f"{row['field_deg']:g}° {row['aim']}" for row in figures["accuracy"])
    methods = figures["accuracy"][0]["r_squared"]
    rows = [(name, *(f"{row['r_squared'][name]:.5f}" for row in figures["accuracy"])) for name in methods]
    print_table(title, ("method", *fields), rows)
    print("\nThe paper's claims")
    for claim in figures["claims"]:
        print(f"  {claim['claim']}: {claim['verdict']}\n    {claim['measured']}")
    return print(f"written: paper.json, paper_timing.png and paper_accuracy.png in {folder}")


def _make(folder: Path) -> None:
    """Make the folder; ExportError when there cannot be one."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise ExportError(
            "{parameter} is {path}, and that folder cannot be made ({reason}); choose another",
            parameter="output",
            path=str(folder),
            reason=reason(error),
        ) from error
