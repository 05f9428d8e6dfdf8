"""The version of this package, the commit it was built from, and the versions of what it stands on."""

import platform
from importlib import import_module


def _built() -> tuple[str, str | None]:
    """Return version and commit as the build wrote them, from the tag; unknown in a checkout never built from."""
    try:
        built = import_module("p2sf._version")
    except ImportError:
        return "0+unknown", None
    return built.__version__, built.__commit_id__


__version__, COMMIT = _built()
STANDS_ON = ("numpy", "scipy", "PySide6_Essentials", "pyqtgraph", "pyvista", "vtk")


def versions() -> dict[str, str]:
    """Return the versions a report needs, by name; what is not installed is left out."""
    from importlib.metadata import PackageNotFoundError, version  # takes longer to load than all of this package

    found = {"p2sf": __version__, "commit": (COMMIT or "unknown").removeprefix("g")}
    found |= {"python": platform.python_version(), "system": f"{platform.system()} {platform.release()}"}
    found["machine"] = platform.machine()
    for name in STANDS_ON:
        try:
            found[name] = version(name)
        except PackageNotFoundError:
            continue
    return found


def version_text() -> str:
    """Return the versions as lines of text."""
    return "\n".join(f"{name} {number}" for name, number in versions().items())
