"""Vignetting factors become rims, and solves numbers: against rays of a tracer of circles in one plane, by hand."""

from math import asin, copysign, cos, hypot, inf, radians, sin, sqrt, tan

import numpy as np
import pytest

from p2sf.errors import LensFileError
from p2sf.lens.lens import Lens, indices
from p2sf.lens.source import Source
from p2sf.raytrace.pencil import pencil
from tests.support.lenses.lens_files import read

FILES = "vignetted.seq", "vignetted.zmx"
FIELDS = {0.0: (0.0, 0.0), 7.0: (0.15, 0.10), 12.0: (0.35, 0.25)}  # degrees: parts of the radius lost above and below
NM = 587.5618


def rows_of(lens: Lens) -> list[tuple[float, float, float, float]]:
    """Return radius, thickness, rim and index behind each surface, as the tracer below takes them."""
    index = indices(lens, NM / 1000)[1:]
    return [(s.radius, s.thickness, s.semi_diameter, float(n)) for s, n in zip(lens.surfaces, index, strict=True)]


def paraxial(rows, y: float, u: float, last: int | None = None) -> tuple[float, float]:
    """Return height at and slope behind the last of some surfaces of a ray in air, y and u at the first."""
    n = 1.0
    for place, (radius, _, _, behind) in enumerate(rows[:last]):
        if place:
            y += rows[place - 1][1] * u
        u = (n * u - y * (behind - n) / radius) / behind
        n = behind
    return y, u


def passes(rows, y: float, angle: float, skip: int) -> bool:
    """Return whether a ray from (0, y) in the plane of the first vertex meets every circle within its rim.

    Points and directions are complex numbers z + iy.
    """
    n, place, way = 1.0, complex(0, y), complex(cos(angle), sin(angle))
    for number, (radius, thickness, rim, behind) in enumerate(rows, 1):
        if radius < inf:
            towards = (place - radius) * way.conjugate()  # from the circle's middle, along the ray and across
            place += way * (-towards.real - copysign(sqrt(radius**2 - towards.imag**2), radius))
            normal = (radius - place) / radius
        else:
            place, normal = place - way * (place.real / way.real), complex(1, 0)
        if number != skip and abs(place.imag) > rim:
            return False
        across = n / behind * (way * normal.conjugate()).imag  # Snell's law: the sine to the normal
        way, n = normal * complex(sqrt(1 - across**2), across), behind
        place -= thickness
    return True


@pytest.mark.parametrize("name", FILES)
@pytest.mark.parametrize("angle", FIELDS)
def test_the_rims_of_factors_end_the_pupil_where_these_end_it(name, angle):
    """By another tracer, through the paraxial entrance pupil; its aberration shifts the ends by some hundredths."""
    lens = read(name).lens
    rows, slope, (upper, lower) = rows_of(lens), tan(radians(angle)), FIELDS[angle]
    at_stop, _ = paraxial(rows, 1.0, 0.0, lens.stop_surface)
    beside, _ = paraxial(rows, 0.0, 1.0, lens.stop_surface)
    pupil, half = beside / at_stop, 5.0  # EPD 10
    along = np.linspace(-1, 1, 801)
    open_at = along[[passes(rows, half * eta - pupil * slope, radians(angle), lens.stop_surface) for eta in along]]
    assert open_at.max() == pytest.approx(1 - upper, abs=0.06) and open_at.min() == pytest.approx(lower - 1, abs=0.06)
    rays = pencil(lens, Source(field_deg=angle), 0 * along, along, clip=True).passed
    assert (along[rays].max(), along[rays].min()) == pytest.approx((open_at.max(), open_at.min()), abs=0.03)


