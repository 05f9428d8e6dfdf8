"""The wavefront over the pupil as a picture and as numbers. No Qt in here.

The wavefront is a sum of Zernike terms, fitted by least squares to exact rays or to the six coefficients: one product
with a fixed matrix. Picture, RMS and the shares of the variance all come from it, over the part of the pupil that
passes light.
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from functools import lru_cache

import numpy as np

from p2sf.errors import GeometryError
from p2sf.lens.lens import Lens, check_unmasked
from p2sf.lens.source import Source
from p2sf.messages import Message
from p2sf.paraxial.seidel import Coefficients
from p2sf.paraxial.wavefront import wavefront
from p2sf.pupil.mask import PupilMask
from p2sf.pupil.mask_nodes import ClearNodes, mask_nodes
from p2sf.pupil.mask_outline import obstructions, opening
from p2sf.pupil.quadrature import DiscNodes, disc_nodes, whole_disc
from p2sf.pupil.tilt import rms
from p2sf.pupil.zernike import basis, powers, terms
from p2sf.pupil.zernike_terms import ZernikeTerm, family, zernike_terms, zernike_values
from p2sf.raytrace.clear_pieces import CLIPPED, LOST
from p2sf.raytrace.clear_rim import ClearRim, clear_rim
from p2sf.raytrace.pencil import displayed_opd, exit_radius, opd_on_sphere, pencil
from p2sf.raytrace.seen_mask import mask_seen
from p2sf.raytrace.zernike_fit import USUAL_TERMS, decomposed
from p2sf_explorer.compute.setup import ParaxialSetup

SAMPLES = {"preview": 128, "settled": 384}  # across the picture; an enlarged panel has some thousand pixels
ORDERS = {"preview": 8, "settled": 18}  # of the fit
RAYS = {"preview": (7, 20), "settled": (16, 44)}  # radii and directions: exact for products of two terms of that order
RIMS = {"preview": (40, 2), "settled": (128, 4)}  # directions and rounds of `clear_rim`
GRIDDED = {"preview": 64, "settled": 192}  # samples across a misaligned pupil of which some is dark
RADII = {"preview": 7, "settled": 12}  # of the nodes over a clipped pupil
TURN = np.linspace(0, 2 * np.pi, 241)
CIRCLE = np.stack([np.sin(TURN), np.cos(TURN)])
EDGE_STEP = 1e-9
ALIKE = 4.0  # of the variance: the focus of third order then is that of the rays up to a factor of two
LEAST_CAUSE = 0.2  # of the focus that a coefficient makes if it is named
MARECHAL = 1 / 14**2  # waves²: a Strehl ratio of 0.8 (Born & Wolf 1999, §9.3)


@dataclass(frozen=True, eq=False)
class WavefrontMap:
    """W in waves over the square about the pupil, (y, x), NaN where the pupil's part that passes light is a pixel away.

    ``rms`` without piston and tilt and ``peak_to_valley``, in waves; ``outline``: ξ and η of the part that
    passes light, closed, (2, points); ``clear``: that part of the pupil's area; ``parts``: aberration → its part of the
    variance, waves², piston and tilt left out; ``rest``: what these parts leave. Of a mask in the stop ``iris`` is its
    opening, ``obstructions`` what stands in that, closed lines too, and ``shade`` the amplitude that passes, at the
    samples; its phase is part of W, and what it covers counts nowhere.
    """

    waves: np.ndarray
    rms: float
    peak_to_valley: float
    kind: str
    outline: np.ndarray = field(default_factory=lambda: CIRCLE)
    clear: float = 1.0
    parts: Mapping[str, float] = field(default_factory=dict)
    rest: float = 0.0
    iris: np.ndarray = field(default_factory=lambda: CIRCLE)
    obstructions: tuple[np.ndarray, ...] = ()
    shade: np.ndarray | None = None


@lru_cache(maxsize=8)
def disc(count: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return ξ, η of ``count``² samples over the pupil's square, and which of them lie inside."""
    axis = centres(count)
    xi, eta = np.meshgrid(axis, axis)
    return xi, eta, xi**2 + eta**2 <= 1


def centres(count: int) -> np.ndarray:
    """Return the centres of ``count`` even cells from −1 to 1."""
    return (2 * np.arange(count) + 1 - count) / count


