"""`p2sf psf`: one point spread function, computed and written to a file."""

from pathlib import Path
from typing import Annotated, Any

from cyclopts import Parameter

from p2sf.cli.cautions import TOO_COARSE, caution
from p2sf.cli.lookups import accuracy_rows, is_database, looked_up
from p2sf.cli.options import AS_IN_THE_FILE, Asked, Json, LensName, Output, Threads, check_output
from p2sf.cli.picture_options import ONE, USUAL, Picture, SetOptions
from p2sf.cli.screen import FILLED, Row, heading, print_json, print_table, warn
from p2sf.colour.spectrum import WORDS
from p2sf.database.accuracy import DatabaseAccuracy
from p2sf.errors import P2SFError, RequestError
from p2sf.figures.measures import Energy
from p2sf.figures.psf_data import facts
from p2sf.figures.window import centroid, radius_of_energy
from p2sf.files.writing import plain
from p2sf.io.psf_files import ENDINGS, write_psf
from p2sf.lensfile.library import find_lens
from p2sf.messages import Message, ParameterName
from p2sf.psf.measures import energy_in, parts_of
from p2sf.psf.methods import AUTO, by_six
from p2sf.psf.pixel_integrals import render_setup
from p2sf.psf.prediction import ALLOWED, TOO_FAR, USELESS
from p2sf.psf.result import IN_WINDOW, Psf
from p2sf.setting import Request, Setup, set_up
from p2sf.threads import using_threads

METHOD = ParameterName("method")
CAUTIOUS = "caution: above {limit:g}; choose {parameter} traced to be sure"
NO_PREDICTION = Message("none: nothing was traced to tell")
LIGHT, POINTS = Message("light of each pixel"), Message("intensity at points")
NO_STREHL = Message("not defined for a fitted shape")
SAME_PUPIL = Message("of the peak of the same pupil without aberration")
SpectrumName = Annotated[str | None, Parameter(help=f"Colour PSF of a point with this spectrum: {WORDS}.")]


def psf(
    lens: LensName,
    /,
    *,
    request: Asked = AS_IN_THE_FILE,
    picture: Annotated[Picture, Parameter(name="*")] = USUAL,
    spectrum: SpectrumName = None,
    several: Annotated[SetOptions, Parameter(name="*")] = ONE,
    output: Output = None,
    threads: Threads = None,
    as_json: Json = False,
) -> None:
    """Compute the PSF of one source and write it as .npz, .tiff, .csv, .fits, .nc or .png; with a spectrum .npz, .png.

    A set of PSFs of several depths, fields and wavelengths on a sensor's pixels, 4 µm apart when not given, is written
    as .npz, .tif, .fits, .mat, or its figures as .csv.
    """
    with using_threads(threads):
        if several.asked:
            from p2sf.cli.psf_sets import write_set

            return write_set(lens, request, picture, spectrum, several, output, as_json)
        several.check_one()
        if spectrum is not None:
            return _in_colour(lens, request, picture, spectrum, output, as_json)
        return _of_one_colour(lens, request, picture, output, as_json)


def _of_one_colour(lens: str, request: Request, picture: Picture, output: Path | None, as_json: bool) -> None:
    check_output(output, ENDINGS, lens)
    if is_database(lens):
        if picture.sampling or (picture.method or AUTO) != AUTO:
            raise RequestError(
                "{parameter} and {sampling} need the lens, and {path} is a database; leave them out",
                parameter="method",
                sampling=ParameterName("sampling"),
                path=lens,
            )
        if picture.clip:
            raise RequestError(
                "{parameter} needs the lens, and {path} is a database; leave it out or name the lens",
                parameter="clip",
                path=lens,
            )
        found = looked_up(lens, request, picture.side, picture.pixel_um)
        result, aim, title, accuracy = found.psf, found.aim, found.title, found.accuracy
        energy = None
    else:
        setup = set_up(find_lens(lens), request)
        if not as_json:
            caution(setup, picture.seidel and picture.sampling != "fft")
        result = render_setup(setup, picture.described_by, picture.side, picture.pixel_um, picture.options)
        title = heading(setup)
        accuracy = None
        aim, energy = setup.lens.aim, energy_of(setup, result.method, picture.clip)
    if output:
        write_psf(result, output)
    if as_json:
        file = None if output is None else str(output)
        whole = {"database_predicted_error": plain(accuracy.record)} if accuracy else {}
        return print_json(
            {"file": file, "pixels": picture.side, "aim": aim, **facts(result), **whole, **figures(result, energy)}
        )
    warn(result.caution)
    warn(accuracy.caution if accuracy else None)
    rows = summary(result, aim, output, energy, accuracy, 1 - picture.min_r2)
    return print_table(title, ("point spread function", "value", "unit"), rows)


def _in_colour(
    lens: str, request: Request, picture: Picture, spectrum: str, output: Path | None, as_json: bool
) -> None:
    from p2sf.cli.colours import colour

    if request.wavelength_nm is not None:
        raise RequestError(
            "{parameter} and {other} are both given; keep one of them",
            parameter="spectrum",
            other=ParameterName("wavelength_nm"),
        )
    if is_database(lens):
        raise RequestError(
            "{parameter} needs the lens, and {path} is a database; leave it out or name the lens",
            parameter="spectrum",
            path=lens,
        )
    return colour(set_up(find_lens(lens), request), spectrum, picture, output, as_json)


