"""Thousands of builds with random errors, by quadratic forms: their wavefront error, Strehl ratio and yield."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from p2sf.conventions import protected
from p2sf.errors import Cancelled, RequestError
from p2sf.pupil import zernike
from p2sf.pupil.quadrature import whole_disc
from p2sf.threads import one_blas_thread
from p2sf.tolerance.contrast import Pairs, pairs_of
from p2sf.tolerance.differentials import NODES, Differentials, OpenRays
from p2sf.tolerance.errors_of_build import IRREGULAR, Tolerance

TOGETHER = 500  # builds at a time
FEW_RAYS_RMS = 0.15  # waves up to which the rays of the differentials carry exp(2πiW)
SUMMED_RMS = 2.0  # waves up to which more rays carry it
ORDER, HARMONICS = 8, 5  # of the polynomials by which a change of the wavefront is known at those
ROUNDS = 2  # of Gauss and Newton's method for compensators, whose effect is nearly linear


@dataclass(frozen=True, eq=False)
class Builds:
    """Builds drawn at random: ``errors`` (builds, errors) in the units of the tolerances, compensators included.

    ``rms_waves`` (builds, fields): of the wavefront without piston and tilt. ``strehl``: |mean of exp(2πiW)|² without
    these, and beyond `SUMMED_RMS` exp(−(2π·RMS)²), nothing (Mahajan 1983). ``boresight_um``
    (builds, fields, 2): how far the image has moved. ``mtf`` (builds, fields, 2): the contrast at one frequency of
    patterns along x (sagittal) and y (tangential), NaN where none was asked for.
    """

    errors: np.ndarray
    rms_waves: np.ndarray
    strehl: np.ndarray
    boresight_um: np.ndarray
    mtf: np.ndarray


@one_blas_thread
def simulate(
    known: Differentials,
    builds: int = 10_000,
    compensators: Sequence[int] = (),
    seed: int = 0,
    frequency_per_mm: float | None = None,
    progress: Callable[[float], None] | None = None,
    cancelled: Callable[[], bool] | None = None,
) -> Builds:
    """Return ``builds`` with every error anywhere within its tolerance, all alike likely.

    Where both irregularities of a surface are tolerances, its size is drawn and its direction, which may be any.
    ``compensators``: places of the tolerances that are set, whatever their amount, so that the mean square of the
    wavefronts of all fields is least. Raises RequestError for a place that there is not, and Cancelled.
    """
    count = len(known.tolerances)
    if not all(0 <= place < count for place in compensators):
        raise RequestError(
            "compensators {places} are not among the {count} tolerances", places=tuple(compensators), count=count
        )
    rng = np.random.default_rng(seed)
    errors = _any_direction(known.tolerances, rng.uniform(-1, 1, (builds, count))) * known.amounts
    errors[:, list(compensators)] = 0.0
    return evaluate(known, errors, compensators, frequency_per_mm, progress, cancelled)


def _any_direction(tolerances: Sequence[Tolerance], drawn: np.ndarray) -> np.ndarray:
    """Return numbers from −1 to 1, (builds, errors), with those of a surface's two irregularities on a circle."""
    places = {(one.kind, one.first): place for place, one in enumerate(tolerances) if one.kind in IRREGULAR}
    found = drawn.copy()
    for (kind, surface), turned in places.items():
        upright = places.get((IRREGULAR[0], surface))
        if kind == IRREGULAR[1] and upright is not None:
            size, angle = drawn[:, upright], np.pi * drawn[:, turned]
            found[:, upright], found[:, turned] = size * np.cos(angle), size * np.sin(angle)
    return found


def evaluate(
    known: Differentials,
    errors: np.ndarray,
    compensators: Sequence[int] = (),
    frequency_per_mm: float | None = None,
    progress: Callable[[float], None] | None = None,
    cancelled: Callable[[], bool] | None = None,
) -> Builds:
    """Return the builds with these errors, (builds, errors), and with the compensators set."""
    form, errors = _Form(known, frequency_per_mm), np.array(errors, dtype=float)
    rms, strehl = (np.empty((len(errors), len(known.sources))) for _ in range(2))
    mtf = np.full((*rms.shape, 2), np.nan)
    for begin in range(0, len(errors), TOGETHER):
        if cancelled and cancelled():
            raise Cancelled("the builds were stopped before they were done")
        some = slice(begin, begin + TOGETHER)
        for _ in range(ROUNDS if compensators else 0):
            errors[some][:, list(compensators)] += form.compensated(errors[some], tuple(compensators))
        change = form.change(errors[some])
        rms[some], strehl[some] = form.quality(change)
        form.contrast(change, mtf[some])
        if progress:
            progress(min(1.0, (begin + TOGETHER) / len(errors)))
    boresight = np.einsum("be,efx->bfx", errors, known.chief_um)
    return Builds(errors, rms, strehl, boresight, mtf)


def sensitivities(
    known: Differentials, compensators: Sequence[int] = (), frequency_per_mm: float | None = None
) -> Builds:
    """Return builds with one error each, at plus and then at minus its tolerance: (2·errors) builds, and the lens last.

    That of a compensator is 0.
    """
    amounts = known.amounts
    amounts[list(compensators)] = 0.0
    alone = np.stack([np.diag(amounts), -np.diag(amounts)], axis=1).reshape(-1, amounts.size)
    return evaluate(known, np.concatenate([alone, np.zeros((1, amounts.size))]), compensators, frequency_per_mm)


