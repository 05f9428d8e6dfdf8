"""Figures of an earlier version beside this one's: ``python -m tests.long.golden OTHER_CHECKOUT [--quick]``.

Some three thousand states: lenses × fields × depths × methods × masks × clipped rims × tilts × zooms, as PSFs, MTF,
energy, Zernike terms, coefficients, kernels in pictures, databases, tolerances, plans and measurements. Each version
computes them in a process of its own, through public functions and the command line, so that the modules behind these
may move. Every twelfth state is a part (``--parts``); with ``--keep`` the parts of a commit are computed once, and a
run can be continued. Printed per kind: how many figures there are, how many differ by more than rounding, the worst
difference and where; then what differs on purpose (`DELIBERATE`), and what only one version refuses.

A picture differs by its largest difference over its peak, a number by the difference over the larger of the two or, if
that is larger, over the unit below which a difference means nothing (`FLOORS`).
"""

import argparse
import json
import os
import pickle
import subprocess
import sys
import tempfile
import warnings
from collections.abc import Callable, Iterator
from contextlib import redirect_stderr, redirect_stdout
from dataclasses import dataclass
from functools import partial
from io import StringIO
from itertools import product
from math import inf
from pathlib import Path
from typing import Any

import numpy as np

HERE = Path(__file__).resolve().parents[2]
PARTS = 12  # part k has every twelfth state from the k-th on; --quick is the first part
METHODS = ("seidel", "fitted", "traced", "huygens")
RELAYS = {"telecentric_relay": 90.9, "relay": 95.0}  # mm, the depth whose picture they form
NEAR = 40  # focal lengths to the near plane of other lenses, which are focused there
FEW = ("double_gauss_28", "tessar", "petzval", "phone_f28", "cassegrain_f10", "eye_navarro")
ZOOMS = (20.0, 31.0, 45.0, 60.0)
FREQUENCIES_PER_MM = np.array([5.0, 10.0, 20.0, 40.0, 80.0])
MASKS = {
    "ring": {"obscuration": 0.35},
    "vanes": {"obscuration": 0.3, "vanes": 4, "vane_width": 0.02},
    "blades": {"blades": 6},
    "turned blades": {"blades": 5, "roundness": 0.4, "blade_angle_deg": 11.0},
    "Gaussian": {"apodisation": 0.8},
    "cubic": {"cubic_um": 1.5},
    "decentred": {"obscuration": 0.25, "obscuration_x": 0.2, "obscuration_y": -0.3},
}
FLOORS = {  # the least size against which a difference is judged, by ending
    **{"waves": 1e-3, "um": 1e-3, "deg": 1e-3},
    **{"form_error": 1e-6, "harm": 1e-6},
    **{"tangential": 1.0, "sagittal": 1.0},  # contrast is 1 where there is no detail
}
ROUNDING = 1e-12  # of the larger figure, or of a picture's peak
IGNORED = {
    *("seconds", "file", "versions", "cpu_seconds", "peak_bytes", "kernel_seconds", "picture_seconds", "memory_bytes"),
    *("scene", "why"),  # a path, and sentences
}
DELIBERATE: dict[tuple[str, str], tuple[float, str]] = {}
"""Of kinds with these words, figures that end so: up to which difference they differ on purpose, and why."""
State = tuple[str, str, Callable[[], Any]]  # kind, name, and what computes its figures


def states() -> Iterator[State]:
    """Yield every state that is compared."""
    import p2sf

    names = sorted(path.stem for path in (HERE / "lenses").glob("*.toml"))
    lenses = {name: p2sf.load_lens(name) for name in names}
    for name, lens in lenses.items():
        yield from _of_lens(name, lens)
    for name in FEW:
        yield from _masked(name, lenses[name])
        yield from _misaligned(name, lenses[name])
        yield from _commands(name, lenses[name])
        yield from _freeform(name, lenses[name])
    for name in FEW[:4]:
        yield from _databases(name, lenses[name])
        yield "measurement", name, partial(_measurement, name, lenses[name])
        yield from _pictures(name, lenses[name])
    yield from _zooms(lenses)
    yield from _arrays()


