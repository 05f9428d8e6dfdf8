"""P2SF: from a lens prescription to its point spread functions, with measured accuracy.

>>> import p2sf
>>> lens = p2sf.load_lens("double_gauss_28")
>>> psf = p2sf.render(lens, p2sf.Source(depth_mm=3000, field_deg=10, wavelength_nm=550), focus_mm=3000)

``p2sf.conventions`` states every sign and unit. Modules load when a name is first used.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

from p2sf.version import __version__ as __version__

if TYPE_CHECKING:
    from p2sf.api import (
        choose_method,
        coefficients,
        encircled_energy,
        line_spread,
        load_lens,
        mtf,
        render,
        zernike,
    )
    from p2sf.camera import Camera
    from p2sf.database.files.building import build_database
    from p2sf.errors import P2SFError, P2SFWarning
    from p2sf.export.psf_cube import open_database
    from p2sf.image.picture import form_image
    from p2sf.io.psf_plot import draw_psf
    from p2sf.lens.lens import Lens, with_absorption, with_mask
    from p2sf.lens.source import Source
    from p2sf.notebook_widget import widget
    from p2sf.paraxial.positions import lens_at
    from p2sf.psf.from_opd import psf_of_opd
    from p2sf.psf.result import Psf
    from p2sf.pupil.mask import PupilMap, PupilMask
    from p2sf.scene.planning.plan import plan
    from p2sf.scene.scene import Scene
    from p2sf.scene.sensor import Sensor
    from p2sf.studies.tradeoff import tradeoff

__all__ = [
    "Camera",
    "Lens",
    "P2SFError",
    "P2SFWarning",
    "Psf",
    "PupilMap",
    "PupilMask",
    "Scene",
    "Sensor",
    "Source",
    "build_database",
    "choose_method",
    "coefficients",
    "draw_psf",
    "encircled_energy",
    "form_image",
    "lens_at",
    "line_spread",
    "load_lens",
    "mtf",
    "open_database",
    "plan",
    "psf_of_opd",
    "render",
    "tradeoff",
    "widget",
    "with_absorption",
    "with_mask",
    "zernike",
]
_ELSEWHERE = {
    "Camera": "p2sf.camera",
    "Lens": "p2sf.lens.lens",
    "P2SFError": "p2sf.errors",
    "P2SFWarning": "p2sf.errors",
    "Psf": "p2sf.psf.result",
    "PupilMap": "p2sf.pupil.mask",
    "PupilMask": "p2sf.pupil.mask",
    "Scene": "p2sf.scene.scene",
    "Sensor": "p2sf.scene.sensor",
    "Source": "p2sf.lens.source",
    "build_database": "p2sf.database.files.building",
    "form_image": "p2sf.image.picture",
    "lens_at": "p2sf.paraxial.positions",
    "open_database": "p2sf.export.psf_cube",
    "plan": "p2sf.scene.planning.plan",
    "tradeoff": "p2sf.studies.tradeoff",
    "with_absorption": "p2sf.lens.lens",
    "with_mask": "p2sf.lens.lens",
    "draw_psf": "p2sf.io.psf_plot",
    "psf_of_opd": "p2sf.psf.from_opd",
    "widget": "p2sf.notebook_widget",
}


def __getattr__(name: str) -> Any:
    if name not in __all__:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    value = getattr(import_module(_ELSEWHERE.get(name, "p2sf.api")), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted({*__all__, *(name for name in globals() if name.startswith("__"))})
