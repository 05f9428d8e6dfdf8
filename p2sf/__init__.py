"""P2SF: from a lens prescription to its point spread functions, with measured accuracy.

>>> import p2sf
>>> lens = p2sf.load_lens("double_gauss_28")
>>> psf = p2sf.render(lens, p2sf.Source(depth_mm=3000, field_deg=10, wavelength_nm=550), focus_mm=3000)

``p2sf.conventions`` states every sign and unit. Modules load when a name is first used.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from p2sf import conventions as conventions

    __version__: str
    from p2sf.api import choose_method, coefficients, encircled_energy, line_spread, load_lens, mtf, render, zernike
    from p2sf.camera import Camera
    from p2sf.database.files.building import build_database
    from p2sf.database.files.provenance import Stored
    from p2sf.errors import (
        ClusterError,
        DatabaseError,
        ExportError,
        GeometryError,
        GlassError,
        LensFileError,
        P2SFError,
        P2SFWarning,
        RequestError,
        SamplingError,
    )
    from p2sf.export.psf_cube import open_database
    from p2sf.glass.media import Medium, medium
    from p2sf.image.exposure import expose, raw_numbers
    from p2sf.image.picture import form_image, sharpen_image
    from p2sf.io.psf_files import read_psf, write_psf
    from p2sf.io.psf_plot import draw_psf
    from p2sf.lens.lens import Aperture, Lens, Surface, with_absorption, with_mask
    from p2sf.lens.misalignment import displaced
    from p2sf.lens.placement import Placement
    from p2sf.lens.source import Source
    from p2sf.lensfile.writing import write_lens
    from p2sf.measure.fitting.point_fit import PointFit
    from p2sf.measure.single_psf import fit_psf
    from p2sf.metrics.measures import Energy, LineSpread, Mtf
    from p2sf.metrics.opd_pupil import Pupil, fit_zernike
    from p2sf.metrics.samples import energy_of_psf, line_spread_of_psf, mtf_of_psf
    from p2sf.named_arrays import NamedArrays
    from p2sf.paraxial.positions import lens_at
    from p2sf.paraxial.seidel import Coefficients
    from p2sf.psf.from_opd import psf_of_opd
    from p2sf.psf.methods import Choice
    from p2sf.psf.result import Psf
    from p2sf.pupil.mask import PupilMap, PupilMask
    from p2sf.raytrace.zernike_fit import ZernikeFit
    from p2sf.scene.planning.plan import Plan, plan
    from p2sf.scene.scene import Channel, Scene
    from p2sf.scene.sensor import Sensor
    from p2sf.studies.tradeoff import tradeoff
    from p2sf.sweep import Sweep
    from p2sf.tolerance.errors_of_build import Tolerance
    from p2sf.tolerance.yields import ToleranceStudy, tolerances
    from p2sf_explorer.notebook_widget import widget

__all__ = [
    "Aperture",
    "Camera",
    "Channel",
    "Choice",
    "ClusterError",
    "Coefficients",
    "DatabaseError",
    "Energy",
    "ExportError",
    "GeometryError",
    "GlassError",
    "Lens",
    "LensFileError",
    "LineSpread",
    "Medium",
    "Mtf",
    "NamedArrays",
    "P2SFError",
    "P2SFWarning",
    "Placement",
    "Plan",
    "PointFit",
    "Psf",
    "Pupil",
    "PupilMap",
    "PupilMask",
    "RequestError",
    "SamplingError",
    "Scene",
    "Sensor",
    "Source",
    "Stored",
    "Surface",
    "Sweep",
    "Tolerance",
    "ToleranceStudy",
    "ZernikeFit",
    "build_database",
    "choose_method",
    "coefficients",
    "displaced",
    "draw_psf",
    "encircled_energy",
    "energy_of_psf",
    "expose",
    "fit_psf",
    "fit_zernike",
    "form_image",
    "lens_at",
    "line_spread",
    "line_spread_of_psf",
    "load_lens",
    "medium",
    "mtf",
    "mtf_of_psf",
    "open_database",
    "plan",
    "psf_of_opd",
    "raw_numbers",
    "read_psf",
    "render",
    "sharpen_image",
    "tolerances",
    "tradeoff",
    "widget",
    "with_absorption",
    "with_mask",
    "write_lens",
    "write_psf",
    "zernike",
]
_ELSEWHERE = {
    "Aperture": "p2sf.lens.lens",
    "Camera": "p2sf.camera",
    "Channel": "p2sf.scene.scene",
    "Choice": "p2sf.psf.methods",
    "Coefficients": "p2sf.paraxial.seidel",
    "ClusterError": "p2sf.errors",
    "DatabaseError": "p2sf.errors",
    "Energy": "p2sf.metrics.measures",
    "ExportError": "p2sf.errors",
    "GeometryError": "p2sf.errors",
    "GlassError": "p2sf.errors",
    "Lens": "p2sf.lens.lens",
    "LensFileError": "p2sf.errors",
    "LineSpread": "p2sf.metrics.measures",
    "Medium": "p2sf.glass.media",
    "Mtf": "p2sf.metrics.measures",
    "NamedArrays": "p2sf.named_arrays",
    "P2SFError": "p2sf.errors",
    "P2SFWarning": "p2sf.errors",
    "Placement": "p2sf.lens.placement",
    "Plan": "p2sf.scene.planning.plan",
    "PointFit": "p2sf.measure.fitting.point_fit",
    "Psf": "p2sf.psf.result",
    "Pupil": "p2sf.metrics.opd_pupil",
    "PupilMap": "p2sf.pupil.mask",
    "PupilMask": "p2sf.pupil.mask",
    "RequestError": "p2sf.errors",
    "SamplingError": "p2sf.errors",
    "Scene": "p2sf.scene.scene",
    "Sensor": "p2sf.scene.sensor",
    "Source": "p2sf.lens.source",
    "Stored": "p2sf.database.files.provenance",
    "Surface": "p2sf.lens.lens",
    "Sweep": "p2sf.sweep",
    "Tolerance": "p2sf.tolerance.errors_of_build",
    "ToleranceStudy": "p2sf.tolerance.yields",
    "ZernikeFit": "p2sf.raytrace.zernike_fit",
    "build_database": "p2sf.database.files.building",
    "displaced": "p2sf.lens.misalignment",
    "draw_psf": "p2sf.io.psf_plot",
    "energy_of_psf": "p2sf.metrics.samples",
    "expose": "p2sf.image.exposure",
    "fit_psf": "p2sf.measure.single_psf",
    "fit_zernike": "p2sf.metrics.opd_pupil",
    "form_image": "p2sf.image.picture",
    "lens_at": "p2sf.paraxial.positions",
    "line_spread_of_psf": "p2sf.metrics.samples",
    "medium": "p2sf.glass.media",
    "mtf_of_psf": "p2sf.metrics.samples",
    "open_database": "p2sf.export.psf_cube",
    "plan": "p2sf.scene.planning.plan",
    "psf_of_opd": "p2sf.psf.from_opd",
    "raw_numbers": "p2sf.image.exposure",
    "read_psf": "p2sf.io.psf_files",
    "sharpen_image": "p2sf.image.picture",
    "tolerances": "p2sf.tolerance.yields",
    "tradeoff": "p2sf.studies.tradeoff",
    "widget": "p2sf_explorer.notebook_widget",
    "with_absorption": "p2sf.lens.lens",
    "with_mask": "p2sf.lens.lens",
    "write_lens": "p2sf.lensfile.writing",
    "write_psf": "p2sf.io.psf_files",
}


if not TYPE_CHECKING:  # for a checker every name is one of those above, and any other is an error

    def __getattr__(name: str) -> Any:
        if name == "__version__":
            return import_module("p2sf.version").program_version()
        if name == "conventions":
            return import_module("p2sf.conventions")
        if name not in __all__:
            own = import_module(__name__)  # from whose names Python suggests one
            raise AttributeError(f"module {__name__!r} has no attribute {name!r}", name=name, obj=own)
        value = getattr(import_module(_ELSEWHERE.get(name, "p2sf.api")), name)
        globals()[name] = value
        return value


def __dir__() -> list[str]:
    return sorted({*__all__, "conventions", *(name for name in globals() if name.startswith("__"))})
