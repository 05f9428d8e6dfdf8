"""The figures of one source as every road shows them: the library, the command line, and the panels of the window.

A road returns `Shown` values: a number to its last bit (library, JSON) or as it is printed, with half a unit of its
last digit. Everything runs in this process.
"""

import io
import json
import re
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, redirect_stderr, redirect_stdout
from dataclasses import dataclass
from math import isfinite, isinf, nan
from typing import Any

import numpy as np

import p2sf
from p2sf.camera import Camera
from p2sf.cli import main
from p2sf.errors import P2SFError
from p2sf.figures.spot import spot
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.setting import set_up_source
from p2sf.tolerance.differentials import differentials

SAME = 5e-6  # relative: half a unit of six digits, which the command line prints
METHODS = ("seidel", "fitted", "traced", "huygens")
EXACT = ("traced", "huygens")
SETTLED = 2e-4  # relative: sums of waves over different windows are each converged to 1e-4
CUSP = 4e-3  # of a modulus that vanishes between two samples of a curve
FEW = 32  # samples a side of a window that need not show all light
PRINTED = re.compile(r"([−-]?\d+(?:\.\d+)?)(?:·10([⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+)|e([-+]?\d+))?")
LOWERED = str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789")


@dataclass(frozen=True)
class Point:
    """One source of one lens: ``focus_mm`` is where the sensor is focused, None as the lens file has it.

    ``steep``: so many waves that PSFs in windows that show all light take minutes.
    """

    name: str
    depth_mm: float
    field_deg: float
    focus_mm: float | None = None
    steep: bool = False

    @property
    def lens(self) -> Lens:
        return p2sf.load_lens(self.name)

    @property
    def source(self) -> Source:
        return Source(self.depth_mm, field_deg=self.field_deg, wavelength_um=self.lens.reference_wavelength_um)

    @property
    def label(self) -> str:
        far = "∞" if isinf(self.depth_mm) else f"{self.depth_mm:g} mm"
        return f"{self.name} {self.field_deg:.4g}° {far}"

    @property
    def flags(self) -> list[str]:
        """Return the source and the camera as the command line takes them."""
        given = {"--depth-mm": self.depth_mm, "--field-deg": self.field_deg, "--focus-mm": self.focus_mm}
        return [part for name, value in given.items() if value is not None for part in (name, repr(value))]


@dataclass(frozen=True)
class Shown:
    """One figure on one road by one method: its value, and how far the truth may be from a rounded one, 0 if exact.

    ``refused``: why there is none.
    """

    road: str
    figure: str
    method: str
    value: float = np.nan
    half_digit: float = 0.0
    refused: str = ""

    def agrees(self, other: float) -> bool:
        """Return whether this is another value, rounded as this is printed."""
        same = SETTLED if self.figure == "Strehl" else SAME
        return bool(abs(self.value - other) <= self.half_digit * (1 + 1e-9) + same * abs(other))


def printed(text: str) -> tuple[float, float]:
    """Return the first number of a text, and half a unit of its last digit."""
    found = PRINTED.search(text)
    assert found, text
    digits, raised, power = found.groups()
    scale = 10.0 ** int((raised or power or "0").translate(LOWERED))
    return float(digits.replace("−", "-")) * scale, 0.5 * scale * 10.0 ** -len(digits.partition(".")[2])


# The library


def library(at: Point, method: str, frequency_per_mm: np.ndarray, pitches_um: tuple[float, ...]) -> Iterator[Shown]:
    """Yield what functions of `p2sf` return; the Strehl ratio also of PSFs sampled at several pitches."""

    def strehl(window: dict[str, float]) -> float:
        return float(p2sf.render(at.lens, at.source, method, **window, focus_mm=at.focus_mm).strehl)

    windows = [{"pixels": FEW, "pixel_um": pitch} for pitch in pitches_um] if at.steep else [{}]
    windows += [{"pixels": FEW, "pixel_um": pitch} for pitch in pitches_um if not at.steep and method in EXACT]
    for window in windows:
        road = f"render, {window['pixel_um']:.2g} µm" if window else "render"
        yield from attempted(road, "Strehl", method, lambda window=window: strehl(window))
    yield from energy(at, method)
    yield from contrast(at, method, frequency_per_mm)


