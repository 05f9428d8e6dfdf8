"""`p2sf info` and `p2sf coefficients`: first-order data, wavefront coefficients and Seidel sums of a lens."""

from typing import Any

import numpy as np

from p2sf.cli.cautions import open_lens
from p2sf.cli.options import AS_IN_THE_FILE, Asked, Json, LensName
from p2sf.cli.screen import Row, heading, print_json, print_table, warn
from p2sf.lens.misalignment import misalignments
from p2sf.lensfile.library import find_lens
from p2sf.paraxial.first_order_data import FirstOrder, first_order
from p2sf.paraxial.lens_checks import lens_checks
from p2sf.paraxial.pupils import paraxial_rays
from p2sf.paraxial.seidel import Coefficients, coefficients, of_aligned_lens, seidel_sums
from p2sf.setting import Setup, set_up

INFO_ROWS = (
    ("effective_focal_length", "effective focal length", "mm"),
    ("back_focal_distance", "back focal distance, from the last vertex", "mm"),
    ("front_focal_distance", "front focal distance, from the first vertex", "mm"),
    ("front_principal_from_first", "front principal point, from the first vertex", "mm"),
    ("rear_principal_from_last", "rear principal point, from the last vertex", "mm"),
    ("front_nodal_from_first", "front nodal point, from the first vertex", "mm"),
    ("rear_nodal_from_last", "rear nodal point, from the last vertex", "mm"),
    ("stop_surface", "aperture stop, surface", ""),
    ("stop_semi_diameter", "aperture stop, semi-diameter", "mm"),
    ("entrance_pupil.from_first", "entrance pupil, from the first vertex", "mm"),
    ("entrance_pupil.diameter", "entrance pupil, diameter", "mm"),
    ("exit_pupil.from_last", "exit pupil, from the last vertex", "mm"),
    ("exit_pupil.diameter", "exit pupil, diameter", "mm"),
    ("numerical_aperture", "numerical aperture n'|u'| at this depth", ""),
    ("f_number", "f-number (focal length / entrance pupil)", ""),
    ("image_distance", "image of this depth, from the last vertex", "mm"),
    ("magnification", "magnification at this depth", ""),
)
WAVES = (
    ("w40", "W40 spherical aberration"),
    ("w31", "W31 coma"),
    ("w22", "W22 astigmatism"),
    ("w20", "W20 field curvature"),
    ("w11", "W11 distortion (moves the image, does not blur it)"),
    ("wd", "Wd defocus"),
)
SUMS = ("surface", "S_I spherical", "S_II coma", "S_III astigm.", "S_IV Petzval", "S_V distort.")


def info(lens: LensName, /, *, request: Asked = AS_IN_THE_FILE, as_json: Json = False) -> None:
    """Show the ABCD matrix, focal, principal and nodal points, stop, pupils and image of a lens."""
    setup = set_up(find_lens(lens), request)
    facts = first_order_record(setup)
    if as_json:
        return print_json(facts)
    aligned = of_aligned_lens(setup.lens), *misalignments(setup.lens)
    for message in (setup.stop.warning, *aligned, *lens_checks(setup.prescription)):
        warn(message)
    chosen = {"file": "as the file says", "auto": "the narrowest rim"}[setup.stop.chosen_by]
    notes = {"stop_surface": chosen}
    rows: list[Row] = []
    for key, label, unit in INFO_ROWS:
        value, across = _look_up(facts, key), _look_up(facts.get("in_x", facts), key)
        rows.append((label if across in (value, None) else f"{label}, in y", value, unit or notes.get(key, "")))
        rows += [] if across in (value, None) else [(f"{label}, in x", across, unit)]
    rows += [
        (f"ABCD matrix, {name}", value, unit) for name, value, unit in zip("ABCD", facts["abcd"], _ABCD, strict=True)
    ]
    return print_table(heading(setup), ("quantity", "value", "unit"), rows)


_ABCD = ("", "mm", "1/mm", "")


