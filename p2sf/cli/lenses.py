"""`p2sf lenses`: the shipped lenses."""

from typing import Any

from p2sf.cli.options import Json
from p2sf.cli.screen import print_json, print_table
from p2sf.lens.lens import Lens
from p2sf.lens.meridians import meridians
from p2sf.lensfile.library import find_lens, shipped_lenses
from p2sf.paraxial.first_order import cardinal_points
from p2sf.paraxial.pupils import f_number


def lenses(*, as_json: Json = False) -> None:
    """List the shipped lenses; every other command takes one of these names."""
    records = [record(find_lens(name)) for name in shipped_lenses()]
    if as_json:
        return print_json({"lenses": records})
    rows = [(r["name"], r["effective_focal_length"], r["f_number"], r["field_deg"], r["character"]) for r in records]
    columns = ("name", "focal length, mm", "f-number", "largest field, °", "what it is")
    return print_table("Shipped lenses", columns, rows)


def record(lens: Lens) -> dict[str, Any]:
    """Return the entry of one lens in the list, at its middle wavelength; its meridian is that of yz."""
    wavelength, along_y = lens.reference_wavelength_um, meridians(lens).y
    return {
        "name": lens.name,
        "title": lens.title,
        "character": lens.character,
        "effective_focal_length": float(cardinal_points(along_y, wavelength).effective_focal_length),
        "f_number": float(f_number(along_y, wavelength)),
        "field_deg": float(lens.widest_field_deg),
        "wavelengths_nm": list(lens.wavelengths_nm),
        "source": lens.source,
    }