def _places(name: str, lens: Any) -> Iterator[tuple[str, Any, dict[str, Any]]]:
    """Yield sources on the axis, at 0.7 and 1 of the field, and a near one in focus: name, source, camera."""
    import p2sf

    relay, field = RELAYS.get(name), max(lens.fields_deg)
    depth = relay or inf
    for share in (0.0, 0.7, 1.0):
        yield f"{name} {share * field:.4g}°", p2sf.Source(depth, field_deg=share * field), {}
    if not relay:
        near = NEAR * abs(_focal(name))
        yield f"{name} {0.7 * field:.4g}° {near:.4g} mm", p2sf.Source(near, field_deg=0.7 * field), {"focus_mm": near}


def _focal(name: str) -> float:
    """Return the focal length of a shipped lens, mm."""
    return float(_command("info", name)["effective_focal_length"])


def _of_lens(name: str, lens: Any) -> Iterator[State]:
    """Yield what every shipped lens has: pictures, coefficients, contrast, energy, Zernike terms."""
    yield "first order", name, partial(_command, "info", name)
    for place, source, at in _places(name, lens):
        for method in METHODS:
            yield f"PSF {method}", place, partial(_psf, lens, source, method, **at)
        yield "PSF seidel preview", place, partial(_psf, lens, source, "seidel", quality="preview", **at)
        yield "coefficients", place, partial(_coefficients, lens, source, **at)
        yield "Zernike", place, partial(_zernike, lens, source, **at)
        yield "choice", place, partial(_choice, lens, source, **at)
        for method in ("traced", "fitted", "seidel"):
            yield f"MTF {method}", place, partial(_mtf, lens, source, method, **at)
    for place, source, at in list(_places(name, lens))[1::2]:
        for method in ("traced", "fitted"):
            yield f"energy {method}", place, partial(_energy, lens, source, method, **at)
        yield "line spread", place, partial(_spread, lens, source, **at)
        for method in ("traced", "fitted", "huygens"):
            yield f"PSF {method} clipped", place, partial(_psf, lens, source, method, clip=True, **at)
        yield "MTF clipped", place, partial(_mtf, lens, source, "traced", clip=True, **at)
        yield "Zernike clipped", place, partial(_zernike, lens, source, clip=True, **at)
        yield "PSF paraxial aim", place, partial(_psf, lens, source, "traced", aim="paraxial", **at)


def _masked(name: str, lens: Any) -> Iterator[State]:
    """Yield pictures, contrast, energy and Zernike terms behind masks in the stop."""
    import p2sf

    for (what, numbers), (place, source, at) in product(MASKS.items(), list(_places(name, lens))[1::2]):
        masked, where = p2sf.with_mask(lens, p2sf.PupilMask(**numbers)), f"{place} {what}"
        for method in METHODS:
            yield f"PSF {method} masked", where, partial(_psf, masked, source, method, **at)
        yield "MTF masked", where, partial(_mtf, masked, source, "traced", **at)
        yield "MTF masked and clipped", where, partial(_mtf, masked, source, "traced", clip=True, **at)
        yield "energy masked", where, partial(_energy, masked, source, "fitted", **at)
        yield "Zernike masked", where, partial(_zernike, masked, source, **at)


