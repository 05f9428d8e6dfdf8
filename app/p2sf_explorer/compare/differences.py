"""A − B of what the panels show beside PSF, pupil and coefficients, or why there is none. No Qt in here."""

from collections.abc import Callable
from dataclasses import fields, replace
from typing import Any

import numpy as np

from p2sf.messages import Message, Number
from p2sf.pupil.zernike_fit import ZernikeFit
from p2sf.raytrace.field_curves import Foci, Heights
from p2sf_explorer.compute.live import View
from p2sf_explorer.compute.views.chromatic import Chromatic
from p2sf_explorer.compute.views.field import FieldView, exaggeration, grid
from p2sf_explorer.compute.views.first_order import NONE, Row
from p2sf_explorer.compute.views.seidel import PerSurface
from p2sf_explorer.compute.views.through_focus import Strip
from p2sf_explorer.compute.views.zernike import ZernikeView
from p2sf_explorer.state.panels import PANELS, difference_of
from p2sf_explorer.state.scales import with_sign


def curves(a: View[Any], b: View[Any]) -> View[Any] | Message:
    """Return A − B of two views' curves at A's positions, their first entry; beyond B's last there is nothing.

    A message where the curves of one of them are still to be computed.
    """
    mine, other = a.found, b.found
    if mine is None or other is None:
        return Message("This is A: the curves of A or of B take longer than a frame.")
    places, *names = (field.name for field in fields(mine))
    at, known = getattr(mine, places), getattr(other, places)
    same = [n for n in names if np.shape(getattr(mine, n)) == at.shape and np.shape(getattr(other, n)) == known.shape]
    less = replace(mine, **{n: getattr(mine, n) - np.interp(at, known, getattr(other, n), 0.0, 0.0) for n in same})
    return View(less, less if a.question else None)


def strips(a: View[None], b: View[None]) -> View[None]:
    """Return A's strip, B's at the same shifts and in the same window to be taken from it."""
    strip: Strip = a.question
    return View(None, replace(strip, less=replace(b.question, shifts_um=strip.shifts_um, window=strip.window)))


def of_found(less: Callable[[Any, Any], Any]) -> Callable[[View[Any], View[Any]], View[Any] | Message]:
    """Return what subtracts two views of which all is found within a frame."""

    def subtracted(a: View[Any], b: View[Any]) -> View[Any] | Message:
        made = less(a.found, b.found)
        return made if isinstance(made, Message) else View(made)

    return subtracted


@of_found
def surfaces(a: PerSurface, b: PerSurface) -> PerSurface | Message:
    """Return what A's surfaces add to each coefficient more than B's, waves; a message if their numbers differ."""
    counts = {name: len(view.waves["w40"]) for name, view in (("a", a), ("b", b))}
    if counts["a"] != counts["b"]:
        return Message("This is A: it has {a} surfaces and B has {b}, so they do not correspond.", **counts)
    return PerSurface({name: waves - b.waves[name] for name, waves in a.waves.items()}, a.stop_surface, a.colours_nm)


@of_found
def terms(a: ZernikeView, b: ZernikeView) -> ZernikeView:
    """Return A − B of the Zernike coefficients and of their shares; RMS and residual likewise."""

    def less(mine: ZernikeFit, other: ZernikeFit) -> ZernikeFit:
        names = ("waves", "rms_waves", "share", "rms", "rms_with_tilt", "residual")
        return replace(mine, **{name: getattr(mine, name) - getattr(other, name) for name in names})

    return replace(a, fits={order: less(fit, b.fits[order]) for order, fit in a.fits.items()})


@of_found
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


@of_found
def colours(a: Chromatic, b: Chromatic) -> Chromatic:
    """Return A − B of the focal shift, µm, at A's wavelengths; nothing where B has none."""
    known = [np.interp(a.wavelength_nm, b.wavelength_nm, zone, np.nan, np.nan) for zone in b.shift_um]
    return replace(a, shift_um=a.shift_um - np.array(known))


@of_found
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


def subtract(key: str, a: View[Any], b: View[Any]) -> tuple[View[Any], Message | None]:
    """Return what a panel shows for A − B of two views, and a message where that is A alone."""
    minus = difference_of(PANELS[key])
    if minus is None or isinstance(minus, Message) or a.why:
        return a, minus if isinstance(minus, Message) else None
    if b.why:
        return a, Message("This is A; B has none: {why}", why=b.why)
    difference = minus(a, b)
    return (a, difference) if isinstance(difference, Message) else (difference, None)
