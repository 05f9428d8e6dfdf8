"""Sensitivities by exact rays: the effect of each tolerance alone, both ways, with the compensators adjusted.

The quadratic form evaluates thousands of builds; at the limit of a large tolerance it lacks third orders, and it
ignores lost rays. Single errors are few, so their figures do not come from the form: the perturbed lens is traced, and
its compensators are adjusted anew. The difference is the error of the form.
"""

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import cached_property

import numpy as np

from p2sf.disc.tilt import without_tilt
from p2sf.errors import Cancelled, GeometryError
from p2sf.lens.lens import Lens
from p2sf.raytrace.pencil import Rays
from p2sf.threads import one_blas_thread
from p2sf.tolerance.builds import SUMMED_RMS, Builds, FieldForm, QuadraticForm, by_form
from p2sf.tolerance.criteria import Criterion, harms
from p2sf.tolerance.differentials import (
    Differentials,
    OpenRays,
    open_rays,
    through_build,
    wavefront_of,
    with_moved_sensor,
)
from p2sf.tolerance.errors_of_build import build
from p2sf.tolerance.strehl import strehl_ratios

STEP, LEAST_STEP = 0.01, 1e-5  # of a compensator, to measure its effect on exact rays
INVALID = 0.1  # of a degradation: beyond, the quadratic form does not describe an error
FINER = (32, 80), (48, 112)  # radii and directions of the rays of a wavefront that is not smooth
SMOOTH = 0.03  # of the RMS: allowed remainder after fitting the form's polynomials, if fewer rays are used
SETTLED = 1e-5  # of the RMS: allowed change from one number of rays to the next


@one_blas_thread
def sensitivities(
    known: Differentials,
    compensators: Sequence[int] = (),
    frequency_per_mm: float | None = None,
    progress: Callable[[float], None] | None = None,
    cancelled: Callable[[], bool] | None = None,
) -> Builds:
    """Return builds with one error each, at plus and then at minus its tolerance, (2·errors), and the lens last.

    Errors of compensators are 0. All figures are by exact rays; only the contrast uses the pairs of points of the
    designed lens, with exact phases. Figures are NaN if the error causes rays to be lost. Raises Cancelled.
    """
    places = tuple(compensators)
    exact = _ExactBuilds(known, places, QuadraticForm(known, frequency_per_mm))
    found = by_form(known, places, frequency_per_mm)
    last = len(found.errors) - 1
    for number in [last, *range(last)]:
        if cancelled and cancelled():
            raise Cancelled("the sensitivities were cancelled before they were known")
        if number < last and number // 2 in places:
            continue
        exact.replace(found, number)
        if progress:
            progress((number + 1) / (last + 1))
    for place in places:
        for values in (found.errors, found.rms_waves, found.strehl, found.boresight_um, found.mtf):
            values[2 * place : 2 * place + 2] = values[-1]
    return found


def form_errors(form: Builds, alone: Builds, criterion: Criterion, compensators: Sequence[int] = ()) -> np.ndarray:
    """Return the excess of the degradations by the form over the exact ones, (errors,); NaN if rays are lost.

    ``form``, ``alone``: results of `by_form` and `sensitivities` for the same compensators.
    """
    excess: np.ndarray = harms(form, criterion, compensators) - harms(alone, criterion, compensators)
    return excess


class _Opening:
    """Rays of every field through the open points of the stop, ``still`` those of the lens without errors."""

    def __init__(self, known: Differentials, fine: Sequence[OpenRays]):
        self._known, self.fine = known, fine
        self.still = self._trace_opening(np.zeros(len(known.tolerances)))[1]
        each = zip(self.still, known.sources, strict=True)
        self._on_sphere = [wavefront_of(known.lens, source, rays) for rays, source in each]

    def waves(self, errors: np.ndarray) -> list[OpenRays]:
        """Return the waves of every field of a build."""
        built, reached = self._trace_opening(errors)
        return [self._straight(k, built, rays) for k, rays in enumerate(reached)]

    def slopes(self, there: list[OpenRays], errors: np.ndarray, place: int) -> list[OpenRays]:
        """Return the change of the waves ``there`` of a build with these errors per unit of a compensator."""
        one = self._known.tolerances[place]
        step = max(STEP * one.amount, LEAST_STEP)
        if one.kind == "thickness" and one.first == len(self._known.lens.surfaces):
            built = build(self._known.lens, self._known.tolerances, errors.tolist())
            moved = [with_moved_sensor(built, waves.rays, step) for waves in there]
            more = [self._straight(k, *each) for k, each in enumerate(moved)]
        else:
            beside = errors.copy()
            beside[place] += step
            more = self.waves(beside)
        return [
            replace(a, phase=(a.phase - b.phase) / step, wavefront=(a.wavefront - b.wavefront) / step)
            for a, b in zip(more, there, strict=True)
        ]

    def _trace_opening(self, errors: np.ndarray) -> tuple[Lens, list[Rays]]:
        known = self._known
        built = build(known.lens, known.tolerances, errors.tolist()) if errors.any() else known.lens
        each = zip(known.sources, self.fine, strict=True)
        return built, [through_build(known.lens, built, source, *open_.axes) for source, open_ in each]

    def _straight(self, field: int, built: Lens, rays: Rays) -> OpenRays:
        """Return the waves of a field by its rays; those of the open rays include the mask's path."""
        open_ = self.fine[field]
        on_sphere = wavefront_of(built, self._known.sources[field], rays) - self._on_sphere[field]
        reached = replace(open_, rays=rays)
        phase = open_.phase + rays.phase - self.still[field].phase
        return replace(
            reached,
            phase=without_tilt(phase, open_.weight, reached.frequencies),
            wavefront=without_tilt(open_.wavefront + on_sphere, open_.share, open_.axes),
        )


