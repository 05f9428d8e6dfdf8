"""Focal lengths of lenses with two meridians as every road shows them, against matrices of either meridian."""

import json
import re
from html import unescape
from math import isfinite

import numpy as np
import pytest
from PySide6.QtGui import QImage

from p2sf.cli import main
from p2sf.lensfile.toml.lens import lens_to_toml
from p2sf_explorer.charts import theme
from p2sf_explorer.compute.live import live, with_views
from p2sf_explorer.compute.setup import default_state
from p2sf_explorer.lessons.measures import MEASURES
from p2sf_explorer.panels.first_order import FirstOrderPanel
from p2sf_explorer.report.contents import report_of
from p2sf_explorer.report.writing import html_report
from p2sf_explorer.state.panels import REGISTRY, view_of
from p2sf_explorer.state.state import change
from p2sf_explorer.store.store import Store
from p2sf_explorer.widgets import readout
from p2sf_explorer.window.lens_cards import lens_card
from tests.support.lenses.anamorphs import ANAMORPH, CYLINDER, INDEX, anamorph, cylinder, figures, turned_by_breaks

LENSES = {
    "cylinder": (cylinder, CYLINDER, "yx"),
    "anamorph": (anamorph, ANAMORPH, "yx"),
    "turned": (lambda: turned_by_breaks(anamorph()), ANAMORPH, "xy"),
}


@pytest.fixture(scope="module", params=LENSES)
def written(request, tmp_path_factory):
    """Return the file of a lens, and its focal lengths in y and in x."""
    make, elements, order = LENSES[request.param]
    path = tmp_path_factory.mktemp("meridians") / f"{request.param}.toml"
    path.write_text(lens_to_toml(make()))
    return path, [figures(elements, meridian) for meridian in order]


def told(capsys, *arguments):
    assert main([*map(str, arguments), "--json"]) in (0, None)
    return json.loads(capsys.readouterr().out)


def shown(mm: float, digits: str = ".3f") -> str:
    return f"{mm:{digits}}".replace("-", "−") if isfinite(mm) else "∞"


def test_the_command_line_tells_both(written, capsys):
    path, both = written
    facts, listed = told(capsys, "info", path), told(capsys, "import", "--list", path.parent)["files"][0]
    for one, due in zip((facts, facts["in_x"]), both, strict=True):
        for name, value in due.items():
            assert one[name] == (pytest.approx(value, rel=1e-9) if isfinite(value) else None)
    for name, due in zip(("focal_length", "focal_length_x"), both, strict=True):
        focal = due["effective_focal_length"]
        assert listed[name] == (pytest.approx(focal, rel=1e-9) if isfinite(focal) else None)


def test_the_table_of_a_folder_and_the_card_show_both(written, capsys):
    path, both = written
    focal = [each["effective_focal_length"] for each in both]
    assert main(["import", "--list", str(path.parent)]) in (0, None)
    assert f"{focal[0]:.6g} in y, {focal[1]:.6g} in x" in capsys.readouterr().out
    card = lens_card(str(path)).facts
    numbers = re.match(r"f′ (\S+) × (\S+) mm", card)
    assert numbers, card
    for text, due in zip(numbers.groups(), focal, strict=True):
        assert float(text.replace("∞", "inf")) == pytest.approx(due, rel=5e-3)


@pytest.mark.parametrize(("name", "order"), [("anamorph", "yx"), ("turned", "xy")])
def test_the_panel_paints_both_and_the_report_prints_them(name, order, tmp_path, qtbot, monkeypatch):
    path = tmp_path / f"{name}.toml"
    path.write_text(lens_to_toml(LENSES[name][0]()))
    both = [figures(ANAMORPH, meridian) for meridian in order]
    entry = next(entry for entry in REGISTRY if entry.key == "first_order")
    answer = live(change(default_state(str(path)), field_deg=2.0))
    answer = with_views(answer, {entry.key: view_of(entry)}, 0.0)
    panel = FirstOrderPanel(Store(answer.state))
    qtbot.addWidget(panel.widget)
    panel.restyle(theme.tokens("light"))
    panel.show(answer)
    panel.widget.resize(1200, 400)
    painted, write = [], readout.write
    monkeypatch.setattr(readout, "write", lambda *given: (painted.append(given[2]), write(*given)))
    panel.widget.render(QImage(1200, 400, QImage.Format.Format_RGB32))
    page = unescape(html_report(report_of(change(answer.state, curves_fields_deg=(0.0, 2.0)))))
    labels = {"effective_focal_length": "Focal length f′", "front_focal_distance": "Front focus F"}
    for key, label in labels.items():
        due = f"{shown(both[0][key])} mm in y, {shown(both[1][key])} mm in x"
        assert painted[painted.index(label) + 1] == due
        assert due in page


def test_distortion_is_measured_from_rays_beside_the_axis(tmp_path):
    """In yz only the last element is bent, its vertex is the stop, and its rear is plane.

    So a chief ray of slope s crosses the glass at sin θ/n and lands at t·tan θ′ + space·s.
    """
    path = tmp_path / "anamorph.toml"
    path.write_text(lens_to_toml(anamorph()))
    _, _, thickness, space = ANAMORPH[-1]
    inside = np.tan(np.arcsin(np.sin(np.deg2rad(4.0)) / INDEX))
    slope = np.tan(np.deg2rad(4.0))
    due = 100 * ((thickness * inside + space * slope) / (slope * (thickness / INDEX + space)) - 1)
    state = change(default_state(str(path)), field_deg=4.0)
    assert MEASURES["distortion_percent"](state) == pytest.approx(due, abs=1e-5)
    assert MEASURES["focal_length_mm"](state) == pytest.approx(figures(ANAMORPH, "y")["effective_focal_length"])
