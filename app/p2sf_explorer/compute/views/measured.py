"""Pictures of points beside the lens on screen: what a measurement depends on, and what the panel shows of it.

A measurement takes seconds: only `question` runs on the live path, and a worker runs `answer`.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from math import inf
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np

from p2sf.conventions import UM_PER_MM
from p2sf.errors import RequestError
from p2sf.files.writing import write_beside
from p2sf.lens.lens import Lens
from p2sf.measure.as_built import CERTAIN
from p2sf.measure.fitting.frame_fit import FrameFit
from p2sf.measure.fitting.frame_terms import F_NUMBER, lens_optics
from p2sf.measure.fitting.point_fit import PointFit
from p2sf.measure.fitting.point_model import PictureOptics
from p2sf.measure.frame import FrameGeometry
from p2sf.measure.measurement import FrameRequest, Measurement, measure_frame
from p2sf.measure.points import window_of
from p2sf.measure.reading import read_frame
from p2sf.measure.simulation import Exposure, grid_of_points, simulated_frame
from p2sf.messages import Message, Number
from p2sf.paraxial.pupils import f_number
from p2sf_explorer.compute.lens_files import stamp
from p2sf_explorer.compute.live import Live, View
from p2sf_explorer.compute.setup import paraxial_setup
from p2sf_explorer.compute.views.first_order import Row
from p2sf_explorer.state.build_errors import with_error, without_piece
from p2sf_explorer.state.scales import significant, with_sign
from p2sf_explorer.state.state import State, change
from p2sf_explorer.state.terms import TERMS
from p2sf_explorer.state.what_if import UNTOUCHED
from p2sf_explorer.state.workspaces import on_stage

NAMES = {
    "sensor_shift_um": "sensor shift",
    "tilt_x_deg": "tilt to +x",
    "tilt_y_deg": "tilt to +y",
    "w40": "W40 of the frame",
    "w31": "W31 of the frame",
    "w22": "W22 of the frame",
    "w20": "W20 of the frame",
    "f_number": "f-number",
}
DEFINITIONS = {
    "f_number": "By how much the f-number exceeds the stated one, which is taken to be right to 3 %.",
    "sensor_shift_um": "How much farther from the lens the sensor was than in the window.",
    "tilt_x_deg": "Tilt by which the sensor recedes from the lens towards +x.",
    "tilt_y_deg": "Tilt by which the sensor recedes from the lens towards +y.",
    "w40": "Of the whole field, the same at every point.",
    "w31": "Of the whole field: at the farthest point, growing with the distance from the axis.",
    "w22": "Of the whole field: at the farthest point, growing with the square of the distance from the axis.",
    "w20": "Of the whole field: at the farthest point, growing with the square of the distance from the axis.",
}

SAMPLE_SHIFT_UM = 60.0  # by which the sensor of a sample is too far from the lens
SAMPLE_PIXELS, SAMPLE_SHARE = (300, 480), 0.72  # of a sample: rows and columns, and the part that points stand in
AUTOMATIC = "automatic"
ENCODED = {"srgb": "numbers read as sRGB and made linear", "linear": "numbers read as linear counts"}

PointLine: TypeAlias = tuple[tuple[str, str, str, str], Message | None]
"""The figures of a point, and why it was not used, if it was not."""


@dataclass(frozen=True)
class MeasurementRequest:
    """Everything a measurement depends on; ``stamp`` changes with the file, ``picture`` "" is none."""

    picture: str
    pixel_um: float
    beside: bool
    encoding: str
    lens: Lens
    depth_mm: float
    wavelength_um: float
    clip: bool
    stamp: tuple[int, int] = (0, 0)


@dataclass(frozen=True, eq=False)
class PointPictures:
    """A point's picture, its model and their difference, (y, x) each, over the picture's peak, background taken off."""

    measured: np.ndarray
    modelled: np.ndarray
    difference: np.ndarray
    pixel_um: float

    @property
    def largest(self) -> float:
        """Return the largest difference, of the peak."""
        return float(np.abs(self.difference).max())


def question(live: Live) -> View[None]:
    """Return the measurement of the state's picture; where the window's source lies in the field does not matter."""
    view, source = live.state.measured, live.setup.source
    known = view.picture, view.pixel_um, view.beside, view.encoding
    return View(
        None, MeasurementRequest(*known, design_of(live), source.depth_mm, source.wavelength_um, live.state.optics.clip)
    )


def design_of(live: Live) -> Lens:
    """Return the lens on screen with its sensor set straight: its tilt is what a measurement tells."""
    state, sensor = live.state, sensor_piece(live.setup.lens)
    straight = without_piece(state.optics.errors, sensor)
    if straight == state.optics.errors:
        return live.setup.lens
    return paraxial_setup(change(state, errors=straight)).lens


def sensor_piece(lens: Lens) -> tuple[int, int]:
    """Return the first and last surface by which errors of a build name the sensor."""
    behind = len(lens.surfaces) + 1
    return behind, behind


def with_file_date(asked: MeasurementRequest) -> MeasurementRequest:
    """Return the request for its file as it is now."""
    return replace(asked, stamp=stamp(asked.picture))


def write_sample(asked: MeasurementRequest, path: Path) -> None:
    """Write a frame of points through the lens of a question, its sensor too far away, to be measured.

    Raises P2SFError where the lens has no such picture, ExportError where it cannot be written.
    """
    across_mm = SAMPLE_PIXELS[1] * asked.pixel_um / UM_PER_MM
    places = grid_of_points(3, 2, SAMPLE_SHARE * across_mm, SAMPLE_SHARE * across_mm / 2)
    geometry, exposure = FrameGeometry(*SAMPLE_PIXELS, asked.pixel_um), Exposure(sensor_shift_um=SAMPLE_SHIFT_UM)
    frame = simulated_frame(asked.lens, places, geometry, exposure, asked.depth_mm, asked.wavelength_um)
    write_beside(path, lambda handle: np.save(handle, frame.values))


def answer(asked: MeasurementRequest, cancelled: Callable[[], bool], progress: Callable[[float], None]) -> Measurement:
    """Return the measurement of a picture. Raises P2SFError for one that cannot be read or holds no point."""
    if not Path(asked.picture).is_file():
        raise RequestError(
            "the picture {name} is not in {folder} any more; put it back there, or choose another",
            name=Path(asked.picture).name,
            folder=str(Path(asked.picture).parent),
        )
    frame = read_frame(asked.picture, asked.pixel_um, encoding=None if asked.encoding == AUTOMATIC else asked.encoding)
    frame = replace(frame, notes=())  # `encoding_words` says it
    optics = scale(asked, frame.geometry.pixel_um)
    lens = asked.lens if asked.beside else None
    depth = asked.depth_mm if asked.beside else inf
    return measure_frame(
        [frame],
        optics,
        FrameRequest(lens=lens, depth_mm=depth, clip=asked.clip),
        progress=progress,
        cancelled=cancelled,
    )


def encoding_words(found: Measurement) -> str:
    """Return what was done with the numbers of the picture; "" where they are neither counts nor encoded."""
    return ENCODED.get(found.frames[0].encoding, "")


def scale(asked: MeasurementRequest, pixel_um: float) -> PictureOptics:
    """Return the scale of the lens's PSFs on the picture's pixels."""
    return lens_optics(asked.lens, asked.depth_mm, asked.wavelength_um, pixel_um)


def point_pictures(found: Measurement, number: int) -> PointPictures | None:
    """Return a point's pictures on one scale; None for a point that was not fitted."""
    fit, frame = found.fits[number], found.frames[0]
    window = window_of(frame, found.points[number], found.half)
    if fit is None or window is None:
        return None
    background = float(fit.frames[0, 3])
    light, model = np.nan_to_num(window.values - background), fit.modelled[0] - background
    peak = max(float(np.max(light)), 1e-30)
    return PointPictures(light / peak, model / peak, (light - model) / peak, frame.geometry.pixel_um)


