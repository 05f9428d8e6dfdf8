"""Figures as the lessons and lectures tell them, read out of their texts and worked out by other means.

Rays and waves are those of `tests/support/rays/plain_lens.py`, the rest is closed formulas: of the program nothing is
asked but its texts, and two pictures. A figure has to be right to its last digit. German texts are held to the same
figures by `test_translations.py` and `tests/explorer/course/test_lectures.py`.
"""

import re
from functools import cache

import numpy as np
import pytest
from numpy.polynomial.legendre import leggauss
from scipy.optimize import brentq, minimize_scalar
from scipy.special import j1, jn_zeros

from p2sf_explorer.compute import live as compute
from p2sf_explorer.compute.views import image
from p2sf_explorer.compute.views.photos import scene_values
from p2sf_explorer.course.lectures import FOLDER as LECTURES
from p2sf_explorer.lessons.lesson import FOLDER as LESSONS
from p2sf_explorer.lessons.lesson import lesson_files, read_lesson
from p2sf_explorer.lessons.task import NumericAnswer
from tests.support.airy import circle_energy
from tests.support.rays.plain_lens import PlainLens, bars_contrast, circle_mtf, read_lens
from tests.support.waves import r_squared

NUMBER = r"([-−+]?\d+(?:\.\d+)?)"
D, F, C, BLUE, RED = 0.5875618, 0.4861327, 0.6562725, 0.4861, 0.6563  # µm
RING = float(jn_zeros(1, 1)[0] / np.pi)  # first zero of the Airy pattern in λN, 1.2197
HALFWAY = float((2 * j1(np.pi * RING / 2) / (np.pi * RING / 2)) ** 2)
ROUNDED = 0.505  # of the last digit: a half, and what rounding λ and f-numbers costs


@cache
def lens(name: str, wavelength_um: float = D, depth: float = np.inf, f_number: float = 0.0) -> PlainLens:
    found = read_lens(name, wavelength_um, depth)
    return found.at_f_number(f_number) if f_number else found


def gauss(f_number: float = 0.0) -> PlainLens:
    return lens("double_gauss_28", f_number=f_number)


@cache
def radius_80(f_number: float = 0.0) -> float:
    """Return the radius of 80 % of the light of the Double Gauss, its sensor in its place."""
    return gauss(f_number).patch().radius_80(60 if f_number else 150)


@cache
def refocused(f_number: float = 0.0) -> float:
    """Return the smallest such radius of all places of the sensor."""
    wide = 60 if f_number else 150
    found = minimize_scalar(
        lambda shift: gauss(f_number).shifted(shift).patch().radius_80(wide),
        bounds=(-0.12, 0.0) if f_number else (-0.4, -0.2),
        method="bounded",
        options={"xatol": 1e-3},
    )
    return float(found.fun)


def best_contrast(f_number: float) -> float:
    """Return the most of 50 line pairs per millimetre that any place of the sensor keeps."""
    return max(gauss(f_number).shifted(shift).patch().contrast(50) for shift in np.linspace(-0.1, -0.04, 13))


def achromat(f_number: float, wavelength_um: float = D) -> float:
    """Return what a sine pattern of 50 line pairs per millimetre keeps behind the achromat, %."""
    return 100 * lens("achromat_f6", wavelength_um, f_number=f_number).patch().contrast(50)


def bars(f_number: float) -> float:
    keeps = lens("achromat_f6", f_number=f_number).patch().contrast
    return 100 * bars_contrast(keeps, 50, 1000 / (D * f_number) - 1e-6)


def close_foci(name: str, field_deg: float) -> tuple[float, float]:
    """Return where rays 1 µm beside the chief ray meet it, µm behind the sensor: tangential and sagittal."""
    one, step = lens(name, 0.55), 1e-3
    chief = one.height_for(0.0, field_deg)
    two = one.trace(chief + np.array([-step, step]), field_deg)
    aside = one.trace(np.array([chief]), field_deg, step)
    tangential = -np.diff(two.place[1]) / np.diff(two.direction[1] / two.direction[2])
    sagittal = -aside.place[0] * aside.direction[2] / aside.direction[0]
    return float(1000 * tangential.item()), float(1000 * sagittal.item())