def energy(at: Point, method: str) -> Iterator[Shown]:
    try:
        found = p2sf.Camera(at.lens, focus_mm=at.focus_mm).at(at.source).energy(method=method)
    except P2SFError as error:
        yield Shown("encircled_energy", "R80", method, refused=str(error))
        return
    yield Shown("encircled_energy", "R80", method, found.radius_80_um)
    if method in EXACT:
        yield Shown("encircled_energy", "spot RMS", "exact rays", found.rms_um)


def contrast(at: Point, method: str, frequency_per_mm: np.ndarray) -> Iterator[Shown]:
    try:
        found = p2sf.Camera(at.lens, focus_mm=at.focus_mm).at(at.source).mtf(frequency_per_mm, method=method)
    except P2SFError as error:
        yield Shown("mtf", "MTF", method, refused=str(error))
        return
    for number in range(frequency_per_mm.size):
        yield Shown("mtf", f"S{number + 1}", method, float(found.sagittal[number]))
        yield Shown("mtf", f"T{number + 1}", method, float(found.tangential[number]))


def library_spot(at: Point) -> Iterator[Shown]:
    setup = set_up_source(at.lens, at.source, Camera(focus_mm=at.focus_mm))
    yield Shown("spot", "spot RMS", "exact rays", float(spot(setup.lens, setup.source).rms_um))


def attempted(road: str, figure: str, method: str, made: Any) -> Iterator[Shown]:
    try:
        yield Shown(road, figure, method, made())
    except P2SFError as error:
        yield Shown(road, figure, method, refused=str(error))


# The command line


def command(*arguments: str) -> dict[str, Any] | str:
    """Return the JSON object that a command line prints, or its sentence where it fails."""
    output, error = io.StringIO(), io.StringIO()
    with redirect_stdout(output), redirect_stderr(error):
        code = main([*arguments, "--json"])
    return json.loads(output.getvalue()) if code == 0 else error.getvalue().strip()


def command_line(at: Point, method: str, pitch_um: float) -> Iterator[Shown]:
    """Yield what `p2sf psf` prints."""
    window = ["--pixels", str(FEW), "--pixel-um", repr(pitch_um)] if at.steep else []
    said = command("psf", at.name, *at.flags, "--method", method, *window)
    if isinstance(said, str):
        yield Shown("p2sf psf", "Strehl", method, refused=said)
        return
    yield Shown("p2sf psf", "Strehl", method, said["strehl"])
    if said["share_of"] == "all light":
        yield Shown("p2sf psf", "R80", method, said["radius_80_um"])
        if method in EXACT:
            yield Shown("p2sf psf", "spot RMS", "exact rays", said["rms_um"])


def command_line_spot(at: Point) -> Iterator[Shown]:
    """Yield what `p2sf spot` prints."""
    said = command("spot", at.name, *at.flags)
    if isinstance(said, str):
        yield Shown("p2sf spot", "spot RMS", "exact rays", refused=said)
    else:
        yield Shown("p2sf spot", "spot RMS", "exact rays", said["rms_um"])


# The window


