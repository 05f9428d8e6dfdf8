"""What a script may hand over: quantities in any unit, lists for tuples; and one sentence for all that is wrong."""

from dataclasses import replace
from math import inf, nan

import numpy as np
import pytest

import p2sf
from p2sf.glass.media import ConstantIndex
from p2sf.lens.lens import Aperture, Lens, Surface
from p2sf.parameters import LARGEST_SIDE
from p2sf_explorer.state.state import FIRST, change

LENS = p2sf.load_lens("achromat_f6")
OPENED = Aperture("stop_semi_diameter", 5.0)
SCENE = p2sf.Scene(
    p2sf.Sensor(rows=6, columns=8, pixel_um=60.0),
    channels=(p2sf.scene.scene.Channel("green", (540.0,), (1.0,)),),
    near_mm=1000,
    far_mm=5000,
    rtol=0.4,
    f_number=8,
)
PICTURE = np.ones((6, 8, 1))


@pytest.fixture(scope="module")
def planned():
    return p2sf.plan(LENS, SCENE)


def surface(**values) -> Surface:
    return Surface(**{"radius": 50.0, "thickness": 90.0, "medium": ConstantIndex(1.5)} | values)


def lens(**values) -> Lens:
    return Lens(**{"surfaces": (surface(), Surface(thickness=50.0)), "aperture": OPENED} | values)


def test_a_quantity_is_converted_to_the_unit_of_its_parameter():
    unit = pytest.importorskip("astropy.units")
    asked = p2sf.Source(3 * unit.m, field_deg=0.1 * unit.rad, wavelength_nm=0.55 * unit.um)
    assert (asked.depth_mm, asked.wavelength_um) == (3000, pytest.approx(0.55, rel=1e-15))
    assert asked.field_slope == pytest.approx(np.tan(0.1), rel=1e-15)
    both = p2sf.Source(field_deg=(3 * unit.deg, 240 * unit.arcmin))
    assert both.field_xy_deg == pytest.approx((3, 4), rel=1e-14)
    one = p2sf.render(LENS, asked, focus_mm=2 * unit.m, pixel_um=2000 * unit.nm, pixels=8, f_number=8 * unit.one)
    other = p2sf.render(LENS, asked, focus_mm=2000.0, pixel_um=2.0, pixels=8, f_number=8)
    np.testing.assert_allclose(one.values, other.values, rtol=1e-9)
    found = p2sf.Camera(LENS).at().mtf([500, 1000] / unit.cm)
    np.testing.assert_allclose(found.frequency_per_mm, [50, 100], rtol=1e-14)
    covered = p2sf.build_database(LENS, [1, 2] * unit.m, [0, 5] * unit.deg, [0.5 * unit.um, 600 * unit.nm]).meta
    assert covered["covers"]["depth_mm"] == [1000, 2000]
    assert covered["covers"]["wavelength_nm"] == pytest.approx([500, 600])
    assert p2sf.Sensor(6, 8, 0.06 * unit.mm).pixel_um == pytest.approx(60)
    assert replace(SCENE, near_mm=1 * unit.m).near_mm == 1000
    assert lens(wavelengths_nm=(0.5 * unit.um,)).wavelengths_nm == pytest.approx((500,))


@pytest.mark.parametrize(
    "call",
    [
        lambda unit: p2sf.Source(3 * unit.s),
        lambda unit: p2sf.render(LENS, f_number=3 * unit.m),
        lambda unit: p2sf.Camera(LENS).at().mtf(50 * unit.mm),
        lambda unit: p2sf.psf_of_opd(np.zeros((32, 32)) * unit.nm, 0.1, 550),
        lambda unit: surface(radius=50 * unit.s),
        lambda unit: surface(conic=1 * unit.mm),
        lambda unit: p2sf.PupilMask(zernike_um=(0, 0, 0, 1 * unit.s)),
    ],
)
def test_a_quantity_of_another_kind_is_refused(call):
    with pytest.raises(p2sf.P2SFError) as raised:
        call(pytest.importorskip("astropy.units"))
    assert raised.value.message.template == "{parameter} is {value}; give a number without a unit, in {unit}"


def test_lengths_of_a_lens_are_converted_to_millimetres():
    unit = pytest.importorskip("astropy.units")
    assert surface(radius=5 * unit.cm, thickness=90000 * unit.um) == surface()
    assert p2sf.Placement(decentre_x=0.1 * unit.mm, tilt_y_deg=30 * unit.arcmin) == p2sf.Placement(0.1, tilt_y_deg=0.5)