def pupil_map(waves: np.ndarray, inside: np.ndarray, kind: str) -> WavefrontMap:
    """Return a map of samples with RMS and peak-to-valley over those inside that have a value."""
    inside = inside & np.isfinite(waves)
    kept = waves[inside]
    if kept.size == 0:
        return WavefrontMap(np.full(waves.shape, np.nan), np.nan, np.nan, kind)
    xi, eta, _ = disc(len(waves))
    blur = rms(kept, np.full(kept.size, 1 / kept.size), np.stack([eta[inside], xi[inside]]))
    return WavefrontMap(np.where(inside, waves, np.nan), blur, float(np.ptp(kept)), kind)


Samples = tuple[ClearNodes, np.ndarray, ClearRim | None]
"""Nodes over the part of the pupil that passes light, W there in waves, and the rim of that part where it is one.

Nodes of the half disc ξ ≥ 0; of exact rays through a misaligned lens, whose wavefront no half tells, of the whole.
"""


def pupil_of(setup: ParaxialSetup, exact: bool, quality: str, clip: bool = False) -> WavefrontMap:
    """Return the wavefront that made the PSF: of the six coefficients for seidel, else of exact rays.

    The six coefficients know no rims. Raises GeometryError where no ray reaches the sensor.
    """
    if exact and setup.lens.misaligned:
        return skew_map(setup, quality, clip)
    samples = pupil_samples(setup, exact, quality, clip)
    if samples[2] is not None:
        check_unmasked(setup.lens, Message("a pupil that ends at rims or where rays are lost"))
        return _clear_map(samples, quality)
    kind = "exact rays" if exact else "what-if" if setup.altered else "six coefficients"
    return map_behind(setup, projection(quality) @ samples[1], quality, kind)


def pupil_samples(setup: ParaxialSetup, exact: bool, quality: str, clip: bool) -> Samples:
    """Return samples of the wavefront that `pupil_of` shows; over the whole pupil they stand at `zernike_nodes`."""
    nodes = zernike_nodes(quality)
    whole = ClearNodes(nodes.xi, nodes.eta, nodes.weight, 1.0)
    if not exact:
        return whole, np.asarray(wavefront(setup.coefficients, nodes.xi, nodes.eta)), None
    lens, source = setup.lens, setup.source
    whole = whole.unfolded() if lens.misaligned else whole
    waves = displayed_opd(lens, source, whole.xi, whole.eta)
    if np.isfinite(waves).all() and not (clip and clipped(lens, source, whole)):
        return whole, waves, None
    rim = clear_rim(lens, source, clip, *RIMS[quality])
    clear = rim.nodes(RADII[quality])
    return clear, displayed_opd(lens, source, clear.xi, clear.eta), rim


def skew_map(setup: ParaxialSetup, quality: str, clip: bool) -> WavefrontMap:
    """Return the map of exact rays through a misaligned lens, whose wavefront no half of the pupil tells.

    Where rays are lost, or rims clip, it is of rays on a grid, and its figures are those of the rays that arrive.
    """
    xi, eta, weight = whole_disc(*RAYS[quality])
    rays = pencil(setup.lens, setup.source, xi, eta, clip=clip)
    if not rays.passed.all():
        return _gridded(setup, quality, clip)
    waves = opd_on_sphere(rays, exit_radius(setup.lens, setup.source, rays))
    return map_behind(setup, pupil_terms(quality, True, xi, eta) * weight @ waves, quality)


def _gridded(setup: ParaxialSetup, quality: str, clip: bool) -> WavefrontMap:
    """Return the map of rays on a grid over the pupil, NaN where one does not arrive or what stands in the stop is."""
    count = GRIDDED[quality]
    xi, eta, inside = disc(count)
    inside = inside & setup.lens.mask.opens(xi, eta)
    rays = pencil(setup.lens, setup.source, xi[inside], eta[inside], clip=clip)
    arrived, waves = rays.passed, np.full((count, count), np.nan)
    if not arrived.any():
        raise GeometryError(CLIPPED if clip else LOST, parameter="clip")
    opd = opd_on_sphere(rays, exit_radius(setup.lens, setup.source, rays))
    opd = opd - setup.lens.mask.path_um(rays.xi, rays.eta) / setup.source.wavelength_um
    waves[inside] = opd
    shown, share = pupil_map(waves, inside, "exact rays"), float(arrived.sum()) / float(disc(count)[2].sum())
    even = np.full(int(arrived.sum()), 1 / arrived.sum())
    nodes = ClearNodes(rays.xi[arrived], rays.eta[arrived], even, share, even=False)
    fit = decomposed(nodes, opd[arrived], "noll", zernike_terms("noll", USUAL_TERMS))
    parts = families((term.n, term.m, part) for term, part in zip(fit.terms, (fit.rms_waves**2).tolist(), strict=True))
    return replace(shown, clear=share, parts=parts, rest=fit.residual**2)


