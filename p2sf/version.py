"""The version of this package, the commit it was built from, and the versions of its dependencies."""

import platform
from importlib import import_module


def _version_as_built() -> str:
    """Return the version that the build took from the tag; unknown in a checkout that was never built."""
    try:
        return str(import_module("p2sf._version").__version__)
    except ImportError:
        return "0+unknown"


__version__ = _version_as_built()
STANDS_ON = ("numpy", "scipy", "PySide6_Essentials", "pyqtgraph", "pyvista", "vtk")


def versions() -> dict[str, str]:
    """Return the versions for a report by package name; packages that are not installed are omitted."""
    from importlib.metadata import PackageNotFoundError, version  # loading it takes longer than loading this package

    found = {"p2sf": __version__, "commit": commit_of(__version__)}
    found |= {"python": platform.python_version(), "system": f"{platform.system()} {platform.release()}"}
    found["machine"] = platform.machine()
    for name in STANDS_ON:
        try:
            found[name] = version(name)
        except PackageNotFoundError:
            continue
    return found


def commit_of(version: str) -> str:
    """Return the commit a version was built from: between tags it follows the plus, as in 0.3.dev4+g0a1b2c3."""
    number, _, local = version.partition("+")
    node = next((part[1:] for part in local.split(".") if part.startswith("g")), "")
    return node or ("unknown" if local or "dev" in number else f"that of tag v{number}")


def version_text() -> str:
    """Return the versions as lines of text."""
    return "\n".join(f"{name} {number}" for name, number in versions().items())
