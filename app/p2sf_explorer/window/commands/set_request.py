"""What a set of PSFs is to hold: from the texts that a person typed to the file. No Qt in here."""

from collections.abc import Callable, Iterable
from dataclasses import astuple, dataclass
from math import inf, isfinite
from pathlib import Path
from threading import Event

from p2sf.export.psf_set import PIXELS, PixelGrid, SetAxes, axes_of, left_out, psf_set
from p2sf.export.psf_set_files import HOLDING, check_set_ending, write_psf_set
from p2sf.image.progress import Progress
from p2sf.io.record import describe_many
from p2sf.messages import Message
from p2sf.raytrace.focusing import object_distance
from p2sf.spans import depths, numbers
from p2sf_explorer.compute.setup import Ranges, prescription, ranges, request_setup
from p2sf_explorer.files.embedded_state import ENTRY
from p2sf_explorer.files.snapshot import check_snapshot, check_state_place, state_beside, state_text, write_state
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.state.scales import read_distance, read_number, significant, written_distance
from p2sf_explorer.state.state import State, change

SEPARATOR = ";"  # a comma may belong to a number
NEAREST = 2.0  # times the middle of the slider of distance: the nearest of the distances that are offered first
AROUND = (0.9, 0.95, 1.0, 1.05, 1.1)  # of a near object's distance
SHARES = (0.0, 0.25, 0.5, 0.75, 1.0)  # of the widest field, and of the way from the nearest distance to infinity
DEGREES, NANOMETRES, MICRONS = {"": 1.0, "°": 1.0}, {"": 1.0, "nm": 1.0, "µm": 1e3}, {"": 1.0, "µm": 1.0, "um": 1.0}
SHARE = {"": 1.0, "%": 0.01}  # a fill factor is typed as 0.8 or 80 %


@dataclass(frozen=True)
class SetTexts:
    """What stands in the fields of the dialog; lists have `SEPARATOR` between their values."""

    depths: str
    fields: str
    wavelengths: str
    pixel: str
    fill: str
    pixels: str


@dataclass(frozen=True)
class SetRequest:
    """A set of PSFs of a state's lens, and the file to write."""

    state: State
    axes: SetAxes
    grid: PixelGrid
    path: str


def first_texts(state: State) -> SetTexts:
    """Return what is offered first: five distances and fields, the colours of the lens file, the window's pixel."""
    lens = prescription(state)
    widest = lens.widest_field_deg
    return SetTexts(
        depths=list_texts(written_distance(depth) for depth in first_depths(ranges(lens), state)),
        fields=list_texts(f"{share * widest:.4g}°" for share in SHARES) if widest else "0°",
        wavelengths=list_texts(f"{wave:.6g} nm" for wave in lens.wavelengths_nm),
        pixel=f"{significant(state.display.pixel_um, 3)} µm",
        fill="100 %",
        pixels=str(PIXELS),
    )


def first_depths(limits: Ranges, state: State) -> tuple[float, ...]:
    """Return depths, mm, about a near object's, or evenly in 1/depth from infinity to `NEAREST` times the middle."""
    near = object_distance(prescription(state))
    if isfinite(near):
        return tuple(share * near for share in AROUND)
    if limits.middle_mm is None:
        return (state.optics.depth_mm,)
    return tuple(NEAREST * limits.middle_mm / (1 - share) if share < 1 else inf for share in SHARES)


def list_texts(texts: Iterable[str]) -> str:
    """Return texts as one, as a person would type them."""
    return f"{SEPARATOR} ".join(texts)


def read_request(state: State, texts: SetTexts, path: str) -> SetRequest:
    """Return what a person asked for; P2SFError names what cannot be."""
    check_set_ending(path)
    check_snapshot(state, path)
    if not holds_state(path):
        check_state_place(state_beside(path))
    axes = read_axes(texts)
    for name, values in zip(("depth_mm", "field_deg", "wavelength_nm"), astuple(axes), strict=True):
        for value in values:
            change(state, **{name: value})  # refuses what no slider can be set to
    pixels = texts.pixels.strip().lower()
    grid = PixelGrid(
        read_number(texts.pixel, "pixel", MICRONS),
        read_number(texts.fill, "fill factor", SHARE),
        None if pixels in ("", tr("auto"), "auto") else round(read_number(pixels, "pixels a side")),
    )
    return SetRequest(state, axes, grid, path)


def read_axes(texts: SetTexts) -> SetAxes:
    """Return the depths, fields and wavelengths that the lists ask for; P2SFError names what cannot be."""
    return axes_of(
        depths(texts.depths, "depths_mm", SEPARATOR, read_distance),
        numbers(texts.fields, "fields_deg", SEPARATOR, lambda text: read_number(text, "field angle", DEGREES)),
        numbers(
            texts.wavelengths, "wavelengths_nm", SEPARATOR, lambda text: read_number(text, "wavelength", NANOMETRES)
        ),
    )


def write_set(request: SetRequest, watch: Progress) -> tuple[Path, Message | None]:
    """Make a set and write it with the state in it, or beside it; return the path and a warning, if one is due.

    Raises P2SFError, Cancelled among them.
    """
    state = request.state
    setup = request_setup(state)
    found = psf_set(setup.lens, request.axes, request.grid, state.optics.clip, watch)
    made = write_psf_set(found, request.path, {**describe_many(setup), ENTRY: state_text(state)})
    if not holds_state(made):
        write_state(state, state_beside(made), exported=made.name)
    return made, left_out(found)


def holds_state(path: str | Path) -> bool:
    """Return whether a set of this name holds the state."""
    return Path(path).suffix.lower() in HOLDING


def work(request: SetRequest) -> Callable[[Event, Callable[[float], None]], tuple[Path, Message | None]]:
    """Return a worker's job that makes and writes a set."""
    return lambda cancelled, progress: write_set(request, Progress(progress, cancelled.is_set))