class Window:
    """Panels outside a window, each with the answer of a state; what they print is read back from them."""

    def __init__(self) -> None:
        from PySide6.QtWidgets import QApplication

        from p2sf_explorer.charts.theme import tokens

        self.app = QApplication.instance() or QApplication([])
        self.theme, self.panels = tokens("light"), dict[str, Any]()

    def close(self) -> None:
        """End the panels' threads."""
        from p2sf_explorer.panels import end_work

        for panel in self.panels.values():
            end_work(panel)

    def shown(self, at: Point, method: str, frequency_per_mm: np.ndarray) -> Iterator[Shown]:
        """Yield what panels print where the state has a method; those of rays once, with the method "traced"."""
        try:
            answer = self.live(at, method)
        except P2SFError as error:
            yield Shown("window", "Strehl", method, refused=str(error))
            return
        if answer.psf.strehl is not None and answer.psf.method == method:
            yield Shown("PSF", "Strehl", method, float(answer.psf.strehl))
            yield from self.read("beside", answer, method, {"Strehl": "Strehl"})
        pupil = {"seidel": "seidel", "traced": "traced"}.get(method)  # panels of the pupil know no others
        if pupil:
            figures = {"R80": "R80"} | ({"spot RMS": "rays"} if pupil == "traced" else {})
            yield from self.read("profiles", answer, pupil, figures)
            yield from self.contrast(answer, pupil, frequency_per_mm)
        if method == "traced":
            yield from self.spot(answer)

    def live(self, at: Point, method: str, **changes: Any) -> Any:
        from p2sf_explorer.compute.live import live

        return live(self.state(at, method, **changes))

    def state(self, at: Point, method: str, **changes: Any) -> Any:
        """Return the state of a point; it has the lens's own settings otherwise."""
        from p2sf_explorer.compute.setup import default_state
        from p2sf_explorer.state.state import change

        own = {"depth_mm": at.depth_mm, "field_deg": at.field_deg, "focus_mm": at.focus_mm, "method": method}
        return change(default_state(at.name), **own, **changes)

    def panel(self, key: str, answer: Any) -> Any:
        """Return a panel that shows an answer; P2SFError where it has nothing to show."""
        from p2sf_explorer.compute.live import with_views
        from p2sf_explorer.panels import build
        from p2sf_explorer.state.panels import REGISTRY, view_of
        from p2sf_explorer.store.late_answers import LateAnswers
        from p2sf_explorer.store.store import Store

        entry = next(entry for entry in REGISTRY if entry.key == key)
        view = view_of(entry)
        answer = with_views(answer, {key: view} if view else {}, 0.0)
        if key in answer.views and (why := answer.views[key].why):
            raise P2SFError(why)
        if key not in self.panels:
            self.panels[key] = build(entry, Store(answer.state))
            self.panels[key].restyle(self.theme)
        made = self.panels[key]
        made.show(answer)
        while any(late.busy for late in made.widget.findChildren(LateAnswers)):
            self.app.processEvents()
        return made

    def read(self, key: str, answer: Any, method: str, figures: dict[str, str]) -> Iterator[Shown]:
        """Yield figures of a panel's line of text, each the number behind a word."""
        try:
            text = self.panel(key, answer).widget.readout.text()
        except P2SFError as error:
            text = str(error)
        for figure, word in figures.items():
            yield read_behind(word, text, key, figure, "exact rays" if figure == "spot RMS" else method)

    def contrast(self, answer: Any, method: str, frequency_per_mm: np.ndarray) -> Iterator[Shown]:
        """Yield what the pointer reads off the curves of *MTF*."""
        try:
            panel = self.panel("mtf", answer)
        except P2SFError as error:
            yield Shown("mtf panel", "MTF", method, refused=str(error))
            return
        for number, frequency in enumerate(frequency_per_mm, 1):
            reading = panel.chart.read(float(frequency), 0.5, snap=False)
            said = {value.name: value.text for value in reading.values} if reading else {}
            for letter, name in (("S", "sagittal"), ("T", "tangential")):
                if name in said:
                    value, half_digit = printed(said[name])  # between samples the last digit is not quite certain
                    cusp = CUSP if value < 2 * CUSP else 0.0
                    yield Shown("mtf panel", f"{letter}{number}", method, value, max(2 * half_digit, cusp))
                else:
                    why = panel.widget.readout.text()
                    yield Shown("mtf panel", f"{letter}{number}", method, refused=why)

    def spot(self, answer: Any) -> Iterator[Shown]:
        """Yield the RMS radius of *Spot*."""
        from p2sf_explorer.i18n.messages import WINDOW

        try:
            rows = self.panel("spot", answer).facts._rows
        except P2SFError as error:
            yield Shown("spot panel", "spot RMS", "exact rays", refused=str(error))
            return
        yield Shown("spot panel", "spot RMS", "exact rays", *printed(rows[0][1].text(WINDOW)))

    def matrix(self, points: Sequence[Point], method: str) -> Iterator[tuple[Point, Shown]]:
        """Yield the figures of *Matrix* for the fields of one lens: Strehl ratio or R80 under a PSF, RMS of a spot."""
        from p2sf_explorer.compute.matrix.pictures import matrix, settle
        from p2sf_explorer.i18n.messages import WINDOW

        rows = {"matrix_across": "side", "matrix_fields_deg": tuple(at.field_deg for at in points)}
        words = {"psf": ("Strehl", "R80")} | ({"spot": ("RMS",)} if method == "traced" else {})
        for what, named in words.items():
            try:
                answer = self.live(points[0], method, matrix_what=what, **rows)
            except P2SFError as error:
                yield points[0], Shown("matrix", what, method, refused=str(error))
                continue
            tiles = settle(matrix(answer).found.request, lambda: False, lambda *_: None)
            for at, (tile,) in zip(points, tiles, strict=True):
                text = tile.figure.text(WINDOW) if tile.content is not None else ""
                for word in named:
                    if word in text and "(" not in text and tile.method in (method, "exact rays"):
                        figure = {"RMS": "spot RMS"}.get(word, word)
                        whose = "exact rays" if word == "RMS" else method
                        yield at, read_behind(word, text, "matrix", figure, whose)