def _misaligned(name: str, lens: Any) -> Iterator[State]:
    """Yield figures of lenses with an element tilted, one decentred, and the sensor tilted."""
    import p2sf

    built, field = _built(lens), 0.7 * max(lens.fields_deg)
    angles = {"axis": 0.0, "y": field, "xy": (field / 2, -field / 3)}
    for (what, skew), (place, angle) in product(built.items(), angles.items()):
        where, source = f"{name} {what} {place}", p2sf.Source(field_deg=angle)
        for method in METHODS[1:]:
            yield f"PSF {method} misaligned", where, partial(_psf, skew, source, method)
        yield "PSF clipped misaligned", where, partial(_psf, skew, source, "traced", clip=True)
        yield "MTF misaligned", where, partial(_mtf, skew, source, "traced")
        yield "energy misaligned", where, partial(_energy, skew, source, "fitted")
        yield "Zernike misaligned", where, partial(_zernike, skew, source)
    for (what, skew), mask in product(built.items(), ("vanes", "decentred")):
        masked, source = p2sf.with_mask(skew, p2sf.PupilMask(**MASKS[mask])), p2sf.Source(field_deg=angles["xy"])
        where = f"{name} {what} {mask}"
        for method in METHODS[1:]:
            yield f"PSF {method} misaligned masked", where, partial(_psf, masked, source, method)
        yield "PSF clipped misaligned masked", where, partial(_psf, masked, source, "traced", clip=True)
        yield "MTF misaligned masked", where, partial(_mtf, masked, source, "traced")
        yield "energy misaligned masked", where, partial(_energy, masked, source, "fitted")


def _built(lens: Any) -> dict[str, Any]:
    """Return a lens with its first element decentred, its last tilted, and its sensor tilted."""
    from p2sf.lens.misalignment import displaced, with_tilted_sensor
    from p2sf.lens.placement import Placement

    last = len(lens.surfaces)
    return {
        "decentred": displaced(lens, 1, 2, Placement(decentre_x=0.02, decentre_y=-0.03)),
        "tilted": displaced(lens, last - 1, last, Placement(tilt_x_deg=0.2, tilt_y_deg=-0.1)),
        "sensor": with_tilted_sensor(lens, Placement(tilt_x_deg=0.5)),
    }


def _freeform(name: str, lens: Any) -> Iterator[State]:
    """Yield figures of lenses with a polynomial or Zernike terms on a surface, and with one that is shaded."""
    from dataclasses import replace

    import p2sf
    from p2sf.lens.freeform import XYPolynomial, ZernikeFringeSag
    from p2sf.lens.transmission import Transmission

    radius = lens.surfaces[0].semi_diameter or 10.0
    parts: dict[str, dict[str, Any]] = {
        "XY": {"shape": XYPolynomial((0.0, 0.0, 2e-4, -1e-4, 3e-4, 1e-4, -2e-4), radius)},
        "Zernike": {"shape": ZernikeFringeSag((0.0, 0.0, 0.0, 0.0, 2e-4, -1e-4, 1e-4, 2e-4), radius)},
        "shaded": {"transmission": Transmission(0.9, -0.5 / radius**2)},
    }
    for what, part in parts.items():
        if "shape" in part and lens.surfaces[0].shape is not None:
            continue
        changed = replace(lens, surfaces=(replace(lens.surfaces[0], **part), *lens.surfaces[1:]))
        for share in (0.0, 0.7):
            where, source = f"{name} {what} {share}", p2sf.Source(field_deg=share * max(lens.fields_deg))
            for method in METHODS[1:]:
                yield f"PSF {method} freeform", where, partial(_psf, changed, source, method)
            yield "MTF freeform", where, partial(_mtf, changed, source, "traced")
            yield "energy freeform", where, partial(_energy, changed, source, "fitted")
            yield "Zernike freeform", where, partial(_zernike, changed, source)


def _commands(name: str, lens: Any) -> Iterator[State]:
    """Yield what only the command line says: tolerances, nodes, spots, and the figures of `p2sf psf`."""
    for share in (0.0, 0.7):
        field = str(share * max(lens.fields_deg))
        commands = {
            "tolerances": ("tolerance", "--builds", "300"),
            "spots": ("spot",),
            "figures": ("psf",),
            "colour": ("psf", "--spectrum", "lines:486,588,656"),
            "Seidel sums": ("coefficients",),
        }
        for kind, (command, *words) in commands.items():
            yield kind, f"{name} {field}", partial(_command, command, name, "--field-deg", field, *words)
    yield "nodes", name, partial(_command, "nodes", name, "--fields", "5")


