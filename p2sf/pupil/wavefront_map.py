"""The wavefront over the part of the pupil that passes light, as a picture and as numbers (handbook 3.4).

The wavefront of the lens is a sum of Zernike terms, fitted by least squares where rays arrive: over the whole disc one
product with a fixed matrix. What rims, lost rays and the mask in the stop leave open is the same for every wavefront;
picture, RMS and the shares of the variance are read off there.
"""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field, replace
from functools import lru_cache, partial

import numpy as np

from p2sf.conventions import write_protect
from p2sf.disc.basis import Terms
from p2sf.disc.domain import HALF, WHOLE, ClearNodes, PupilDomain
from p2sf.disc.mask import PupilMask
from p2sf.disc.mask_nodes import mask_nodes
from p2sf.disc.mask_outline import obstructions, opening
from p2sf.disc.open_part import WHOLE_DISC, OpenPart
from p2sf.disc.tilt import rms
from p2sf.disc.zernike import powers
from p2sf.disc.zernike_terms import family, zernike_terms, zernike_values
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.paraxial.seidel import Coefficients
from p2sf.paraxial.wavefront import wavefront
from p2sf.pupil.seen_mask import mask_seen
from p2sf.pupil.vignetting import clear_part
from p2sf.pupil.zernike_fit import USUAL_TERMS
from p2sf.raytrace.pencil import displayed_opd, exit_radius, opd_on_sphere, pencil

SAMPLES = {"preview": 128, "settled": 384}  # across the picture; an enlarged panel has some thousand pixels
ORDERS = {"preview": 8, "settled": 18}  # of the fit
RAYS = {"preview": (7, 20), "settled": (16, 44)}  # radii and directions: exact for products of two terms of that order
RIM_COUNTS = {"preview": (7, 32), "settled": (12, 72)}  # radii and directions over a clipped pupil
TURN = np.linspace(0, 2 * np.pi, 241)
CIRCLE = np.stack([np.sin(TURN), np.cos(TURN)])
RIM_RAYS = 5  # every so many points of that circle are traced
EDGE_STEP = 1e-9
LINES_PER_RADIUS = 4  # of nodes of positive weights, between corners and ends of edges
RIM_POINTS = 128  # on half a clipped rim as drawn
ON_EDGE = 1e-9  # beyond an edge, and still on it


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


@dataclass(frozen=True, eq=False)
class WavefrontSamples:
    """Nodes over the part of the pupil where rays arrive, W there in waves, and that part where it is not the disc.

    ``domain``: HALF for a wavefront that is even in ξ.
    """

    nodes: ClearNodes
    waves: np.ndarray
    domain: PupilDomain
    clear: OpenPart | None = None