def clipped(lens: Lens, source: Source, nodes: ClearNodes) -> bool:
    """Return whether a rim stops a ray through the nodes or through the pupil's own rim."""
    rim = (_half(CIRCLE) if nodes.even else CIRCLE)[:, ::5]
    xi, eta = np.append(nodes.xi, rim[0]), np.append(nodes.eta, rim[1])
    return not pencil(lens, source, xi, eta, clip=True).passed.all()


def _clear_map(samples: Samples, quality: str) -> WavefrontMap:
    """Return the map over the part of the pupil that passes light."""
    nodes, waves, rim = samples
    root = np.sqrt(nodes.weight)
    table = basis(ORDERS[quality], nodes.xi, nodes.eta) * root
    found = np.linalg.lstsq(table.T, waves * root, rcond=1e-12)[0]
    fit = decomposed(nodes, waves, "noll", zernike_terms("noll", USUAL_TERMS))
    parts = families((term.n, term.m, part) for term, part in zip(fit.terms, (fit.rms_waves**2).tolist(), strict=True))
    shown, peak = _picture(found, quality, rim)
    outline = CIRCLE if rim is None else rim.outline()
    return WavefrontMap(shown, fit.rms, peak, "exact rays", outline, nodes.share, parts, fit.residual**2)


def families(terms: Iterable[tuple[int, int, float]]) -> dict[str, float]:
    """Return (n, m, part of the variance) added up by the aberration's name; piston and tilt are left out."""
    parts: dict[str, float] = {}
    for n, m, part in terms:
        if n > 1:
            name = family(n, abs(m))
            parts[name] = parts.get(name, 0.0) + part
    return parts


def whole_map(found: np.ndarray, quality: str, kind: str = "exact rays") -> WavefrontMap:
    """Return the map of a wavefront over the whole pupil, given by the even terms of `zernike` up to the order.

    That of a misaligned lens goes on with the odd terms, as `pupil_terms` has them.
    """
    order = ORDERS[quality]
    known = terms(order) if _is_even(found, quality) else (*terms(order), *terms(order, True))
    parts = families((n, m, part) for (n, m), part in zip(known, (found**2).tolist(), strict=True))
    shown, peak = _picture(found, quality, None)
    return WavefrontMap(shown, float(np.sqrt(sum(parts.values()))), peak, kind, parts=parts)


def pupil_terms(quality: str, skew: bool, xi: np.ndarray, eta: np.ndarray) -> np.ndarray:
    """Return the terms of a map at pupil points, (terms, points): the even ones, and with ``skew`` the odd ones too."""
    even = basis(ORDERS[quality], xi, eta)
    return np.concatenate([even, basis(ORDERS[quality], xi, eta, odd=True)]) if skew else even


def _is_even(found: np.ndarray, quality: str) -> bool:
    """Return whether a wavefront is given by even terms alone."""
    return len(found) == len(terms(ORDERS[quality]))


@dataclass(frozen=True, eq=False)
class MaskedPupil:
    """What a mask in the stop leaves open, for the map: all that no lens and no wavelength changes.

    The terms of `zernike` and the path from the chief ray's, µm, at ``nodes``, at the open sides of edges, and at nodes
    of positive weights, over which ``columns`` (nodes, terms) times the roots of the weights are orthogonal ``terms``.
    """

    nodes: ClearNodes
    at_nodes: "Basis"
    at_edges: "Basis"
    at_parts: "Basis"
    root: np.ndarray
    columns: np.ndarray
    terms: tuple[ZernikeTerm, ...]
    path_um: np.ndarray | float
    open: np.ndarray
    beyond: np.ndarray
    shade: np.ndarray | None