def far_out(shift_mm: float) -> float:
    """Return how far from the axis the ray through the rim lands behind the achromat's focus, mm."""
    one = lens("achromat_f6").shifted(shift_mm)
    return abs(float(one.trace(np.array([one.highest])).place[1, 0]))


@cache
def zero_of_star(least: float, most: float) -> float:
    """Return at how many line pairs per millimetre the MTF of the achromat is least, 600 µm out of focus."""
    star = lens("achromat_f6").shifted(0.6).patch(spherical=True)
    return float(minimize_scalar(star.contrast, bounds=(least, most), method="bounded", options={"xatol": 0.01}).x)


def distortion(name: str, field_deg: float) -> float:
    one, near = lens(name), 0.01
    ideal = one.chief_mm(near) * np.tan(np.radians(field_deg)) / np.tan(np.radians(near))
    return float(100 * (one.chief_mm(field_deg) / ideal - 1))


def focus(name: str, wavelength_um: float) -> float:
    """Return where rays close to the axis meet, µm behind the sensor."""
    return 1000 * lens(name, wavelength_um).image_mm()


def ring_field(radius: np.ndarray, dark: float) -> np.ndarray:
    """Return the field of a pupil with a round hole, radii in λN: 2J₁(x)/x of both discs (Born & Wolf 1999, §8.6.2)."""
    x = np.pi * np.maximum(radius, 1e-9)
    return (2 * j1(x) / x - (dark * 2 * j1(dark * x) / x if dark else 0)) / (1 - dark**2)


@cache
def holed(dark: float) -> dict[str, float]:
    """Return dark ring and radius of 80 %, in λN, and the brightest ring over the middle, %."""
    radius = np.linspace(0, 12, 240001)
    light = ring_field(radius, dark) ** 2
    first = int(np.argmax(np.diff(light) > 0))
    within = np.cumsum(light * radius) * radius[1] * np.pi**2 / 2 * (1 - dark**2)
    return {
        "dark": float(radius[first]),
        "ring": float(100 * light[first:].max()),
        "80": float(np.interp(0.8, within, radius)),
    }


def common_area(r: float, s: float, apart: float) -> float:
    """Return the common area of two discs by the two sectors less the kite."""
    if apart >= r + s:
        return 0.0
    if apart <= abs(r - s):
        return np.pi * min(r, s) ** 2
    at_r = np.arccos((apart**2 + r**2 - s**2) / (2 * apart * r))
    at_s = np.arccos((apart**2 + s**2 - r**2) / (2 * apart * s))
    return float(r**2 * (at_r - np.sin(2 * at_r) / 2) + s**2 * (at_s - np.sin(2 * at_s) / 2))


def holed_mtf(part: float, dark: float) -> float:
    """Return the MTF at this part of the limit of a disc with a round hole, %."""
    areas = common_area(1, 1, 2 * part) - 2 * common_area(1, dark, 2 * part) + common_area(dark, dark, 2 * part)
    return 100 * areas / (np.pi * (1 - dark**2))


def rms(wavefront, dark: float = 0.0) -> float:
    """Return the RMS of a function of ρ over the area between the hole and the rim."""
    node, weight = leggauss(30)
    values = wavefront(np.sqrt((1 + dark**2 + (1 - dark**2) * node) / 2))
    return float(np.sqrt(weight @ values**2 / 2 - (weight @ values / 2) ** 2))


def gain_of_focus(dark: float) -> float:
    best = minimize_scalar(lambda wd: rms(lambda rho: rho**4 + wd * rho**2, dark))
    return rms(lambda rho: rho**4, dark) / float(best.fun)


