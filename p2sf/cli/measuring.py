"""`p2sf measure` and `p2sf compare`: from pictures of points back to the wavefronts that made them."""

from dataclasses import dataclass, replace
from math import inf
from pathlib import Path
from typing import Annotated, Any, Literal

import numpy as np
from cyclopts import Parameter

from p2sf.cli.cautions import open_lens
from p2sf.cli.options import AS_IN_THE_FILE, LENS_ENDINGS, Asked, Json, Output, Threads, check_output
from p2sf.cli.screen import Row, percent_line, print_json, print_table, warn
from p2sf.cli.spots import Clip
from p2sf.conventions import NM_PER_UM, UM_PER_MM
from p2sf.errors import RequestError
from p2sf.measure.as_built import left_out, write_as_built
from p2sf.measure.fitting.frame_fit import FrameFit
from p2sf.measure.fitting.frame_terms import F_NUMBER_ERROR, FIELD, FOCUS, lens_optics
from p2sf.measure.fitting.point_fit import PointFit
from p2sf.measure.fitting.point_model import PictureOptics
from p2sf.measure.frame import Frame, Noise
from p2sf.measure.measurement import (
    FrameRequest,
    Measurement,
    MeasurementComparison,
    compare_measurements,
    measure_frame,
    write_measurement,
)
from p2sf.measure.reading import read_frame
from p2sf.measure.target import TargetMatch, read_target
from p2sf.messages import Message
from p2sf.setting import FIELDS, Request, Setup, mask_of, set_up
from p2sf.threads import using_threads

Pictures = Annotated[list[Path], Parameter(help="Pictures of the same points, one for each focus position.")]
LensOption = Annotated[str | None, Parameter(help="The lens as designed, from which the picture departs.")]
FocusUm = Annotated[
    list[float], Parameter(help="How much farther from the lens the sensor was at each picture, µm; 0 for the first.")
]
Numbers = Annotated[str, Parameter(help="What each point is fitted by: seidel, 26 or 46 numbers.")]
Unknown = Annotated[
    list[str],
    Parameter(
        help="What of the whole frame: sensor_shift_um, tilt_x_deg, tilt_y_deg, w40, w31, w22, w20; or what is off in "
        "the lens: decentre_x, decentre_y, tilt_x, tilt_y, radius, thickness or index, and its surfaces: tilt_x:3-4."
    ),
]
TargetFile = Annotated[
    Path | None,
    Parameter(
        help="Text file of the points' places: lines of number, x and y under a line number x_mm y_mm, or x_deg."
    ),
]
Light = Annotated[
    list[str],
    Parameter(help="Light of several wavelengths: each in nm and how much it brings, as --light 530:1 --light 550:2."),
]
FNumberError = Annotated[
    float,
    Parameter(
        help="One standard deviation of the f-number as stated, percent; of a frame it is an unknown unless this is 0."
    ),
]
Built = Annotated[
    Path | None,
    Parameter(help="File for the lens as built: .toml, .zmx, .seq or .json, or .npz for its PSF database."),
]


@dataclass(frozen=True)
class SensorOptions:
    """What is known of the sensor that took the pictures.

    Attributes
    ----------
    pixel_um
        Pixel pitch in µm, unless the file says it.
    dark
        A picture of the same sensor without light, to be subtracted.
    flat
        A picture of the same sensor in even light, to be divided by.
    gain
        Electrons per count; without it shot noise is left out.
    read_noise
        Of a dark pixel in counts; estimated otherwise.
    full_scale
        Counts from which a pixel is saturated.
    channel
        Of a colour picture: red, green or blue.
    encoding
        What whole numbers of a picture mean: srgb or linear. 8 bits are sRGB when not given.
    """

    pixel_um: float | None = None
    dark: Path | None = None
    flat: Path | None = None
    gain: float | None = None
    read_noise: float | None = None
    full_scale: float | None = None
    channel: str = "green"
    encoding: Literal["srgb", "linear"] | None = None

    def frame(self, path: Path) -> Frame:
        """Return the frame of a picture."""
        gain, full_scale = (inf if value is None else value for value in (self.gain, self.full_scale))
        noise = Noise(gain, self.read_noise, full_scale)
        fields = {"dark": self.dark, "flat": self.flat}
        return read_frame(path, self.pixel_um, **fields, noise=noise, channel=self.channel, encoding=self.encoding)


ANY_CAMERA = SensorOptions()
ANY_FIELD = (*FIELDS, "field_x_deg")


