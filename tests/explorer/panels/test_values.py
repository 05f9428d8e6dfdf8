"""What plots say under the pointer is the function behind them, to the digits printed.

The pointer is moved over each plot, the text beside it is read back, and the function is called anew through p2sf at
the place that is said, with the arguments that the state stands for; nothing is taken from the plot's own data.
"""

import re
from math import inf

import numpy as np
import pytest
from PySide6.QtCore import QPoint, QPointF
from PySide6.QtWidgets import QApplication
from scipy.special import j1

import p2sf
from p2sf.conventions import slope_from_degrees
from p2sf.disc.quadrature import disc_nodes
from p2sf.disc.zernike_terms import zernike_terms, zernike_values
from p2sf.figures.fans import opd_fan, ray_fan
from p2sf.figures.perfect import airy_radius_um
from p2sf.figures.spot import spot
from p2sf.lens.source import Source
from p2sf.paraxial.pupils import paraxial_rays
from p2sf.paraxial.seidel import chromatic_sums, coefficients, seidel_sums
from p2sf.paraxial.wavefront import wavefront
from p2sf.psf.huygens import huygens_psf
from p2sf.psf.seidel import seidel_psf
from p2sf.raytrace.field_curves import colour_shift, heights, real_foci, seidel_foci
from p2sf.raytrace.pencil import pencil
from p2sf_explorer.charts.chart import Chart
from p2sf_explorer.compute.live import live
from p2sf_explorer.compute.reference import REFERENCE_TOLERANCE, measure
from p2sf_explorer.compute.setup import paraxial_setup
from p2sf_explorer.state.state import new_state
from p2sf_explorer.state.workspaces import on_stage
from tests.support.windows.windows import at_rest

STATE = new_state(method="seidel", theme="light", f_number=8.0, field_deg=5.0, psf_units="peak", phase="waves")
PLACES = ((0.5, 0.5), (0.37, 0.45), (0.61, 0.58), (0.29, 0.7), (0.8, 0.3))
NUMBER = re.compile(r"(−?\d+(?:\.\d+)?)(?:·10([⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+))?")
LOWERED = str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789")


@pytest.fixture(scope="module")
def setup():
    return paraxial_setup(STATE)


def printed(text: str) -> tuple[float, float]:
    """Return a number as it is written, and half a unit of its last digit."""
    digits, power = NUMBER.search(text).groups()
    scale = 10.0 ** int((power or "0").translate(LOWERED))
    digits = digits.replace("−", "-")
    return float(digits) * scale, 0.5 * scale * 10.0 ** -len(digits.partition(".")[2])


def readings(window, qtbot, key: str, number: int = 0, stage: bool = False):
    """Yield what is said at several places of a panel's plot, the pointer being moved there."""
    window.store.replace(STATE)
    window.open_panel(key)
    if stage:  # where there is room for every plot
        window.store.update(**on_stage(window.store.state.display, key))
    at_rest(window, qtbot)
    QApplication.processEvents()
    charts = [chart for chart in window.panels[key].widget.findChildren(Chart) if chart.isVisible()]
    chart, seen = charts[number], 0
    for across, up in PLACES:
        area = chart.area
        at = QPointF(area.left() + across * area.width(), area.bottom() - up * area.height()).toPoint()
        qtbot.mouseMove(chart, at + QPoint(1, 1))
        qtbot.mouseMove(chart, at)
        if found := chart.crosshair():
            seen += 1
            yield found
    chart.hand.point(None)
    assert seen >= 2


def agree(text: str, truth: float, round_off: float = 1e-9) -> None:
    """Assert that a printed number is the truth, rounded; ``round_off`` is what two ways of computing differ by."""
    value, half = printed(text)
    assert value == pytest.approx(float(truth), abs=half * (1 + 1e-6) + float(round_off)), text


