"""`p2sf nodes`: where in the field coma and astigmatism vanish, and what moves these nodes."""

from typing import Annotated, Any, Literal

import numpy as np
from cyclopts import Parameter

from p2sf.cli.cautions import open_lens
from p2sf.cli.options import AS_IN_THE_FILE, Asked, Json, LensName
from p2sf.cli.screen import Row, heading, print_json, print_table, warn
from p2sf.conventions import degrees_from_slope
from p2sf.parameters import check_whole
from p2sf.paraxial.bending import elements
from p2sf.setting import Setup, set_up
from p2sf.tolerance.nodal import FieldAberrations, NodalSensitivities, field_aberrations, nodal_sensitivities

Pieces = Annotated[Literal["elements", "surfaces"], Parameter(help="What is decentred and tilted for sensitivities.")]
Fields = Annotated[int, Parameter(help="Fields along each axis at which exact rays are traced.")]
SENSITIVITY = ("surfaces", "move", "W31, waves", "towards", "node of coma, °", "nodes of astigmatism, °", "image, µm")
MOST_FIELDS = 41
NOTHING = 1e-4  # of a shift: less is a rounding of the differences that it is found by, or of second order


def nodes(
    lens: LensName,
    /,
    *,
    request: Asked = AS_IN_THE_FILE,
    of: Pieces = "elements",
    fields: Fields = 7,
    as_json: Json = False,
) -> None:
    """Show where coma and astigmatism vanish, as far out as the lens's widest field, and what each mm or ° does."""
    check_whole("fields", fields, 3, MOST_FIELDS)
    setup = set_up(open_lens(lens), request)
    place = setup.source.depth_mm, setup.source.wavelength_um
    widest = abs(setup.field_deg) or setup.lens.widest_field_deg or 1.0
    axis = np.linspace(-widest, widest, fields)
    found = field_aberrations(setup.lens, *place, axis, axis)
    count = len(setup.lens.surfaces)
    whole = elements(setup.lens) if of == "elements" else ()
    pieces = whole or [(number, number) for number in range(1, count + 1)]
    moved = nodal_sensitivities(setup.lens, *place, pieces)
    if as_json:
        return print_json(record_of(found, moved))
    warn(setup.stop.warning)
    return show(setup, found, moved)


def record_of(found: FieldAberrations, moved: NodalSensitivities) -> dict[str, Any]:
    """Return nodes, fields and sensitivities as JSON names them: pairs are (x, y)."""
    third = found.third_order
    return {
        "third_order": {
            "coma_node_deg": _angles(third.coma_node),
            "astigmatism_nodes_deg": [_angles(node) for node in third.astigmatism_nodes.tolist()],
        },
        "coma_nodes_deg": found.coma_nodes_deg.tolist(),
        "astigmatism_nodes_deg": found.astigmatism_nodes_deg.tolist(),
        "x_deg": found.x_deg.tolist(),
        "y_deg": found.y_deg.tolist(),
        "coma_waves": _pairs(found.coma),
        "astigmatism_waves": _pairs(found.astigmatism),
        "defocus_waves": found.defocus.tolist(),
        "sensitivities": [
            {
                "kind": move.kind,
                "surfaces": [move.first, move.last],
                "per": move.unit,
                "coma_waves": _pair(coma),
                "astigmatism_waves_per_slope": _pair(astigmatism),
                "coma_node_deg": _pair(np.rad2deg(1) * node),
                "astigmatism_middle_deg": _pair(np.rad2deg(1) * middle),
                "landing_um": _pair(landing),
            }
            for move, coma, astigmatism, node, middle, landing in zip(
                moved.moves,
                moved.coma,
                moved.astigmatism,
                moved.coma_node,
                moved.astigmatism_middle,
                moved.landing_um,
                strict=True,
            )
        ],
    }


def _pair(value: complex) -> list[float]:
    """Return (x, y) of y + ix."""
    return [float(value.imag), float(value.real)]


def _pairs(values: np.ndarray) -> list[Any]:
    pairs: list[Any] = np.stack([values.imag, values.real], -1).tolist()
    return pairs


def _angles(field: complex) -> list[float]:
    return [float(degrees_from_slope(part)) for part in (field.imag, field.real)]


def show(setup: Setup, found: FieldAberrations, moved: NodalSensitivities) -> None:
    """Print the nodes, and what moves them."""
    third = found.third_order
    rows: list[Row] = [("coma, third order", *_angles(third.coma_node))]
    rows += [("coma, exact rays", x, y) for x, y in found.coma_nodes_deg.tolist()]
    rows += [("astigmatism, third order", *_angles(node)) for node in third.astigmatism_nodes.tolist()]
    rows += [("astigmatism, exact rays", x, y) for x, y in found.astigmatism_nodes_deg.tolist()]
    print_table(heading(setup), ("node of", "x, °", "y, °"), rows)
    table: list[Row] = []
    for number, move in enumerate(moved.moves):
        waves = complex(moved.coma[number])
        table.append(
            (
                f"{move.first}–{move.last}" if move.last > move.first else str(move.first),
                f"{move.kind.replace('_', ' ')}, per {move.unit}",
                abs(waves),
                f"{(round(np.rad2deg(np.angle(waves))) + 179) % 360 - 179}°",
                _without_rounding(np.rad2deg(1) * moved.coma_node[number]),
                _without_rounding(np.rad2deg(1) * moved.astigmatism_middle[number]),
                _without_rounding(moved.landing_um[number]),
            )
        )
    print_table("\nTo first order; towards counts from +y to +x", SENSITIVITY, table)


def _without_rounding(value: complex) -> str:
    """Return x and y, that part as 0 which is nothing but the rounding of differences."""
    least = NOTHING * abs(value)
    x, y = (part if abs(part) > least else 0.0 for part in _pair(value))
    return f"{x:.4g}, {y:.4g}"
