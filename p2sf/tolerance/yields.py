"""The yield of a lens as it is set: what share of builds drawn at random keeps limits of its figures."""

import re
from collections.abc import Mapping
from dataclasses import dataclass, replace
from math import isfinite

import numpy as np

from p2sf.arguments import check_arguments
from p2sf.errors import RequestError
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.messages import Alternatives
from p2sf.parameters import check_between
from p2sf.tolerance.builds import Builds, by_form, simulate
from p2sf.tolerance.criteria import CRITERIA, LARGE_IS_GOOD, Criterion, harms, share_of, within_limit
from p2sf.tolerance.criteria import of_worst_field as worst_of
from p2sf.tolerance.differentials import Differentials, differentials, usual_sources
from p2sf.tolerance.errors_of_build import Grade, Tolerance, usual_tolerances
from p2sf.tolerance.files import back_focus, with_compensators

CONTRAST = re.compile(r"mtf(\d+(?:\.\d+)?)")
ALL = "all"


@dataclass(frozen=True, eq=False)
class ToleranceStudy:
    """Builds of a lens, drawn at random with the back focus set after each, against limits of their worst fields.

    Attributes
    ----------
    limits : dict
        By name, such as "strehl", "rms_waves", "boresight_um" and "mtf50", the contrast at 50 cycles per mm.
    known : Differentials
        The lens, its fields and its tolerances.
    builds : dict
        By name the builds, whose errors are the same for every limit.
    compensators : tuple of int
        Places of those errors that are set and not drawn.
    """

    limits: dict[str, float]
    known: Differentials
    builds: dict[str, Builds]
    compensators: tuple[int, ...]

    @property
    def yields(self) -> dict[str, float]:
        """Return the share of builds that keep each limit in all fields, and "all" of them."""
        return {name: share_of(kept)[0] for name, kept in self._within_limits.items()}

    @property
    def errors(self) -> dict[str, float]:
        """Return one standard error of each yield."""
        return {name: share_of(kept)[1] for name, kept in self._within_limits.items()}

    @property
    def values(self) -> dict[str, np.ndarray]:
        """Return each limited figure in the worst field of every build, (builds,)."""
        return {name: worst_of(found, _criterion(name)[0]) for name, found in self.builds.items()}

    def harms(self, name: str) -> list[tuple[Tolerance, float]]:
        """Return by how much each tolerance, alone and at its limit, makes a figure worse, the most harmful first."""
        criterion, frequency = _criterion(name)
        found = harms(by_form(self.known, self.compensators, frequency), criterion, self.compensators)
        pairs = list(zip(self.known.tolerances, found.tolist(), strict=True))
        return sorted(pairs, key=lambda pair: -pair[1])

    @property
    def _within_limits(self) -> dict[str, np.ndarray]:
        worst = self.values
        kept = {name: within_limit(worst[name], _criterion(name)[0], limit) for name, limit in self.limits.items()}
        return kept | {ALL: np.logical_and.reduce(list(kept.values()))}

    def __repr__(self) -> str:
        shares = ", ".join(f"{name} {100 * share:.3g} %" for name, share in self.yields.items())
        return f"<ToleranceStudy of {self.known.lens.name}: {shares}>"


@check_arguments
def tolerances(
    lens: Lens,
    source: Source,
    limits: Mapping[str, float],
    *,
    grade: Grade = "precision",
    builds: int = 10_000,
    seed: int = 0,
) -> ToleranceStudy:
    """Draw lenses with the usual errors of a grade, set the back focus of each, and tell which keep limits.

    Parameters
    ----------
    lens : Lens
        The lens as it is set.
    source : Source
        Its depth and wavelength; the fields are the axis, seven tenths and the edge of the lens's own.
    limits : dict
        The least "strehl" and "mtf50" (the contrast at 50 cycles per mm, and so at others), the most "rms_waves" and
        "boresight_um", in the worst field.
    grade : {"commercial", "precision", "high"}
        Which tolerances, see ``p2sf tolerance --help``.
    builds : int
        How many lenses.
    seed : int
        Another one draws other lenses.

    Returns
    -------
    ToleranceStudy
        ``.yields`` by name, and ``.errors`` of these.

    Raises
    ------
    RequestError
        For limits that are none.
    GeometryError
        Where a ray does not reach the sensor, also of a lens with one of the errors.
    """
    _check_limits(limits)
    listed, places = with_compensators(usual_tolerances(lens, grade), (back_focus(lens),))
    known = differentials(lens, usual_sources(lens, replace(source, field_slope=0.0, azimuth_deg=0.0)), listed)
    drawn = {name: simulate(known, builds, places, seed, _criterion(name)[1]) for name in limits}
    return ToleranceStudy(dict(limits), known, drawn, places)


def _criterion(name: str) -> tuple[Criterion, float | None]:
    """Return the criterion of a limit, and the frequency of a contrast. Raises RequestError."""
    contrast = CONTRAST.fullmatch(name)
    if contrast and float(contrast[1]) > 0:
        return "mtf", float(contrast[1])
    found = next((each for each in CRITERIA if each == name and each != "mtf"), None)
    if found is None:
        raise RequestError(
            '{parameter} is "{value}"; choose {choices}',
            parameter="limits",
            value=name,
            choices=Alternatives((*(each for each in CRITERIA if each != "mtf"), "mtf50")),
        )
    return found, None


def _check_limits(limits: Mapping[str, float]) -> None:
    if not isinstance(limits, Mapping):
        raise RequestError(
            "{parameter} is {value}; give the least or the most of figures by name, such as {example}; tolerances are "
            "those of a grade",
            parameter="limits",
            value=f"{limits!r:.60}",
            example='{"strehl": 0.8}',
        )
    if not limits:
        raise RequestError("{parameter} has no number; give one or more", parameter="limits")
    for name, limit in limits.items():
        most = 1.0 if _criterion(name)[0] in LARGE_IS_GOOD else float("inf")
        check_between(name, limit if isfinite(limit) else float("nan"), 0.0, most)