class Pint:
    """A quantity as pint has it: ``units``, and ``to(unit).magnitude``."""

    def __init__(self, magnitude, units):
        self.magnitude, self.units = magnitude, (units,)

    def to(self, unit):
        factors = {("m", "mm"): 1e3, ("nm", "nm"): 1.0, ("", "dimensionless"): 1.0}
        if (*self.units, unit) not in factors:
            raise TypeError(unit)
        return Pint(np.multiply(self.magnitude, factors[(*self.units, unit)]), unit)


def test_a_quantity_of_pint_is_converted_too():
    assert p2sf.Source(3 * np.float64(1), wavelength_nm=Pint(550, "nm")).wavelength_um == pytest.approx(0.55)
    camera = p2sf.Camera(LENS, focus_mm=Pint(2, "m"), f_number=Pint(8, ""))
    assert (camera.focus_mm, camera.f_number) == (2000, 8)
    assert camera.at(depth_mm=Pint([1, 2], "m")).axes["depth_mm"].tolist() == [1000, 2000]
    with pytest.raises(p2sf.P2SFError):
        p2sf.Source(Pint(3, "s"))


def test_quantities_of_pint_itself():
    unit = pytest.importorskip("pint").UnitRegistry()
    asked = p2sf.Source(3 * unit.m, field_deg=0.1 * unit.rad, wavelength_nm=0.55 * unit.um)
    assert (asked.depth_mm, asked.wavelength_um) == (3000, pytest.approx(0.55, rel=1e-15))
    assert p2sf.Camera(LENS).at().mtf(np.array([50, 100]) / unit.mm).frequency_per_mm.tolist() == [50, 100]
    with pytest.raises(p2sf.P2SFError):
        p2sf.Source(3 * unit.s)


def test_a_lens_is_made_of_names_and_numbers():
    stated = Lens((Surface(50.0, 90.0, p2sf.medium("N-BK7")), Surface(thickness=50.0)), Aperture("f_number", 8.0))
    assert Lens([Surface(50, 90, "N-BK7"), Surface(thickness=50)], 8) == stated
    assert Surface(50, 90, 1.5) == Surface(50, 90, np.float32(1.5)) == surface()
    assert Surface(medium={"nd": 1.5168, "vd": 64.17}).medium == p2sf.medium({"nd": 1.5168, "vd": 64.17})
    assert Surface(-80, -50, "mirror").reflects
    assert lens(object_medium="1.33").object_medium == ConstantIndex(1.33)


def test_lists_and_arrays_are_tuples():
    listed = lens(
        surfaces=[surface(aspheric=[1e-7]), Surface(thickness=50.0)],
        fields_deg=np.array([0.0, 5.0]),
        wavelengths_nm=[500.0, 600.0],
    )
    stated = lens(
        surfaces=(surface(aspheric=(1e-7,)), Surface(thickness=50.0)),
        fields_deg=(0.0, 5.0),
        wavelengths_nm=(500.0, 600.0),
    )
    assert listed == stated and hash(listed) == hash(stated)
    assert p2sf.PupilMask(zernike_um=np.array([0, 0.1])) == p2sf.PupilMask(zernike_um=[0, 0.1])
    assert p2sf.Sensor(6, 8, 60.0, [1.0, 2.0]) == p2sf.Sensor(6, 8, 60.0, (1.0, 2.0))


def test_one_frequency_radius_or_position_is_enough():
    np.testing.assert_array_equal(p2sf.Camera(LENS).at().mtf(50).sagittal, p2sf.Camera(LENS).at().mtf([50.0]).sagittal)
    assert p2sf.Camera(LENS).at().energy(5).fraction.shape == (1,)
    assert p2sf.Camera(LENS).at().line_spread(0).edge_x == pytest.approx(0.5, abs=1e-3)
    one = p2sf.tradeoff(LENS, depths_mm=1000, fields_deg=5, wavelengths_nm=550, methods="seidel", pixels=8)[0]
    assert (one.depth_mm, one.field_deg) == (1000, 5)


