"""A page whose answer is a size or a place holds its scale: what is painted changes by the ratio that it claims."""

import numpy as np
import pyqtgraph
import pytest
from PySide6.QtGui import QImage

from p2sf.errors import P2SFError
from p2sf_explorer.charts.chart import Chart
from p2sf_explorer.compute.framing import light_circle
from p2sf_explorer.compute.live import live
from p2sf_explorer.course.lectures import FOLDER as COURSE_FOLDER
from p2sf_explorer.lessons.changes import LessonError, apply_changes, read_changes
from p2sf_explorer.lessons.claims import measure_claim
from p2sf_explorer.lessons.lesson import FOLDER as LESSON_FOLDER
from p2sf_explorer.lessons.lesson import lesson_files, read_lesson
from p2sf_explorer.lessons.making.recording import written_changes
from p2sf_explorer.state.limits import HOLDABLE
from p2sf_explorer.state.link import link, state_of_link
from p2sf_explorer.state.state import State, change, new_state
from p2sf_explorer.store.store import Store
from tests.support.windows.windows import at_rest

LESSONS = {path.stem: read_lesson(path) for folder in (LESSON_FOLDER, COURSE_FOLDER) for path in lesson_files(folder)}
SIZES = "airy_radius_um", "radius_80_um"
SHOWN = 0.86  # of the light within the held square at least: `SHARE` in a circle, less what a square about it cuts
COMPARED = [
    pytest.param(LESSONS[name].state(number), claim, id=f"{name}-{number + 1}-{claim.text}")
    for name, lesson in LESSONS.items()
    for number, step in enumerate(lesson.steps)
    for claim in step.claims
    if claim.measure in (*SIZES, "centroid_y_um") and claim.how == "/" and lesson.state(number).display.stage == "psf"
]


def painted(window, qtbot, state: State) -> QImage:
    """Return the plot on the stage, within its axes, as it is painted for a state at rest."""
    window.store.replace(state)
    at_rest(window, qtbot)
    chart = window.panels[state.display.stage].widget.findChild(type(window.panels["psf"].map.chart))
    return chart.grab(chart.area.toRect()).toImage().convertToFormat(QImage.Format.Format_RGB32)