def strehl(w40: float, wd: float) -> float:
    """Return the light in the middle of ρ⁴ and ρ², waves, over that of no waves at all."""
    node, weight = leggauss(200)
    square = (1 + node) / 2
    return float(abs(weight @ np.exp(2j * np.pi * (w40 * square**2 + wd * square)) / 2) ** 2)


def hubble_edge_um() -> float:
    """Return by how much a hyperboloid of K = −1.0139 lies below one of −1.0023 at 1.2 m, of R = 11.04 m."""
    radius, height = 11040.0, 1200.0
    sag = [height**2 / (radius + np.sqrt(radius**2 - (1 + k) * height**2)) for k in (-1.0023, -1.0139)]
    return 1000 * (sag[0] - sag[1])


def far_rim(depth: float, f_number: float = 0.0) -> float:
    one = lens("achromat_f6", depth=depth, f_number=f_number)
    return float(one.waves(np.array([one.highest]))[0])


def singlet_foci() -> tuple[float, float, float]:
    """Return how far before the sensor Petzval surface, sagittal and tangential focus lie at 5°, µm (third order)."""
    one = lens("singlet_f6")
    w = one.third_order(5.0)
    per_wave = 2 * D / one.aperture**2
    return tuple(per_wave * (w["w20"] + k * w["w22"]) for k in (-0.5, 0.0, 1.0))


TEN = brentq(lambda depth: far_rim(depth) - 10, 200, 300)
CASSEGRAIN = 0.546074 * 10  # λN, µm