def _databases(name: str, lens: Any) -> Iterator[State]:
    """Yield what is looked up in databases of every kind."""
    for method, rule in (("seidel", "exact"), ("seidel", "table1"), ("seidel", "linear"), ("fitted", "exact")):
        yield f"database {method}", f"{name} {rule}", partial(_looked_up, name, lens, method, rule)


def _looked_up(name: str, lens: Any, method: str, rule: str) -> dict[str, Any]:
    import p2sf

    field, near = max(lens.fields_deg), NEAR * abs(_focal(name))
    nodes = [near, 3 * near, inf], [0.0, field / 2, field], [500.0, 550.0, 600.0]
    database = p2sf.build_database(lens, *nodes, method=method, interpolant=rule)
    found: dict[str, Any] = {}
    for number, (depth, share, wave) in enumerate(product((1.5 * near, inf), (0.3, 0.8), (520, 590))):
        source = p2sf.Source(depth, field_deg=share * field, wavelength_nm=wave)
        found[f"PSF {number}"] = database.psf(source).values
        if method == "seidel":
            found[f"six {number}"] = _of_coefficients(database.coefficients(source))
    return found


def _pictures(name: str, lens: Any) -> Iterator[State]:
    """Yield plans, and pictures of a few points, which are the kernels themselves."""
    for tolerance, number in product((0.2, 0.05), (8, 11)):
        yield "pictures", f"{name} f/{number} {tolerance}", partial(_picture, name, lens, tolerance, number)
        yield "plans", f"{name} f/{number} {tolerance}", partial(_plan, name, lens, tolerance, number)
    for what, skew in _built(lens).items():
        yield "pictures misaligned", f"{name} {what}", partial(_picture, name, skew, 0.1, 8)


def _pixel_um(name: str, lens: Any) -> float:
    """Return the pitch of pixels of which 60 reach from the middle to the end of the field."""
    wide = 1000 * abs(_focal(name)) * np.tan(np.deg2rad(max(lens.fields_deg)))  # µm
    return float(f"{wide / 60:.3g}")


def _plan(name: str, lens: Any, tolerance: float, f_number: float) -> dict[str, Any]:
    with tempfile.TemporaryDirectory() as folder:
        scene = Path(folder) / "scene.toml"
        sensor = f"[sensor]\nrows = 24\ncolumns = 36\npixel_um = {_pixel_um(name, lens)}\n"
        scene.write_text(f"tolerance = {tolerance}\nf_number = {f_number}\n{sensor}", encoding="utf-8")
        return _command("plan", name, str(scene))