WRONG = {
    "a source that is a number": lambda: p2sf.render(LENS, 10),
    "a source for coefficients": lambda: p2sf.Camera(LENS).at("axis").coefficients(),
    "a source for a choice": lambda: p2sf.Camera(LENS).at(5).choose_method(),
    "a source for an MTF": lambda: p2sf.Camera(LENS).at(5).mtf(),
    "a depth as a text": lambda: p2sf.Source("3000"),
    "depths in a list": lambda: p2sf.Source([3000, 1000]),
    "a complex wavelength": lambda: p2sf.Source(wavelength_nm=550j),
    "an f-number as a text": lambda: p2sf.render(LENS, f_number="8"),
    "a focus as a text": lambda: p2sf.render(LENS, focus_mm="inf"),
    "a shift that is None": lambda: p2sf.render(LENS, sensor_shift_um=None),
    "a pitch as a text": lambda: p2sf.render(LENS, pixel_um="2"),
    "several pitches": lambda: p2sf.render(LENS, pixel_um=np.array([1.0, 2.0])),
    "a tolerance as a text": lambda: p2sf.render(LENS, min_r2="0.9"),
    "a clip as a text": lambda: p2sf.render(LENS, clip="no"),
    "integrated as a text": lambda: p2sf.render(LENS, integrated="no"),
    "half a term": lambda: p2sf.Camera(LENS).at().zernike(terms=3.5),
    "terms as a text": lambda: p2sf.Camera(LENS).at().zernike(terms="37"),
    "frequencies in two axes": lambda: p2sf.Camera(LENS).at().mtf([[1, 2], [3, 4]]),
    "a frequency that is NaN": lambda: p2sf.Camera(LENS).at().mtf([nan]),
    "a frequency as a text": lambda: p2sf.Camera(LENS).at().mtf("50"),
    "an angle as a text": lambda: p2sf.Camera(LENS).at().mtf(turn_deg="x"),
    "an infinite radius": lambda: p2sf.Camera(LENS).at().energy([inf]),
    "a position where the sum repeats": lambda: p2sf.Camera(LENS).at().line_spread(1e9),
    "a field as a text": lambda: p2sf.tradeoff(LENS, fields_deg=["a"]),
    "nodes as a text": lambda: p2sf.build_database(LENS, ["a"], [0], [550]),
    "complex nodes": lambda: p2sf.build_database(LENS, [1000j], [0], [550]),
    "a path that is a number": lambda: p2sf.build_database(LENS, [inf], [0], [550], path=5),
    "a stored PSF's source": lambda: p2sf.build_database(LENS, [inf], [0], [550]).psf(5),
    "stored coefficients' source": lambda: p2sf.build_database(LENS, [inf], [0], [550]).coefficients(5),
    "many sources": lambda: p2sf.build_database(LENS, [inf], [0], [550]).psf(p2sf.Source(np.array([inf, 500.0]))),
    "a file that is a number": lambda: p2sf.open_database(5),
    "a lens for a name": lambda: p2sf.load_lens(LENS),
    "a scene that is none": lambda: p2sf.plan(LENS, {}),
    "a scene for a plan": lambda: p2sf.form_image(SCENE, PICTURE),
    "an aperture as a text": lambda: p2sf.psf_of_opd(np.zeros((32, 32)), "0.1", 550),
    "surfaces that are none": lambda: lens(surfaces=(1, 2)),
    "a surface alone": lambda: lens(surfaces=surface()),
    "an aperture of 0": lambda: lens(aperture=0),
    "an aperture as a name": lambda: lens(aperture="f/8"),
    "an unknown kind of aperture": lambda: Aperture("fnumber", 8),
    "a radius as a text": lambda: surface(radius="50"),
    "a glass that nobody sells": lambda: surface(medium="N-BK77"),
    "an index of 0": lambda: surface(medium=0),
    "a medium that is none": lambda: surface(medium=None),
    "object space that is none": lambda: lens(object_medium=[1.33]),
    "a placement that is a number": lambda: p2sf.displaced(LENS, 1, 2, 0.1),
    "a tilt as a text": lambda: p2sf.Placement(tilt_x_deg="1"),
    "a setting by position": lambda: p2sf.Camera("achromat_f6", pixel_um="4"),
    "a field of three": lambda: p2sf.Source(field_deg=(1, 2, 3)),
    "an axis that is none": lambda: p2sf.Camera(LENS).at(fields_deg=[0, 5]),
    "an R² for an error": lambda: p2sf.Scene(SCENE.sensor, rtol=5),
    "two limits": lambda: p2sf.Scene(SCENE.sensor, rtol=0.1, min_r2=0.99),
    "a wavefront that is not square": lambda: p2sf.Pupil.from_opd(np.zeros((8, 9)), 0.1, 550),
    "a PSF in two rows": lambda: p2sf.fit_psf(np.zeros(9), na=0.1, wavelength_nm=550, pixel_um=1),
    "a limit of nothing": lambda: p2sf.Camera("achromat_f6").tolerances({"sharpness": 0.3}),
    "a number for a scheduler": lambda: p2sf.form_image(p2sf.plan(LENS, SCENE), PICTURE, scheduler=5),
    "a number for the scheduler of points": lambda: p2sf.Camera(LENS).at(depth_mm=[3000], scheduler=5).strehl(),
    "no pixels": lambda: p2sf.Camera("achromat_f6").photograph(PICTURE),
    "no lens": lambda: p2sf.Camera(f_number=8).at(depth_mm=3000),
    "a stop as a text": lambda: lens(stop_surface="1"),
    "a wavelength of a lens as a text": lambda: lens(wavelengths_nm=("550",)),
    "fields of a lens as a text": lambda: lens(fields_deg="5"),
    "an array for a mask": lambda: p2sf.with_mask(LENS, np.ones((8, 8))),
    "no mask": lambda: p2sf.with_mask(LENS, None),
    "a name for a lens": lambda: p2sf.lens_at("zoom", 5),
    "an array for a map": lambda: p2sf.PupilMask(phase_map=np.zeros((8, 8))),
    "an obscuration as a text": lambda: p2sf.PupilMask(obscuration="0.3"),
    "half a row": lambda: p2sf.Sensor(8.5, 10, 60.0),
    "a centre that is one number": lambda: p2sf.Sensor(8, 10, 60.0, 5.0),
    "a sensor that is a shape": lambda: p2sf.Scene((8, 10)),
    "a near end as a text": lambda: replace(SCENE, near_mm="1"),
    "no PSF to draw": lambda: p2sf.draw_psf("x.png", None),
}