class _ExactBuilds:
    """Figures of builds by as many exact rays as their wavefronts require."""

    def __init__(self, known: Differentials, places: tuple[int, ...], form: QuadraticForm):
        self._known, self._places, self._form = known, places, form
        self._few = _Opening(known, known.fine)

    @cached_property
    def _more(self) -> list[_Opening]:
        known = self._known
        return [_Opening(known, [open_rays(known.lens, one, counts) for one in known.sources]) for counts in FINER]

    def replace(self, found: Builds, number: int) -> None:
        """Overwrite the figures of the form by those of one build."""
        try:
            waves = self._write(found, number, self._few)
            smooth = map(_smooth, self._form.on_sphere, waves)
            for opening in () if all(smooth) else self._more:
                before = found.rms_waves[number].copy()
                self._write(found, number, opening)
                if (np.abs(found.rms_waves[number] - before) <= SETTLED * before).all():
                    break
        except GeometryError:
            for values in (found.rms_waves, found.strehl, found.boresight_um, found.mtf):
                values[number] = np.nan
            return
        if self._form.patterns:
            change = [field.polynomials(one.phase) for field, one in zip(self._form.fields, waves, strict=True)]
            stretch = np.einsum("e,efx->fx", found.errors[number], self._known.stretch)
            self._form.contrast(np.stack(change)[None], stretch[None], found.mtf[number : number + 1])

    def _write(self, found: Builds, number: int, opening: _Opening) -> list[OpenRays]:
        """Write all figures except the contrast by the rays of an opening, and return its waves."""
        waves = self._set(found.errors[number], opening)
        found.rms_waves[number], found.strehl[number] = np.transpose([_quality(one) for one in waves])
        each = zip(waves, opening.still, strict=True)
        found.boresight_um[number] = [one.rays.chief_um - still.chief_um for one, still in each]
        return waves

    def _set(self, errors: np.ndarray, opening: _Opening) -> list[OpenRays]:
        """Return the waves after adjusting the compensators in ``errors``, which are nearly adjusted already."""
        waves, places = opening.waves(errors), self._places
        if not places:
            return waves
        by_place = [opening.slopes(waves, errors, place) for place in places]
        slopes = [np.stack([one.wavefront for one in field]) for field in zip(*by_place, strict=True)]
        each = list(zip(slopes, waves, strict=True))
        normal = sum(slope * one.share @ slope.T for slope, one in each)
        step = -np.linalg.solve(normal, sum(slope @ (one.share * one.wavefront) for slope, one in each))
        errors[list(places)] += step
        of_phase = [np.stack([one.phase for one in field]) for field in zip(*by_place, strict=True)]
        return [
            replace(one, phase=one.phase + step @ phase, wavefront=one.wavefront + step @ slope)
            for one, phase, slope in zip(waves, of_phase, slopes, strict=True)
        ]


def _smooth(form: FieldForm, waves: OpenRays) -> bool:
    """Return whether the form's polynomials describe the difference of a wavefront from the lens's."""
    change = waves.wavefront - form.still
    rest = change - form.polynomials(waves.wavefront) @ form.terms
    return bool(form.mean_square(rest) <= SMOOTH**2 * form.mean_square(waves.wavefront))


def _quality(waves: OpenRays) -> tuple[float, float]:
    """Return the RMS and the Strehl ratio, as in `Builds`."""
    rms = float(np.sqrt(max(waves.share @ waves.wavefront**2, 0.0)))
    if rms > SUMMED_RMS:
        return rms, 0.0
    return rms, float(strehl_ratios(waves.phase[None], waves.weight, waves.frequencies)[0])