FIGURES = {
    "lecture_1": {
        "one wavelength λ long, here # µm": lambda: [D],
        "an error of a quarter wave is # µm": lambda: [D / 4],
        "At f/6 this is # µm.": lambda: [RING * D * 6],
        "D is # mm, and the angle is about # seconds": lambda: [
            2 * lens("achromat_f6").rim,
            np.degrees(RING * D / 2000 / lens("achromat_f6").rim) * 3600,
        ],
        "Each star gives # % of its peak there. Together that is # %": lambda: [
            100 * HALFWAY,
            200 * HALFWAY,
        ],
        "× 11 = # µm.": lambda: [RING * 0.486 * 11],
        "λN is #, #, # and # µm. Red makes the disc # times": lambda: [
            *(wave * number for number in (6, 12) for wave in (0.4861, 0.6563)),
            0.6563 / 0.4861,
        ],
        "× 0.588 µm) = #.": lambda: [10 / (RING * D)],
    },
    "lecture_2": {
        "For σ = 1/14 this gives #.": lambda: [np.exp(-((2 * np.pi / 14) ** 2))],
        "makes σ = #, and the Strehl ratio is #.": lambda: [
            rms(lambda rho: rho**2 / 4),
            strehl(0, 0.25),
        ],
        "exp(−0.395) = #.": lambda: [np.exp(-((0.2 * np.pi) ** 2))],
        "has to fall from # waves": lambda: [abs(gauss(3).third_order(10)["w31"])],
        "Here # waves or so are left": lambda: [abs(gauss(6).third_order(10)["w31"])],
    },
    "lecture_3": {
        "is # µm at f/3, # µm at f/8 and # µm at f/22.": lambda: [
            radius_80(),
            radius_80(8),
            radius_80(22),
        ],
        "goes from # µm to # µm and back to # µm.": lambda: [
            radius_80(),
            radius_80(8),
            radius_80(22),
        ],
        "then it is # µm at f/3, # µm at f/6 and # µm at f/8": lambda: [
            refocused(),
            refocused(6),
            refocused(8),
        ],
        "at 20° some # %.": lambda: [100 * np.cos(np.radians(20)) ** 4],
        "At f/3 this lens has # waves": lambda: [gauss().third_order(14)["w40"]],
        "2⁴ = 16 is # waves": lambda: [gauss(6).third_order(14)["w40"]],
        "#, #, # and # waves. W20 and W22": lambda: corner(8),
        "at f/3 they are #, #, # and # waves": lambda: corner(0),
    },
    "lecture_4": {
        "0.588 µm these are #.": lambda: [1000 / (17 * D)],
        "# %. The curve is nearly straight": lambda: [100 * circle_mtf(0.5)],
        "4/π times as much, # %.": lambda: [100 * bars_contrast(circle_mtf, 0.5, 1.0)],
        "than red, here by # mm.": lambda: [(focus("landscape", C) - focus("landscape", F)) / 1000],
        "lands # µm farther out": lambda: [
            1000 * (lens("landscape", F).chief_mm(10) - lens("landscape", C).chief_mm(10))
        ],
        "8) = # line pairs": lambda: [1 / (0.00055 * 8)],
        "some # µm behind yellow": lambda: [focus("singlet_f6", RED)],
        "from # to #, # and # line pairs": lambda: [1000 / (D * n) for n in (6, 12, 24, 32)],
    },
    "lecture_5": {
        "a pixel keeps # % of the contrast": lambda: [200 / np.pi],
        "0.60 × 0.64 = #.": lambda: [0.6 * 2 / np.pi],
        "has a radius of # µm": lambda: [radius_80(22)],
        "At f/8 the lens keeps # %. At f/6 it keeps # %": lambda: [
            100 * gauss(8).patch().contrast(50),
            100 * gauss(6).patch().contrast(50),
        ],
        "at f/11 # % because of the Airy disc": lambda: [100 * gauss(11).patch().contrast(50)],
        "With a new focus f/6 would keep # %.": lambda: [100 * best_contrast(6)],
    },
    "lecture_6": {
        "is # µm too low": lambda: [hubble_edge_um()],
        "0.55 µm = # waves.": lambda: [2 * hubble_edge_um() / 0.55],
    },
    "01_what_is_a_psf": {
        "light lies within # µm": lambda: [radius_80(8)],
    },
    "02_diffraction": {
        "0.61 λ/NA, here # µm": lambda: [RING * D * 6],
        "656.3/486.1 is #, but the ratio of the radii is a little more, #.": lambda: [
            RED / BLUE,
            RED / BLUE * lens("achromat_f6", RED).focal_length / lens("achromat_f6", BLUE).focal_length,
        ],
    },
    "03_defocus": {
        "and the peak keeps # % of its height": lambda: [100 * lens("achromat_f6").shifted(0.0423).patch().strehl()],
        "grows from # to # µm": lambda: [
            lens("achromat_f6").shifted(shift).patch().radius_80(40) for shift in (0.0, 0.0423)
        ],
        "a point # cm in front": lambda: [TEN / 10],
        "It is # mm across": lambda: [
            2
            * abs(lens("achromat_f6", depth=TEN).trace(np.array([lens("achromat_f6", depth=TEN).highest])).place[1, 0])
        ],
        "ten waves over √12, # waves": lambda: [lens("achromat_f6", depth=TEN).rms_waves()],
        "The bar of Wd shows only # waves": lambda: [-lens("achromat_f6", depth=TEN).defocus],
        "only # of the ten waves": lambda: [far_rim(TEN, 12)],
    },
    "04_spherical_aberration": {
        "W40 = # waves at the rim, and the peak is down to # %": lambda: [
            lens("singlet_f6").third_order(5)["w40"],
            100 * lens("singlet_f6").patch().strehl(),
        ],
        "Wd = −W40, brings it to #.": lambda: [strehl(1, -1)],
    },
    "05_coma": {
        "the cube root of two, #, in aperture": lambda: [2 ** (1 / 3)],
        "At f/#. Twice the field": lambda: [2.4 * (np.tan(np.radians(6)) / np.tan(np.radians(3))) ** (1 / 3)],
    },
    "06_astigmatism": {
        "meet # µm behind the sensor's usual place": lambda: [close_foci("cooke_triplet", 14)[0]],
        "in the strip below, to # µm, where": lambda: [close_foci("cooke_triplet", 14)[1]],
        "here # µm in front of the sensor": lambda: [singlet_foci()[0]],
        "sagittal focus lies # µm in front of the Petzval": lambda: [singlet_foci()[1] - singlet_foci()[0]],
        "# µm, three times as far": lambda: [singlet_foci()[2] - singlet_foci()[0]],
    },
    "07_distortion": {
        "at 10° lands # % too far": lambda: [distortion("landscape", 10)],
    },
    "08_the_stop": {
        "distortion is # %: pincushion": lambda: [distortion("landscape", 10)],
        "distortion is # %: barrel": lambda: [distortion(str(LESSONS / "landscape_front"), 10)],
        "At 15° only # % is left": lambda: [distortion("periskop", 15)],
    },
    "09_stopping_down": {
        "lies within # µm of the middle. The reason is # waves": lambda: [
            radius_80(),
            gauss().third_order(14)["w40"],
        ],
        "Ten times smaller, # µm. W40 has fallen by a factor of (8/3)⁴ = #.": lambda: [
            radius_80(8),
            (8 / 3) ** 4,
        ],
        "takes a radius of # µm": lambda: [radius_80(22)],
    },
    "10_chromatic_aberration": {
        "comes to a focus # µm behind blue": lambda: [focus("singlet_f6", C) - focus("singlet_f6", F)],
        "Strehl ratio than yellow, # against #.": lambda: [
            lens("singlet_f6", RED).patch().strehl(),
            lens("singlet_f6").patch().strehl(),
        ],
        "blue are # µm apart, # times less": lambda: [
            focus("achromat_f6", C) - focus("achromat_f6", F),
            (focus("singlet_f6", C) - focus("singlet_f6", F)) / (focus("achromat_f6", C) - focus("achromat_f6", F)),
        ],
    },
    "12_depth_and_database": {
        "Wd of a candle at 10 m is # waves": lambda: [lens("double_gauss_28", depth=10000.0).defocus],
    },
    "14_hubble": {
        "it is # µm too low": lambda: [hubble_edge_um()],
    },
    "17_a_hole_in_the_pupil": {
        "first dark ring has a radius of # µm, the first bright ring is # %": lambda: [
            holed(0.0)["dark"] * CASSEGRAIN,
            holed(0.0)["ring"],
        ],
        "of all light lies within # µm": lambda: [CASSEGRAIN * brentq(lambda r: circle_energy(r / 2) - 0.8, 0.1, 2)],
        "and so # % of the light. The dark ring has shrunk to # µm": lambda: [
            100 * 0.35**2,
            holed(0.35)["dark"] * CASSEGRAIN,
        ],
        "ring is now # % as bright as the middle, and 80 % of all light takes # µm": lambda: [
            holed(0.35)["ring"],
            holed(0.35)["80"] * CASSEGRAIN,
        ],
        "the contrast falls from # to #.": lambda: [holed_mtf(0.05 * CASSEGRAIN, dark) / 100 for dark in (0.0, 0.35)],
        "of the limit, from # to #.": lambda: [holed_mtf(0.15 * CASSEGRAIN, dark) / 100 for dark in (0.0, 0.35)],
        "per millimetre is #, and the first bright ring is # %": lambda: [
            holed_mtf(0.05 * CASSEGRAIN, 0.5) / 100,
            holed(0.5)["ring"],
        ],
    },
    "21_contrast": {
        "this lens keeps # % at f/6 and # % at f/12": lambda: [achromat(6), achromat(12)],
        "Its radius is # µm": lambda: [RING * D * 12],
        "0.588 µm this is #.": lambda: [1000 / (17 * D)],
        "a perfect lens keeps # %": lambda: [100 * circle_mtf(0.5)],
        "the curve end at # line pairs": lambda: [1000 / (32 * D)],
        "contrast of the same lines is # %": lambda: [achromat(17, BLUE)],
        "its contrast is 4/π, # times": lambda: [4 / np.pi],
        "per millimetre # % at f/6, not # %, and # % at f/12, not # %": lambda: [
            bars(6),
            achromat(6),
            bars(12),
            achromat(12),
        ],
        "Beyond # line pairs per millimetre it is zero, and the second sine pattern of the bars has #.": lambda: [
            1000 / (12 * D),
            3 * 50,
        ],
        "A sine pattern keeps # % there.": lambda: [achromat(17)],
        "is # %. The finer": lambda: [bars(17)],
        "a point makes a patch # mm wide": lambda: [2 * far_out(0.6)],
        "At # mm from the middle the star has # line pairs": lambda: [
            36 / (2 * np.pi * zero_of_star(10, 16)),
            zero_of_star(10, 16),
        ],
        "A second grey ring lies farther in, at # mm": lambda: [36 / (2 * np.pi * zero_of_star(20, 28))],
    },
}