def measure(
    pictures: Pictures,
    /,
    *,
    lens: LensOption = None,
    request: Asked = AS_IN_THE_FILE,
    camera: Annotated[SensorOptions, Parameter(name="*")] = ANY_CAMERA,
    focus_um: FocusUm | None = None,
    light: Light | None = None,
    target: TargetFile = None,
    model: Numbers = "seidel",
    unknowns: Unknown | None = None,
    clip: Clip = False,
    f_number_error: FNumberError = F_NUMBER_ERROR,
    built: Built = None,
    output: Output = None,
    threads: Threads = None,
    as_json: Json = False,
) -> None:
    """Find the points of a picture and the wavefront of each, with errors; of five or more, what explains the frame.

    Without a lens, the f-number and the wavelength are needed. One picture leaves the common sign of all even terms
    open; a second at another focus decides. The numbers go to an .npz.
    """
    check_output(output, (".npz",), *pictures)
    check_output(built, (*LENS_ENDINGS, ".npz"), lens, *pictures)
    known = None if target is None else read_target(target)
    frames = [camera.frame(path) for path in pictures]
    setup = _setup(lens, request, frames[0])
    optics = _scale(setup, request, frames[0])
    if setup and any(getattr(request, name) is not None for name in ANY_FIELD):
        frames = [replace(frame, field_deg=setup.source.field_deg) for frame in frames]
    optics = replace(optics, light=tuple(_colour(text) for text in light or ()))
    with using_threads(threads), percent_line() as tell:
        found = measure_frame(
            frames,
            optics,
            FrameRequest(
                focus_um=focus_um or [0.0] * len(frames),
                model=model,
                lens=setup.lens if setup else None,
                depth_mm=setup.source.depth_mm if setup else request.depth_mm,
                unknowns=unknowns or (*FOCUS, *FIELD),
                clip=clip,
                target=known,
                f_number_error=f_number_error,
            ),
            progress=tell,
        )
    if output:
        write_measurement(found, output)
    if built:
        _write_built(found, built)
    if as_json:
        return print_json({"file": None if output is None else str(output), **record(found)})
    return _show(found)


def _colour(text: str) -> tuple[float, float]:
    """Return a wavelength in µm and how much of the light it brings, of text such as 550:2."""
    wavelength, _, share = text.partition(":")
    try:
        return float(wavelength) / NM_PER_UM, float(share)
    except ValueError as error:
        raise RequestError(
            '{parameter} "{text}" is not a wavelength in nm and its share; write for example 550:2',
            parameter="light",
            text=text,
        ) from error


def _write_built(found: Measurement, path: Path) -> None:
    """Write the lens as built, and warn of what it leaves out."""
    if found.whole is None:
        raise RequestError(
            "too few points can be used for a lens as built: five are needed, and there are {count}", count=found.used
        )
    write_as_built(found.whole, path)
    for why in left_out(found.whole, path):
        warn(why)


def _setup(lens: str | None, request: Request, frame: Frame) -> Setup | None:
    """Return the lens as asked, None without one; RequestError for a field of what is no single PSF of a lens."""
    for name in ANY_FIELD:
        if getattr(request, name) is not None and (not frame.psf or lens is None):
            raise RequestError(
                "{parameter} is given, and says where the one point of a PSF lies beside its lens; leave it out: "
                "points of a picture are where they are seen",
                parameter=name,
            )
    return None if lens is None else set_up(open_lens(lens), request)


def _scale(setup: Setup | None, request: Request, frame: Frame) -> PictureOptics:
    """Return the scale of the PSFs of a lens, or of an f-number and a wavelength."""
    pitch = frame.geometry.pixel_um
    if setup:
        return lens_optics(setup.lens, setup.source.depth_mm, setup.source.wavelength_um, pitch)
    for name in ("f_number", "wavelength_nm"):
        if getattr(request, name) is None:
            raise RequestError(
                "{parameter} is not given; give it, or the lens by {lens}", parameter=name, lens="--lens"
            )
    assert request.f_number is not None and request.wavelength_nm is not None
    mask = mask_of(None, request)
    return PictureOptics(1 / (2 * request.f_number), request.wavelength_nm / NM_PER_UM, pitch, mask=mask)


def record(found: Measurement) -> dict[str, Any]:
    """Return a measurement as JSON names it."""
    points = [
        {
            "x_mm": point.x_mm,
            "y_mm": point.y_mm,
            "place": point.place,
            "number": point.number,
            "flags": [str(flag) for flag in point.flags] + ([str(failure)] if failure else []),
            **({} if one is None else _point(one)),
        }
        for point, one, failure in zip(found.points, found.fits, found.failures, strict=True)
    ]
    whole = None if found.whole is None else _whole(found.whole)
    target = None if found.target is None else _target(found.target)
    return {
        "points": points,
        "frame": whole,
        "target": target,
        "na": found.optics.na,
        "pixel_um": found.optics.pixel_um,
        "encoding": found.frames[0].encoding or None,
        "warnings": [str(warning) for warning in found.warnings],
    }


def _point(one: PointFit) -> dict[str, Any]:
    columns = zip(one.names, one.numbers, one.errors, one.bounds, strict=True)
    return {
        "numbers": {name: {"value": v, "error": e, "bound": b} for name, v, e, b in columns} if one.reliable else None,
        "others": [other.tolist() for other in one.others] if one.reliable else None,
        "r2": one.r2.tolist(),
        "chi2": one.chi2,
        "warnings": [str(warning) for warning in one.warnings],
    }