@dataclass(frozen=True, eq=False)
class Basis:
    """The terms of a wavefront at points, (terms, points), and the path of a mask there, µm."""

    terms: np.ndarray
    path_um: np.ndarray | float

    def waves(self, found: np.ndarray, per_um: float) -> np.ndarray:
        """Return W behind the mask, waves: a delay makes the path longer, and W smaller."""
        waves: np.ndarray = found @ self.terms - per_um * self.path_um
        return waves


def map_behind(setup: ParaxialSetup, found: np.ndarray, quality: str, kind: str = "exact rays") -> WavefrontMap:
    """Return the map of a wavefront, given as `whole_map` takes it, behind the mask in the lens's stop."""
    mask = mask_seen(setup.lens, setup.source)
    if mask.clear:
        return whole_map(found, quality, kind)
    per_um, known = 1 / setup.source.wavelength_um, masked_pupil(mask, quality, not _is_even(found, quality))
    shown = _sampled(found, quality) - per_um * known.path_um
    at_edges, waves = known.at_edges.waves(found, per_um), known.at_nodes.waves(found, per_um)
    highest = np.max(shown, initial=at_edges.max(initial=-np.inf), where=known.open)
    lowest = np.min(shown, initial=at_edges.min(initial=np.inf), where=known.open)
    parts, rest = masked_parts(known, found, per_um)
    shown[known.beyond] = np.nan
    return WavefrontMap(
        shown,
        rms(waves, known.nodes.weight, known.nodes.axes),
        float(highest - lowest),
        kind,
        clear=known.nodes.share,
        parts=parts,
        rest=rest,
        iris=opening(mask),
        obstructions=obstructions(mask),
        shade=known.shade,
    )


def masked_parts(known: MaskedPupil, found: np.ndarray, per_um: float) -> tuple[dict[str, float], float]:
    """Return the parts of the variance behind a mask by aberrations, waves², and what they leave of it."""
    waves = known.root * known.at_parts.waves(found, per_um)
    amounts = known.columns.T @ waves
    rest = waves - known.columns @ amounts
    parts = families((t.n, t.m, part) for t, part in zip(known.terms, (amounts**2).tolist(), strict=True))
    return parts, float(rest @ rest)


@lru_cache(maxsize=8)
def masked_pupil(mask: PupilMask, quality: str, skew: bool = False) -> MaskedPupil:
    """Return what a mask leaves open, ``skew`` for wavefronts of a misaligned lens.

    Zernike's terms are made orthogonal over it (`p2sf.raytrace.zernike_fit`), vanes set aside: the nodes then have
    positive weights, as the decomposition needs. Raises GeometryError where nothing is open.
    """

    def path_um(xi: np.ndarray, eta: np.ndarray) -> np.ndarray | float:
        return mask.path_um(xi, eta) - mask.path_um(np.zeros(1), np.zeros(1)) if mask.phased else 0.0

    def at(xi: np.ndarray, eta: np.ndarray) -> Basis:
        return Basis(pupil_terms(quality, skew, xi, eta), path_um(xi, eta))

    nodes, parts = (mask_nodes(some, *RAYS[quality]) for some in (mask, replace(mask, vanes=0)))
    if skew:
        nodes, parts = nodes.unfolded(), parts.unfolded()
    terms = tuple(term for term in zernike_terms("noll", USUAL_TERMS) if term.even or not parts.even)
    root = np.sqrt(parts.weight)
    xi, eta, inside = disc(SAMPLES[quality])
    covered = ~mask.opens(xi, eta)
    return MaskedPupil(
        nodes=nodes,
        at_nodes=at(nodes.xi, nodes.eta),
        at_edges=at(*_open_edges(mask)),
        at_parts=at(parts.xi, parts.eta),
        root=root,
        columns=np.linalg.qr((zernike_values(terms, parts.xi, parts.eta) * root).T)[0],
        terms=terms,
        path_um=path_um(xi, eta),
        open=inside & ~covered,
        beyond=_all_around(covered) | _whole(SAMPLES[quality])[1],
        shade=_shade(mask, SAMPLES[quality]),
    )