def _measurement(name: str, lens: Any) -> dict[str, Any]:
    """Return what is measured in a picture of points whose sensor stands 20 µm too far."""
    import p2sf

    side, half, pitch, focal = 121, 12, 3.45, abs(_focal(name))
    picture = np.random.default_rng(1).normal(50, 2, (side, side))
    for row, column in product((-36, 0, 36), repeat=2):  # up the sensor rows run down
        angle = tuple(float(np.degrees(np.arctan(n * pitch / 1000 / focal))) for n in (column, -row))
        source = p2sf.Source(field_deg=(angle[0] or 0.0, angle[1]))
        spot = p2sf.render(lens, source, "fitted", pixels=2 * half + 1, pixel_um=pitch, f_number=8, sensor_shift_um=20)
        place = tuple(slice(side // 2 + n - half, side // 2 + n + half + 1) for n in (row, column))
        picture[place] += 1000 * spot.values[::-1] / spot.values.max()
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "points.npy"
        np.save(file, picture)
        flags = ("--lens", name, "--pixel-um", str(pitch), "--f-number", "8", "--unknowns", "sensor_shift_um")
        return _command("measure", str(file), *flags)


def _picture(name: str, lens: Any, tolerance: float, f_number: float) -> dict[str, Any]:
    import p2sf

    sensor = p2sf.Sensor(rows=24, columns=36, pixel_um=_pixel_um(name, lens))
    planned = p2sf.plan(lens, p2sf.Scene(sensor, rtol=tolerance, f_number=f_number))
    points = np.zeros((24, 36, 3))
    points[4::8, 4::8] = 1
    formed = p2sf.form_image(planned, points, threads=1)
    return {"picture": formed, "predicted_error": planned.predicted_error, "meets": planned.meets}


def _zooms(lenses: dict[str, Any]) -> Iterator[State]:
    """Yield a zoom and a lens that focuses inside, at and between their columns."""
    import p2sf

    for share in (0.0, 0.7):
        for zoom in ZOOMS:
            lens = lenses["zoom_3x"]
            source = p2sf.Source(field_deg=share * max(lens.fields_deg))
            yield "PSF zoomed", f"{zoom} {share}", partial(_psf, p2sf.lens_at(lens, zoom=zoom), source, "fitted")
        for depth in (inf, 500.0, 240.0):
            lens = lenses["macro_floating"]
            source = p2sf.Source(field_deg=share * max(lens.fields_deg))
            yield "PSF zoomed", f"{depth} mm {share}", partial(_psf, lens, source, "fitted", focus_mm=depth)


def _arrays() -> Iterator[State]:
    """Yield PSFs of wavefronts given as arrays."""
    for amount in (0.0, 0.2, 1.0):
        yield "PSF of an OPD", str(amount), partial(_psf_of_array, amount)


def _psf_of_array(amount: float) -> dict[str, Any]:
    import p2sf

    y, x = np.mgrid[-1:1:65j, -1:1:65j]
    opd = np.where(x * x + y * y <= 1, amount * (x * x + y * y) ** 2 + amount * x * y, np.nan)
    return _of_psf(p2sf.psf_of_opd(opd, na=0.1, wavelength_nm=550))


def _psf(lens: Any, source: Any, method: str, **camera: Any) -> dict[str, Any]:
    import p2sf

    return _of_psf(p2sf.render(lens, source, method, pixels=32, **camera))


def _of_psf(psf: Any) -> dict[str, Any]:
    return {name: getattr(psf, name) for name in ("values", "pixel_um", "strehl", "energy", "predicted_error")}


def _figure(name: str, lens: Any, source: Any, camera: dict[str, Any], **how: Any) -> Any:
    """Return a figure of a point, by the function that versions before 0.4 have for it."""
    import p2sf

    if hasattr(p2sf.Camera, "at"):
        of_figure = {part: camera[part] for part in camera if part == "clip"}
        of_camera = {part: camera[part] for part in camera if part != "clip"}
        return getattr(p2sf.Camera(lens, **of_camera).at(source), name)(**how, **of_figure)
    former = "encircled_energy" if name == "energy" else name
    return getattr(p2sf, former)(lens, source, **how, **camera)


def _mtf(lens: Any, source: Any, method: str, **camera: Any) -> dict[str, Any]:
    found = _figure("mtf", lens, source, camera, frequency_per_mm=FREQUENCIES_PER_MM, method=method)
    return {"tangential": found.tangential, "sagittal": found.sagittal}


def _energy(lens: Any, source: Any, method: str, **camera: Any) -> dict[str, Any]:
    found = _figure("energy", lens, source, camera, method=method)
    return {name: getattr(found, name) for name in ("radius_50_um", "radius_80_um", "rms_um")}


def _spread(lens: Any, source: Any, **camera: Any) -> dict[str, Any]:
    found = _figure("line_spread", lens, source, camera, position_um=np.linspace(-20, 20, 9))
    return {"edge_x": found.edge_x, "edge_y": found.edge_y}


def _zernike(lens: Any, source: Any, **camera: Any) -> dict[str, Any]:
    fit = _figure("zernike", lens, source, camera)
    return {"terms_waves": fit.waves, "rms_waves": fit.rms, "residual_waves": fit.residual}


def _choice(lens: Any, source: Any, **camera: Any) -> dict[str, Any]:
    choice = _figure("choose_method", lens, source, camera)
    return {"method": choice.method, "predicted_error": choice.predicted_error}


def _coefficients(lens: Any, source: Any, **camera: Any) -> dict[str, Any]:
    return _of_coefficients(_figure("coefficients", lens, source, camera))


def _of_coefficients(six: Any) -> dict[str, Any]:
    names = ("w40", "w31", "w22", "w20", "w11", "wd")
    return {f"{name}_waves": getattr(six, name) for name in names} | {"na": six.na, "image_height": six.image_height}


def _command(*words: str) -> dict[str, Any]:
    """Return what a command prints as JSON; its message as a refusal where it fails."""
    from p2sf.cli import main

    out, error = StringIO(), StringIO()
    with redirect_stdout(out), redirect_stderr(error):
        code = main([*words, "--json"])
    if code:
        raise ValueError(error.getvalue())
    return json.loads(out.getvalue())


def flat(value: Any, name: str = "") -> Iterator[tuple[str, Any]]:
    """Yield the arrays, numbers and words of nested results, with their paths."""
    if isinstance(value, dict):
        for key, inner in value.items():
            if key not in IGNORED:
                yield from flat(inner, f"{name}.{key}" if name else str(key))
    elif isinstance(value, list | tuple) and not _numeric(value):
        for index, inner in enumerate(value):
            yield from flat(inner, f"{name}.{index}")
    elif isinstance(value, str | bool | np.bool_ | None):
        yield name, value
    elif isinstance(value, int | float | list | tuple | np.ndarray | np.generic):
        yield name, np.asarray(value, dtype=float)


def _numeric(values: Any) -> bool:
    try:
        return np.asarray(values, dtype=float).size > 0
    except (TypeError, ValueError):
        return False


def compute(path: Path, part: int, kinds: list[str]) -> None:
    """Write a part of the figures of the version that Python finds: {(kind, state): {name: value} or a refusal}."""
    found: dict[tuple[str, str], Any] = {}
    warnings.simplefilter("ignore")
    for number, (kind, name, figures) in enumerate(states()):
        if number % PARTS != part or (kinds and not kind.startswith(tuple(kinds))):
            continue
        try:
            found[kind, name] = dict(flat(figures()))
        except ValueError as refusal:  # every failure of the library is one
            found[kind, name] = f"{type(refusal).__name__}: {refusal}"
    path.write_bytes(pickle.dumps(found))


def difference(name: str, one: Any, other: Any) -> float:
    """Return how far two values are apart: 0 the same, inf if they cannot be compared."""
    if isinstance(one, np.ndarray) and isinstance(other, np.ndarray):
        if one.shape != other.shape or not np.array_equal(np.isnan(one), np.isnan(other)):
            return inf
        floor = next((unit for ending, unit in FLOORS.items() if name.endswith(ending)), 0.0)
        size = max(*(float(np.nanmax(np.abs(v[np.isfinite(v)]), initial=0.0)) for v in (one, other)), floor)
        with np.errstate(invalid="ignore"):
            apart = np.where(one == other, 0.0, np.abs(one - other))
        largest = float(np.nanmax(apart, initial=0.0))
        return largest / size if size else largest
    return 0.0 if type(one) is type(other) and one == other else inf


@dataclass
class Row:
    """What became of one kind: states, figures, how many differ by more than rounding, the worst and where."""

    states: int = 0
    figures: int = 0
    differing: int = 0
    worst: float = 0.0
    where: str = ""

    def add(self, apart: float, where: str) -> None:
        self.figures += 1
        self.differing += apart > ROUNDING
        if apart > self.worst:
            self.worst, self.where = apart, where


def compared(now: dict[Any, Any], before: dict[Any, Any]) -> tuple[dict[str, Row], dict[str, Row], list[str]]:
    """Return a row for every kind, one for every deliberate change by its reason, and lines on refusals."""
    table: dict[str, Row] = {}
    deliberate: dict[str, Row] = {}
    refusals = []
    for key in sorted(now.keys() | before.keys()):
        kind, state = key
        ours, theirs = now.get(key), before.get(key)
        row = table.setdefault(kind, Row())
        row.states += 1
        if not isinstance(ours, dict) or not isinstance(theirs, dict):
            if isinstance(ours, dict) != isinstance(theirs, dict):
                said = theirs if isinstance(ours, dict) else ours
                refusals.append(f"{kind}, {state}: {'no longer' if isinstance(ours, dict) else 'now'} refused: {said}")
            continue
        for name in sorted(ours.keys() | theirs.keys()):
            apart = difference(name, ours.get(name), theirs.get(name))
            reason = _reason(kind, name, apart) if apart > ROUNDING else ""
            where = f"{kind}, {state}: {name}" if reason else f"{state}: {name}"
            (deliberate.setdefault(reason, Row()) if reason else row).add(apart, where)
    return table, deliberate, refusals


def _reason(kind: str, name: str, apart: float) -> str:
    """Return why a figure of this kind differs by so much on purpose; empty where it should not."""
    for (words, ends), (most, why) in DELIBERATE.items():
        if words in kind and name.endswith(ends) and apart <= most:
            return why
    return ""


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("other", type=Path, nargs="?", help="folder of the earlier checkout")
    parser.add_argument("--quick", action="store_true", help=f"every {PARTS}th state")
    parser.add_argument("--parts", nargs="*", type=int, default=range(PARTS), help=f"some of the {PARTS} parts")
    parser.add_argument("--kinds", nargs="*", default=[], help="kinds that begin so, such as MTF")
    parser.add_argument("--keep", type=Path, help="folder where figures stay, so that those of a version are made once")
    parser.add_argument("--compute", type=Path, help=argparse.SUPPRESS)
    given = parser.parse_args()
    parts = [0] if given.quick else given.parts
    if given.compute:
        compute(given.compute, parts[0], given.kinds)
        return
    with tempfile.TemporaryDirectory() as folder:
        keep = given.keep or Path(folder)
        before, now = {}, {}
        for part in parts:
            before |= _figures(given.other, keep, part, given.kinds)
            now |= _figures(HERE, keep, part, given.kinds)
    table, deliberate, refusals = compared(now, before)
    for kind, row in sorted(table.items()):
        print(f"{kind:30s} {row.states:5d} states {_shown(row)}")
    for reason, row in deliberate.items():
        print(f"on purpose, {reason}:\n    {_shown(row)}")
    print(*refusals, sep="\n")
    rows = [*table.values(), *deliberate.values()]
    figures, differing = (sum(getattr(row, name) for row in rows) for name in ("figures", "differing"))
    print(f"{len(now)} states, {figures} figures, {differing} differ by more than {ROUNDING:g}")


def _shown(row: Row) -> str:
    return f"{row.figures:6d} figures, {row.differing:5d} differ, worst {row.worst:8.1e}  {row.where}"


def _figures(root: Path, keep: Path, part: int, kinds: list[str]) -> dict[Any, Any]:
    """Return a part of the figures of one checkout, from a process of its own."""
    name = subprocess.run(["git", "-C", root, "rev-parse", "HEAD"], capture_output=True, text=True).stdout.strip()
    dirty = subprocess.run(["git", "-C", root, "status", "--porcelain"], capture_output=True, text=True).stdout.strip()
    path = keep / f"{name or root.name}-{part}-{'-'.join(kinds)}.pickle"
    if dirty or not path.exists():
        one = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "P2SF_THREADS": "1"}
        words = [sys.executable, __file__, "--compute", str(path), "--parts", str(part)]
        words += ["--kinds", *kinds] if kinds else []
        subprocess.run(words, env=os.environ | one | {"PYTHONPATH": str(root)}, check=True)
    return pickle.loads(path.read_bytes())


if __name__ == "__main__":
    main()