def test_psf(window, qtbot, setup):
    """The same sum of waves over the same window, made again: its samples are where the reading says they are."""
    heat = window.panels["psf"].map
    for reading in readings(window, qtbot, "psf"):
        count, pitch = len(heat.values), heat.rect_shown[2] / len(heat.values)
        psf = seidel_psf(setup.coefficients, count, pitch, "settled")
        row, column = round(reading.y / pitch) + count // 2, round(reading.x / pitch) + count // 2
        assert (psf.x_um[column], psf.y_um[row]) == pytest.approx((reading.x, reading.y), abs=1e-6)
        agree(reading.values[0].text, psf.values[row, column] / psf.values.max(), 1e-6)  # shown in float32
        x, y = (printed(part) for part in reading.head.split(","))
        assert (x[0], y[0]) == pytest.approx((reading.x, reading.y), abs=max(x[1], y[1]) * 1.001)


def test_pupil(window, qtbot, setup):
    for reading in readings(window, qtbot, "pupil"):
        if reading.x**2 + reading.y**2 < 1:
            waves = wavefront(setup.coefficients, np.array([reading.x]), np.array([reading.y]))
            agree(reading.values[0].text, waves[0], 1e-6)


def field_at(setup, x_um: float, y_um: float, count: int = 240) -> float:
    """Return |field|² at a point over the unaberrated peak: a plain sum over the disc, many nodes."""
    c, nodes = setup.coefficients, disc_nodes(count, count)
    scale = -float(c.reduced_slope) / float(c.wavelength_um)
    waves = wavefront(c, nodes.xi, nodes.eta)
    total = 0.0 + 0.0j
    for side in (-1, 1):  # the nodes are one half of a pupil that is even in ξ
        total += (
            nodes.weight * np.exp(2j * np.pi * (waves + scale * (side * nodes.xi * x_um + nodes.eta * y_um)))
        ).sum()
    return float(abs(total / (2 * nodes.weight.sum())) ** 2)


def test_profiles(window, qtbot, setup):
    line = np.linspace(-30, 30, 2401)
    peak = max(
        field_at(setup, x, y)
        for x, y in [*((v, 0.0) for v in line[1000:1401:4]), *((0.0, v) for v in line[1000:1401:4])]
    )
    for reading in readings(window, qtbot, "profiles"):
        _, along_x, along_y = reading.values
        agree(along_x.text, field_at(setup, reading.x, 0.0) / peak, 2e-4)  # the live sum keeps 1e-4 of the peak
        agree(along_y.text, field_at(setup, 0.0, reading.x) / peak, 2e-4)


def test_energy_within(window, qtbot, setup):
    for reading in readings(window, qtbot, "profiles", 1):
        found = p2sf.Camera(setup.lens, aim="stop").at(setup.source).energy([reading.x], method="seidel")
        agree(reading.values[1].text, found.fraction[0], 1e-4)


def test_mtf(window, qtbot, setup):
    for reading in readings(window, qtbot, "mtf"):
        found = p2sf.Camera(setup.lens, aim="stop").at(setup.source).mtf([reading.x], method="seidel")
        agree(reading.values[1].text, found.sagittal[0], 1e-6)
        agree(reading.values[2].text, found.tangential[0], 1e-6)


def test_spot(window, qtbot, setup):
    rays = spot(setup.lens, setup.source)
    landed = np.stack([rays.x_um, rays.y_um], axis=-1)
    for reading in readings(window, qtbot, "spot"):
        near = landed[np.nanargmin(np.hypot(*(landed - (reading.x, reading.y)).T))]
        for value, truth in zip(reading.values, near, strict=True):
            agree(value.text, truth)


@pytest.mark.parametrize(("key", "function"), [("ray_fan", ray_fan), ("opd_fan", opd_fan)])
def test_fans(window, qtbot, setup, key, function):
    for reading in readings(window, qtbot, key):
        fan = function(setup.lens, setup.source, 41)
        place = int(np.abs(fan.pupil - reading.x).argmin())
        assert fan.pupil[place] == pytest.approx(reading.x)
        agree(reading.values[0].text, fan.sagittal[place])
        agree(reading.values[1].text, fan.tangential[place])