def lightness(image: QImage) -> np.ndarray:
    """Return the sum of red, green and blue of every pixel, rows downwards."""
    pixels = np.frombuffer(image.constBits(), np.uint8).reshape(image.height(), image.bytesPerLine() // 4, 4)
    return pixels[:, : image.width(), :3].sum(2, dtype=int)


def half_width(image: QImage) -> int:
    """Return how many pixels of the middle row are at least half as light as the middle, in one run about it.

    The middle is the chief ray, where a lens without coma has its peak.
    """
    row = lightness(image)[image.height() // 2]
    middle = image.width() // 2
    dark = np.flatnonzero(row < row[middle] / 2)
    return int(dark[dark > middle].min() - dark[dark < middle].max() - 1)


@pytest.mark.parametrize(
    ("name", "number", "before", "after", "claimed"),
    [
        ("lecture_1", 2, 6.0, 12.0, 2.0),  # "twice as wide"
        ("02_diffraction", 1, 6.0, 24.0, 4.0),  # "to f/24": the disc grows in proportion
        ("02_diffraction", 1, 6.0, 12.0, 2.0),
        ("check_before", 1, 6.0, 12.0, 2.0),
        ("check_after", 1, 6.0, 12.0, 2.0),
    ],
)
def test_the_painted_disc_grows_as_the_page_says(window, qtbot, name, number, before, after, claimed):
    """A twentieth or a pixel is asked, of a disc some tens of pixels wide; its rings are darker than half."""
    state = LESSONS[name].state(number)
    small, large = (half_width(painted(window, qtbot, change(state, f_number=value))) for value in (before, after))
    assert small > 10 and large / small == pytest.approx(claimed, rel=max(0.05, 1 / small))


def test_the_painted_fan_falls_to_an_eighth(window, qtbot):
    """Third order: the miss grows with the cube of the aperture; its curve is orange at the right edge of the pupil."""

    def height(image: QImage) -> int:
        colours = [[image.pixelColor(x, y) for y in range(image.height())] for x in range(image.width() - 40)]
        orange = [(x, y) for x, column in enumerate(colours) for y, c in enumerate(column) if c.red() > c.blue() + 120]
        rows = [y for _, y in orange]
        return max(rows) - min(rows)

    state = LESSONS["lecture_2"].state(2)
    wide, narrow = (height(painted(window, qtbot, change(state, f_number=value))) for value in (6.0, 12.0))
    assert wide > 200 and wide / narrow == pytest.approx(8.0, rel=1.5 / narrow)  # a line of two pixels


@pytest.mark.slow
@pytest.mark.parametrize(("state", "claim"), COMPARED)
def test_what_a_page_compares_stands_on_one_scale_and_is_in_view(window, qtbot, state, claim):
    """Micrometres of the sensor in a pixel of the screen, and the light that the square of the panel shows."""
    scales = []
    for changes in (claim.first, claim.second):
        painted(window, qtbot, apply_changes(state, changes))
        chart, live = window.panels["psf"].map.chart, window.live
        scales.append(chart.per_pixel())
        light = light_circle(live.psf.values, live.psf.pixel_um, live.airy_radius_um)
        for at, (low, high) in zip((light.x_um, light.y_um), chart.ranges(), strict=True):
            assert low <= at - SHOWN * light.radius_um and at + SHOWN * light.radius_um <= high
    assert scales[0] == scales[1]


def grab_of(chart) -> np.ndarray:
    """Return where on the scale of its greys each pixel of the plot stands, 0 to 1."""
    image = chart.grab(chart.area.toRect()).toImage().convertToFormat(QImage.Format.Format_RGB32)
    greys = pyqtgraph.colormap.get("CET-L1").getLookupTable(nPts=255, alpha=False).sum(1)
    return np.interp(lightness(image), greys, np.linspace(0, 1, len(greys)))


GREYS = 254  # steps of the scale


def painted_figure(window, qtbot, state: State, measure: str) -> float:
    """Return what a person with a ruler reads off the picture, in pixels.

    In grey the square root of the light is painted. The ring is what differs with its curve and without it.
    """
    painted(window, qtbot, change(state, colours="grey"))
    panel = window.panels["psf"]
    chart, with_ring = panel.map.chart, grab_of(panel.map.chart)
    for curve in (panel.airy, panel.arrow):
        curve.set_data([], [])
    plain = grab_of(chart)
    if measure == "airy_radius_um":
        ring = np.flatnonzero(with_ring[len(plain) // 2] != plain[len(plain) // 2])
        return (ring.max() - ring.min()) / 2
    step = plain * GREYS  # a grey stands for roots of the light from one step to the next: the mean of their squares
    light, (rows, columns) = step**2 + step + 1 / 3, np.indices(plain.shape)
    y, x = (float((light * at).sum() / light.sum()) for at in (rows, columns))
    if measure == "centroid_y_um":
        return float(chart.to_pixels(0.0, 0.0)[1]) - chart.area.top() - 0.5 - y
    away = np.hypot(rows - y, columns - x).ravel()
    order = away.argsort()
    psf, ((left, right), (low, high)) = window.live.psf, chart.ranges()
    seen = (psf.x_um >= left) & (psf.x_um <= right), (psf.y_um >= low) & (psf.y_um <= high)
    share = float(psf.energy) * psf.values[np.ix_(*reversed(seen))].sum()  # of all light; the rest lies beyond the axes
    return float(away[order][np.searchsorted(light.ravel()[order].cumsum(), 0.8 / share * light.sum())])


@pytest.mark.slow
@pytest.mark.parametrize(("state", "claim"), COMPARED)
def test_what_is_painted_changes_by_the_ratio_that_is_claimed(window, qtbot, state, claim):
    """By a twentieth, or a pixel where that is more, as a hall can see."""
    first, second = (
        painted_figure(window, qtbot, apply_changes(state, changes), claim.measure)
        for changes in (claim.first, claim.second)
    )
    claimed = claim.number if claim.relation == "is" else measure_claim(claim, state)
    assert first / second == pytest.approx(claimed, rel=max(0.05, 1 / min(abs(first), abs(second))))


HELD = [
    pytest.param(LESSONS[name].state(number), id=f"{name}-{number + 1}")
    for name, lesson in LESSONS.items()
    for number in range(len(lesson.steps))
    if "psf" in dict(lesson.state(number).display.held_scales)
]


@pytest.mark.parametrize("state", HELD)
def test_what_a_page_begins_with_is_within_its_held_scale(state):
    found, half = live(state), dict(state.display.held_scales)["psf"]
    light = light_circle(found.psf.values, found.psf.pixel_um, found.airy_radius_um)
    assert max(abs(light.x_um), abs(light.y_um)) + SHOWN * light.radius_um <= half


def test_the_padlock_lets_go_in_the_state_too_until_another_page_holds_a_scale(window, qtbot):
    lesson, chart = LESSONS["02_diffraction"], window.panels["psf"].map.chart
    painted(window, qtbot, lesson.state(1))
    assert chart.locked and chart.x_axis.shown == (-36.0, 36.0)
    chart.turn_lock("xy")
    assert window.store.state.display.held_scales == ()
    painted(window, qtbot, change(window.store.state, f_number=20.0))
    assert not chart.locked and chart.x_axis.shown != (-36.0, 36.0)
    painted(window, qtbot, lesson.state(2))
    assert chart.locked and chart.y_axis.shown == (-9.0, 9.0)
    painted(window, qtbot, lesson.state(0))
    assert not chart.locked


def test_a_held_scale_ends_with_its_lesson_and_with_another_lens(window):
    """Also in a window that began inside the lesson, where nothing was before."""
    window.store.take_over(Store(LESSONS["14_hubble"].state(1)))
    window.teaching.leave()
    assert not window.store.state.lesson.name and window.store.state.display.held_scales == ()
    window.store.replace(LESSONS["lecture_1"].state(2))
    window.commands.open_lens("cooke_triplet")
    assert window.store.state.display.held_scales == ()


def test_a_held_scale_is_written_and_read_back():
    held = new_state(held_scales=(("psf", 30.0), ("ray_fan", 1.5)))
    assert written_changes(State(), held) == "held_scales psf 30+ray_fan 1.5"
    assert apply_changes(State(), read_changes("held_scales psf 30+ray_fan 1.5", 1, "")) == held
    assert apply_changes(held, read_changes("held_scales none", 1, "")) == State()
    assert state_of_link(link(held)) == held


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        ("psf", "is not a scale to hold"),
        ("mtf 30", "give pairs such as psf 30, of psf, spot"),
        ("psf 0", "end of the axes is 0"),
        ("psf nan", "end of the axes is nan"),
        ("psf 3+psf 4", "name each panel once"),
    ],
)
def test_a_scale_that_cannot_be_held_is_a_sentence(wrong, said):
    with pytest.raises(LessonError, match=said):
        read_changes(f"held_scales {wrong}", 1, "")


def test_every_panel_whose_scale_can_be_held_has_one_chart_to_hold(window):
    for key in HOLDABLE:
        window.open_panel(key)
        assert len(window.panels[key].widget.findChildren(Chart)) == 1, key


@pytest.mark.parametrize("wrong", [30.0, ("psf", 30.0), (("psf", "30"),), (("psf", 30.0, 1.0),)])
def test_a_file_may_not_hold_anything_else(wrong):
    with pytest.raises(P2SFError, match=r"held_scales is|end of the axes is"):
        new_state(held_scales=wrong)