def read_behind(word: str, text: str, road: str, figure: str, method: str) -> Shown:
    """Return the number that stands behind a word in a panel's text."""
    place = text.find(word)
    if place < 0:
        return Shown(road, figure, method, refused=text[:160])
    return Shown(road, figure, method, *printed(text[place + len(word) :]))


def each_road(at: Point, method: str, frequency_per_mm: np.ndarray, window: Window | None) -> Iterator[Shown]:
    """Yield every figure of a point by a method, the library first."""
    pitches = pitches_um(at)
    yield from library(at, method, frequency_per_mm, pitches)
    if method == "traced":
        yield from library_spot(at)
        yield from command_line_spot(at)
    yield from command_line(at, method, pitches[0])
    if window and not at.steep:
        yield from window.shown(at, method, frequency_per_mm)


def pitches_um(at: Point) -> tuple[float, float]:
    """Return distances of samples, µm: a fifth and a half of λ/NA."""
    na = float(p2sf.Camera(at.lens, focus_mm=at.focus_mm).at(at.source).coefficients().na)
    return 0.2 * at.source.wavelength_um / na, 0.5 * at.source.wavelength_um / na


# Tolerances


class KeptDifferentials:
    """Wavefront differentials that are computed once for all roads that ask for the same ones."""

    def __init__(self) -> None:
        self._kept: dict[tuple, Any] = {}

    def __call__(self, lens: Lens, sources: Sequence[Source], tolerances: Sequence[Any], *more: Any) -> Any:
        key = lens, tuple(sources), tuple(tolerances)
        if key not in self._kept:
            self._kept = {key: differentials(lens, sources, tolerances)}
        return self._kept[key]


@contextmanager
def one_computation() -> Iterator[None]:
    """Have the command line and the window take differentials that are known already, and draw few builds."""
    import p2sf.cli.tolerances as on_the_command_line
    from p2sf_explorer.compute.views import tolerances as analysis

    kept = KeptDifferentials()
    modules = (on_the_command_line, analysis)
    before, builds = [module.differentials for module in modules], analysis.BUILDS
    try:
        for module in modules:
            module.differentials = kept
        analysis.BUILDS = 10
        yield
    finally:
        for module, own in zip(modules, before, strict=True):
            module.differentials = own
        analysis.BUILDS = builds


def harms_on_the_command_line(at: Point) -> dict[tuple[str, int], float] | str:
    """Return what `p2sf tolerance` says that each error, by kind and first surface, adds to the worst RMS, waves.

    NaN where it says that rays are lost.
    """
    camera = Point(at.name, at.depth_mm, 0.0, at.focus_mm).flags
    camera = [*camera[:2], *camera[4:]]  # all three fields
    said = command("tolerance", at.name, *camera, "--builds", "10")

    def number(value: float | None) -> float:
        return nan if value is None else value

    return (
        said
        if isinstance(said, str)
        else {(row["kind"], row["first"]): number(row["adds_waves"]) for row in said["errors"]}
    )


def harms_in_the_window(at: Point, window: Window) -> dict[tuple[str, int], tuple[float, float]] | str:
    """Return the numbers in the table of *Tolerances*, and half a unit of their last digits."""
    from p2sf_explorer.compute.views.tolerances import Analyst, figures, question
    from p2sf_explorer.panels.tolerances.tables import LOST, ErrorTable
    from p2sf_explorer.state.state import ToleranceView

    try:
        asked = question(window.live(at, "seidel" if at.field_deg == 0 else "traced")).question
        found = figures(Analyst().answer(asked.request, lambda: False, lambda _: None), asked.view)
    except P2SFError as error:
        return str(error)
    table = ErrorTable()
    table.show_errors(found, ToleranceView())
    texts = [table.item(row, 2).text() for row in range(table.rowCount())]
    least = 1e-3 * max((abs(harm) for *_, harm in found.errors if isfinite(harm)), default=0.0)  # below, it says 0
    special = {"0": (0.0, least), LOST: (nan, 0.0)}
    read = [special[text] if text in special else printed(text) for text in texts]
    return {(one.kind, one.first): value for (one, *_), value in zip(found.errors, read, strict=True)}