def _whole(whole: FrameFit) -> dict[str, Any]:
    columns = zip(whole.model.unknowns, whole.values, whole.errors, whole.bounds, strict=True)
    return {
        "unknowns": None
        if not whole.reliable
        else {name: {"value": v, "error": e, "bound": b, "unit": whole.model.unit(name)} for name, v, e, b in columns},
        "twin": None if whole.twin is None or not whole.reliable else whole.twin.tolist(),
        "height_mm": whole.model.height_mm,
        "chi2": whole.chi2,
        "least_r2": float(whole.r2.min()),
        "warnings": [str(warning) for warning in whole.warnings],
    }


def _target(match: TargetMatch) -> dict[str, Any]:
    names = ("axis_mm", "scale", "rotation_deg", "mirrored", "distortion", "rms_mm")
    return {
        "found": match.count,
        "of": len(match.numbers),
        **{name: getattr(match, name) for name in names},
        "warnings": [str(warning) for warning in match.warnings],
    }


def _show(found: Measurement) -> None:
    used = [(point, one) for point, one in zip(found.points, found.fits, strict=True) if one is not None]
    if found.target is not None:
        _show_target(found.target)
    rows: list[Row] = []
    for point, one in used[:MOST_ROWS]:
        pairs = zip(one.numbers[:SHOWN].tolist(), one.errors[:SHOWN].tolist(), strict=True)
        cells = [f"{v:.3f} ± {e:.3f}" if one.reliable else None for v, e in pairs]
        number = "" if point.number is None else f"{point.number}: "
        rows.append((f"{number}{point.x_mm:.3f}, {point.y_mm:.3f}", *cells, f"{one.r2.min():.4f}", f"{one.chi2:.2f}"))
    names = used[0][1].names[:SHOWN] if used else ()
    print_table(f"{len(found.points)} points, {len(used)} used", ("x, y in mm", *names, "R²", "χ²"), rows)
    if len(used) > MOST_ROWS:
        print(f"… and {len(used) - MOST_ROWS} more; --json or -o has all")
    flags = [flag for point in found.points for flag in point.flags] + [why for why in found.failures if why]
    for warning in found.warnings:
        warn(warning)
    for why in dict.fromkeys(flags):
        warn(Message("{count} points not used: {why}", count=flags.count(why), why=why))
    every = [warning for _, one in used for warning in one.warnings]
    for template in dict.fromkeys(warning.template for warning in every):
        alike = [warning for warning in every if warning.template == template]
        warn(Message("at {count} of {all} points, {why}", count=len(alike), all=len(used), why=alike[0]))
    if found.whole is not None:
        if found.whole.reliable:
            print_table(*_frame_table(found.whole))
        for why in found.whole.warnings:
            warn(why)


def _show_target(match: TargetMatch) -> None:
    (x, y), mirrored = match.axis_mm, ", mirrored" if match.mirrored else ""
    print(
        f"target: {match.count} of {len(match.numbers)} points{mirrored}, turned by {match.rotation_deg:.2f}°, "
        f"{match.scale:.4g} times as large as expected; its origin {x:.3f}, {y:.3f} mm from the middle; "
        f"{match.distortion:+.2%} of distortion beyond; {match.rms_mm * UM_PER_MM:.1f} µm RMS left"
    )
    for why in match.warnings:
        warn(why)


def _frame_table(whole: FrameFit) -> tuple[str, tuple[str, ...], list[Row]]:
    twin = whole.twin if whole.twin is not None else np.full(whole.values.size, np.nan)
    rows: list[Row] = [
        (name, f"{v:.4g} ± {e:.2g}", f"{b:.2g}", "" if np.isnan(t) else f"{t:.4g}", whole.model.unit(name))
        for name, v, e, b, t in zip(whole.model.unknowns, whole.values, whole.errors, whole.bounds, twin, strict=True)
    ]
    head = f"\nThe whole frame: R² at least {whole.r2.min():.4f}, reduced χ² {whole.chi2:.2f}"
    return head, ("unknown", "value", "bound", "twin", "unit"), rows


MOST_ROWS, SHOWN = 20, 6


def compare(first: Path, second: Path, /, *, as_json: Json = False) -> None:
    """Compare two measurements of the same points: differences of all numbers, in standard deviations of both."""
    found = compare_measurements(first, second)
    if as_json:
        return print_json(_comparison(found))
    rows: list[Row] = [
        (row.name, f"{row.first:.4g}", f"{row.second:.4g}", f"{row.second - row.first:.3g}", f"{row.sigmas:.1f}")
        for row in found.rows
    ]
    head = f"{found.points} points in common"
    return print_table(head, ("number", first.name, second.name, "difference", "σ"), rows)


def _comparison(found: MeasurementComparison) -> dict[str, Any]:
    return {
        "points": found.points,
        "rows": [
            {"name": row.name, "first": row.first, "second": row.second, "sigmas": row.sigmas} for row in found.rows
        ],
    }
