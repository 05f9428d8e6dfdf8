"""The version of this package, and the versions of its dependencies."""

import platform
from functools import cache

STANDS_ON = ("numpy", "scipy", "PySide6_Essentials", "pyqtgraph", "pyvista", "vtk")


@cache
def program_version() -> str:
    """Return the version of pyproject.toml as it was installed; unknown in a checkout that never was."""
    return _installed("p2sf") or "0+unknown"


def _installed(name: str) -> str | None:
    from importlib.metadata import PackageNotFoundError, version  # loading it takes longer than loading this package

    try:
        return version(name)
    except PackageNotFoundError:
        return None


def versions() -> dict[str, str]:
    """Return the versions for a report by package name; packages that are not installed are omitted."""
    found = {"p2sf": program_version(), "python": platform.python_version()}
    found |= {"system": f"{platform.system()} {platform.release()}", "machine": platform.machine()}
    return found | {name: number for name in STANDS_ON if (number := _installed(name))}


def version_text() -> str:
    """Return the versions as lines of text."""
    return "\n".join(f"{name} {number}" for name, number in versions().items())
