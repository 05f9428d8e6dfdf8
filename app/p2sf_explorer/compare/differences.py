"""A − B of what the panels show beside PSF, pupil and coefficients, or why there is none. No Qt in here."""

import re
from collections.abc import Callable
from dataclasses import fields, replace

import numpy as np

from p2sf.raytrace.field_curves import Foci, Heights
from p2sf_explorer.compute.live import Refused
from p2sf_explorer.i18n.messages import spoken
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.results.chromatic import Chromatic
from p2sf_explorer.results.field import FieldView, exaggeration, grid
from p2sf_explorer.results.seidel import PerSurface
from p2sf_explorer.results.through_focus import Strip
from p2sf_explorer.state.scales import signed

FROM_ANSWERS = ("psf", "pupil", "coefficients")  # what `p2sf_explorer.compare.comparison.difference` holds
WHY = {
    "layout": "This is A: two lenses drawn to scale have no difference that could be drawn.",
    "field_map": "This is A: over the field the pictures of A and of B have windows of their own; PSF shows A − B.",
    "beside": "This is A: here it is compared with a perfect lens.",
    "colour": "This is A: one colour less another is no colour.",
    "spot": "This is A: a spot is places of rays, not amounts; the fans show A − B.",
    "lens": "This is A: it is the lens that is edited here; the strip above names what differs.",
    "ybar": "This is A: the diagram's points are surfaces, and those of B are others.",
    "depth_of_field": "This is A: how far it is sharp is where it begins and ends, which B does not move.",
    "solid": "This is A: bodies in space have no difference that could be shown.",
    "import": "This is A: it is what was read from its file.",
    "image": "This is A: light that A has less of than B cannot be shown as a photograph.",
    "database": "This is A: a database belongs to one lens.",
    "accuracy": "This is A: each lens is measured against its own rays.",
}
OTHER_SURFACES = "This is A: it has {a} surfaces and B has {b}, so that none stands for another."
NONE_OF_B = "This is A: B has none. {why}"
NUMBER = re.compile(r"[−-]?\d+(?:\.\d+)?")


def curves(a, b):
    """Return A − B of two views' curves at A's positions, their first entry; beyond B's last there is nothing."""
    places, *names = (field.name for field in fields(a))
    at, known = getattr(a, places), getattr(b, places)
    same = [n for n in names if np.shape(getattr(a, n)) == at.shape and np.shape(getattr(b, n)) == known.shape]
    return replace(a, **{n: getattr(a, n) - np.interp(at, known, getattr(b, n), 0.0, 0.0) for n in same})


def surfaces(a: PerSurface, b: PerSurface) -> PerSurface | str:
    """Return what A's surfaces add to each coefficient more than B's, waves; a sentence where they are others."""
    counts = {name: len(view.waves["w40"]) for name, view in (("a", a), ("b", b))}
    if counts["a"] != counts["b"]:
        return tr(OTHER_SURFACES, **counts)
    return PerSurface({name: waves - b.waves[name] for name, waves in a.waves.items()}, a.stop_surface)


def field(a: FieldView, b: FieldView) -> FieldView:
    """Return A − B of foci, mm, and of distortion at A's fields, which the grid then shows; nothing beyond B's last."""

    def less(mine: np.ndarray, other: np.ndarray) -> np.ndarray:
        return mine - np.interp(a.field_deg, b.field_deg, other, right=np.nan)

    foci = [Foci(*map(less, mine, other)) for mine, other in ((a.real, b.real), (a.third, b.third))]
    real = less(a.heights.distortion, b.heights.distortion)
    third = less(a.heights.third_order_distortion, b.heights.third_order_distortion)
    unit, times = a.heights.paraxial, exaggeration(real)
    made = Heights(unit * (1 + real), unit * (1 + third), unit)
    return FieldView(a.field_deg, *foci, made, a.straight, grid(unit, times * real), times)


def colours(a: Chromatic, b: Chromatic) -> Chromatic:
    """Return A − B of the focal shift, µm, at A's wavelengths; nothing where B has none."""
    known = [np.interp(a.wavelength_nm, b.wavelength_nm, zone, np.nan, np.nan) for zone in b.shift_um]
    return replace(a, shift_um=a.shift_um - np.array(known))


def strips(a: Strip | str, b: Strip | str) -> Strip | str:
    """Return A's strip, B's at the same shifts and in the same window to be taken from it; a sentence where one has."""
    sentence = next((side for side in (a, b) if isinstance(side, str)), "")
    return sentence or replace(a, less=replace(b, shifts_um=a.shifts_um, window=a.window))


def tables(a, b):
    """Return columns of (name, A − B, definition)."""
    return tuple(
        tuple((name, minus(mine, other), words) for (name, mine, words), (_, other, _) in zip(*both, strict=True))
        for both in zip(a, b, strict=True)
    )


def minus(a: str, b: str) -> str:
    """Return A − B of the numbers in two values as they are written; both where they are no numbers of one unit."""
    if a == b and not NUMBER.search(a):
        return "–"
    if NUMBER.split(a) != NUMBER.split(b) or a.startswith("surface"):
        return "–" if a == b else f"{a} | {b}"
    others = iter(NUMBER.findall(b))
    return NUMBER.sub(lambda found: _less(found[0], next(others)), a).removeprefix("f/")


def _less(mine: str, other: str) -> str:
    places = max(len(number.partition(".")[2]) for number in (mine, other))
    return signed(float(mine.replace("−", "-")) - float(other.replace("−", "-")), places)


SUBTRACTED: dict[str, Callable] = {
    "profiles": curves,
    "mtf": curves,
    "ray_fan": curves,
    "opd_fan": curves,
    "seidel": surfaces,
    "field": field,
    "chromatic": colours,
    "first_order": tables,
    "through_focus": strips,
}


def subtracted(key: str, a, b) -> tuple[object, str]:
    """Return what a panel shows for A − B of two views, and a sentence where that is A alone."""
    if key not in SUBTRACTED or isinstance(a, Refused):
        return a, WHY.get(key, "")
    if isinstance(b, Refused):
        return a, tr(NONE_OF_B, why=tr(spoken(b.sentence)))
    found = SUBTRACTED[key](a, b)
    return (a, found) if isinstance(found, str) else (found, "")