def first_order_record(setup: Setup) -> dict[str, Any]:
    """Return the first-order data of a setup; distances in mm, positive to the right of the vertex in their name.

    Of cylinders, toroids and biconics those in yz, and "in_x" those in xz.
    """
    found = first_order(setup.lens, setup.source.depth_mm, setup.source.wavelength_um, setup.stop)
    moved = [str(words) for words in misalignments(setup.lens)]
    across = {} if found.in_x is None else {"in_x": _record(found.in_x)}
    return _record(found) | ({"misalignment": moved} if moved else {}) | across


def _record(found: FirstOrder) -> dict[str, Any]:
    """Return first-order data as JSON names them."""
    return {
        "abcd": list(found.abcd),
        "effective_focal_length": found.focal_length_mm,
        "back_focal_distance": found.back_focal_from_last_mm,
        "front_focal_distance": found.front_focal_from_first_mm,
        "front_principal_from_first": found.front_principal_from_first_mm,
        "rear_principal_from_last": found.rear_principal_from_last_mm,
        "front_nodal_from_first": found.front_nodal_from_first_mm,
        "rear_nodal_from_last": found.rear_nodal_from_last_mm,
        "stop_surface": found.stop_surface,
        "stop_semi_diameter": found.stop_semi_diameter_mm,
        "entrance_pupil": {
            "from_first": found.entrance_pupil_from_first_mm,
            "diameter": found.entrance_pupil_diameter_mm,
        },
        "exit_pupil": {"from_last": found.exit_pupil_from_last_mm, "diameter": found.exit_pupil_diameter_mm},
        "numerical_aperture": found.numerical_aperture,
        "f_number": found.f_number,
        "image_distance": found.image_from_last_mm,
        "magnification": found.magnification,
    }


def _look_up(facts: Any, key: str) -> object:
    for part in key.split("."):
        facts = facts.get(part)
    return facts


def coefficients_command(lens: LensName, /, *, request: Asked = AS_IN_THE_FILE, as_json: Json = False) -> None:
    """Show the six wavefront coefficients of one source in waves, and the Seidel sums of every surface."""
    setup = set_up(open_lens(lens), request)
    six, sums = seidel_numbers(setup)
    if as_json:
        return print_json({**wave_record(six, setup), "per_surface": sums.tolist()})
    warn(setup.stop.warning)
    for message in (of_aligned_lens(setup.lens), *misalignments(setup.lens)):
        warn(message)
    rows: list[Row] = [(label, float(getattr(six, name)), "waves") for name, label in WAVES]
    rows.append(("numerical aperture n'|u'|", float(six.na), ""))
    rows.append(("image distance, from the last vertex", float(six.image_distance), "mm"))
    rows.append(("image height on the sensor", float(six.image_height), "mm"))
    print_table(heading(setup), ("coefficient", "value", "unit"), rows)
    lines = [(number, *row) for number, row in enumerate(sums.tolist(), 1)]
    return print_table("\nSeidel sums, mm", SUMS, [*lines, ("all", *sums.sum(0).tolist())])


def seidel_numbers(setup: Setup) -> tuple[Coefficients, np.ndarray]:
    """Return the six coefficients, and S_I … S_V per surface in mm, shape (surfaces, 5).

    A curved sensor is one more surface.
    """
    lens, source = setup.lens, setup.source
    where = (source.depth_mm, source.wavelength_um, setup.stop)
    sums = seidel_sums(lens, paraxial_rays(lens, *where), source.field_slope)
    columns = np.broadcast_arrays(*sums.columns())
    six = coefficients(lens, source.depth_mm, source.field_slope, source.wavelength_um, setup.stop)
    return six, np.stack(columns, axis=-1)


def wave_record(six: Coefficients, setup: Setup) -> dict[str, float]:
    """Return the coefficients of one source as JSON names them."""
    record = {name: float(getattr(six, name)) for name, _ in WAVES}
    mm = {"na": six.na, "image_distance": six.image_distance, "image_height": six.image_height}
    return {**record, **{name: float(value) for name, value in mm.items()}, "field_deg": setup.field_deg}
