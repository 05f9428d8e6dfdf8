"""The wavefront over the part of the pupil that passes light, as a picture and as numbers (handbook 3.4).

The wavefront of the lens is a function over the disc: through nodes there where all rays arrive, else by least squares
where they do. What rims, lost rays and the mask in the stop leave open is the same for every wavefront; picture, RMS
and the shares of the variance are read off there.
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from functools import lru_cache

import numpy as np

from p2sf.disc.basis import Terms
from p2sf.disc.disc_function import DiscFunction
from p2sf.disc.domain import HALF, WHOLE, ClearNodes, PupilDomain
from p2sf.disc.mask import PupilMask
from p2sf.disc.mask_outline import obstructions, opening
from p2sf.disc.open_part import WHOLE_DISC, OpenPart
from p2sf.disc.tilt import rms
from p2sf.disc.zernike_terms import ZernikeTerm, family, orthonormal_terms, zernike_terms
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.paraxial.seidel import Coefficients
from p2sf.paraxial.wavefront import wavefront
from p2sf.pupil.seen_mask import mask_seen
from p2sf.pupil.smooth_pupil import all_reach
from p2sf.pupil.vignetting import clear_part
from p2sf.pupil.zernike_fit import USUAL_TERMS
from p2sf.raytrace.pencil import displayed_opd

SAMPLES = {"preview": 128, "settled": 384}  # across the picture; an enlarged panel has some thousand pixels
ORDERS = {"preview": 8, "settled": 18}  # of a fit where rays arrive, and of the parts of the variance
RAYS = {"preview": (7, 20), "settled": (16, 44)}  # radii and directions: exact for products of two terms of that order
RIM_COUNTS = {"preview": (7, 32), "settled": (12, 72)}  # radii and directions over a clipped pupil
TURN = np.linspace(0, 2 * np.pi, 241)
CIRCLE = np.stack([np.sin(TURN), np.cos(TURN)])
EDGE_STEP = 1e-9
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


def wavefront_of_rays(lens: Lens, source: Source, quality: str, clip: bool = False) -> tuple[DiscFunction, OpenPart]:
    """Return the displayed OPD of exact rays, waves, and the part of the disc where rims and lost rays let any pass.

    ``quality``: "preview" or "settled". Raises GeometryError where no ray reaches the sensor.
    """
    clear, domain = clear_part(lens, source, clip, all_reach(lens, source)), lens.pupil_domain
    nodes = domain.nodes(RAYS[quality]) if clear.rim is None else clear.rim.nodes(RIM_COUNTS[quality])
    waves = displayed_opd(lens, source, nodes.xi, nodes.eta)
    if clear.rim is not None:
        terms, root = Terms(ORDERS[quality], domain.parities(False)), np.sqrt(nodes.weight)
        found = np.linalg.lstsq((terms.values(nodes.xi, nodes.eta) * root).T, waves * root, rcond=1e-12)[0]
        disc_nodes = domain.nodes(RAYS[quality])
        waves = found @ terms.values(disc_nodes.xi, disc_nodes.eta)
    return DiscFunction(waves[None], RAYS[quality], (False,), domain), clear


def wavefront_of_coefficients(six: Coefficients, quality: str) -> DiscFunction:
    """Return W of the six coefficients, waves, which know no rims."""
    nodes = HALF.nodes(RAYS[quality])
    return DiscFunction(np.asarray(wavefront(six, nodes.xi, nodes.eta))[None], RAYS[quality], (False,))


def map_of(
    lens: Lens,
    source: Source,
    waves: DiscFunction,
    quality: str,
    clear: OpenPart = WHOLE_DISC,
    kind: str = "exact rays",
) -> WavefrontMap:
    """Return the map of a wavefront in the ``clear`` part, behind the mask in the lens's stop.

    Raises GeometryError where nothing is open.
    """
    mask, per_um = mask_seen(lens, source), 1 / source.wavelength_um
    part = _whole_part(mask, waves.domain, quality) if clear.whole else _map_part(clear.behind(mask), quality)
    axis = _centres(SAMPLES[quality])
    # A delay makes the path longer, and W smaller.
    shown = waves.on_grid(axis, axis)[0] - per_um * part.path_um
    at_edges, at_nodes = (
        waves.at(*place)[0] - per_um * part.path_at(*place) for place in (part.edges, (part.nodes.xi, part.nodes.eta))
    )
    highest = np.max(shown, initial=at_edges.max(initial=-np.inf), where=part.open)
    lowest = np.min(shown, initial=at_edges.min(initial=np.inf), where=part.open)
    shown[part.beyond] = np.nan
    amounts = part.columns.T @ (part.nodes.weight * at_nodes)
    left = at_nodes - part.columns @ amounts
    parts = families((term.n, term.m, square) for term, square in zip(part.terms, (amounts**2).tolist(), strict=True))
    rest = max(float(part.nodes.weight @ left**2), 0.0)  # of weights that may be negative
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
        iris=opening(mask),
        obstructions=obstructions(mask),
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
class MapPart:
    """What rims and mask leave open of the pupil, for maps: all that no wavefront and no wavelength changes.

    ``columns``: ``terms`` made orthonormal over the ``nodes``, (nodes, terms). ``edges``: ξ and η of points on the open
    sides of edges, (2, points). ``path_um``: the mask's path from the chief ray's, at the samples.
    """

    mask: PupilMask
    nodes: ClearNodes
    terms: tuple[ZernikeTerm, ...]
    columns: np.ndarray
    edges: np.ndarray
    path_um: np.ndarray | float
    open: np.ndarray
    beyond: np.ndarray
    shade: np.ndarray | None

    def path_at(self, xi: np.ndarray, eta: np.ndarray) -> np.ndarray | float:
        """Return the mask's path from the chief ray's at points, µm."""
        return _path_um(self.mask, xi, eta)


@lru_cache(maxsize=8)
def _whole_part(mask: PupilMask, domain: PupilDomain, quality: str) -> MapPart:
    return _map_part(replace(WHOLE_DISC, domain=domain).behind(mask), quality)


def _map_part(part: OpenPart, quality: str) -> MapPart:
    """Return what maps need of an open part. Raises GeometryError where nothing is open.

    Zernike's terms are made orthogonal over it (`p2sf.pupil.zernike_fit`): those of a fit over the disc, where they are
    as they are, elsewhere the usual ones.
    """
    mask, degree = part.mask, ORDERS[quality]
    plain = part.whole and mask.clear
    nodes = part.nodes(RAYS[quality] if part.whole else RIM_COUNTS[quality])
    every = zernike_terms("noll", (degree + 1) * (degree + 2) // 2 if plain else USUAL_TERMS)
    terms = tuple(term for term in every if term.odd in nodes.domain.parities(False))
    open_, beyond = _on_samples(part, SAMPLES[quality])
    return MapPart(
        mask=mask,
        nodes=nodes,
        terms=terms,
        columns=orthonormal_terms(terms, nodes),
        edges=_open_edges(part),
        path_um=_path_um(mask, *disc(SAMPLES[quality])[:2]),
        open=open_,
        beyond=beyond,
        shade=_shade(mask, SAMPLES[quality]),
    )


def _path_um(mask: PupilMask, xi: np.ndarray, eta: np.ndarray) -> np.ndarray | float:
    return mask.path_um(xi, eta) - mask.path_um(np.zeros(1), np.zeros(1)) if mask.phased else 0.0


def _on_samples(part: OpenPart, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Return which samples of the square are open, and which more than a pixel away from all that is."""
    xi, eta, _ = disc(count)
    covered, excess = ~part.mask.opens(xi, eta), part.beyond(xi, eta)
    return (excess <= 0) & ~covered, _all_around(covered) | (excess >= np.sqrt(2) * 2 / count)


def _outline(part: OpenPart) -> np.ndarray:
    """Return ξ and η around the clear part, closed."""
    if part.rim is None:
        return CIRCLE
    xi, eta = part.rim.points(RIM_POINTS, WHOLE)
    return np.stack([np.append(xi, xi[:1]), np.append(eta, eta[:1])])


def _open_edges(part: OpenPart) -> np.ndarray:
    """Return ξ and η of points on edges, or beside those of a mask, where these are open, (2, points)."""
    mask = part.mask
    drawn = [opening(mask), *obstructions(mask)] if mask.edged else []
    beside = [edge * scale for edge in drawn for scale in (1 - EDGE_STEP, 1 + EDGE_STEP)]
    places = np.concatenate([_outline(part), *beside], axis=1)
    return places[:, (part.beyond(*places) <= ON_EDGE / 2) & mask.opens(*places)]


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