def corner(f_number: float) -> list[float]:
    """Return the sizes of W20, W22, W40 and W31 of the Double Gauss at 14°."""
    w = gauss(f_number).third_order(14.0)
    return [abs(w[term]) for term in ("w20", "w22", "w40", "w31")]


PLACES = [(name, words) for name, told in FIGURES.items() for words in told]


@cache
def told(name: str) -> str:
    """Return all that a lesson or lecture tells, on one line."""
    folder = LECTURES if name.startswith("lecture") else LESSONS
    parts = []
    for step in read_lesson(folder / f"{name}.md").steps:
        parts += [step.text, step.attempt, step.question, step.answer]
        if step.task:
            words = step.task.words
            parts += [*words.options, *filter(None, words.option_hints), *words.wrong, *words.hints]
    return " ".join(" ".join(parts).replace("**", "").split())


@pytest.mark.parametrize(("name", "words"), PLACES)
def test_a_figure_is_right_to_its_last_digit(name, words):
    found = re.findall(re.escape(words).replace(r"\#", NUMBER), told(name))
    assert len(found) == 1, f"not told once: {words}"
    figures = found[0] if isinstance(found[0], tuple) else found
    for figure, value in zip(figures, FIGURES[name][words](), strict=True):
        last = 10.0 ** -len(figure.partition(".")[2])
        assert abs(float(figure.replace("−", "-")) - value) <= ROUNDED * last, f"{words}: {figure} is {value:.6g}"