def test_seidel(window, qtbot, setup):
    sums = seidel_sums(setup.lens, setup.rays, setup.source.field_slope)
    colour = chromatic_sums(setup.lens, setup.rays, 0.4861327, 0.6562725, setup.source.field_slope)
    waves = 1e3 / setup.source.wavelength_um
    columns = {
        "W40": sums.spherical / 8,
        "W31": sums.coma / 2,
        "W22": sums.astigmatism / 2,
        "Petzval": sums.petzval / 4,
    }
    columns |= {"W20": (sums.astigmatism + sums.petzval) / 4, "W11": sums.distortion / 2}
    columns |= {"C I": colour.axial / 2, "C II": colour.lateral}
    for reading in readings(window, qtbot, "seidel"):
        value = reading.values[0]
        column = columns[value.name] * waves
        surface = re.search(r"\d+", reading.head)
        agree(value.text, column[int(surface[0]) - 1] if surface else column.sum(), 1e-4)  # F and C to seven digits


def test_zernike(window, qtbot, setup):
    """By projection on each of Noll's terms, orthonormal over the disc, and not by a decomposition."""
    nodes, terms = disc_nodes(60, 60), zernike_terms("noll", 37)
    values = zernike_values(terms, nodes.xi, nodes.eta)
    found = values @ (nodes.weight * wavefront(setup.coefficients, nodes.xi, nodes.eta))
    for reading in readings(window, qtbot, "zernike"):
        number = round(reading.x)
        agree(reading.values[0].text, found[number - 1] if terms[number - 1].even else 0.0, 1e-9)


def test_field_curves(window, qtbot, setup):
    for reading in readings(window, qtbot, "field"):
        slope = float(slope_from_degrees(reading.y))
        c = coefficients(setup.lens, inf, slope, setup.source.wavelength_um, setup.stop)
        third, real = seidel_foci(c), real_foci(setup.lens, setup.source, np.array([slope]), setup.stop)
        truths = (third.sagittal, third.tangential, real.sagittal[0], real.tangential[0])
        for value, truth in zip(reading.values, truths, strict=True):
            agree(value.text, truth, 1e-7)


def test_distortion(window, qtbot, setup):
    for reading in readings(window, qtbot, "field", 1):
        found = heights(setup.lens, setup.source, np.array([float(slope_from_degrees(reading.y))]), setup.stop)
        agree(reading.values[0].text, 100 * float(found.third_order_distortion[0]), 1e-7)
        agree(reading.values[1].text, 100 * float(found.distortion[0]), 1e-7)


def test_chromatic(window, qtbot, setup):
    for reading in readings(window, qtbot, "chromatic"):
        found = colour_shift(setup.lens, inf, np.array([reading.x / 1000]), (0.0, 0.7, 1.0), setup.stop)
        for value, truth in zip(reading.values, 1e3 * found[:, 0], strict=True):
            agree(value.text, truth, 1e-6)


def test_ybar(window, qtbot, setup):
    rays = setup.rays
    for reading in readings(window, qtbot, "ybar"):
        k = (
            len(rays.y)
            if "Sensor" in reading.head or "sensor" in reading.head
            else int(re.search(r"\d+", reading.head)[0]) - 1
        )
        reach = setup.lens.sensor_mm / rays.index[-1] if k == len(rays.y) else 0.0
        last = min(k, len(rays.y) - 1)
        agree(reading.values[0].text, setup.source.field_slope * (rays.chief_y[last] + reach * rays.chief_nu[-1]))
        agree(reading.values[1].text, rays.y[last] + reach * rays.nu[-1])


def test_depth_of_field(window, qtbot, setup):
    """The cone of a point on the axis has the diameter 2|y| on the sensor; y from the paraxial equations by hand."""
    for reading in readings(window, qtbot, "depth_of_field"):
        depth = 1 / reading.x if reading.x else inf
        rays = paraxial_rays(setup.lens, depth, setup.source.wavelength_um, setup.stop)
        height = rays.y[-1] + setup.lens.sensor_mm / rays.index[-1] * rays.nu[-1]
        agree(reading.values[0].text, 2e3 * abs(float(height)), 1e-6)


