"""Accuracy of the PSFs of a database against exact rays: the predicted 1 − R² over its space.

The errors measured by a build are only those of interpolation; exactly interpolated coefficients may still be a poor
description.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import product
from math import inf, isinf
from typing import Any

import numpy as np

from p2sf.conventions import NM_PER_UM, degrees_from_slope
from p2sf.database.build import build_database
from p2sf.database.departure import scatter
from p2sf.database.fitted import FittedDatabase
from p2sf.database.fitted_build import build_fitted
from p2sf.database.render import Database
from p2sf.database.space import Space
from p2sf.errors import DatabaseError, GeometryError, RequestError
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.messages import Alternatives, Message, ParameterName
from p2sf.paraxial.pupils import Stop
from p2sf.paraxial.seidel import reason_against_coefficients
from p2sf.psf.methods import AUTO, FITTED, SEIDEL, by_six
from p2sf.psf.prediction import ALLOWED, USELESS, predicted_error, seidel_error
from p2sf.pupil.fit import behind_mask, trace_check_rays
from p2sf.pupil.seen_mask import mask_seen
from p2sf.threads import one_blas_thread

METHODS = (AUTO, SEIDEL.name, FITTED.name)
POINTS = 32  # between the corners of a space
EXACT = "exact"  # the default interpolant


@dataclass(frozen=True)
class DatabaseAccuracy:
    """The predicted 1 − R² of a database's PSFs: the median over its space, the largest, and its position.

    An infinite value means that rays are lost, which no database represents. ``field_x_deg`` is 0 except over a
    rectangle.
    """

    median: float
    worst: float
    depth_mm: float
    field_deg: float
    field_x_deg: float
    wavelength_nm: float
    method: str

    @property
    def record(self) -> dict[str, float]:
        """Return the entry for a file: the figures and the position of the worst one."""
        across = {"field_x_deg": self.field_x_deg} if self.field_x_deg else {}
        place = {"depth_mm": self.depth_mm, "field_deg": self.field_deg, **across, "wavelength_nm": self.wavelength_nm}
        return {"median": self.median, "worst": self.worst, **place}

    @property
    def where(self) -> Message:
        """Return the position of the worst one."""
        return where(self.depth_mm, self.field_deg, self.wavelength_nm)

    @property
    def usual(self) -> Message:
        """Return what is to be expected in the middle of the space."""
        if self.median >= USELESS:
            return Message("and so in half of its space")
        return Message("median 1 − R² {median:.1e}", median=self.median)

    @property
    def summary(self) -> Message:
        """Return the prediction for the PSFs as one line."""
        if self.worst < USELESS:
            return Message(
                "predicted 1 − R² against exact rays: median {median:.1e}, up to {worst:.1e} {where}",
                median=self.median,
                worst=self.worst,
                where=self.where,
            )
        if self.median < USELESS:
            return Message(
                "predicted 1 − R² against exact rays: median {median:.1e}, too far from them to tell {where}",
                median=self.median,
                where=self.where,
            )
        return Message("in half of this space PSFs are too far from exact rays to predict how far")

    @property
    def caution(self) -> Message | None:
        """Return a warning if 1 − R² may exceed ALLOWED, else None."""
        if self.worst <= ALLOWED:
            return None
        narrower = remedy = Message("narrow the depths, the fields or the wavelengths")
        if by_six(self.method):
            remedy = Message("{parameter} fitted keeps more of them", parameter=ParameterName("method"))
        if isinf(self.worst):
            return Message(
                "rays are lost {where}, and neither six coefficients nor fits describe that; {remedy}",
                where=self.where,
                remedy=narrower,
            )
        if self.worst >= USELESS:
            return Message(
                "PSFs of this database are predicted to be too far from those of exact rays {where} to say how far, "
                "{median}; "
                "{remedy}",
                where=self.where,
                median=self.usual,
                remedy=remedy,
            )
        return Message(
            "PSFs of this database are predicted to differ from those of exact rays by 1 − R² up to {worst:.1e} "
            "{where}, median {median:.1e}; {remedy}",
            worst=self.worst,
            where=self.where,
            median=self.median,
            remedy=remedy,
        )


def where(depth_mm: float, field_deg: float, wavelength_nm: float) -> Message:
    """Return the position of a source for a sentence."""
    values = {"field": field_deg, "wave": wavelength_nm}
    if isinf(depth_mm):
        return Message("at infinity, {field:.4g}°, {wave:.4g} nm", **values)
    return Message("at {depth:.6g} mm, {field:.4g}°, {wave:.4g} nm", depth=depth_mm, **values)


@lru_cache(maxsize=4)
@one_blas_thread
def accuracy(database: Database, lens: Lens) -> DatabaseAccuracy:
    """Return the predicted accuracy of a database of this lens, at the corners of its space and points between."""
    points = list(_points(database.space, getattr(database, "last_depth_mm", inf)))
    errors = [_error(database, lens, database.space.source(*point)) for point in points]
    worst = int(np.argmax(errors))
    depth, *slopes, wave = points[worst]
    field, *across = (float(degrees_from_slope(slope)) for slope in slopes)
    place = depth, field, across[0] if across else 0.0, wave * NM_PER_UM
    return DatabaseAccuracy(float(np.median(errors)), errors[worst], *place, database.method)


def accuracy_from(record: dict[str, Any], method: str) -> DatabaseAccuracy:
    """Return the accuracy stated in a file, in which null means infinite; KeyError and TypeError for other entries."""
    values = {name: inf if value is None else float(value) for name, value in record.items()}
    return DatabaseAccuracy(**{"field_x_deg": 0.0, **values}, method=method)


def _points(space: Space, last_depth_mm: float) -> Iterator[tuple[float, ...]]:
    """Yield the corners of a space up to the last interpolated depth, and points distributed evenly between them."""
    depths = space.depths_mm[[0, -1]].clip(max=last_depth_mm)
    yield from product(*(dict.fromkeys(nodes[[0, -1]].tolist()) for nodes in (depths, *space.nodes[1:])))
    yield from zip(*(axis.tolist() for axis in scatter(space, POINTS, last_depth_mm)), strict=True)


def _error(database: Database, lens: Lens, source: Source) -> float:
    """Return the predicted 1 − R² of one PSF, infinite if rays are lost."""
    if isinstance(database, FittedDatabase):
        try:
            checks = trace_check_rays(lens, source, mask_seen(lens, source))
        except GeometryError:
            return inf
        found = replace(database.fit_at(source), residual_waves=0.0, map_residual=0.0, amplitude_residual=0.0)
        return predicted_error(behind_mask(found, checks).error_waves, "fitted")
    six = database.coefficients(source.depth_mm, source.field_slope, source.wavelength_um)
    return seidel_error(lens, source, six)


def check_kind(method: str, interpolant: str, rectangle: bool) -> None:
    """Raise RequestError for a method without databases of this interpolant, or over a rectangle of fields."""
    if method not in METHODS:
        raise RequestError(
            '{parameter} is "{value}"; choose {choices}',
            parameter="method",
            value=method,
            choices=Alternatives(METHODS),
        )
    if method != AUTO and not by_six(method) and interpolant != EXACT:
        raise RequestError(
            "{parameter} is {value}, which is for {method} seidel; leave it out",
            parameter="interpolant",
            value=interpolant,
            method=ParameterName("method"),
        )
    if by_six(method) and rectangle:
        raise RequestError(
            "{parameter} is for {method} fitted; leave it out", parameter="fields_x_deg", method=ParameterName("method")
        )


def build_by(
    lens: Lens, space: Space, method: str = "auto", interpolant: str = "exact", stop: Stop | None = None
) -> Database:
    """Return the database of a lens by a method: six coefficients, fits, or what ``auto`` chooses.

    ``auto`` chooses the six coefficients if 1 − R² ≤ ALLOWED over the whole space, or if another interpolant is
    requested, which only they support; otherwise fits, unless these cannot be built or are no better. Raises
    RequestError for another method, and P2SFError as the builds do.
    """
    check_kind(method, interpolant, space.field_x_slopes is not None)
    if method != AUTO:
        return build_database(lens, space, interpolant, stop) if by_six(method) else build_fitted(lens, space, stop)
    refused = lens.misaligned or space.field_x_slopes is not None
    if refused or (interpolant == EXACT and reason_against_coefficients(lens)):
        return build_fitted(lens, space, stop)
    six = build_database(lens, space, interpolant, stop)
    if interpolant != EXACT or accuracy(six, lens).worst <= ALLOWED:
        return six
    try:
        fits = build_fitted(lens, space, stop)
    except (DatabaseError, GeometryError):  # rays are lost, or the space is too wide for fits
        return six
    return fits if accuracy(fits, lens).worst < accuracy(six, lens).worst else six
