"""Pupils of a lens over field, depths and colours, wider than one scene needs, kept for the next one and on disk.

Rays are traced once through a stop that may be wider than the scene's. A pupil behind a narrower stop is the inner part
of the same polynomials, so that f-numbers share what is kept.
"""

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import lru_cache
from hashlib import sha256
from itertools import product
from math import ceil, floor, log2, prod
from typing import Any

import numpy as np

from p2sf.conventions import depth_of
from p2sf.disc.basis import PupilBasis, at_nodes
from p2sf.disc.domain import PupilDomain
from p2sf.disc.mask import CLEAR, PupilMask
from p2sf.errors import P2SFError
from p2sf.files.cache import Arrays, read_cached, write_cached
from p2sf.lens.lens import Aperture, Lens, lens_range_um
from p2sf.lens.source import Source
from p2sf.lensfile.toml.lens import lens_to_toml
from p2sf.paraxial.pupils import stop_rim
from p2sf.paraxial.seidel import coefficients
from p2sf.pixel_kernels.frequency_grid import NODES, ORDERS, PHASE_RESIDUAL, POINT_RESIDUAL, fits_of, pupils_of
from p2sf.pixel_kernels.pupil_stack import FORMS, PupilStack, frequency_basis, terms_of
from p2sf.pixel_kernels.pupil_table import PupilTable
from p2sf.pupil.fit import levels_for
from p2sf.pupil.seen_mask import mask_seen
from p2sf.scene.planning.adaptive_table import Ends, KnownPupils, PupilAt, adaptive_table
from p2sf.version import program_version

STOPS = 0.5  # powers of two between the rims of stops for which pupils are kept
VISIBLE_UM = 0.4, 0.7
WINDOW_WAVES, MOST_WAVES = 4.0, 64.0  # of defocus, in half of the depths of a table
TARGET_ERROR = 1e-3  # of a kernel by interpolation along one axis
RIM = 16, 16  # radii and directions at which the rim of a narrower stop is sought
RADII, BEYOND = 32, 1.01  # parts of a radius to which a narrower one is rounded up, and how far beyond the rim
CONVERGED_WAVES = 3e-4
NONE: Arrays = {}  # what is kept of lenses that have no such table, lest it be tried again


@dataclass(frozen=True)
class TableRange:
    """What pupils are kept for: a stop of ``rim`` mm, field slopes, vergences and wavelengths."""

    rim: float
    slopes: tuple[float, float]
    vergences: tuple[float, float]
    waves_um: tuple[float, float]

    @property
    def ends(self) -> Ends:
        """Return the ends of x, y, vergences and wavelengths; fields lie along y."""
        return (0.0, 0.0), self.slopes, self.vergences, self.waves_um


@dataclass(frozen=True, eq=False)
class LensPupils:
    """Pupils of a lens, behind a stop of ``part`` of the rim they were fitted to, described up to ``order``.

    ``table`` is over field slopes in place of y, and landing points in place of shifts; ``radius`` is the part of the
    fitted pupils' radius that is needed. ``error``: the relative error that interpolation adds to a kernel.
    """

    table: PupilTable
    part: float
    radius: float
    order: int
    mask: PupilMask
    error: float

    def between(self, slopes: np.ndarray, vergences: np.ndarray, waves_um: np.ndarray) -> tuple[PupilStack, np.ndarray]:
        """Return pupils, whose reach is not known, and where their chief rays land, (pupils, 2) mm.

        Raises GeometryError outside the table.
        """
        wide, landed = self.table.between(0.0, slopes, vergences, waves_um)
        return replace(_stopped_down(wide, self.part, self.radius, self.order), mask=self.mask), landed


def lens_pupils(lens: Lens, slope: float, ends: tuple[float, float], waves: tuple[float, float]) -> LensPupils | None:
    """Return pupils of a lens out to a field slope, between two vergences and two wavelengths, from what is kept.

    What is not kept is fitted and kept, without the mask. None where that is not possible, or not worth it: for light
    that is not visible, depths far out of focus, and fields beyond what rays reach.
    """
    covered = _covered(lens, slope, ends, waves)
    if covered is None:
        return None
    wide = replace(lens, aperture=Aperture("stop_semi_diameter", covered.rim), mask=CLEAR)
    table, error = _table(wide, covered)
    mask = mask_seen(lens, Source(wavelength_um=waves[0]))
    return _behind_stop(table, stop_rim(lens) / covered.rim, slope, mask, error) if table else None


