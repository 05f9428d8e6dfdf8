"""Thousands of builds with random errors, by quadratic forms: their wavefront error, Strehl ratio and yield."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np

from p2sf.conventions import write_protect
from p2sf.disc import zernike
from p2sf.disc.quadrature import whole_disc
from p2sf.disc.tilt import without_tilt
from p2sf.errors import Cancelled, RequestError
from p2sf.threads import one_blas_thread
from p2sf.tolerance.contrast import NEAR, Pairs, at_frequency, pairs_of
from p2sf.tolerance.differentials import NODES, Differentials
from p2sf.tolerance.errors_of_build import IRREGULAR, Tolerance
from p2sf.tolerance.strehl import strehl_ratios

TOGETHER = 500  # builds at a time
FEW_RAYS_RMS = 0.15  # waves up to which the rays of the differentials resolve exp(2πiW)
SUMMED_RMS = 2.0  # waves up to which more rays resolve it
ORDER, HARMONICS = 8, 5  # of the polynomials that give the change of the wavefront at those
ROUNDS = 2  # of Gauss and Newton's method for compensators, whose effect is nearly linear


@dataclass(frozen=True, eq=False)
class Builds:
    """Random builds: ``errors`` (builds, errors) in the units of the tolerances, compensators included.

    ``rms_waves`` (builds, fields): of the displayed wavefront without piston and tilt, as in `zernike_fit`.
    ``strehl``: of the peak, as `Psf.strehl`, and 0 beyond `SUMMED_RMS`. ``boresight_um`` (builds, fields, 2): shift of
    the image. ``mtf`` (builds, fields, 2): the contrast at one frequency of patterns along x (sagittal)
    and y (tangential), NaN unless requested.
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
    """Return ``builds`` random builds with errors uniformly distributed within their tolerances.

    If both irregularities of a surface are tolerances, magnitude and direction of its irregularity are drawn.
    ``compensators``: indices of the tolerances that are adjusted, regardless of their amount, to minimise the mean
    square of the wavefronts of all fields. Raises RequestError for an index outside the tolerances, and Cancelled.
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
    """Return the builds with these errors, (builds, errors), after adjusting the compensators."""
    form, errors = QuadraticForm(known, frequency_per_mm), np.array(errors, dtype=float)
    rms, strehl = (np.empty((len(errors), len(known.sources))) for _ in range(2))
    mtf = np.full((*rms.shape, 2), np.nan)
    for begin in range(0, len(errors), TOGETHER):
        if cancelled and cancelled():
            raise Cancelled("the builds were cancelled before they were finished")
        some = slice(begin, begin + TOGETHER)
        for _ in range(ROUNDS if compensators else 0):
            errors[some][:, list(compensators)] += form.compensation(errors[some], tuple(compensators))
        change = form.phase.change(errors[some])
        rms[some], strehl[some] = form.quality(change, form.wavefront.change(errors[some]))
        stretch = np.einsum("be,efx->bfx", errors[some], known.stretch)
        form.contrast(change, stretch, mtf[some])
        if progress:
            progress(min(1.0, (begin + TOGETHER) / len(errors)))
    boresight = np.einsum("be,efx->bfx", errors, known.chief_um)
    return Builds(errors, rms, strehl, boresight, mtf)


def by_form(known: Differentials, compensators: Sequence[int] = (), frequency_per_mm: float | None = None) -> Builds:
    """Return the figures of single errors by the quadratic form, in the form of `p2sf.tolerance.sensitivities`."""
    return evaluate(known, single_errors(known, compensators), compensators, frequency_per_mm)


def single_errors(known: Differentials, compensators: Sequence[int] = ()) -> np.ndarray:
    """Return each error alone, at plus and then at minus its tolerance, and no error last: (2·errors + 1, errors).

    That of a compensator is 0.
    """
    amounts = known.amounts
    amounts[list(compensators)] = 0.0
    alone = np.stack([np.diag(amounts), -np.diag(amounts)], axis=1).reshape(-1, amounts.size)
    return np.concatenate([alone, np.zeros((1, amounts.size))])


class FieldForm:
    """The waves of one field at open rays, (rays,), without the best-fit piston and tilt.

    A build adds polynomials to those of the lens: it has ``still`` (rays,) + change (terms,) @ ``terms`` (terms, rays).
    (1, change) @ ``root`` are numbers whose squares sum to the mean square. ``axes``: the coordinates in which a tilt
    is linear.
    """

    def __init__(self, places: np.ndarray, waves: np.ndarray, weight: np.ndarray, axes: np.ndarray):
        self.weight, self.axes = weight, axes
        rows = without_tilt(np.concatenate([waves[None], _terms(*places)]), weight, axes)
        self.still, self.terms = rows[0], rows[1:]
        # Not of the rays times the roots of their weights, since weights at a mask's edges may be negative.
        values, vectors = np.linalg.eigh((rows * weight) @ rows.T)
        self.root = vectors * np.sqrt(np.maximum(values, 0.0))

    def polynomials(self, waves: np.ndarray) -> np.ndarray:
        """Return the polynomials, (terms,), of waves without piston and tilt, (rays,), minus those of the lens."""
        found: np.ndarray = (waves - self.still) @ self._inverse
        return found

    def mean_square(self, waves: np.ndarray) -> float:
        """Return the mean square of waves, (rays,)."""
        return max(float(self.weight @ waves**2), 0.0)

    @cached_property
    def _inverse(self) -> np.ndarray:
        return np.linalg.pinv(self.terms)

    def strehl(self, change: np.ndarray) -> np.ndarray:
        """Return the Strehl ratios of builds, (builds,), that differ by (builds, terms)."""
        return strehl_ratios(self.still + change @ self.terms, self.weight, self.axes)


class Expansion:
    """Contributions of errors to the waves of every field, as polynomials over the stop, to second order."""

    def __init__(self, first: np.ndarray, second: np.ndarray):
        one, other = np.triu_indices(len(first))
        felt = second[one, other].any((1, 2))
        self._pairs = one[felt], other[felt]
        factor = np.where(self._pairs[0] == self._pairs[1], 0.5, 1.0)
        self._first, self._by_one = first @ _to_terms(), second @ _to_terms()
        self._second = self._by_one[self._pairs] * factor[:, None, None]

    def change(self, errors: np.ndarray) -> np.ndarray:
        """Return the polynomials that errors, (builds, errors), add to the waves, (builds, fields, terms)."""
        products = errors[:, self._pairs[0]] * errors[:, self._pairs[1]]
        return np.tensordot(errors, self._first, 1) + np.tensordot(products, self._second, 1)

    def slope(self, errors: np.ndarray, place: int) -> np.ndarray:
        """Return the polynomials that a unit of one error adds to builds, (builds, fields, terms)."""
        slope: np.ndarray = self._first[place] + np.tensordot(errors, self._by_one[place], 1)
        return slope


class QuadraticForm:
    """The quadratic form of all fields' waves in the errors.

    ``phase`` is for the Strehl ratio and the contrast, and the displayed ``wavefront`` for the RMS.
    """

    def __init__(self, known: Differentials, frequency_per_mm: float | None = None):
        self.fields = [FieldForm(one.axes, one.phase, one.weight, one.frequencies) for one in known.fine]
        self.few = [_few_rays(known, k) for k in range(len(self.fields))] if known.lens.mask.clear else self.fields
        self.on_sphere = [FieldForm(one.axes, one.wavefront, one.share, one.axes) for one in known.fine]
        self.phase = Expansion(known.first, known.second)
        self.wavefront = Expansion(known.first_of_wavefront, known.second_of_wavefront)
        self.patterns = []
        if frequency_per_mm is not None:
            for k in range(len(self.fields)):
                asked, near = (pairs_of(known, k, by * frequency_per_mm) for by in (1.0, 1.0 - NEAR))
                both = zip(asked, near, strict=True)
                self.patterns.append([(_Pattern(a), _Pattern(b)) if a and b else None for a, b in both])

    def _root(self, change: np.ndarray, still: float) -> np.ndarray:
        """Return numbers whose squares sum to the mean square of each field, (…, fields, terms + 1).

        For the change of the wavefront alone if ``still`` is 0, for the whole wavefront if it is 1.
        """
        roots = [still * one.root[0] + change[..., k, :] @ one.root[1:] for k, one in enumerate(self.on_sphere)]
        return np.stack(roots, axis=-2)

    def compensation(self, errors: np.ndarray, places: tuple[int, ...]) -> np.ndarray:
        """Return the step of compensators, (builds, compensators), that minimises the mean square of all fields."""
        waves = self._root(self.wavefront.change(errors), 1.0).reshape(len(errors), -1)
        each = [self.wavefront.slope(errors, place) for place in places]
        slopes = np.stack([self._root(one, 0.0).reshape(len(errors), -1) for one in each], axis=1)
        normal = slopes @ slopes.swapaxes(1, 2)
        step: np.ndarray = -np.linalg.solve(normal, (slopes @ waves[..., None]))[..., 0]
        return step

    def quality(self, of_phase: np.ndarray, of_wavefront: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return RMS in waves and Strehl ratio, (builds, fields), of changes of both, (builds, fields, terms)."""
        rms = np.sqrt(np.square(self._root(of_wavefront, 1.0)).sum(-1))
        strehl = np.zeros_like(rms)
        for k, field in enumerate(self.fields):
            near = rms[:, k] <= FEW_RAYS_RMS
            strehl[near, k] = self.few[k].strehl(of_phase[near, k])
            far = ~near & (rms[:, k] <= SUMMED_RMS)
            strehl[far, k] = field.strehl(of_phase[far, k])
        return rms, strehl

    def contrast(self, change: np.ndarray, stretch: np.ndarray, found: np.ndarray) -> None:
        """Write the contrast of builds, (builds, fields, 2), if a frequency is given; 0 beyond the cut-off."""
        for field, both in enumerate(self.patterns):
            terms = change[:, field].astype(np.float32)
            for axis, known in enumerate(both):
                if known is None:
                    found[:, field, axis] = 0.0
                    continue
                contrast, near = (pattern.contrast(terms) for pattern in known)
                found[:, field, axis] = at_frequency(contrast, near, stretch[:, field, axis])