@lru_cache(maxsize=8)
def disc(count: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return ξ, η of ``count``² samples over the pupil's square, and which of them lie inside."""
    axis = _centres(count)
    xi, eta = np.meshgrid(axis, axis)
    return xi, eta, xi**2 + eta**2 <= 1


def _centres(count: int) -> np.ndarray:
    """Return the centres of ``count`` even cells from −1 to 1."""
    return (2 * np.arange(count) + 1 - count) / count


def map_of_samples(waves: np.ndarray, inside: np.ndarray, kind: str) -> WavefrontMap:
    """Return a map of samples with RMS and peak-to-valley over those inside that have a value."""
    inside = inside & np.isfinite(waves)
    kept = waves[inside]
    if kept.size == 0:
        return WavefrontMap(np.full(waves.shape, np.nan), np.nan, np.nan, kind)
    xi, eta, _ = disc(len(waves))
    blur = rms(kept, np.full(kept.size, 1 / kept.size), np.stack([eta[inside], xi[inside]]))
    return WavefrontMap(np.where(inside, waves, np.nan), blur, float(np.ptp(kept)), kind)


@dataclass(frozen=True)
class MapTerms:
    """Zernike terms up to the order of a quality, as the domain of the lens has them: even in ξ, then odd."""

    quality: str
    domain: PupilDomain

    @property
    def terms(self) -> Terms:
        """Return the terms."""
        return Terms(ORDERS[self.quality], self.domain.parities(False))

    @property
    def degrees(self) -> list[tuple[int, int]]:
        """Return (n, m) of each term."""
        return [(n, m) for n, m in self.terms.indices.T.tolist()]

    def at(self, xi: np.ndarray, eta: np.ndarray) -> np.ndarray:
        """Return the terms at pupil points, (terms, points)."""
        return self.terms.values(xi, eta)

    def sampled(self, amounts: np.ndarray) -> np.ndarray:
        """Return their sum on the square: powers of η times powers of ξ², of odd ones times ξ, mirrored at ξ = 0."""
        left, right = 0.0, 0.0
        for odd, own in self.terms.kinds(amounts):
            along, across, table = _power_tables(self.quality, odd)
            half = along @ np.tensordot(own, table, 1).T @ across
            left, right = left + (-half if odd else half), right + half
        waves: np.ndarray = np.concatenate([np.asarray(left)[:, ::-1], np.asarray(right)], axis=1)
        return waves

    def fitted(self, samples: WavefrontSamples) -> np.ndarray:
        """Return how much of each term a wavefront has, by least squares."""
        if samples.clear is None:
            whole: np.ndarray = _projection(self) @ samples.waves
            return whole
        root = np.sqrt(samples.nodes.weight)
        table = self.at(samples.nodes.xi, samples.nodes.eta) * root
        found: np.ndarray = np.linalg.lstsq(table.T, samples.waves * root, rcond=1e-12)[0]
        return found


@lru_cache(maxsize=4)
def _power_tables(quality: str, odd: bool) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return ηᵇ of the rows, ξ²ᵃ of the right half's columns, and the terms as powers, (terms, a, b).

    Of the ``odd`` terms they are those times ξ.
    """
    axis, table = _centres(SAMPLES[quality]), powers(ORDERS[quality], odd)
    right = axis[axis.size // 2 :]
    across = np.vander(right**2, table.shape[1], increasing=True).T * (right if odd else 1.0)
    return np.vander(axis, table.shape[2], increasing=True), across, table


@lru_cache(maxsize=4)
def _projection(known: MapTerms) -> np.ndarray:
    """Return the matrix from waves at nodes over the disc to the terms: their means over it, (terms, nodes)."""
    nodes = known.domain.nodes(RAYS[known.quality])
    return write_protect(known.at(nodes.xi, nodes.eta) * nodes.weight)


def samples_of_rays(lens: Lens, source: Source, quality: str, clip: bool = False) -> WavefrontSamples:
    """Return the displayed OPD of exact rays, where rims and lost rays let any pass.

    ``quality``: "preview" or "settled". Raises GeometryError where no ray reaches the sensor.
    """
    nodes = lens.pupil_domain.nodes(RAYS[quality])
    rays = pencil(lens, source, nodes.xi, nodes.eta)
    waves = opd_on_sphere(rays, exit_radius(lens, source, rays))
    if np.isfinite(waves).all() and not (clip and _clipped(lens, source, nodes)):
        return WavefrontSamples(nodes, waves, lens.pupil_domain)
    clear = clear_part(lens, source, clip)
    nodes = _positive_nodes(clear, RIM_COUNTS[quality])
    return WavefrontSamples(nodes, displayed_opd(lens, source, nodes.xi, nodes.eta), lens.pupil_domain, clear)


def samples_of_coefficients(six: Coefficients, quality: str) -> WavefrontSamples:
    """Return W of the six coefficients, which know no rims."""
    nodes = HALF.nodes(RAYS[quality])
    return WavefrontSamples(nodes, np.asarray(wavefront(six, nodes.xi, nodes.eta)), HALF)


def _clipped(lens: Lens, source: Source, nodes: ClearNodes) -> bool:
    """Return whether a rim stops a ray through the nodes or through the pupil's own rim."""
    rim = CIRCLE[:, ::RIM_RAYS]
    return not pencil(lens, source, np.append(nodes.xi, rim[0]), np.append(nodes.eta, rim[1]), clip=True).passed.all()


def _positive_nodes(part: OpenPart, counts: tuple[int, int]) -> ClearNodes:
    """Return nodes over what is open with positive weights, as a decomposition needs them."""
    if part.mask.clear and part.rim is not None and not part.shadows:
        return part.rim.nodes(counts)
    return part.line_nodes(LINES_PER_RADIUS * counts[0], 2 * counts[0])


def map_of(
    lens: Lens, source: Source, samples: WavefrontSamples, quality: str, kind: str = "exact rays"
) -> WavefrontMap:
    """Return the map of a wavefront behind the mask in the lens's stop. Raises GeometryError where nothing is open."""
    known = MapTerms(quality, samples.domain)
    return map_of_terms(lens, source, known, known.fitted(samples), samples.clear, kind)


def map_of_terms(
    lens: Lens,
    source: Source,
    known: MapTerms,
    found: np.ndarray,
    clear: OpenPart | None = None,
    kind: str = "exact rays",
) -> WavefrontMap:
    """Return the map of a wavefront of the lens, ``found`` of the terms ``known``, behind the mask in its stop."""
    mask, per_um = mask_seen(lens, source), 1 / source.wavelength_um
    part = _whole_part(mask, known) if clear is None else _open_part(mask, known, clear)
    shown = known.sampled(found) - per_um * part.path_um
    at_edges = part.at_edges.waves(found, per_um)
    highest = np.max(shown, initial=at_edges.max(initial=-np.inf), where=part.open)
    lowest = np.min(shown, initial=at_edges.min(initial=np.inf), where=part.open)
    shown[part.beyond] = np.nan
    waves, weight = part.at_nodes.waves(found, per_um), part.nodes.weight
    amounts = part.columns.T @ (weight * waves)
    left = waves - part.columns @ amounts
    parts = families((n, m, square) for (n, m), square in zip(part.degrees, (amounts**2).tolist(), strict=True))
    rest = max(float(weight @ left**2), 0.0)  # of weights that may be negative
    blur = float(np.sqrt(sum(parts.values()) + rest))  # the terms are orthogonal
    return WavefrontMap(
        shown,
        blur,
        float(highest - lowest),
        kind,
        outline=_outline(clear),
        clear=part.nodes.share,
        parts=parts,
        rest=rest,
        iris=part.iris,
        obstructions=part.obstructions,
        shade=part.shade,
    )


def families(amounts: Iterable[tuple[int, int, float]]) -> dict[str, float]:
    """Return (n, m, part of the variance) added up by the aberration's name; piston and tilt are left out."""
    parts: dict[str, float] = {}
    for n, m, part in amounts:
        if n > 1:
            name = family(n, abs(m))
            parts[name] = parts.get(name, 0.0) + part
    return parts


@dataclass(frozen=True, eq=False)
class TermsAt:
    """The terms of a wavefront at points, (terms, points), and the path of a mask there, µm."""

    terms: np.ndarray
    path_um: np.ndarray | float

    def waves(self, found: np.ndarray, per_um: float) -> np.ndarray:
        """Return W behind the mask, waves: a delay makes the path longer, and W smaller."""
        waves: np.ndarray = found @ self.terms - per_um * self.path_um
        return waves


@dataclass(frozen=True, eq=False)
class MapPart:
    """What rims and mask leave open of the pupil, for maps: all that no wavefront and no wavelength changes.

    The terms and the path from the chief ray's, µm, at the open sides of edges, and at ``nodes``, over which
    ``columns`` (nodes, terms) of ``degrees`` (n, m) are orthonormal.
    """

    nodes: ClearNodes
    at_nodes: TermsAt
    at_edges: TermsAt
    columns: np.ndarray
    degrees: list[tuple[int, int]]
    path_um: np.ndarray | float
    open: np.ndarray
    beyond: np.ndarray
    iris: np.ndarray
    obstructions: tuple[np.ndarray, ...]
    shade: np.ndarray | None


@lru_cache(maxsize=8)
def _whole_part(mask: PupilMask, known: MapTerms) -> MapPart:
    return _open_part(mask, known, None)


def _open_part(mask: PupilMask, known: MapTerms, clear: OpenPart | None) -> MapPart:
    """Return what a mask and the clear part leave open. Raises GeometryError where that is nothing.

    Zernike's terms are made orthogonal over it (`p2sf.pupil.zernike_fit`).
    """

    def path_um(xi: np.ndarray, eta: np.ndarray) -> np.ndarray | float:
        return mask.path_um(xi, eta) - mask.path_um(np.zeros(1), np.zeros(1)) if mask.phased else 0.0

    def at(xi: np.ndarray, eta: np.ndarray) -> TermsAt:
        return TermsAt(known.at(xi, eta), path_um(xi, eta))

    nodes = _figure_nodes(mask, known, clear)
    if mask.clear and clear is None:  # where they are orthogonal as they are
        degrees, terms = known.degrees, known.at
    else:
        used = tuple(term for term in zernike_terms("noll", USUAL_TERMS) if term.odd in nodes.domain.parities(False))
        degrees, terms = [(term.n, term.m) for term in used], partial(zernike_values, used)
    open_, beyond = _on_samples(mask, clear, SAMPLES[known.quality])
    return MapPart(
        nodes=nodes,
        at_nodes=at(nodes.xi, nodes.eta),
        at_edges=at(*_open_edges(mask, clear)),
        columns=_orthonormal(terms, nodes),
        degrees=degrees,
        path_um=path_um(*disc(SAMPLES[known.quality])[:2]),
        open=open_,
        beyond=beyond,
        iris=opening(mask),
        obstructions=obstructions(mask),
        shade=_shade(mask, SAMPLES[known.quality]),
    )


def _orthonormal(terms: Callable[[np.ndarray, np.ndarray], np.ndarray], nodes: ClearNodes) -> np.ndarray:
    """Return terms made orthonormal in order over nodes of positive weights, (nodes, terms), by a QR decomposition."""
    columns, _ = np.linalg.qr((terms(nodes.xi, nodes.eta) * np.sqrt(nodes.weight)).T)
    return np.asarray(columns / np.sqrt(nodes.weight)[:, None])


def _figure_nodes(mask: PupilMask, known: MapTerms, clear: OpenPart | None) -> ClearNodes:
    """Return nodes over what is open, of positive weights, over which figures are those of least squares."""
    if clear is None:
        counts = RAYS[known.quality]
        plain = known.domain.nodes(counts) if mask.clear else known.domain.over(mask_nodes(mask, *counts))
        if (plain.weight > 0).all():
            return plain
    part = clear or replace(WHOLE_DISC, domain=known.domain)
    return _positive_nodes(part.behind(mask), RIM_COUNTS[known.quality])


def _on_samples(mask: PupilMask, clear: OpenPart | None, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Return which samples of the square are open, and which more than a pixel away from all that is."""
    xi, eta, _ = disc(count)
    covered, pixel = ~mask.opens(xi, eta), np.sqrt(2) * 2 / count
    excess = np.hypot(xi, eta) - 1 if clear is None else clear.beyond(xi, eta)
    return (excess <= 0) & ~covered, _all_around(covered) | (excess >= pixel)


def _outline(clear: OpenPart | None) -> np.ndarray:
    """Return ξ and η around the clear part, closed."""
    if clear is None or clear.rim is None:
        return CIRCLE
    xi, eta = clear.rim.points(RIM_POINTS, WHOLE)
    return np.stack([np.append(xi, xi[:1]), np.append(eta, eta[:1])])


def _open_edges(mask: PupilMask, clear: OpenPart | None) -> np.ndarray:
    """Return ξ and η of points on edges, or beside those of a mask, where these are open, (2, points)."""
    rim = _outline(clear)
    drawn = [opening(mask), *obstructions(mask)] if mask.edged else []
    beside = np.concatenate([rim, *(edge * part for edge in drawn for part in (1 - EDGE_STEP, 1 + EDGE_STEP))], axis=1)
    beyond = np.hypot(*beside) - 1 if clear is None else clear.beyond(*beside)
    return beside[:, (beyond <= ON_EDGE / 2) & mask.opens(*beside)]


def _all_around(covered: np.ndarray) -> np.ndarray:
    """Return the covered samples whose neighbours on all sides are covered: the painted edge then has no gap."""
    padded = np.pad(covered, 1, constant_values=True)
    sides = [np.roll(padded, (row, column), (0, 1)) for row in (-1, 0, 1) for column in (-1, 0, 1)]
    within: np.ndarray = np.logical_and.reduce(sides)[1:-1, 1:-1]
    return within


def _shade(mask: PupilMask, count: int) -> np.ndarray | None:
    """Return the amplitude that passes over its largest, at the samples; None where it is the same everywhere."""
    if not mask.shaded:
        return None
    xi, eta, inside = disc(count)
    amplitude = np.abs(mask.amplitude(xi, eta))
    shade: np.ndarray = np.minimum(amplitude / (float(amplitude[inside].max()) or 1.0), 1.0)
    return shade