def _covered(lens: Lens, slope: float, ends: tuple[float, float], waves: tuple[float, float]) -> TableRange | None:
    """Return what pupils are to be kept for, from few steps, so that scenes share it; None where they are not."""
    rim = float(2.0 ** (STOPS * ceil(log2(stop_rim(lens)) / STOPS - 1e-9)))
    edge = float(np.tan(np.deg2rad(max(lens.fields_deg)))) or abs(slope)
    if not edge:
        return None
    out = edge * 2.0 ** max(0, ceil(log2(abs(slope) / edge) - 1e-9)) if slope else edge
    low, high = lens_range_um(lens) or VISIBLE_UM
    low, high = max(low, VISIBLE_UM[0]), min(high, VISIBLE_UM[1])
    if not (low <= waves[0] and waves[1] <= high):
        return None
    far, near = min(ends), max(ends)
    step = _window(replace(lens, aperture=Aperture("stop_semi_diameter", rim)), far)
    for _ in range(int(log2(MOST_WAVES / WINDOW_WAVES)) + 1):
        start = floor(far / step) * step
        if near <= start + 2 * step:
            return TableRange(rim, (0.0, out) if slope >= 0 else (-out, 0.0), (start, start + 2 * step), (low, high))
        step *= 2
    return None


def _window(lens: Lens, vergence: float) -> float:
    """Return the vergence, rounded to a power of 2, by which defocus changes by WINDOW_WAVES about another."""
    near = vergence + 1e-7
    there = (float(coefficients(lens, depth_of(v), 0.0, lens.reference_wavelength_um).wd) for v in (vergence, near))
    first, second = there
    return float(2.0 ** round(log2(WINDOW_WAVES * 1e-7 / max(abs(second - first), 1e-12))))


@lru_cache(maxsize=32)
def _table(lens: Lens, covered: TableRange) -> tuple[PupilTable | None, float]:
    """Return the table of a lens with a stop of the covered rim, as kept, else fitted; and its error."""
    media = [medium.index(np.array(covered.waves_um)).tolist() for medium in lens.media]
    name = "pupils-" + sha256(repr((program_version(), lens_to_toml(lens), media, covered)).encode()).hexdigest()[:40]
    kept = read_cached(name)
    if kept == NONE:
        return None, 0.0
    table, error = _from_arrays(kept, lens.pupil_domain) if kept else (None, 0.0)
    if table is None:
        with suppress(P2SFError):  # rays that do not arrive, or pupils too distorted
            table, error = _fit(lens, covered)
        write_cached(name, _as_arrays(table, error) if table else NONE)
    return table, error


def _fit(lens: Lens, covered: TableRange) -> tuple[PupilTable | None, float]:
    """Return `adaptive_table` from exact rays."""
    known = KnownPupils()

    def sources(pupils: Sequence[PupilAt]) -> list[Source]:
        return [Source(depth_of(at.vergence), at.y_mm, at.wave_um) for at in pupils]

    _, slopes, vergences, (blue, _) = covered.ends
    corners = sources([PupilAt(0.0, s, v, blue) for s in slopes for v in vergences])
    for level in levels_for(lens):
        if fits_of(lens, corners, level)[0][1].max() < CONVERGED_WAVES:
            break

    def fit(pupils: Sequence[PupilAt]) -> tuple[PupilStack, np.ndarray]:
        missing = known.missing(pupils)
        if missing:
            fits, landed = fits_of(lens, sources(missing), level)
            known.add(missing, pupils_of(lens, sources(missing), fits, level, order=known.order), landed)
        return known.of(pupils)

    return adaptive_table(covered.ends, fit, TARGET_ERROR)


@lru_cache(maxsize=64)
def _behind_stop(table: PupilTable, part: float, slope: float, mask: PupilMask, error: float) -> LensPupils:
    """Return the pupils behind a stop of this part of the rim, of as few terms as fields out to a slope need."""
    _, _, vergences, waves = table.axes
    probes = np.array(list(product((0.0, slope / 2, slope), (vergences[0], vergences[-1]), (waves[0], waves[-1]))))
    wide, _ = table.between(0.0, *probes.T)
    radius = min(1.0, ceil(RADII * BEYOND * _rim_radius(wide, part)) / RADII)
    narrow = _stopped_down(wide, part, radius, wide.order)
    order = next(k for k in range(ORDERS[0], wide.order + 1, 2) if _describes(k, narrow))
    return LensPupils(table, part, radius, order, mask, error)