def _open_edges(mask: PupilMask) -> np.ndarray:
    """Return ξ and η of points beside the edges of a mask, where these are open, (2, points)."""
    edges = np.concatenate([opening(mask), *obstructions(mask)], axis=1)
    beside = np.concatenate([edges * (1 - EDGE_STEP), edges * (1 + EDGE_STEP)], axis=1)
    beside = beside[:, np.hypot(*beside) <= 1]
    return beside[:, mask.opens(*beside)]


def _all_around(covered: np.ndarray) -> np.ndarray:
    """Return the covered samples whose neighbours on all sides are covered: the painted edge then has no gap."""
    padded = np.pad(covered, 1, constant_values=True)
    sides = [np.roll(padded, (row, column), (0, 1)) for row in (-1, 0, 1) for column in (-1, 0, 1)]
    return np.logical_and.reduce(sides)[1:-1, 1:-1]


def _shade(mask: PupilMask, count: int) -> np.ndarray | None:
    """Return the amplitude that passes over its largest, at the samples; None where it is the same everywhere."""
    if not mask.shaded:
        return None
    xi, eta, inside = disc(count)
    amplitude = np.abs(mask.amplitude(xi, eta))
    return np.minimum(amplitude / (float(amplitude[inside].max()) or 1.0), 1.0)


def zernike_nodes(quality: str) -> DiscNodes:
    """Return the pupil points of the rays that the terms are fitted to."""
    return disc_nodes(*RAYS[quality])


@lru_cache(maxsize=2)
def projection(quality: str) -> np.ndarray:
    """Return the matrix from waves at `zernike_nodes` to the terms: their means over the disc, (terms, nodes)."""
    nodes = zernike_nodes(quality)
    return basis(ORDERS[quality], nodes.xi, nodes.eta) * nodes.weight


def _picture(found: np.ndarray, quality: str, rim: ClearRim | None) -> tuple[np.ndarray, float]:
    """Return the samples of a wavefront up to a pixel beyond the rim, and its peak-to-valley up to the rim itself."""
    count = SAMPLES[quality]
    if rim is None:
        at_rim = found @ _circle_basis(quality, not _is_even(found, quality))
    else:
        at_rim = found @ basis(ORDERS[quality], *_half(rim.outline()))
    waves = _sampled(found, quality)
    inside, beyond = _whole(count) if rim is None else _parts(_mirrored(rim.excess(*_right(count))))
    highest = np.max(waves, initial=at_rim.max(), where=inside)
    lowest = np.min(waves, initial=at_rim.min(), where=inside)
    waves[beyond] = np.nan
    return waves, float(highest - lowest)