def energy_of(setup: Setup, method: str, clip: bool = False) -> Energy | None:
    """Return the energy of the pupil that a method describes; None where it describes none that can be summed."""
    try:
        parts, used = parts_of(setup.lens, setup.source, method, clip)
        return energy_in(parts, used)
    except P2SFError:  # of a fitted shape, of lost rays: what the samples hold is left
        return None


def figures(result: Psf, energy: Energy | None = None) -> dict[str, Any]:
    """Return the centroid, from the chief ray, and the radii around it that hold 50 and 80 % of the light.

    "share_of" says of which light: of all that the pupil sends, or of that in the window.
    """
    if energy:
        radii = {"radius_50_um": energy.radius_50_um, "radius_80_um": energy.radius_80_um}
        light = {
            "rms_um": energy.rms_um,
            "share_of": "all light",
            "geometric_limit_departs_by": energy.departure or None,
            "share_predicted_error": energy.predicted_error,
        }
        return {"centroid_um": [energy.centroid_x_um, energy.centroid_um], **radii, **light}
    x, y = centroid(result)
    half, most = (float(radius_of_energy(result, share)) for share in (0.5, 0.8))
    radii = {"radius_50_um": half, "radius_80_um": most}
    return {"centroid_um": [float(x), float(y)], **radii, "rms_um": None, "share_of": f"the {IN_WINDOW}"}


def window_of(result: Psf) -> Message:
    """Return where figures come from that have no pupil to be summed from."""
    pixel = result.pixel_um
    width = result.values.shape[-1] * pixel
    return Message("read off a window {width:g} µm wide, sampled every {pixel:g} µm", width=width, pixel=pixel)


def _peak(result: Psf) -> tuple[float | None, float | None]:
    """Return where the PSF is brightest, µm; None of a fitted shape."""
    return (None, None) if result.peak_um is None else (float(result.peak_um[0]), float(result.peak_um[1]))


def prediction(error: float | None, allowed: float) -> tuple[float | None, Message | str]:
    """Return what a method is predicted to miss, and a note where that is more than ``allowed`` or unknown."""
    if error is None:
        return None, NO_PREDICTION
    if error >= USELESS:
        return None, TOO_FAR
    return error, Message(CAUTIOUS, limit=allowed, parameter=METHOD) if error > allowed else ""


def exit_pupil_rows(result: Psf, allowed: float) -> list[Row]:
    """Return the Fresnel number and what plane waves miss, where these are known."""
    missed, number = result.plane_wave_error, result.fresnel_number
    if missed is None or number is None:
        return []
    return [
        ("predicted 1 − R² of plane waves", *prediction(float(missed), allowed)),
        ("Fresnel number", float(number), ""),
    ]


def summary(
    result: Psf,
    aim: str,
    output: Path | None,
    energy: Energy | None = None,
    accuracy: DatabaseAccuracy | None = None,
    allowed: float = ALLOWED,
) -> list[Row]:
    """Return the rows that tell a person what was computed.

    ``accuracy``: of the database it was looked up in; ``allowed``: 1 − R² above which a prediction is a caution.
    """
    known, measured = facts(result), figures(result, energy)
    light, stated = "all light" if energy else f"the {IN_WINDOW}", result.predicted_error is not None
    rows: list[Row] = [
        ("method", result.method, ""),
        ("samples", f"{result.values.shape[-1]} × {result.values.shape[-2]}", LIGHT if result.integrated else POINTS),
        ("pixel", result.pixel_um, "µm"),
        ("Strehl ratio", known["strehl"], NO_STREHL if known["strehl"] is None else SAME_PUPIL),
        *([("other peaks within 0.2 % of it", known["other_peaks"], "")] if known["other_peaks"] else []),
        *(
            []
            if result.peak_um is None
            else [
                (f"peak, from the chief ray, along {axis}", place, "µm")
                for axis, place in zip("xy", _peak(result), strict=True)
            ]
        ),
        (IN_WINDOW, known["energy"], TOO_COARSE if known["energy"] is None else ""),
        *([("centroid, from the chief ray, along x", x, "µm")] if (x := measured["centroid_um"][0]) else []),
        ("centroid, from the chief ray, along y", measured["centroid_um"][1], "µm"),
        (f"radius of 50 % of {light}", measured["radius_50_um"], "µm"),
        (f"radius of 80 % of {light}", measured["radius_80_um"], "µm"),
        *([("these radii", note, "")] if (note := energy.note if energy else window_of(result)) else []),
        *([("RMS radius of the rays", measured["rms_um"], "µm")] if energy else []),
        *([("predicted 1 − R²", *prediction(result.predicted_error, allowed))] if stated or not accuracy else []),
        *exit_pupil_rows(result, allowed),
        *(accuracy_rows(accuracy, " in this database") if accuracy else []),
        ("sampling", result.sampling, ""),
        ("numbers that describe it", result.numbers, ""),
        ("traced rays", result.rays, ""),
        *([("exact rays fill", FILLED[aim], "")] if not by_six(result.method) else []),
        ("time", 1e3 * result.seconds, "ms"),
    ]
    return rows if output is None else [*rows, ("written to", str(output), "")]
