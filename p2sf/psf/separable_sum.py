"""Pupil nodes in rows of equal spatial frequency fy, over which the sum of plane waves separates into small products.

A fit gives fy(ξ, η). Row j passes through the rim point (sin φ_j, cos φ_j), φ_j = jπ/(n + 1), and its nodes follow the
curve fy(ξ, η) = fy_j, with ξ at Gauss–Legendre fractions of sin φ_j. Then

    (1/π)∫∫ F dξ dη = (1/π)∫ |dfy/dφ| dφ ∫ F/|∂fy/∂η| dξ,

exact for any smooth fy that rises along the rim: the trapezoid in φ is Gauss–Chebyshev quadrature, so the edge of
the pupil does not slow the convergence, and since a row shares fy the kernel in y acts once per row, not per node.
"""

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from numpy.polynomial.legendre import legvander
from numpy.typing import DTypeLike

from p2sf.conventions import protected
from p2sf.errors import SamplingError
from p2sf.messages import Message
from p2sf.psf.plane_waves import pupil_amplitude
from p2sf.pupil.outline_rows import outline_points
from p2sf.pupil.phasors import cosine_sine
from p2sf.pupil.quadrature import chords_for, even_count, gauss_legendre
from p2sf.pupil.zernike import columns as power_columns
from p2sf.pupil.zernike import evaluate, evaluate_in_eta, in_square
from p2sf.raytrace.fit import FittedPencil

MOST_NODES = 2**26  # some ten seconds of work
IN_MEMORY = 2**21  # nodes at all columns at a time: some 100 MB
PREVIEW = 0.85  # of the settled counts: 1 − R² against the settled sum is below 1e-5 on every stored row
NEWTON_STEPS = 8
ONE_SIDED = 4  # columns more than half as many, where a row ends in the middle
MORE_NODES = 10  # than the order of a fit's phase: polynomials of twice as high an order along each row
STRIDE = 4  # of the cosines that are computed; the others follow from them
NODES_AT_ONCE = 8192  # so many that their cosines stay in the cache
SETTLED = 1e-5  # a last step this small leaves its square, 1e-10 of the pupil: 1e-8 waves at a slope of 100