@pytest.mark.parametrize("name", FILES)
def test_factors_and_rims_are_told_with_how_far_they_agree(name):
    report = read(name).report
    (note,) = (note for note in report.notes if "missed" in note.message.values)
    assert note.kind == "read" and note.message.values["missed"] <= 0.05 and note.message.values["value"] == 0.35
    assert lens_rims(read(name).lens) == set(note.message.values["surfaces"])
    stated = ("S 22.01 3.26 1.62041:60.32\n", "S 22.01 3.26 1.62041:60.32\nCIR 4.0\n") if name.endswith("seq") else None
    if stated:
        (told,) = (note for note in read(name, stated).report.notes if "missed" in note.message.values)
        assert told.kind == "caution" and told.message.values["missed"] > 0.05 and "surfaces" not in told.message.values


def lens_rims(lens: Lens) -> set[int]:
    return {number for number, s in enumerate(lens.surfaces, 1) if s.semi_diameter < inf}


@pytest.mark.parametrize(
    ("name", "change"),
    [
        ("vignetted.zmx", ("VDXN 0 0 0", "VDXN 0 0.1 0")),
        ("vignetted.zmx", ("VANN 0 0 0", "VANN 0 30 0")),
        ("vignetted.zmx", ("XFLN 0 0 0", "XFLN 0 1 0")),
        ("vignetted.zmx", ("VCYN 0 1.25E-1", "VCYN 0 1.2")),
        ("vignetted.seq", ("VLX 0.0 0.01 0.03", "VLX 0.0 0.02 0.03")),
    ],
)
def test_factors_that_no_rim_about_the_axis_gives_are_told(name, change):
    report = read(name, change).report
    (note,) = (note for note in report.of("caution") if "value" in note.message.values)
    assert "reason" in note.message.values and note.line and not lens_rims(read(name, change).lens)


@pytest.mark.parametrize("name", FILES)
def test_solves_give_the_curvature_and_the_thickness_that_are_not_stated(name):
    """A marginal ray 5 mm high that leaves at −0.1 has its focus 50 mm behind the principal plane."""
    rows = rows_of(read(name).lens)
    y, u = paraxial(rows, 5.0, 0.0)
    assert u == pytest.approx(-0.1, rel=1e-13) and rows[-1][1] == pytest.approx(-y / u, rel=1e-13)


CURVATURES = {
    "CUY UMY -0.08": lambda y, u, n, after, chief: after[1] == pytest.approx(-0.08, rel=1e-12),
    "CUY IMY 0.02": lambda y, u, n, after, chief: (
        hypot(0, n * 0.02) == pytest.approx(abs(n * (u + y * after[2])), rel=1e-12)
    ),
    "CUY UCY 0.15": lambda y, u, n, after, chief: chief == pytest.approx(0.15, rel=1e-12),
}


@pytest.mark.parametrize("command", CURVATURES)
def test_every_solve_of_a_curvature_gives_its_ray_what_it_states(command):
    rows = rows_of(read("vignetted.seq", ("CUY UMY -0.1", command), ("THI HMY 0.0", "THI 40.0")).lens)
    y, u = paraxial(rows, 5.0, 0.0, 5)
    y, n = y + rows[4][1] * u, rows[4][3]
    at_stop, beside = paraxial(rows, 1.0, 0.0, 4)[0], paraxial(rows, 0.0, 1.0, 4)[0]
    slope = tan(radians(12))
    chief = paraxial(rows, -beside / at_stop * slope, slope)[1]
    assert CURVATURES[command](y, u, n, (*paraxial(rows, 5.0, 0.0), 1 / rows[5][0]), chief)


@pytest.mark.parametrize(
    ("solve", "law"),
    [
        ("5 0 0", lambda y, u, c, n: u + y * c),  # normal incidence
        ("7 0 0", lambda y, u, c, n: (n * u - y * c * (1 - n)) / 1 - u / n),  # u'/n' = u/n
        ("11 4.0 0", lambda y, u, c, n: (n * u - y * c * (1 - n)) + 1 / 8),  # f/4: u' = −1/8
    ],
)
def test_solves_of_zemax_for_curvatures_hold_their_laws(solve, law):
    rows = rows_of(read("vignetted.zmx", ("CURV 0.0 2 -0.1 0 0", f"CURV 0.0 {solve}"), ("  MAZH 0 0\n", "")).lens)
    y, u = paraxial(rows, 5.0, 0.0, 5)
    y += rows[4][1] * u
    assert law(y, u, 1 / rows[5][0], rows[4][3]) == pytest.approx(0, abs=1e-13)


