"""The facts that a file carries beside its numbers: lens, setup, units, versions, and those of a PSF."""

import hashlib
import platform
from dataclasses import fields

import numpy as np

from p2sf.camera import Setup
from p2sf.conventions import NM_PER_UM
from p2sf.files.writing import plain
from p2sf.glass.pages import data_version
from p2sf.lens.lens import Lens
from p2sf.messages import Message
from p2sf.psf.result import Psf
from p2sf.version import program_version

CONVENTIONS = (
    "unit sum in the window; rows +y up the sensor, row 0 the lowest y, columns +x; a positive field's chief ray "
    "lands at +y; sample N//2 (from 0) is the chief ray; infinite values are null"
)
FORMER = {"tolerance": "error"}
"""Fields of files before 0.3 by their names today."""
UNITS = {"x_um": "µm", "y_um": "µm", "psf": "fraction of the window's light per sample"}


def describe(setup: Setup) -> dict:
    """Return the facts that a file carries beside its numbers: lens and hash, setup, units, versions."""
    lens, source = setup.prescription, setup.source
    known: dict = plain(
        {
            "lens": {
                "name": lens.name,
                "title": lens.title,
                "source": lens.source,
                "sha256_of_toml": lens_hash(lens),
            },
            "setup": {
                "depth_mm": source.depth_mm,
                "field_deg": setup.field_deg,
                **({"azimuth_deg": source.azimuth_deg} if source.azimuth_deg else {}),
                "wavelength_nm": source.wavelength_um * NM_PER_UM,
                "sensor_mm": setup.lens.sensor_mm,
                "stop_surface": setup.stop.surface,
                "stop_semi_diameter_mm": setup.stop.semi_diameter,
                "stop_chosen_by": setup.stop.chosen_by,
                "aim": setup.lens.aim,
                **position_of(setup.lens),
            },
            "units": UNITS,
            "conventions": CONVENTIONS,
            "versions": versions(),
        }
    )
    return known


def lens_hash(lens: Lens) -> str:
    """Return the SHA-256 of the lens written as TOML: two equal prescriptions have one hash."""
    from p2sf.lensfile.toml.lens import lens_to_toml

    return hashlib.sha256(lens_to_toml(lens).encode()).hexdigest()


def position_of(lens: Lens) -> dict[str, str]:
    """Return where the rings of a lens stand that zooms or focuses inside; nothing for another."""
    return {"position": str(lens.positions.words)} if lens.positions else {}


def versions() -> dict[str, str]:
    """Return the versions that a result depends on."""
    return {
        "p2sf": program_version(),
        "python": platform.python_version(),
        "numpy": np.__version__,
        "glass data": data_version(),
    }


def facts(psf: Psf) -> dict:
    """Return what a PSF says about itself but its samples, as JSON can carry it; its azimuth where it has one."""
    left_out = {"values"} if psf.azimuth_deg else {"values", "azimuth_deg"}
    known = {f.name: getattr(psf, f.name) for f in fields(psf) if f.name not in left_out}
    return {name: plain(value) for name, value in (known | {"sampling": str(psf.sampling)}).items()}


def psf_from(values: np.ndarray, known: dict) -> Psf:
    """Return a PSF of its samples and its `facts`; TypeError where these are not a PSF's."""
    peak = known.get("peak_um")
    read = {"sampling": Message(str(known.get("sampling", ""))), "peak_um": peak and tuple(peak)}
    known = {FORMER.get(name, name): value for name, value in known.items()}
    return Psf(values, **{**known, **read})


def caption(meta: dict) -> str:
    """Return one or two lines on what a picture shows."""
    setup, psf = meta.get("setup", {}), meta["psf"]
    depth = "∞" if setup.get("depth_mm") is None else f"{setup['depth_mm']:g} mm"
    where = f"object at {depth}, field {setup['field_deg']:g}°, " if setup else ""
    lens = meta.get("lens", {})
    name = lens.get("title") or lens.get("name") or "point spread function"
    peak = "" if psf["strehl"] is None else f" · Strehl {psf['strehl']:.3g}"
    name += f", {setup['position']}" if setup.get("position") else ""
    return f"{name}\n{where}{psf['wavelength_um'] * NM_PER_UM:g} nm · {psf['method']}{peak}"