def _half(outline: np.ndarray) -> np.ndarray:
    """Return the right half of an outline; the left is its mirror image."""
    return outline[:, : outline.shape[1] // 2 + 1]


@lru_cache(maxsize=4)
def _circle_basis(quality: str, skew: bool) -> np.ndarray:
    """Return the terms on the unit circle, (terms, points)."""
    return pupil_terms(quality, skew, *(CIRCLE if skew else _half(CIRCLE)))


def _sampled(found: np.ndarray, quality: str) -> np.ndarray:
    """Return the sum of the terms on the whole square: powers of η times powers of ξ², mirrored at ξ = 0.

    Odd terms are ξ times such a sum, and change their sign there.
    """
    along, across, table = _power_tables(quality)
    if _is_even(found, quality):
        return _mirrored(along @ np.tensordot(found, table, 1).T @ across)
    even, odd = found[: len(table)], found[len(table) :]
    along_odd, across_odd, table_odd = _power_tables(quality, True)
    one = along @ np.tensordot(even, table, 1).T @ across
    other = along_odd @ np.tensordot(odd, table_odd, 1).T @ across_odd
    return np.concatenate([(one - other)[:, ::-1], one + other], axis=1)


def _mirrored(right: np.ndarray) -> np.ndarray:
    """Return both halves of a map that is even in ξ."""
    return np.concatenate([right[:, ::-1], right], axis=1)


def _right(count: int) -> tuple[np.ndarray, np.ndarray]:
    """Return ξ and η of the samples with ξ > 0."""
    xi, eta, _ = disc(count)
    return xi[:, count // 2 :], eta[:, count // 2 :]


@lru_cache(maxsize=4)
def _power_tables(quality: str, odd: bool = False) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return ηᵇ of the rows, ξ²ᵃ of the right half's columns, and the terms as powers, (terms, a, b).

    Of the ``odd`` terms they are those times ξ.
    """
    axis, table = centres(SAMPLES[quality]), powers(ORDERS[quality], odd)
    right = axis[axis.size // 2 :]
    across = np.vander(right**2, table.shape[1], increasing=True).T * (right if odd else 1.0)
    return np.vander(axis, table.shape[2], increasing=True), across, table


@lru_cache(maxsize=4)
def _whole(count: int) -> tuple[np.ndarray, np.ndarray]:
    """Return which samples lie inside the unit circle, and which more than a pixel beyond it."""
    xi, eta, _ = disc(count)
    return _parts(np.hypot(xi, eta) - 1)


def _parts(excess: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return which samples lie inside, and which more than a pixel beyond, given how far beyond the rim they lie."""
    return excess <= 0, excess >= np.sqrt(2) * 2 / len(excess)


def variance_parts(coefficients: Coefficients) -> dict[str, float]:
    """Return how the variance of the six coefficients' W (waves²) is to be laid to each of them; tilt is left out.

    Spherical beyond its best focus W40²/180, coma beyond its tilt W31²/72, astigmatism about its medial focus W22²/24,
    and all focus together (W40 + W20 + Wd + W22/2)²/12 (Mahajan 1991, table 2-1). What pushes the focus the way it is
    off shares that part, each by its size; what pulls against it has none.
    """
    w40, w31, w22, w20, wd = (float(getattr(coefficients, name)) for name in ("w40", "w31", "w22", "w20", "wd"))
    causes = {"w40": w40, "w20": w20 + w22 / 2, "wd": wd}
    focus = sum(causes.values())
    pushes = {name: max(0.0, cause * focus) for name, cause in causes.items()}
    whole = sum(pushes.values()) or 1.0
    shares = {name: focus**2 / 12 * push / whole for name, push in pushes.items()}
    return {"w40": w40**2 / 180 + shares["w40"], "w31": w31**2 / 72, "w22": w22**2 / 24} | {
        name: shares[name] for name in ("w20", "wd")
    }


def strongest(coefficients: Coefficients) -> str:
    """Return which of the six coefficients is to be changed first: the one that most of the variance is laid to."""
    parts = variance_parts(coefficients)
    return max(parts, key=parts.__getitem__)


def dominant(pupil: WavefrontMap, coefficients: Coefficients) -> Message:
    """Return what blurs most: an aberration and its share of the variance without piston and tilt (handbook 3.4).

    What refocusing would remove need not be a defocus: where the six coefficients account for it, those that make it
    are named.
    """
    if pupil.rms**2 < MARECHAL:
        return Message("Diffraction-limited: RMS {rms:.3f} λ", rms=pupil.rms)
    total = sum(pupil.parts.values()) + pupil.rest
    name = max(pupil.parts, key=pupil.parts.__getitem__)
    percent, term = 100 * pupil.parts[name] / total, Message(name)
    if name == "defocus":
        causes = focus_causes(coefficients, pupil.parts[name])
        if causes:
            sentence = "Refocusing would remove {percent:.0f} % of the wavefront variance, made by {causes}"
            return Message(sentence, percent=percent, causes=causes)
        return Message("Refocusing would remove {percent:.0f} % of the wavefront variance", percent=percent)
    if percent > 50:
        return Message("Mostly {term}: {percent:.0f} % of the wavefront variance", term=term, percent=percent)
    return Message("Mainly {term}: {percent:.0f} % of the wavefront variance", term=term, percent=percent)


def focus_causes(coefficients: Coefficients, variance: float) -> tuple[str, ...]:
    """Return the coefficients that make this variance of focus, the largest first; none where they make another."""
    c = coefficients
    focus = float(c.w40 + c.w20 + c.wd + c.w22 / 2)
    if not 1 / ALIKE < focus**2 / 12 / variance < ALIKE:
        return ()
    pulls = {"W40": float(c.w40), "W20": float(c.w20), "Wd": float(c.wd), "W22": float(c.w22 / 2)}
    found = [name for name, pull in pulls.items() if pull / focus > LEAST_CAUSE]
    return tuple(sorted(found, key=lambda name: -pulls[name] / focus))