def test_the_power_of_an_element_gives_its_second_curvature():
    rows = rows_of(read("vignetted.zmx", ("CURV 0.0 2 -0.1 0 0", "CURV 0.0 8 0.03 0")).lens)
    _, u = paraxial(rows[4:], 1.0, 0.0)
    assert -u == pytest.approx(0.03, rel=1e-13)


def test_a_solve_that_the_surfaces_before_do_not_determine_is_refused_without_a_value():
    """The size of its ray follows from the f-number of the whole lens; with a value stored, this one is read."""
    without, stored = ("EPD 10.0", "FNO 5.0"), ("S 0.0 0.0\n", "S -18.4 0.0\n")
    with pytest.raises(LensFileError) as refused:
        read("vignetted.seq", without)
    assert refused.value.message.values["message"].values["surface"] == 6 and refused.value.line == 19
    assert read("vignetted.seq", without, stored).lens.surfaces[5].radius == -18.4


GLASS = "  GLAS ___BLANK 1 0 1.62041 60.32 0 0 0 0 0 0\n"
LAST_OF_GLASS = (("  CURV 0.0 2 -0.1 0 0\n", f"  CURV 0.0 8 0.03 0\n{GLASS}"),)
PUPIL_AT_THE_OBJECT = (
    ("CURV 0.0\n  DISZ INFINITY", "CURV 0.0\n  DISZ 0.0"),
    ("SURF 4\n  STOP\n", "SURF 4\n"),
    ("SURF 1\n", "SURF 1\n  STOP\n"),
)


@pytest.mark.parametrize("change", [LAST_OF_GLASS, PUPIL_AT_THE_OBJECT])
def test_a_solve_whose_surface_or_aperture_determines_nothing_is_refused(change):
    with pytest.raises(LensFileError) as refused:
        read("vignetted.zmx", *change)
    assert refused.value.message.values["message"].values["surface"] == 6


def test_a_solve_that_gives_another_number_than_the_file_is_told_and_the_file_kept():
    found = read("vignetted.seq", ("S 0.0 0.0\n", "S -20.0 41.0\n"))
    notes = [note.message.values for note in found.report.notes if "old" in note.message.values]
    assert [values["old"] for values in notes] == [pytest.approx(-0.05), 41.0]
    assert (found.lens.surfaces[5].radius, found.lens.sensor_mm) == (-20.0, 41.0)


def test_a_pickup_of_code_v_is_named():
    (note,) = read("vignetted.seq", ("GO", "PIK CUY S6 S5 -1\nGO")).report.of("caution")
    assert note.message.values == {"command": "PIK CUY S6 S5 -1"} and note.line


@pytest.mark.parametrize(("stated", "slope"), [("FNUM 4.0 1", 1 / 8), ("OBNA 0.05 0", None), ("OBNA 2.0 1", None)])
def test_apertures_of_a_finite_object_have_the_marginal_ray_that_the_file_states(stated, slope):
    """The working f-number is 1/(2|u'|); NA and cone angle are those of the ray from the object, 200 mm away."""
    change = ("ENPD 10.0", stated), ("CURV 0.0\n  DISZ INFINITY", "CURV 0.0\n  DISZ 200.0"), ("2 -0.1 0 0", "0 0 0 0")
    lens = read("vignetted.zmx", *change, ("CURV 0.0 0", "CURV -5.4E-2 0")).lens
    rows = rows_of(lens)
    at_stop, _ = paraxial(rows, 200.0, 1.0, lens.stop_surface)
    start = lens.aperture.value / abs(at_stop)
    wanted = {"OBNA 0.05 0": tan(asin(0.05)), "OBNA 2.0 1": tan(radians(2.0))}.get(stated)
    if wanted is None:
        assert abs(paraxial(rows, 200.0 * start, start)[1]) == pytest.approx(slope, rel=1e-12)
    else:
        assert start == pytest.approx(wanted, rel=1e-12)