class _Field:
    """The waves of one field at open rays, without the piston and the tilt that are best there.

    A build adds polynomials to those of the lens: it has ``still`` (rays,) + change (terms,) @ ``terms`` (terms, rays).
    (1, change) @ ``root`` are numbers whose squares add to the mean square.
    """

    def __init__(self, rays: OpenRays):
        self.weight = rays.weight
        rows = np.concatenate([rays.phase[None], _terms(rays.xi, rays.eta)])
        flat = np.stack([np.ones_like(rays.fx), rays.fx, rays.fy])
        weighted = flat * rays.weight
        rows = rows - np.linalg.solve(weighted @ flat.T, weighted @ rows.T).T @ flat
        self.still, self.terms = rows[0], rows[1:]
        # Not of the rays themselves times roots of their weights, since those of a mask's edges may be negative.
        values, vectors = np.linalg.eigh((rows * rays.weight) @ rows.T)
        self.root = vectors * np.sqrt(np.maximum(values, 0.0))

    def strehl(self, change: np.ndarray) -> np.ndarray:
        """Return |Σ weight·exp(2πi·waves)|² of builds, (builds,), that differ by (builds, terms)."""
        angle = 2 * np.pi * (self.still + change @ self.terms)
        strehl: np.ndarray = (np.cos(angle) @ self.weight) ** 2 + (np.sin(angle) @ self.weight) ** 2
        return strehl


class _Form:
    """The quadratic form of all fields' waves in the errors, by polynomials over the stop."""

    def __init__(self, known: Differentials, frequency_per_mm: float | None = None):
        self.fields = [_Field(rays) for rays in known.fine]
        clear = known.lens.mask.clear
        self.few = [_Field(_few_rays(known, k)) for k in range(len(self.fields))] if clear else self.fields
        one, other = np.triu_indices(len(known.tolerances))
        felt = known.second[one, other].any((1, 2))
        self.pairs = one[felt], other[felt]
        factor = np.where(self.pairs[0] == self.pairs[1], 0.5, 1.0)
        self.first, self.by_one = known.first @ _to_terms(), known.second @ _to_terms()
        self.second = self.by_one[self.pairs] * factor[:, None, None]
        self.patterns = []
        if frequency_per_mm is not None:
            for k in range(len(self.fields)):
                both = pairs_of(known, k, frequency_per_mm)
                self.patterns.append([pairs and (pairs, _differences(pairs)) for pairs in both])

    def change(self, errors: np.ndarray) -> np.ndarray:
        """Return the polynomials that errors, (builds, errors), add to every field's waves, (builds, fields, terms)."""
        products = errors[:, self.pairs[0]] * errors[:, self.pairs[1]]
        return np.tensordot(errors, self.first, 1) + np.tensordot(products, self.second, 1)

    def _rooted(self, change: np.ndarray, still: float) -> np.ndarray:
        """Return numbers whose squares add to each field's mean square, (…, fields, terms + 1).

        Of a change of the waves alone where ``still`` is 0, and of the waves where it is 1.
        """
        roots = [still * field.root[0] + change[..., k, :] @ field.root[1:] for k, field in enumerate(self.fields)]
        return np.stack(roots, axis=-2)

    def compensated(self, errors: np.ndarray, places: tuple[int, ...]) -> np.ndarray:
        """Return the step of compensators, (builds, compensators), that makes the mean square of all fields least."""
        waves = self._rooted(self.change(errors), 1.0).reshape(len(errors), -1)
        each = [self.first[place] + np.tensordot(errors, self.by_one[place], 1) for place in places]
        slopes = np.stack([self._rooted(one, 0.0).reshape(len(errors), -1) for one in each], axis=1)
        normal = slopes @ slopes.swapaxes(1, 2)
        step: np.ndarray = -np.linalg.solve(normal, (slopes @ waves[..., None]))[..., 0]
        return step

    def quality(self, change: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return RMS in waves and Strehl ratio, (builds, fields)."""
        rms = np.sqrt(np.square(self._rooted(change, 1.0)).sum(-1))
        strehl = np.exp(-((2 * np.pi * rms) ** 2))
        for k, field in enumerate(self.fields):
            near = rms[:, k] <= FEW_RAYS_RMS
            strehl[near, k] = self.few[k].strehl(change[near, k])
            far = ~near & (rms[:, k] <= SUMMED_RMS)
            strehl[far, k] = field.strehl(change[far, k])
        return rms, strehl

    def contrast(self, change: np.ndarray, found: np.ndarray) -> None:
        """Write the contrast of builds, (builds, fields, 2), where a frequency is asked for; 0 beyond the cut-off."""
        for field, both in enumerate(self.patterns):
            terms = change[:, field].astype(np.float32)
            for axis, known in enumerate(both):
                found[:, field, axis] = known[0].contrast(terms @ known[1]) if known else 0.0


def _few_rays(known: Differentials, field: int) -> OpenRays:
    """Return the rays of the differentials, which carry exp(2πiW) of a clear stop where W is small."""
    xi, eta, _ = whole_disc(*NODES)
    return OpenRays(xi, eta, known.weight[field], known.phase[field], known.fx[field], known.fy[field])


@lru_cache(maxsize=1)
def _to_terms() -> np.ndarray:
    """Return the matrix (rays, terms) from a smooth change at the rays of the differentials to its polynomials."""
    return protected(np.linalg.pinv(_terms(*whole_disc(*NODES)[:2])))


def _terms(xi: np.ndarray, eta: np.ndarray) -> np.ndarray:
    kept = np.array([m <= HARMONICS for odd in (False, True) for _, m in zernike.terms(ORDER, odd)])
    rows: np.ndarray = np.concatenate([zernike.basis(ORDER, xi, eta, odd) for odd in (False, True)])[kept]
    return rows


def _differences(pairs: Pairs) -> np.ndarray:
    """Return the difference of every polynomial at pairs of points, (terms, pairs)."""
    found: np.ndarray = (_terms(*pairs.ends[0]) - _terms(*pairs.ends[1])).astype(np.float32)
    return found