def _few_rays(known: Differentials, field: int) -> FieldForm:
    """Return the phase at the rays of the differentials, which resolve exp(2πiW) for a clear stop and small W."""
    frequencies = np.stack([known.fx[field], known.fy[field]])
    places = np.stack(whole_disc(*NODES)[:2])
    return FieldForm(places, known.phase[field], known.weight[field], frequencies)


@lru_cache(maxsize=1)
def _to_terms() -> np.ndarray:
    """Return the matrix (rays, terms) from a smooth change at the rays of the differentials to its polynomials."""
    return write_protect(np.linalg.pinv(_terms(*whole_disc(*NODES)[:2])))


def _terms(xi: np.ndarray, eta: np.ndarray) -> np.ndarray:
    kept = np.array([m <= HARMONICS for odd in (False, True) for _, m in zernike.terms(ORDER, odd)])
    rows: np.ndarray = np.concatenate([zernike.basis(ORDER, xi, eta, odd) for odd in (False, True)])[kept]
    return rows


class _Pattern:
    """Pairs of points, and the difference of every polynomial at them, (terms, pairs)."""

    def __init__(self, pairs: Pairs):
        self._pairs = pairs
        self._differences = (_terms(*pairs.ends[0]) - _terms(*pairs.ends[1])).astype(np.float32)

    def contrast(self, terms: np.ndarray) -> np.ndarray:
        """Return the contrast of builds that add polynomials, (builds, terms), to the waves."""
        return self._pairs.contrast(terms @ self._differences)
