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
from p2sf.tolerance.differentials import FINE, NODES, Differentials
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
        waves = form.waves(errors[some])
        for _ in range(ROUNDS if compensators else 0):
            waves, change = form.compensated(waves, errors[some], tuple(compensators))
            errors[some][:, list(compensators)] += change
        rms[some], strehl[some] = form.quality(waves)
        form.contrast(waves, mtf[some])
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


class _Form:
    """The quadratic form of all fields' waves, with what piston and tilt take out of them."""

    def __init__(self, known: Differentials, frequency_per_mm: float | None = None):
        self.shape = known.phase.shape
        self.frequency_per_mm = frequency_per_mm
        count = len(known.tolerances)
        one, other = np.triu_indices(count)
        felt = known.second[one, other].any((1, 2))
        self.pairs = one[felt], other[felt]
        factor = np.where(self.pairs[0] == self.pairs[1], 0.5, 1.0)
        root = np.sqrt(known.weight)
        self.out = [_orthonormal(root[k], known.fx[k], known.fy[k]) for k in range(self.shape[0])]
        self.root = root.ravel()
        # Scaled by the root of each ray's light, sums of squares are mean squares; piston and tilt are taken out once.
        self.still = self._projected(known.phase[None])[0]
        self.first = self._projected(known.first)
        self.second = self._projected(known.second[self.pairs] * factor[:, None, None])
        self.by_one = known.second
        self.finer = _continued(*whole_disc(*FINE)[:2])
        self.fine_light, phase, fx, fy = known.fine
        self.fine_still = np.stack([self._fine(known, k, phase[k], fx[k], fy[k]) for k in range(self.shape[0])])

        self.pairs_of_field = [
            (None, None) if frequency_per_mm is None else pairs_of(known, k, frequency_per_mm)
            for k in range(self.shape[0])
        ]
        self.to_pairs = [[pairs and _differences(pairs) for pairs in both] for both in self.pairs_of_field]

    @staticmethod
    def _fine(known: Differentials, field: int, phase: np.ndarray, fx: np.ndarray, fy: np.ndarray) -> np.ndarray:
        """Return the waves of the lens at many rays less the piston and tilt that the fewer rays of a field have."""
        root = np.sqrt(known.weight[field])
        terms = np.stack([root, root * known.fx[field], root * known.fy[field]], axis=1)
        piston, across, along = np.linalg.lstsq(terms, root * known.phase[field], rcond=None)[0]
        left: np.ndarray = phase - piston - across * fx - along * fy
        return left

    def _projected(self, waves: np.ndarray) -> np.ndarray:
        """Return waves (…, fields, rays) times the roots of the light, without piston and tilt, (…, fields·rays)."""
        scaled = waves * self.root.reshape(self.shape)
        for field, out in enumerate(self.out):
            scaled[:, field] -= (scaled[:, field] @ out) @ out.T
        flat: np.ndarray = scaled.reshape(len(waves), self.root.size)
        return flat

    def waves(self, errors: np.ndarray) -> np.ndarray:
        """Return the scaled waves of builds, (builds, fields·rays)."""
        products = errors[:, self.pairs[0]] * errors[:, self.pairs[1]]
        waves: np.ndarray = self.still + errors @ self.first + products @ self.second
        return waves

    def compensated(
        self, waves: np.ndarray, errors: np.ndarray, places: tuple[int, ...]
    ) -> tuple[np.ndarray, np.ndarray]:
        """Return the waves after a step that makes their mean square least, and the step, (builds, compensators)."""
        slopes = np.stack([self.first[place] + errors @ self._slope(place) for place in places], axis=1)
        normal = slopes @ slopes.swapaxes(1, 2)
        step = -np.linalg.solve(normal, (slopes @ waves[..., None]))[..., 0]
        moved = errors.copy()
        moved[:, list(places)] += step
        return self.waves(moved), step

    def _slope(self, place: int) -> np.ndarray:
        return self._projected(self.by_one[place].copy())

    def quality(self, waves: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return RMS in waves and Strehl ratio, (builds, fields)."""
        by_field = waves.reshape(-1, *self.shape)
        rms = np.sqrt((by_field * by_field).sum(-1))
        root, strehl = self.root.reshape(self.shape), np.exp(-((2 * np.pi * rms) ** 2))
        for field, light in enumerate(root * root):
            near = rms[:, field] <= FEW_RAYS_RMS
            strehl[near, field] = _strehl(by_field[near, field] / root[field], light)
            far = ~near & (rms[:, field] <= SUMMED_RMS)
            change = self._change(waves[far], field)
            strehl[far, field] = _strehl(self.fine_still[field] + change @ self.finer, self.fine_light[field])
        return rms, strehl

    def _change(self, waves: np.ndarray, field: int) -> np.ndarray:
        """Return what scaled waves of builds add to a field's, (builds, rays)."""
        added = (waves - self.still).reshape(-1, *self.shape)[:, field]
        change: np.ndarray = added / self.root.reshape(self.shape)[field]
        return change

    def contrast(self, waves: np.ndarray, found: np.ndarray) -> None:
        """Write the contrast of builds, (builds, fields, 2), where a frequency is asked for; 0 beyond the cut-off."""
        if self.frequency_per_mm is None:
            return
        for field, both in enumerate(self.pairs_of_field):
            terms = (self._change(waves, field) @ _to_terms()).astype(np.float32)
            for axis, pairs in enumerate(both):
                found[:, field, axis] = pairs.contrast(terms @ self.to_pairs[field][axis]) if pairs else 0.0


def _strehl(waves: np.ndarray, light: np.ndarray) -> np.ndarray:
    """Return |Σ light·exp(2πi·waves)|² over the last axis."""
    angle = 2 * np.pi * waves
    strehl: np.ndarray = (np.cos(angle) @ light) ** 2 + (np.sin(angle) @ light) ** 2
    return strehl


@lru_cache(maxsize=1)
def _to_terms() -> np.ndarray:
    """Return the matrix (rays, terms) from a smooth change at the few rays to its polynomials."""
    return protected(np.linalg.pinv(_terms(*whole_disc(*NODES)[:2])))


def _terms(xi: np.ndarray, eta: np.ndarray) -> np.ndarray:
    kept = np.array([m <= HARMONICS for odd in (False, True) for _, m in zernike.terms(ORDER, odd)])
    rows: np.ndarray = np.concatenate([zernike.basis(ORDER, xi, eta, odd) for odd in (False, True)])[kept]
    return rows


def _continued(xi: np.ndarray, eta: np.ndarray) -> np.ndarray:
    """Return the matrix (rays, points) that continues a smooth change from the few rays to any points."""
    matrix: np.ndarray = _to_terms() @ _terms(xi, eta)
    return matrix


def _differences(pairs: Pairs) -> np.ndarray:
    """Return the difference of every polynomial at pairs of points, (terms, pairs)."""
    found: np.ndarray = (_terms(*pairs.ends[0]) - _terms(*pairs.ends[1])).astype(np.float32)
    return found


def _orthonormal(root: np.ndarray, fx: np.ndarray, fy: np.ndarray) -> np.ndarray:
    """Return an orthonormal basis of piston and tilts, (rays, 3), where rays are scaled by the root of the light."""
    basis: np.ndarray = np.linalg.qr(np.stack([root, root * fx, root * fy], axis=1))[0]
    return basis