def rim_lands(name: str, depth: float, f_number: float) -> float:
    one = lens(name, depth=depth, f_number=f_number)
    return abs(float(one.trace(np.array([one.highest])).place[1, 0]))


def coma_along(w31: float) -> tuple[float, float]:
    """Return where the light of W31 ρ³ cos θ is brightest and where its centroid lies, in λ/NA along the tail.

    The light by a plain sum over the disc; the centroid is the mean slope of the wavefront, W31.
    """
    node, weight = leggauss(120)
    eta = node
    half = np.sqrt(1 - eta**2)
    xi = half[:, None] * node
    places = np.linspace(-1.0, 3.0, 801)
    waves = w31 * eta[:, None] * (xi**2 + eta[:, None] ** 2)
    rows = (np.exp(2j * np.pi * waves) @ weight) * half * weight
    light = np.abs(np.exp(-2j * np.pi * np.outer(places, eta)) @ rows) ** 2
    return float(places[light.argmax()]), w31


RATIOS = {
    ("lecture_2", "An eighth: W40 falls to a sixteenth"): lambda: (
        8,
        rim_lands("singlet_f6", np.inf, 6) / rim_lands("singlet_f6", np.inf, 12),
    ),
    ("lecture_3", "the patch is ten times as wide as at f/8"): lambda: (10, radius_80() / radius_80(8)),
    ("lecture_3", "makes the patch more than twice as wide as at f/8"): lambda: (2.4, radius_80(22) / radius_80(8)),
    ("lecture_3", "Half as wide. The width of the blur follows"): lambda: (
        2,
        rim_lands("double_gauss_28", 5000.0, 8) / rim_lands("double_gauss_28", 5000.0, 16),
    ),
    ("lecture_3", "by about half a millimetre"): lambda: (0.5, lens("double_gauss_28", depth=20000.0).image_mm()),
    ("09_stopping_down", "twice as much as at f/11"): lambda: (2, radius_80(22) / radius_80(11)),
    ("14_hubble", "By four on a full pupil"): lambda: (4, gain_of_focus(0.0)),
    ("14_hubble", "and by five on the ring"): lambda: (5, gain_of_focus(0.33)),
    ("06_astigmatism", "three times as far"): lambda: (
        3,
        (singlet_foci()[2] - singlet_foci()[0]) / (singlet_foci()[1] - singlet_foci()[0]),
    ),
}