def test_database(window, qtbot, setup):
    for reading in readings(window, qtbot, "database"):
        depth = 1000 / reading.x if reading.x else inf
        slope = float(slope_from_degrees(reading.y))
        c = coefficients(setup.lens, depth, slope, setup.source.wavelength_um, setup.stop)
        agree(reading.values[0].text, c.w22, 1e-7)


def test_perfect_lens(window, qtbot, setup):
    """The Airy pattern (2J₁(v)/v)², from scipy."""
    radius = float(airy_radius_um(setup.source.wavelength_um, setup.coefficients.na))
    for reading in readings(window, qtbot, "beside", 1):
        v = 3.8317059702 * np.hypot(reading.x, reading.y) / radius
        agree(reading.values[0].text, (2 * j1(v) / v) ** 2 if v else 1.0, 1e-5)  # drawn from a table of radii


def test_through_focus(window, qtbot, setup):
    """A picture's sample is that of the PSF of the shifted sensor, over the perfect peak."""
    for reading in readings(window, qtbot, "through_focus"):
        shift, x, y = (printed(part)[0] for part in re.findall(r"−?\d[\d.]*", reading.head)[:3])
        window_of_one = window.panels["through_focus"].found[0].window
        moved = paraxial_setup(new_state(method="seidel", f_number=8.0, field_deg=5.0, sensor_shift_um=shift))
        psf = seidel_psf(moved.coefficients, *window_of_one, "preview")
        row, column = (round(v / psf.pixel_um) + len(psf.values) // 2 for v in (y, x))
        truth = psf.values[row, column] * float(psf.sum_over_peak)
        agree(reading.values[0].text, truth, 1e-3 * max(truth, 1e-6))  # the shift is said to a tenth of a µm


def test_field_map(window, qtbot, setup):
    """The middle column of a map stands on its head or on its feet, so that its samples are those of the PSF."""
    for reading in readings(window, qtbot, "field_map"):
        across, up, x, y = (float(part) for part in re.findall(r"-?\d[\d.]*", reading.head.replace("−", "-"))[:4])
        panel = window.panels["field_map"]
        asked = panel.found[0]
        if across or not up:
            continue
        slope = np.hypot(across, up) * asked.corner_slope
        c = coefficients(setup.lens, inf, slope, setup.source.wavelength_um, setup.stop)
        psf = seidel_psf(c, *asked.window, "preview")
        row, column = (round(np.sign(up) * v / psf.pixel_um) + len(psf.values) // 2 for v in (y, x))
        agree(reading.values[0].text, psf.values[row, column] / psf.values.max(), 1e-3)  # the place is said to 3 digits


def test_atlas(window, qtbot, setup):
    """A cell's sample is that of the PSF of its depth and field over its peak, where it says that it is."""
    for reading in readings(window, qtbot, "database", 2, stage=True):
        atlas = window.panels["database"]._answer.atlas
        column, row = round(reading.values[0].mark[0] if reading.values[0].mark else reading.x), round(reading.y)
        depth, field = float(atlas.depths_mm[column]), float(atlas.fields_deg[row])
        c = coefficients(setup.lens, depth, slope_from_degrees(field), setup.source.wavelength_um, setup.stop)
        size = atlas.psfs.shape[-1]
        psf = seidel_psf(c, size, atlas.pixel_um, "preview")
        x, y = (printed(part)[0] for part in re.findall(r"−?\d[\d.]*(?: µm)?", reading.head.split(": ")[1])[:2])
        at = tuple(round(v / atlas.pixel_um) + size // 2 for v in (y, x))
        agree(reading.values[0].text, psf.values[at] / psf.values.max(), 2e-3)  # previews keep some 1e-3 of the peak


def test_accuracy(window, qtbot, setup):
    """The difference map says the picture less the Huygens sum, both made again, in percent of the reference's peak."""
    window.store.replace(STATE)
    window.open_panel("accuracy")
    made = measure(live(STATE), False, lambda: False, lambda part: None)
    panel = window.panels["accuracy"]
    panel.show_accuracy(made, stale=False)
    QApplication.processEvents()
    count, pitch = made.reference.values.shape[0], made.reference.pixel_um
    reference = huygens_psf(setup.lens, setup.source, count, pitch, REFERENCE_TOLERANCE)
    picture = seidel_psf(setup.coefficients, count, pitch, "settled")
    chart = panel.difference.chart
    for across, up in PLACES:
        area = chart.area
        at = QPointF(area.left() + across * area.width(), area.bottom() - up * area.height())
        reading = chart.read(*chart.from_pixels(at))
        row, column = (round(v / pitch) + count // 2 for v in (reading.y, reading.x))
        truth = (picture.values[row, column] - reference.values[row, column]) / reference.values.max()
        agree(reading.values[0].text, 100 * truth, 1e-2)  # the sums differ by what either is known to
    panel.body.setVisible(False)
    panel.empty.setVisible(True)


def test_overlays(window, qtbot, setup):
    """Each field's MTF by a call of its own."""
    for reading in readings(window, qtbot, "curves"):
        for value in reading.values:
            field, direction = value.name.split("° ")
            source = Source(field_deg=float(field), wavelength_nm=1000 * setup.source.wavelength_um)
            found = p2sf.Camera(setup.lens, aim="stop").at(source).mtf([reading.x], method="seidel")
            agree(value.text, getattr(found, direction)[0], 1e-6)


def test_matrix(window, qtbot, setup):
    """Each tile's sample is that of its field's and colour's PSF, as light per area."""
    window.store.replace(STATE)
    window.open_panel("matrix")
    at_rest(window, qtbot)
    QApplication.processEvents()
    charts = [chart for chart in window.panels["matrix"].widget.findChildren(Chart) if chart.isVisible()]
    points = [(field, nm) for field in (0.0, 10.0, 14.0) for nm in (486.1327, 587.5618, 656.2725)]
    assert len(charts) == len(points)
    for chart, (field, nm) in zip(charts, points, strict=True):
        c = coefficients(setup.lens, inf, float(slope_from_degrees(field)), nm / 1000, setup.stop)
        _, _, wide, _ = chart.samples.rect
        count = len(chart.samples.values)
        psf = seidel_psf(c, count, wide / count, "settled")
        for across, up in PLACES:
            reading = chart.read(across * wide - wide / 2, up * wide - wide / 2)
            row, column = (round(v / psf.pixel_um) + count // 2 for v in (reading.y, reading.x))
            truth = psf.values[row, column] * psf.energy / psf.pixel_um**2
            agree(reading.values[0].text, truth, 1e-4 * psf.values.max() / psf.pixel_um**2)  # tiles keep 1e-4 of a peak


def test_lateral_colour(window, qtbot, setup):
    """Where chief rays land beside that of the shown wavelength."""

    def landing(um: float) -> float:
        return 1e3 * float(pencil(setup.lens, Source(inf, setup.source.field_slope, um), [0.0], [0.0]).chief_y.item())

    for reading in readings(window, qtbot, "colour", 1):
        shift = landing(reading.x / 1000) - landing(setup.source.wavelength_um)
        agree(reading.values[0].text, shift, 1e-4)


def test_layout(window, qtbot, setup):
    """The chief ray passes through the middle of the stop and lands where the image height is said to be."""
    list(readings(window, qtbot, "layout"))
    chart = window.panels["layout"].widget.findChildren(Chart)[0]
    places = np.cumsum([0.0, *(surface.thickness for surface in setup.lens.surfaces[:-1])])
    height = float(pencil(setup.lens, setup.source, [0.0], [0.0]).chief_y.item())
    for z, truth in ((places[setup.lens.stop_surface - 1], 0.0), (places[-1] + setup.lens.sensor_mm, height)):
        agree(chart.read(z, 0.0).values[0].text, truth, 1e-6)
