"""P2SF: from a lens prescription to its point spread functions, with measured accuracy.

>>> import p2sf
>>> lens = p2sf.load_lens("double_gauss_28")
>>> psf = p2sf.render(lens, p2sf.Source(depth_mm=3000, field_deg=10, wavelength_nm=550), focus_mm=3000)

``p2sf.conventions`` states every sign and unit. Modules load when a name is first used.
"""

import re
from importlib import import_module
from typing import Any

# `__init__.pyi` declares every public name and the module that defines it.
with open(f"{__path__[0]}/__init__.pyi", encoding="utf-8") as _stub:
    _HOMES = {name: home for home, name in re.findall(r"^from (\w+\.\S+) import (\w+)", _stub.read(), re.MULTILINE)}
__all__ = sorted(_HOMES)
_FORMER = {
    "choose_method": "p2sf.Camera(lens, …).at(source).choose_method()",
    "coefficients": "p2sf.Camera(lens, …).at(source).coefficients()",
    "encircled_energy": "p2sf.Camera(lens, …).at(source).energy(radius_um)",
    "line_spread": "p2sf.Camera(lens, …).at(source).line_spread(position_um)",
    "mtf": "p2sf.Camera(lens, …).at(source).mtf(frequency_per_mm)",
    "zernike": "p2sf.Camera(lens, …).at(source).zernike()",
    "Sweep": "p2sf.Camera(lens, …).at(depth_mm=…, field_deg=…, wavelength_nm=…)",
}
"""Names of earlier versions, and what is written instead."""


def __getattr__(name: str) -> Any:
    if name == "__version__":
        return import_module("p2sf.version").program_version()
    if name == "conventions":
        return import_module("p2sf.conventions")
    if name in _FORMER:
        raise AttributeError(f"p2sf has no {name} any more; write {_FORMER[name]}")
    if name not in _HOMES:
        own = import_module(__name__)  # from whose names Python suggests one
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}", name=name, obj=own)
    value = getattr(import_module(_HOMES[name]), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted({*__all__, "conventions", *(name for name in globals() if name.startswith("__"))})
