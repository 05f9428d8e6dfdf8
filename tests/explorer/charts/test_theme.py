"""Colours: the heat maps are told apart with every kind of colour blindness, and the window follows the system."""

import re
from dataclasses import replace

import numpy as np
import pyqtgraph as pg
import pytest
from PySide6.QtCore import QSize, Qt
from PySide6.QtGui import QColor, QGuiApplication

from p2sf_explorer.charts.theme import BRIGHTNESS, DARK, DONE, LIGHT, screen_scale, stylesheet, tokens
from p2sf_explorer.panels import pupil
from p2sf_explorer.scene3d.widget import WAVES_MAP
from p2sf_explorer.state.limits import CHOICES

# Machado, Oliveira and Fernandes (2009), IEEE TVCG 15, table 1: no cone of one kind at all; linear RGB.
BLIND = {
    "none": np.eye(3),
    "protan": [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]],
    "deutan": [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]],
    "tritan": [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.303900]],
}
TO_XYZ = np.array([[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]])  # IEC 61966-2-1
WHITE = TO_XYZ.sum(axis=1)
ENOUGH = 13.0  # CIE 1976 ΔE; 2.3 is just noticeable


def lab(linear: np.ndarray) -> np.ndarray:
    """Return CIE L*a*b* of linear RGB (CIE 15:2004, without the linear part: no map here is that dark over a fifth)."""
    x, y, z = np.moveaxis(np.cbrt(np.clip(linear, 0, 1) @ TO_XYZ.T / WHITE), -1, 0)
    return np.stack([116 * y - 16, 500 * (x - y), 200 * (y - z)], -1)


def least_difference(name: str, matrix, cyclic: bool) -> float:
    """Return the smallest colour difference of values a fifth of the scale apart."""
    coded = pg.colormap.get(name).getLookupTable(nPts=60)[:, :3] / 255
    linear = np.where(coded <= 0.04045, coded / 12.92, ((coded + 0.055) / 1.055) ** 2.4)
    seen = lab(linear @ np.asarray(matrix).T)
    apart = np.abs(np.subtract.outer(np.arange(60), np.arange(60)))
    apart = np.minimum(apart, 60 - apart) if cyclic else apart
    return float(np.linalg.norm(seen[:, None] - seen, axis=-1)[apart >= 12].min())


@pytest.mark.parametrize("vision", BLIND)
@pytest.mark.parametrize("name", [*BRIGHTNESS.values(), pupil.WAVES_MAP, pupil.WRAPPED_MAP, WAVES_MAP])
def test_values_a_fifth_of_the_scale_apart_differ_for_everybody(name, vision):
    assert least_difference(name, BLIND[vision], name == pupil.WRAPPED_MAP) > ENOUGH


def test_a_map_that_red_green_blind_eyes_cannot_read_would_be_found():
    assert least_difference("CET-R3", BLIND["protan"], False) < ENOUGH


@pytest.mark.parametrize("vision", BLIND)
@pytest.mark.parametrize("theme", [LIGHT, DARK], ids=["light", "dark"])
def test_the_colours_of_curves_differ_for_everybody_and_from_the_card(theme, vision):
    """The energy's is none of those that mean along x and along y beside it."""
    coded = np.array([QColor(c).getRgbF()[:3] for c in (theme.marginal, theme.chief, theme.third, theme.card)])
    linear = np.where(coded <= 0.04045, coded / 12.92, ((coded + 0.055) / 1.055) ** 2.4)
    seen = lab(linear @ np.asarray(BLIND[vision]).T)
    apart = np.linalg.norm(seen[:, None] - seen, axis=-1)
    assert apart[np.triu_indices(4, 1)].min() > ENOUGH


def test_every_choice_of_the_state_has_its_colours():
    assert set(BRIGHTNESS) == set(CHOICES["colours"])
    assert tokens("dark", "grey").brightness == "CET-L1" and tokens("light") is tokens("light")


def test_the_window_takes_the_chosen_colours(window):
    heat = window.panels["psf"].map
    before = heat._table.copy()
    window.store.update(colours="viridis")
    assert not np.array_equal(before, heat._table)
    red, green, blue = pg.colormap.get("viridis").getLookupTable(nPts=255)[200][:3]
    assert heat._table[200] == 0xFF000000 | int(red) << 16 | int(green) << 8 | int(blue)


def test_light_and_dark_follow_the_system_live(window, monkeypatch):
    window.store.update(theme="system")
    for scheme, theme in ((Qt.ColorScheme.Dark, DARK), (Qt.ColorScheme.Light, LIGHT)):
        monkeypatch.setattr("p2sf_explorer.charts.theme.system_scheme", lambda scheme=scheme: scheme)
        QGuiApplication.styleHints().colorSchemeChanged.emit(scheme)
        assert window.grab().toImage().pixelColor(3, 3).name() == theme.window


@pytest.mark.parametrize("theme", [LIGHT, DARK], ids=["light", "dark"])
def test_per_cent_are_read_on_both_parts_of_a_bar(theme):
    """WCAG 2.1 asks a contrast of 4.5 of small letters."""
    text, rest, accent = (np.array(QColor(c).getRgbF()[:3]) for c in (theme.text, theme.faint, theme.accent))
    part = int(DONE[1:], 16) / 255
    for ground in (rest, part * accent + (1 - part) * rest):
        light = sorted(
            TO_XYZ[1] @ np.where(c <= 0.04045, c / 12.92, ((c + 0.055) / 1.055) ** 2.4) for c in (text, ground)
        )
        assert (light[1] + 0.05) / (light[0] + 0.05) > 4.5


def test_every_length_of_the_style_sheet_grows_with_the_scale():
    """Twice the scale doubles each length exactly, since a whole number needs no rounding."""
    plain, double = (
        [int(px) for px in re.findall(r"(\d+)px", stylesheet(replace(LIGHT, scale=scale)))] for scale in (1.0, 2.0)
    )
    assert len(plain) > 50 and double == [2 * px for px in plain]
    assert min(int(px) for px in re.findall(r"font-size: (\d+)px", stylesheet(LIGHT))) == LIGHT.small


@pytest.mark.parametrize(
    ("size", "scale", "least"),
    [
        ((1280, 720), 1, 11),
        ((1920, 1080), 1, 11),
        ((2560, 1440), 4 / 3, 14),
        ((3840, 2160), 2, 20),
        ((800, 8000), 1, 11),
    ],
)
def test_a_larger_screen_has_larger_type(size, scale, least):
    """14 px at 2560 × 1440 and 20 px at 3840 × 2160 are what can be read there from an arm's length."""
    assert screen_scale(QSize(*size)) == pytest.approx(scale)
    assert tokens("light", scale=screen_scale(QSize(*size))).small >= least


def test_a_stroke_never_vanishes():
    assert replace(LIGHT, scale=0.5).px(1) == 1
