"""Write and read random systems of every kind of surface and all shipped lenses: ``python -m tests.long.round_trips``.

For every kind of `tests.support.lenses.every_surface`, with chains of breaks and mirrors, the largest distance between
rays of the system and of what .toml, .zmx and .seq hold, mm, their path included; and the surface that a format refuses
by name. ``--rays N`` checks the first N systems of every kind against a tracer in forty digits too, and ``--folder``
takes the lens files of a folder besides, each as it is read. Exit code 1 above 1e-9 mm, and where rays are lost in one
of the two only.
"""

import argparse
import sys
from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace
from functools import partial
from math import inf
from pathlib import Path

import numpy as np

from p2sf.conventions import NM_PER_UM
from p2sf.errors import GeometryError, LensFileError
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.lensfile.formats.codev_writing import lens_to_seq
from p2sf.lensfile.glass_lookup import GlassSources
from p2sf.lensfile.importing import import_lens, import_text
from p2sf.lensfile.library import find_lens, shipped_lenses
from p2sf.lensfile.source_text import LensText
from p2sf.lensfile.toml.lens import lens_to_toml, parse_toml
from p2sf.lensfile.writing import lens_to_zmx
from p2sf.raytrace.pencil import pencil
from p2sf.raytrace.trace import trace
from tests.support.lenses.every_surface import KINDS, rays, system_of
from tests.support.rays import freeform_rays

WRITERS: dict[str, Callable[[Lens], str]] = {".toml": lens_to_toml, ".zmx": lens_to_zmx, ".seq": lens_to_seq}
READ = ".zmx", ".seq", ".roa", ".len", ".zar"
CLOSE_MM = 1e-9
FINITE_MM = {"relay": 95.0}  # depths of lenses that no ray from infinity passes off the axis
NO_DIGITS = ("odd asphere", "extended asphere", "Qcon", "Qbfs", "ideal lens")  # of which that tracer knows no sag


def read_again(lens: Lens, ending: str) -> Lens:
    """Return the lens that a file of a format holds; LensFileError where it cannot."""
    text = WRITERS[ending](lens)
    if ending == ".toml":
        return parse_toml(text, "again.toml")
    return import_text(LensText(f"again{ending}", "utf-8", text), GlassSources()).lens


def apart_mm(one: Lens, other: Lens, origins: np.ndarray, ways: np.ndarray) -> float:
    """Return the largest distance between the last points, and between paths, of the same rays."""
    found, again = (trace(each, origins, ways, 0.55, clip=True, stop_clips=False) for each in (one, other))
    return _largest(*(np.column_stack([f.points[-1], f.path]) for f in (found, again)))


def pupils_apart_mm(one: Lens, other: Lens) -> float:
    """Return the same of the rays that fill the stop from every field of a lens that passes, and of their light."""
    rho, theta = np.meshgrid([0.0, 0.5, 0.95], np.linspace(0, 2 * np.pi, 7))
    nodes = (rho * np.cos(theta)).ravel(), (rho * np.sin(theta)).ravel()
    farthest = -inf
    for field in one.field_places_deg:
        for nm in one.wavelengths_nm:
            source = Source(FINITE_MM.get(one.name, inf), field_deg=field, wavelength_um=nm / NM_PER_UM)
            try:
                found, again = (pencil(each, source, *nodes, clip=True) for each in (one, other))
            except GeometryError:  # of a field that no ray passes, off the axis of a relay for near objects
                continue
            assert found.passed.any()
            columns = (np.column_stack([f.chief_x + f.dx, f.chief_y + f.dy, f.path, f.light]) for f in (found, again))
            farthest = max(farthest, _largest(*columns))
    return farthest


def _largest(one: np.ndarray, other: np.ndarray) -> float:
    """Return the largest difference of rows (ray, number); inf where a ray is lost in one only."""
    if not np.array_equal(np.isnan(one), np.isnan(other)):
        return np.inf
    return float(np.nanmax(np.abs(one - other), initial=0.0))


def digits_apart_mm(lens: Lens, origins: np.ndarray, ways: np.ndarray) -> float:
    """Return the largest distance of points and paths from rays in forty digits, of those that pass."""
    found, far = trace(lens, origins, ways, 0.55), 0.0
    for ray in np.flatnonzero(found.status == 0):
        points, _, path = freeform_rays.fly(lens, origins[ray], ways[ray], 0.55)
        far = max(far, np.abs(found.points[1:, ray] - np.array(points, float)).max())
        far = max(far, abs(found.path[ray] - float(path)))
    return far


def read_folder(folder: Path | None) -> dict[str, Lens]:
    """Return the lenses of a folder that can be read, by their paths in it."""
    found = {}
    for path in sorted(folder.rglob("*")) if folder else ():
        if path.suffix.lower() in READ:
            with suppress(LensFileError):
                found[str(path.relative_to(folder))] = import_lens(path, True).lens
    return found


def row(name: str, worst: dict[str, float], refused: dict[str, str]) -> str:
    figures = (f"{ending} {far:.1e}" for ending, far in worst.items())
    return f"{name:22} {'  '.join(figures)}" + "".join(f"\n    {ending}: {why}" for ending, why in refused.items())


def compare(lens: Lens, apart: Callable[[Lens, Lens], float], worst: dict, refused: dict) -> None:
    """Take note of the largest distance of every format, or why it refuses the lens."""
    for ending in WRITERS:
        try:
            far = apart(lens, read_again(lens, ending))
        except LensFileError as refusal:
            refused[ending] = str(refusal)
        else:
            worst[ending] = max(worst.get(ending, 0.0), far)


def main(arguments: list[str] | None = None) -> int:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--systems", type=int, default=100)
    parser.add_argument("--rays", type=int, default=4)
    parser.add_argument("--folder", type=Path)
    options = parser.parse_args(arguments)
    farthest = 0.0
    for kind in KINDS:
        worst: dict[str, float] = {}
        refused: dict[str, str] = {}
        for seed in range(options.systems):
            lens, (origins, ways) = system_of(kind, seed), rays(seed)
            compare(lens, partial(apart_mm, origins=origins, ways=ways), worst, refused)
            if seed < options.rays and kind not in NO_DIGITS:
                worst["40 digits"] = max(worst.get("40 digits", 0.0), digits_apart_mm(lens, origins[:3], ways[:3]))
        print(row(kind, worst, refused), flush=True)
        farthest = max(farthest, *worst.values())
    lenses = {name: find_lens(name) for name in shipped_lenses()} | read_folder(options.folder)
    for name, lens in lenses.items():
        worst, refused = {}, {}
        compare(replace(lens, positions=None), pupils_apart_mm, worst, refused)
        print(row(name, worst, refused), flush=True)
        farthest = max(farthest, *worst.values())
    print(f"{len(lenses)} lenses")
    print(f"largest distance {farthest:.1e} mm")
    return int(farthest > CLOSE_MM)


if __name__ == "__main__":
    sys.exit(main())