def point_lines(found: Measurement) -> tuple[PointLine, ...]:
    """Return x, y, R² and reduced χ² of every point, and what speaks against it; the brightest first."""
    lines: list[PointLine] = []
    for point, fit, failure in zip(found.points, found.fits, found.failures, strict=True):
        why = (*point.flags, *((failure,) if failure else ()), None)[0]
        r2, chi2 = (f"{fit.r2[0]:.4f}", f"{fit.chi2:.2f}") if fit else ("", "")
        lines.append(((_plain(point.x_mm), _plain(point.y_mm), r2, chi2), why))
    return tuple(lines)


def _plain(value: float) -> str:
    return with_sign(value, 3)


def point_rows(found: Measurement, number: int, own: tuple[float, ...] | None) -> tuple[Row, ...]:
    """Return the coefficients of a point with their errors, the lens's ``own`` beside, and what else was fitted."""
    fit = found.fits[number]
    if fit is None or not fit.reliable:
        return ()
    beside = own if own is not None else (None,) * len(fit.numbers)
    columns = zip(fit.names, fit.numbers.tolist(), fit.errors.tolist(), beside, strict=False)
    return tuple(
        (
            name,
            _value(value, error, lens),
            "Peak waves ± one standard deviation; in brackets those of the lens at the f-number found.",
        )
        for name, value, error, lens in columns
    )