@dataclass(frozen=True)
class FrequencyRows:
    """Nodes on ξ > 0, with weights that count the mirror images too: ``fy`` (rows,), the rest (rows, nodes).

    The weights are areas times the light of unit area there, and sum to 1; ``light`` is the mean of that light.
    The sum takes ``columns`` columns, those at ξ < 0 included. Functions along a row are smooth and even in ξ, so
    where a row has fewer nodes the polynomial through them gives the values at the other columns. The columns of rows
    that are ``one_sided``, whose weights count no mirror images, integrate odd functions of ξ too.
    """

    fy: np.ndarray
    xi: np.ndarray
    eta: np.ndarray
    weight: np.ndarray
    columns: int
    light: float = 1.0
    one_sided: bool = False

    def lit(self, light: np.ndarray) -> "FrequencyRows":
        """Return the same nodes with weights times ``light``, (rows, nodes), again of unit sum."""
        weight = self.weight * light
        mean = float(weight.sum() / self.weight.sum())
        return replace(self, weight=weight / mean, light=self.light * mean)

    @property
    def words(self) -> Message:
        """Return how many rows and columns there are, the mirror half counted."""
        return Message(
            "{rows} rows × {columns} columns of equal frequency", rows=self.xi.shape[0], columns=self.columns
        )

    def intensity(
        self, phase: np.ndarray, fx: np.ndarray, pixels: int, pixel_um: float, dtype: DTypeLike = np.float64
    ) -> np.ndarray:
        """Return the intensity (y, x) of phases in waves and fx in cycles/µm, (rows, nodes), on a centred grid."""
        return mirrored_intensity(self.field(phase, fx, pixels, pixel_um, dtype), pixels)

    def field(
        self, phase: np.ndarray, fx: np.ndarray, pixels: int, pixel_um: float, dtype: DTypeLike = np.float64
    ) -> np.ndarray:
        """Return the field at x ≥ 0, (pixels, pixels//2 + 1): that at −x is the same."""
        together = max(1, IN_MEMORY // self.columns)
        field = np.zeros((pixels, pixels // 2 + 1), np.result_type(dtype, np.complex64))
        for first in range(0, len(self.fy), together):
            some = slice(first, first + together)
            part = FrequencyRows(self.fy[some], self.xi[some], self.eta[some], self.weight[some], self.columns)
            weight, waves, cycles = part._on_columns(phase[some], fx[some])
            field += sum_rows(pupil_amplitude(weight, waves, dtype), cycles, part.fy, pixels, pixel_um)
        return field

    def both_sides(self, even: np.ndarray, odd: np.ndarray, fx: np.ndarray, pixels: int, pixel_um: float) -> np.ndarray:
        """Return the field (y, x) of a pupil that is not even in ξ: half the sum and half the difference at ±ξ.

        ``even`` and ``odd``: weighted amplitudes at the columns, complex, each (rows, columns/2).
        """
        half, together = pixels // 2, max(1, IN_MEMORY // self.columns)
        sides = np.zeros((2, pixels, half + 1), even.dtype)
        for first in range(0, len(self.fy), together):
            some = slice(first, first + together)
            angle = 2 * np.pi * pixel_um * fx[some]
            for side, parts in zip(sides, sum_both_sides(even[some], odd[some], angle, half + 1), strict=True):
                side += sum_up(parts, self.fy[some], pixels, pixel_um)
        return side_by_side(sides, pixels)

    def with_every_column(self, phase: np.ndarray, fx: np.ndarray) -> "tuple[FrequencyRows, np.ndarray, np.ndarray]":
        """Return the same rows with a node at each column, and phases and fx there."""
        few = self.xi.shape[1]
        if few == _columns(self.columns, self.one_sided)[0].size:
            return self, phase, fx
        weight, waves, cycles = self._on_columns(phase, fx)
        place, wanted = _half_legendre(2 * few)[0], _columns(self.columns, self.one_sided)[0]
        xi, eta = self.xi[:, :1] / place[0] * wanted, self.eta @ _refining(few, self.columns, self.one_sided)
        return replace(self, xi=xi, eta=eta, weight=weight), waves, cycles

    def _on_columns(self, phase: np.ndarray, fx: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return weights, phases and fx at all columns, (rows, columns/2), from those at the nodes."""
        few, (wanted, wanted_share) = self.xi.shape[1], _columns(self.columns, self.one_sided)
        if few == wanted.size:
            return self.weight, phase, fx
        place, share = _half_legendre(2 * few)
        refine = _refining(few, self.columns, self.one_sided)
        weight = (self.weight / share) @ refine
        return weight * wanted_share, phase @ refine, (fx / place) @ refine * wanted


def mirrored_intensity(field: np.ndarray, pixels: int) -> np.ndarray:
    """Return |field|² on a centred grid, (pixels, pixels), from the field at x ≥ 0."""
    intensity: np.ndarray = field.real**2 + field.imag**2
    return intensity[:, np.abs(np.arange(pixels) - pixels // 2)]


def side_by_side(sides: np.ndarray, pixels: int) -> np.ndarray:
    """Return the field on a centred grid, (pixels, pixels), from both at x ≥ 0 and at −x, (2, pixels, count)."""
    half = pixels // 2
    return np.concatenate([sides[1][:, half:0:-1], sides[0][:, : pixels - half]], axis=1)


def rows_for(
    found: FittedPencil, pixels: int, pixel_um: float, quality: str, every: bool = False
) -> FrequencyRows | None:
    """Return rows that carry the phase of a fit over a window; a preview takes PREVIEW of the settled counts.

    ``every``: put a node at each column, for weights that are not smooth along a row.
    None where the pupil map is too curved for rows. Raises SamplingError where too many nodes would be needed.
    """
    rows, columns = row_counts(found, pixels, pixel_um, quality)
    if rows * columns > MOST_NODES:
        raise too_many(rows, columns, pixels, pixel_um)
    return frequency_rows(found, rows, columns, None if every else enough_nodes(found, columns))


def enough_nodes(found: FittedPencil, columns: int) -> int | None:
    """Return how many nodes of a row say what its columns carry; None where that is no fewer."""
    enough = found.level.wave_order + MORE_NODES
    return None if 2 * enough >= columns else enough


def too_many(rows: int, columns: int, pixels: int, pixel_um: float) -> SamplingError:
    """Return the error that refuses a sum of so many pupil samples."""
    return SamplingError(
        "this blur over {pixels} pixels of {pixel_um:g} µm needs {rows} × {columns} pupil samples; bring the "
        "sensor nearer to the image, stop down, or show a smaller window",
        pixels=pixels,
        pixel_um=pixel_um,
        rows=rows,
        columns=columns,
    )


def row_counts(found: FittedPencil, pixels: int, pixel_um: float, quality: str) -> tuple[int, int]:
    """Return how many rows and columns carry the phase of a fit over a window."""
    steep = found.steepness
    reach = steep.spread * pixel_um * (pixels // 2)
    share = 1.0 if quality == "settled" else PREVIEW
    rows, columns = (even_count(share * count) for count in chords_for(steep.along, steep.across, reach))
    return rows, columns


def frequency_rows(found: FittedPencil, rows: int, columns: int, nodes: int | None = None) -> FrequencyRows | None:
    """Return the nodes of a fit, or None where fy does not rise steadily along the rim and across the disc.

    ``nodes``: how many of a row are solved for, from which the columns follow; by default one at each column.
    """
    sine, cosine, xi, share = _rim(rows, 2 * nodes if nodes else columns)
    form = power_columns(found.fy, found.level.map_order)
    fy, rise = _along_rim(form, sine[:, 0], cosine[:, 0])
    if not rise.min() * rise.max() > 0:
        return None
    return _followed(found, form, fy, xi, cosine, share * -rise[:, None], columns)


def _followed(
    found: FittedPencil,
    form: list[list[float]],
    fy: np.ndarray,
    xi: np.ndarray,
    edge: np.ndarray,
    share: np.ndarray,
    columns: int,
) -> FrequencyRows | None:
    """Return rows at these ξ, from where η is ``edge``, (rows, 1), along curves of equal fy; None where they bend back.

    ``form``: fy as a polynomial (`zernike.columns`); ``share``: the weights times ∂fy/∂η.
    """
    parts = [in_square(column, xi * xi) for column in form]
    slopes = [b * part for b, part in enumerate(parts)][1:]
    eta = np.repeat(edge, xi.shape[1], axis=1)
    for _ in range(NEWTON_STEPS):
        slope = evaluate_in_eta(slopes, eta)
        step = evaluate_in_eta(parts, eta)
        step -= fy[:, None]
        step /= slope
        eta -= step
        if np.abs(step).max() < SETTLED:
            break
    else:
        return None
    if not slope.min() * slope.max() > 0:
        return None
    rows = FrequencyRows(fy, xi, eta, share / slope, columns)
    return rows.lit(found.weight_at(xi, eta)) if found.level.weighted else rows


def iris_rows(found: FittedPencil, rows: int, columns: int) -> tuple[FrequencyRows, float, np.ndarray | None] | None:
    """Return rows of the mask's iris, with weights of unit sum, and its share of the disc's area; None as above.

    Each goes from ξ = 0 to a point of the outline. By Green's theorem ∫∫F dξ dfy = −∮Φ dfy with Φ = ∫F dξ from 0 to
    the outline, taken clockwise; whether fy rises along an edge or falls does not matter. Rows of an iris that is not
    even in ξ are one-sided; of those the third result says which side they are on, 1 or −1.
    """
    sided, outline = not found.mask.even, outline_points(found.mask, rows)
    form = power_columns(found.fy, found.level.map_order)
    fy, (across, along) = _with_slopes(form, outline.xi, outline.eta)
    rise = across * outline.step_xi + along * outline.step_eta
    few = enough_nodes(found, columns)
    place, weight = _half_legendre(2 * few) if few else _columns(columns, sided)
    share = -(rise * outline.xi)[:, None] * (weight * ((1 if sided else 2) / np.pi))
    xi = np.abs(outline.xi)[:, None] * place
    made = _followed(found, form, fy, xi, outline.eta[:, None], share, columns)
    if made is None:
        return None
    area = float(made.weight.sum())
    unit = replace(made, weight=made.weight / area, one_sided=sided)
    return unit, area, np.sign(outline.xi) if sided else None


def _along_rim(form: list[list[float]], sine: np.ndarray, cosine: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return fy at the rim points (sin φ, cos φ) and dfy/dφ there."""
    fy, (across, along) = _with_slopes(form, sine, cosine)
    return fy, cosine * across - sine * along


def _with_slopes(
    form: list[list[float]], xi: np.ndarray, eta: np.ndarray
) -> tuple[np.ndarray, tuple[np.ndarray, np.ndarray]]:
    """Return Σ c[b][a]·ξ²ᵃ·ηᵇ at pupil points, with ∂/∂ξ and ∂/∂η."""
    square = xi * xi
    by_square = [[a * c for a, c in enumerate(column)][1:] or [0.0] for column in form]
    by_eta = [[b * c for c in column] for b, column in enumerate(form)][1:]
    slopes = 2 * xi * evaluate(by_square, square, eta), evaluate(by_eta, square, eta)
    return evaluate(form, square, eta), slopes


@lru_cache(maxsize=16)
def _rim(rows: int, columns: int) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Return sin φ and cos φ (rows, 1), ξ and the constant part of the weights (rows, columns/2)."""
    angle = (np.arange(1, rows + 1) * (np.pi / (rows + 1)))[:, None]
    fraction, weight = _half_legendre(columns)
    sine = np.sin(angle)
    return sine, np.cos(angle), sine * fraction, 2 / (rows + 1) * sine * weight


def _half_legendre(columns: int) -> tuple[np.ndarray, np.ndarray]:
    """Return Gauss–Legendre nodes on (0, 1) and their weights, (columns/2,)."""
    node, weight = gauss_legendre(columns)
    return node[columns // 2 :], weight[columns // 2 :]


@lru_cache(maxsize=32)
def _columns(columns: int, one_sided: bool) -> tuple[np.ndarray, np.ndarray]:
    """Return where the columns at ξ > 0 lie on (0, 1) and their weights: of the even rule, or of one of its own."""
    if not one_sided:
        return _half_legendre(columns)
    node, weight = gauss_legendre(columns // 2 + ONE_SIDED)
    return protected((1 + node) / 2), protected(weight / 2)


@lru_cache(maxsize=32)
def _refining(few: int, columns: int, one_sided: bool = False) -> np.ndarray:
    """Return the matrix (few, columns/2) that takes an even function from a rule's nodes to those of a finer one.

    f = Σ (2n + 1)/2·⟨f, Pₙ⟩·Pₙ over even n, which the rule of 2·few nodes integrates exactly (A&S 22.2.10).
    """
    (place, share), (wanted, _) = _half_legendre(2 * few), _columns(columns, one_sided)
    here, there = (legvander(x, 2 * few - 2)[:, ::2] for x in (place, wanted))
    return protected((here * share[:, None] * np.arange(1, 4 * few, 4)) @ there.T)


def sum_rows(amplitude: np.ndarray, fx: np.ndarray, fy: np.ndarray, pixels: int, pixel_um: float) -> np.ndarray:
    """Return the field Σ amplitude·cos(2π fx·x)·exp(2πi fy·y) over (rows, columns), shape (pixels, pixels//2 + 1).

    y as of a centred grid; x = 0, 1 … samples either side of the middle, which are alike. Precision follows
    ``amplitude``. The sum goes along the rows first, then across them, where the parts even and odd in y give ±y.
    """
    return sum_up(sum_across(amplitude, 2 * np.pi * pixel_um * fx, pixels // 2 + 1), fy, pixels, pixel_um)


def sum_up(parts: np.ndarray, fy: np.ndarray, pixels: int, pixel_um: float) -> np.ndarray:
    """Return Σ parts·exp(2πi fy·y) over the rows, (pixels, count), of their sums (rows, 2, count), re and im."""
    half, count = pixels // 2, parts.shape[-1]
    tables = cosine_sine(np.outer(pixel_um * np.arange(half + 1), fy), parts.dtype)
    even, odd = ((table @ parts.reshape(len(fy), -1)).reshape(-1, 2, count) for table in tables)
    field = np.empty((pixels, count), np.result_type(parts.dtype, np.complex64))
    most, above, below = pixels - half, field[half:], field[:half][::-1]
    np.subtract(even[:most, 0], odd[:most, 1], out=above.real)
    np.add(even[:most, 1], odd[:most, 0], out=above.imag)
    np.add(even[1:, 0], odd[1:, 1], out=below.real)
    np.subtract(even[1:, 1], odd[1:, 0], out=below.imag)
    return field


def sum_across(amplitude: np.ndarray, angle: np.ndarray, count: int) -> np.ndarray:
    """Return S_m = Σ amplitude·cos(m·angle) over each row's columns, m = 0 … count − 1: (rows, 2, count), re and im.

    All follow (`_unfolding`) from the sums Q of amplitude·cos(rθ), r = 0 … 3, with every fourth cosine, which saves
    three quarters of the cosines and of the products.
    """
    sums = _sums_with_some(np.stack([amplitude.real, amplitude.imag]), _reduced(angle, amplitude.real.dtype), count)
    return _unfolded(sums, _unfolding(count, sums.dtype))


def sum_both_sides(even: np.ndarray, odd: np.ndarray, angle: np.ndarray, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Return Σ even·cos(m·angle) ± i·Σ odd·sin(m·angle) over each row's columns: (rows, 2, count) each, re and im.

    The sines follow from sums of odd·sin θ with the same cosines (`_unfolding_sines`).
    """
    angle = _reduced(angle, even.real.dtype)
    sine = np.sin(angle)
    sums = _sums_with_some(np.stack([even.real, even.imag, odd.real * sine, odd.imag * sine]), angle, count)
    cosines = _unfolded(sums[:, :2], _unfolding(count, sums.dtype))
    sines = _unfolded(sums[:, 2:], _unfolding_sines(count, sums.dtype))
    turned = np.stack([-sines[:, 1], sines[:, 0]], axis=1)  # times i
    return cosines + turned, cosines - turned


def _reduced(angle: np.ndarray, dtype: np.dtype) -> np.ndarray:
    """Return angles in a precision, less whole turns where that would lose digits of them."""
    return (angle - 2 * np.pi * np.rint(angle / (2 * np.pi))).astype(dtype) if dtype == np.float32 else angle


def _sums_with_some(parts: np.ndarray, angle: np.ndarray, count: int) -> np.ndarray:
    """Return Q_{r,k} = Σ part·cos(rθ)·cos(4kθ) over each row's columns, (rows, parts, those of all r and k).

    ``parts``: (parts, rows, columns); r = 0 … 3, and as many k as give ``count`` cosines.
    """
    number, parts = len(parts), parts[:, None]
    (rows, columns), steps = angle.shape, -(-count // STRIDE)
    sums = np.empty((rows, number * STRIDE, steps), parts.dtype)
    size = max(1, NODES_AT_ONCE // columns)
    for start in range(0, rows, size):
        some = slice(start, start + size)
        near, far = _cosines(angle[some], steps)
        weighted = (parts[:, :, some] * near).reshape(number * STRIDE, -1, columns)
        np.matmul(weighted.swapaxes(0, 1), np.moveaxis(far, 0, -1), out=sums[some])  # both are views
    return sums.reshape(rows, number, STRIDE * steps)


def _unfolded(sums: np.ndarray, matrix: np.ndarray) -> np.ndarray:
    """Return ``sums`` @ ``matrix`` as one product of matrices, where numpy would make one for each row."""
    unfolded: np.ndarray = sums.reshape(-1, len(matrix)) @ matrix
    return unfolded.reshape(*sums.shape[:2], -1)


@lru_cache(maxsize=16)
def _unfolding(count: int, dtype: np.dtype) -> np.ndarray:
    """Return the matrix that gives S_m, m in the last axis, from Q_{r,k}: S_{4k + r} = 2Q_{r,k} − S_{4(k − 1) + 4 − r}.

    This is 2cos(rθ)cos(4kθ) = cos((4k + r)θ) + cos((4k − r)θ); where r or k is 0, S is Q itself.
    """
    steps = -(-count // STRIDE)
    sums = np.eye(STRIDE * steps).reshape(STRIDE, steps, -1)
    sums[1:, 1:] *= 2
    for k in range(1, steps):
        sums[1:, k] -= sums[:0:-1, k - 1]
    return protected(np.ascontiguousarray(sums.transpose(2, 1, 0).reshape(STRIDE * steps, -1)[:, :count], dtype))


@lru_cache(maxsize=16)
def _unfolding_sines(count: int, dtype: np.dtype) -> np.ndarray:
    """Return the matrix that gives Σ part·sin(mθ) as `_unfolding` does, where the parts of Q have the factor sin θ.

    This is sin((m + 1)θ) = 2 sin θ·cos(mθ) + sin((m − 1)θ).
    """
    cosines = _unfolding(count, np.dtype(float))
    sines = np.zeros_like(cosines)
    sines[:, 1:2] = cosines[:, :1]
    for m in range(2, count):
        sines[:, m] = 2 * cosines[:, m - 1] + sines[:, m - 2]
    return protected(sines.astype(dtype))


def _cosines(angle: np.ndarray, steps: int) -> tuple[np.ndarray, np.ndarray]:
    """Return cos(rθ), r = 0 … 3, and cos(4kθ), k = 0 … steps − 1, each (number, rows, columns).

    A cosine is cheap in float32 and expensive in float64, where Chebyshev's recurrence replaces it.
    """
    near = chebyshev(np.cos(angle), STRIDE)
    if angle.dtype == np.float32:
        far = np.arange(0, STRIDE * steps, STRIDE, dtype=angle.dtype)[:, None, None] * angle
        return near, np.cos(far, out=far)
    return near, chebyshev(2 * near[2] ** 2 - 1, steps)


def chebyshev(cosine: np.ndarray, count: int) -> np.ndarray:
    """Return cos(mθ) from cos θ, m = 0 … count − 1 on the first axis; errors grow with m²."""
    out = np.ones((count, *cosine.shape), cosine.dtype)
    out[1:2] = cosine
    twice = 2 * cosine
    for m in range(2, count):
        np.multiply(twice, out[m - 1], out=out[m])
        out[m] -= out[m - 2]
    return out