def _describes(order: int, pupils: PupilStack) -> bool:
    """Return whether the terms up to an order describe pupils: the others add too little, being orthonormal."""
    for name, allowed in (("phase", PHASE_RESIDUAL), ("eta", POINT_RESIDUAL), ("xi", POINT_RESIDUAL)):
        degree, _ = terms_of(pupils.basis, name).indices
        dropped = np.square(getattr(pupils, name)[:, degree > order]).sum(1)
        if dropped.max(initial=0.0) > (allowed / 2) ** 2:
            return False
    return True


def _rim_radius(pupils: PupilStack, part: float) -> float:
    """Return the greatest radius, over that of the pupils, where rays are at this part of their pupil's radius."""
    radii, angles = (np.arange(1, RIM[0] + 1) / RIM[0], np.linspace(0, np.pi, RIM[1]))
    u, v = ((radii[:, None] * side(angles)).ravel() for side in (np.sin, np.cos))
    values = pupils.basis.values(u, v)
    height = np.hypot(pupils.eta @ values.fy, pupils.xi @ values.fx).reshape(len(pupils), *RIM)
    inside = (height < part).sum(1, keepdims=True).clip(1, RIM[0] - 1)
    low, high = (np.take_along_axis(height, inside - back, 1) for back in (1, 0))
    return float(((inside + (part - low) / (high - low)) / RIM[0]).max())


def _stopped_down(wide: PupilStack, part: float, radius: float, order: int) -> PupilStack:
    """Return the inner part of pupils, out to a part of their radius, behind a stop of ``part`` of their rim."""
    scales, basis = _scales(wide.basis, radius), frequency_basis(order, wide.basis.domain)
    forms: dict[str, Any] = {}
    for name in FORMS:
        degree, _ = terms_of(wide.basis, name).indices
        form, scale = getattr(wide, name), scales["xi" if name == "xi" else "eta"]
        forms[name] = form @ scale[:, degree <= order] if form.shape[-1] else form
    forms["eta"], forms["xi"] = forms["eta"] / part, forms["xi"] / part
    return replace(wide, basis=basis, **forms, radius=radius * wide.radius, energy=wide.energy / part**2)


@lru_cache(maxsize=128)
def _scales(basis: PupilBasis, radius: float) -> dict[str, np.ndarray]:
    """Return what maps coefficients over the disc to those over its inner part, (terms, terms), of η and of ξ.

    Projections onto orthonormal terms; exact, as the quadrature is for products of two of them.
    """
    at = at_nodes(basis, NODES)
    inner = basis.values(radius * at.nodes.xi, radius * at.nodes.eta)
    share = at.nodes.weight / at.nodes.weight.sum()
    return {"eta": inner.fy @ (share * at.values.fy).T, "xi": inner.fx @ (share * at.values.fx).T}


def _as_arrays(table: PupilTable, error: float) -> Arrays:
    """Return a table and its error as arrays, for `_from_arrays`."""
    like = table.like
    sizes = np.array(
        [like.order, like.numbers, like.weight.shape[-1], like.residual_waves.max(), like.wavelength_um[0], error]
    )
    return {**{f"axis_{k}": np.array(axis) for k, axis in enumerate(table.axes)}, "rows": table.rows, "sizes": sizes}


def _from_arrays(kept: Arrays, domain: PupilDomain) -> tuple[PupilTable | None, float]:
    """Return the table of what was kept, None if it is something else, and its error."""
    try:
        axes: list[Any] = [tuple(kept[f"axis_{k}"].tolist()) for k in range(4)]
        rows, (order, numbers, weights, residual, sign, error) = kept["rows"], kept["sizes"].tolist()
    except (KeyError, ValueError):
        return None, 0.0
    basis = frequency_basis(int(order), domain)
    counts = {
        "phase": basis.phase.count,
        "eta": basis.fy.count,
        "xi": basis.fx.count,
        "weight": int(weights),
        "rims": 0,
    }
    if rows.shape != (prod(map(len, axes)), sum(counts.values()) + 4) or not np.isfinite(rows).all():
        return None, 0.0
    forms: dict[str, Any] = dict(
        zip(FORMS, np.split(rows, np.cumsum([counts[name] for name in FORMS]), 1), strict=False)
    )
    forms["rims"] = np.empty((len(rows), 0, basis.fy.count))
    radius, energy = rows[:, -4], rows[:, -3]
    known: dict[str, Any] = {"residual_waves": np.full(len(rows), residual), "wavelength_um": np.full(len(rows), sign)}
    like = PupilStack(
        basis, radius, **forms, energy=energy, reach_um=np.nan * radius, **known, method="fitted", numbers=int(numbers)
    )
    x, y, vergences, waves = axes
    return PupilTable(x, y, vergences, waves, rows, like), error