def _value(value: float, error: float, lens: float | None) -> Message:
    said = _with_error(value, error)
    if lens is None:
        return Message("{value} ± {error} λ", **said)
    return Message("{value} ± {error} λ ({own})", **said, own=Number(with_sign(lens, 3)))


def _with_error(value: float, error: float) -> dict[str, Number]:
    """Return an error to two digits, and its value to as many decimals."""
    text = significant(error, 2)
    return {"value": Number(with_sign(value, len(text.partition(".")[2]))), "error": Number(text)}


def whole_rows(found: Measurement) -> tuple[Row, ...]:
    """Return what explains the whole frame, with errors; empty where too few points were found, or nothing does."""
    whole = found.whole
    if whole is None or not whole.reliable:
        return ()
    columns = zip(whole.model.unknowns, whole.values.tolist(), whole.errors.tolist(), strict=True)
    return tuple(
        (
            NAMES[name],
            Message("{value} ± {error}{unit}", **_with_error(value, error), unit=_suffix(whole.model.unit(name))),
            DEFINITIONS[name],
        )
        for name, value, error in columns
    )


def _suffix(unit: str) -> str:
    """Return a unit as it stands behind a number."""
    return unit if unit in ("", "°") else " λ" if unit == "waves" else f" {unit}"


def own_six(found: Measurement, number: int) -> tuple[float, ...] | None:
    """Return W40, W31, W22 and W20 + Wd of the lens at a point's place; None without a lens."""
    whole, point = found.whole, found.points[number]
    if whole is None or whole.model.lens is None:
        return None
    return tuple(whole.known_stop.six_of_lens(float(np.hypot(point.x_mm, point.y_mm))).tolist())


def has_lens_as_built(found: Measurement) -> bool:
    """Return whether the picture tells of a lens as built: it was measured beside the lens, with enough points."""
    return found.whole is not None and found.whole.model.lens is not None and found.whole.reliable


def as_free_pupil(fit: PointFit) -> dict[str, Any]:
    """Return the entries of the State that show a point's fitted pupil: W20 + Wd goes into Wd."""
    w40, w31, w22, focus = (round(float(value), 4) for value in fit.numbers[:4])
    waves = {"w40": w40, "w31": w31, "w22": w22, "wd": focus}
    return UNTOUCHED | {"added_waves": tuple(waves.get(term, 0.0) for term in TERMS), "free_pupil": True}


def into_image(found: FrameFit, pixel_um: float, state: State) -> dict[str, Any]:
    """Return the entries of the State that sharpen photos by the lens as measured, in the Image panel.

    The sensor is moved, and tilted where its tilt is certain, and so is the stop set; field polynomials are no part of
    a lens.
    """
    assert found.model.lens is not None
    told = dict(zip(found.model.unknowns, found.values.tolist(), strict=True))
    certain = dict(zip(found.model.unknowns, np.abs(found.values) > CERTAIN * found.errors, strict=True))
    sensor, errors = sensor_piece(found.model.lens), state.optics.errors
    # Right-handed angles: one about x takes +y along z, one about y takes +x against it.
    tilt_x, tilt_y = (round(told[name], 4) if certain[name] else 0.0 for name in ("tilt_y_deg", "tilt_x_deg"))
    errors = with_error(with_error(errors, "tilt_x", sensor, tilt_x), "tilt_y", sensor, -tilt_y)
    shift = round(state.optics.sensor_shift_um + told["sensor_shift_um"], 2)
    view = on_stage(state.display, "image") | {"tab": "measured"}
    aperture = {}
    if certain.get(F_NUMBER, False):
        stopped = found.known_stop.lens
        assert stopped is not None
        aperture = {"f_number": round(float(f_number(stopped, stopped.reference_wavelength_um)), 3)}
    photo = {"photo_show": "taken", "photo_pixel_um": pixel_um, "photo_full": False}
    return UNTOUCHED | view | photo | aperture | {"sensor_shift_um": shift, "errors": errors}