@pytest.mark.parametrize("place", RATIOS, ids=lambda place: place[1])
def test_a_ratio_told_in_words_is_true(place):
    name, words = place
    said, value = RATIOS[place]()
    assert words in told(name)
    assert value == pytest.approx(said, rel=0.05)


def test_the_best_f_number_is_where_it_is_said_to_be():
    """With the sensor in its place near f/8, with a new focus at each near f/6."""
    assert "Near f/8. The radius" in told("lecture_3") and "and the best is near f/6" in told("lecture_3")
    assert "Near f/8, where" in told("09_stopping_down") and "and the best is near f/6" in told("09_stopping_down")
    numbers = (5.0, 5.5, 6.0, 6.5, 7.0, 8.0, 9.0, 10.0, 11.0)
    assert min(numbers, key=radius_80) == 8.0
    assert min(numbers, key=refocused) == 6.0


def test_the_order_in_the_corner_is_the_same_wide_open():
    assert "in the same order" in told("lecture_3")
    assert all(sizes == sorted(sizes, reverse=True) for sizes in (corner(3), corner(8)))


def test_the_peak_of_coma_lies_between_the_chief_ray_and_the_centroid():
    peak, centroid = coma_along(1.5)
    assert "and the light's centre of gravity farther still" in told("05_coma")
    assert 0.2 < peak < 0.9 * centroid


def test_ten_waves_are_shown_by_the_method_that_the_step_holds_to():
    """R² of the picture against a sum of spherical waves; by plane waves it is 0.959, by six coefficients 0.950."""
    lesson = read_lesson(LESSONS / "03_defocus.md")
    number = [step.title for step in lesson.steps].index("Ten waves")
    shown = compute.live(lesson.state(number)).psf
    own = lens("achromat_f6", depth=lesson.state(number).optics.depth_mm).patch(spherical=True)
    radius = np.hypot(shown.x_um, shown.y_um[:, None])
    fine = np.linspace(0, radius.max(), 4000)
    light = np.interp(radius, fine, own.light(fine))
    assert r_squared(shown.values, light) > 0.999


def test_the_spokes_jump_where_the_step_says_so():
    """The picture follows the star outside the first ring, opposes it inside, and follows it inside the second."""
    lesson = read_lesson(LESSONS / "21_contrast.md")
    state = lesson.state([step.title for step in lesson.steps].index("A star of spokes"))
    asked = image.question(compute.live(state)).question
    found, star = image.coarse(asked).after[..., 1], scene_values("siemens_star", (image.ROWS, image.COLUMNS))[..., 1]
    rows, columns = (np.arange(n) - (n - 1) / 2 for n in star.shape)
    radius = np.hypot(columns, rows[:, None]) * state.photo.pixel_um / 1000
    alike = []
    for least, most in ((0.55, 0.70), (0.28, 0.38), (0.19, 0.21)):
        ring = (radius > least) & (radius < most)
        alike.append(np.corrcoef(found[ring], star[ring])[0, 1])
    assert alike[0] > 0.5 and alike[1] < -0.5 and alike[2] > 0.3


