"""A − B of what the panels show beside PSF, pupil and coefficients, or why there is none. No Qt in here."""

from dataclasses import fields, replace
from typing import Any

import numpy as np

from p2sf.messages import Message, Number
from p2sf.raytrace.field_curves import Foci, Heights
from p2sf.raytrace.zernike_fit import ZernikeFit
from p2sf_explorer.compute.live import Refused
from p2sf_explorer.compute.measured import MeasureRequest
from p2sf_explorer.compute.views.chromatic import Chromatic
from p2sf_explorer.compute.views.field import FieldView, exaggeration, grid
from p2sf_explorer.compute.views.first_order import NONE, Row
from p2sf_explorer.compute.views.seidel import PerSurface
from p2sf_explorer.compute.views.through_focus import Strip
from p2sf_explorer.compute.views.zernike import ZernikeView
from p2sf_explorer.state.panels import PANELS, difference_of
from p2sf_explorer.state.scales import with_sign


def curves(a: Any, b: Any) -> Any:
    """Return A − B of two views' curves at A's positions, their first entry; beyond B's last there is nothing.

    A message where the curves of one of them are still to be computed.
    """
    if isinstance(a, MeasureRequest) or isinstance(b, MeasureRequest):
        return Message("This is A: the curves of A or of B take longer than a frame.")
    places, *names = (field.name for field in fields(a))
    at, known = getattr(a, places), getattr(b, places)
    same = [n for n in names if np.shape(getattr(a, n)) == at.shape and np.shape(getattr(b, n)) == known.shape]
    return replace(a, **{n: getattr(a, n) - np.interp(at, known, getattr(b, n), 0.0, 0.0) for n in same})


def surfaces(a: PerSurface, b: PerSurface) -> PerSurface | Message:
    """Return what A's surfaces add to each coefficient more than B's, waves; a message if their numbers differ."""
    counts = {name: len(view.waves["w40"]) for name, view in (("a", a), ("b", b))}
    if counts["a"] != counts["b"]:
        return Message("This is A: it has {a} surfaces and B has {b}, so they do not correspond.", **counts)
    return PerSurface({name: waves - b.waves[name] for name, waves in a.waves.items()}, a.stop_surface, a.colours_nm)


def terms(a: ZernikeView, b: ZernikeView) -> ZernikeView:
    """Return A − B of the Zernike coefficients and of their shares; RMS and residual likewise."""

    def less(mine: ZernikeFit, other: ZernikeFit) -> ZernikeFit:
        names = ("waves", "rms_waves", "share", "rms", "rms_with_tilt", "residual")
        return replace(mine, **{name: getattr(mine, name) - getattr(other, name) for name in names})

    return replace(a, fits={order: less(fit, b.fits[order]) for order, fit in a.fits.items()})


def field(a: FieldView, b: FieldView) -> FieldView:
    """Return A − B of foci, mm, and of distortion at A's fields, which the grid then shows; nothing beyond B's last."""

    def less(mine: np.ndarray, other: np.ndarray) -> np.ndarray:
        return mine - np.interp(a.field_deg, b.field_deg, other, right=np.nan)

    real, third = (Foci(*map(less, mine, other)) for mine, other in ((a.real, b.real), (a.third, b.third)))
    distortion = less(a.heights.distortion, b.heights.distortion)
    third_order = less(a.heights.third_order_distortion, b.heights.third_order_distortion)
    unit, times = a.heights.paraxial, exaggeration(distortion)
    heights = Heights(unit * (1 + distortion), unit * (1 + third_order), unit)
    return FieldView(a.field_deg, real, third, heights, a.straight, grid(unit, times * distortion), times)


def colours(a: Chromatic, b: Chromatic) -> Chromatic:
    """Return A − B of the focal shift, µm, at A's wavelengths; nothing where B has none."""
    known = [np.interp(a.wavelength_nm, b.wavelength_nm, zone, np.nan, np.nan) for zone in b.shift_um]
    return replace(a, shift_um=a.shift_um - np.array(known))


def strips(a: Strip | Message, b: Strip | Message) -> Strip | Message:
    """Return A's strip, B's at the same shifts and in the same window to be taken from it; a message where one has."""
    if isinstance(a, Message):
        return a
    return b if isinstance(b, Message) else replace(a, less=replace(b, shifts_um=a.shifts_um, window=a.window))


def tables(a: tuple[tuple[Row, ...], ...], b: tuple[tuple[Row, ...], ...]) -> tuple[tuple[Row, ...], ...]:
    """Return columns of (name, A − B, definition)."""
    return tuple(
        tuple((name, minus(mine, other), words) for (name, mine, words), (_, other, _) in zip(*both, strict=True))
        for both in zip(a, b, strict=True)
    )


def minus(a: Message, b: Message) -> Message:
    """Return A − B of the amounts in two values; both values where they have no amounts in the same units."""
    amounts = {name: value for name, value in a.values.items() if isinstance(value, float | Number)}
    if amounts and a.template == b.template:
        others = (b.values[name] for name in amounts)
        less = {name: _less(mine, other) for (name, mine), other in zip(amounts.items(), others, strict=True)}
        return Message(a.template.removeprefix("f/"), **(a.values | less))
    return NONE if a == b else Message("{a} | {b}", a=a, b=b)


def _less(mine: object, other: object) -> object:
    if isinstance(mine, float) and isinstance(other, float):
        return mine - other
    places = max(len(str(number).partition(".")[2]) for number in (mine, other))
    first, second = (float(str(number).replace("−", "-")) for number in (mine, other))
    return Number(with_sign(first - second, places))


def subtract(key: str, a: object, b: object) -> tuple[object, Message | None]:
    """Return what a panel shows for A − B of two views, and a message where that is A alone."""
    minus = difference_of(PANELS[key])
    if minus is None or isinstance(minus, Message) or isinstance(a, Refused):
        return a, minus if isinstance(minus, Message) else None
    if isinstance(b, Refused):
        return a, Message("This is A; B has none: {why}", why=b.message)
    difference = minus(a, b)
    return (a, difference) if isinstance(difference, Message) else (difference, None)