@pytest.mark.parametrize("call", WRONG.values(), ids=WRONG)
def test_what_no_argument_can_be_is_one_sentence(call):
    with pytest.raises(p2sf.P2SFError):
        call()


@pytest.mark.parametrize("method", ["seidel", "traced", "auto"])
def test_more_samples_than_memory_holds_are_refused_at_once(method):
    for pixels in (LARGEST_SIDE + 1, 100_000):
        with pytest.raises(p2sf.P2SFError) as raised:
            p2sf.render(LENS, method=method, pixels=pixels)
        assert raised.value.message.values["high"] == LARGEST_SIDE
    with pytest.raises(p2sf.P2SFError):
        p2sf.psf_of_opd(np.zeros((32, 32)), 0.1, 550, pixels=100_000)


@pytest.mark.parametrize("depth", [2.0, 999.0, 5001.0, inf], ids=str)
def test_a_depth_without_kernels_is_refused(planned, depth):
    """2 mm are 2 m in the wrong unit; they used to be those of the near end."""
    depths = np.full((6, 8), 3000.0)
    depths[0, 0] = depth
    with pytest.raises(p2sf.P2SFError) as raised:
        p2sf.form_image(planned, PICTURE, depths)
    assert (raised.value.message.values["near"], raised.value.message.values["far"]) == (1000, 5000)


def test_depths_at_the_ends_of_a_scene_are_inside(planned):
    ends = np.array([1000, 5000], np.float32).repeat(24).reshape(6, 8)
    assert p2sf.form_image(planned, PICTURE, ends).shape == (6, 8, 1)


@pytest.mark.parametrize("kind", [np.uint8, np.uint16, int, complex])
def test_codes_of_srgb_are_no_linear_light(planned, kind):
    with pytest.raises(p2sf.P2SFError):
        p2sf.form_image(planned, np.full((6, 8, 1), 128).astype(kind))
    with pytest.raises(p2sf.P2SFError):
        p2sf.form_image(planned, np.ma.masked_less(PICTURE, 2))


def test_an_unknown_entry_of_the_state_is_named():
    with pytest.raises(p2sf.P2SFError) as raised:
        change(FIRST, fild_deg=5)
    assert raised.value.message.values["name"] == "fild_deg" and "field_deg" in raised.value.message.values["names"]