# Answers that the tasks foresee, as the slips that their hints name would give them.
SLIPS = {
    "l1-airy": lambda: [
        2 * RING * 0.486 * 11,
        0.486 * 11,
        RING / 2 * 0.486 * 11,
        RING * D * 11,
        RING * 0.486 * 6,
    ],
    "l2-strehl": lambda: [
        np.exp(-0.2 * np.pi),
        np.exp(-(0.1**2)),
        1 - (0.2 * np.pi) ** 2,
        0.1,
        np.exp(-((2 * np.pi / 14) ** 2)),
    ],
    "l3-w40": lambda: [gauss().third_order(14)["w40"] / k for k in (2, 4, 8, 1)],
    "l4-limit": lambda: [
        1 / (RING * 0.00055 * 8),
        1 / (0.55 * 8),
        2 / (0.00055 * 8),
        0.5 / (0.00055 * 8),
        1 / (0.00055 * 6),
    ],
    "l5-nyquist": lambda: [1000 / 10, 1000 / 40, 1 / 20, 10],
    "l6-hubble": lambda: [2.2 / 0.55, 2.2, 2 * 2.2, 2.2 * 0.55, 4 * 2.2 / 0.55],
    "s4-star": lambda: [2 * line_um() / (2 * 7), line_um() / (4 * 7)],
}
RIGHT = {
    "l1-airy": lambda: RING * 0.486 * 11,
    "l2-strehl": lambda: strehl(0, 0.1 * np.sqrt(12)),
    "l3-w40": lambda: gauss(6).third_order(14)["w40"],
    "l4-limit": lambda: 1 / (0.00055 * 8),
    "l5-nyquist": lambda: 1000 / 20,
    "l6-hubble": lambda: 2 * hubble_edge_um() / 0.55,
    "s4-star": lambda: line_um() / (2 * 7),
}


def line_um() -> float:
    """Return how far rays of W = 1.5 η² land to one side at f/6, µm: the largest ∂W/∂η times 2 N λ of the d line."""
    eta = np.linspace(-1, 1, 2001)
    return float(np.abs(np.gradient(1.5 * eta**2, eta)).max()) * 2 * 6 * D


def numeric_tasks() -> dict[str, NumericAnswer]:
    lectures = (read_lesson(path) for path in lesson_files(LECTURES))
    tasks = (step.task for lecture in lectures for step in lecture.steps if step.task)
    return {task.name: task.answer for task in tasks if isinstance(task.answer, NumericAnswer)}


@pytest.mark.parametrize(("name", "answer"), numeric_tasks().items())
def test_answers_and_foreseen_slips_are_what_they_are_said_to_be(name, answer):
    (right,) = answer.parts
    assert RIGHT[name]() == pytest.approx(right.number, abs=right.tolerance)
    for (slip, hint), value in zip(answer.wrong, SLIPS[name](), strict=True):
        assert value == pytest.approx(slip.number, abs=slip.tolerance), hint


def spike(blades: int, least: float, most: float) -> float:
    """Return the mean light of a spike between radii in λN over that in the middle, by the width of the iris there."""
    x = np.linspace(-1, 1, 8001)
    low, high = -np.sqrt(1 - x**2), np.sqrt(1 - x**2)
    for angle in 2 * np.pi * np.arange(blades) / blades:  # the first edge stands across the spike
        room = np.cos(np.pi / blades) - x * np.cos(angle)
        if abs(np.sin(angle)) < 1e-9:
            low, high = (np.where(room < 0, 0.0, edge) for edge in (low, high))
        elif np.sin(angle) > 0:
            high = np.minimum(high, room / np.sin(angle))
        else:
            low = np.maximum(low, room / np.sin(angle))
    width = np.maximum(high - low, 0)
    radius = np.linspace(least, most, 400)
    return float((np.abs(np.exp(1j * np.pi * np.outer(radius, x)) @ width) ** 2).mean() / width.sum() ** 2)


def test_spikes_of_five_blades_are_fainter_than_those_of_six_far_out_alone():
    assert "Far from the middle each of these is fainter" in told("18_an_irises_blades")
    assert spike(5, 12, 40) < 0.9 * spike(6, 12, 40)
    assert spike(5, 3.66, 6.1) > spike(6, 3.66, 6.1)  # 3 to 5 Airy radii, where the lesson measures spikes
