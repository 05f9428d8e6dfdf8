"""Polynomials in x and y and Zernike's as parts of surfaces: rays in forty digits, waves, methods, drawings, files."""

from dataclasses import replace

import numpy as np
import pytest
from mpmath import mpf

import p2sf
from p2sf.errors import GeometryError, LensFileError
from p2sf.glass.media import MIRROR, ConstantIndex
from p2sf.lens.freeform import XYPolynomial, ZernikeFringeSag, ZernikeStandardSag
from p2sf.lens.lens import Aperture, Lens, Surface, with_sensor
from p2sf.lens.placement import Placement
from p2sf.lens.source import Source
from p2sf.lensfile.formats.codev_writing import lens_to_seq
from p2sf.lensfile.glass_lookup import GlassSources
from p2sf.lensfile.importing import import_text
from p2sf.lensfile.source_text import LensText
from p2sf.lensfile.toml.lens import lens_to_toml, parse_toml
from p2sf.lensfile.writing import lens_to_zmx
from p2sf.raytrace.trace import trace
from tests.support.lenses.simple_lenses import in_the_stop
from tests.support.rays import freeform_rays

RNG = np.random.default_rng(29)
SHAPES = {
    "XY polynomial": XYPolynomial(tuple(RNG.uniform(-0.03, 0.03, 20)), 7.0),
    "powers of x and y": XYPolynomial((1e-3, -2e-3, 1e-4, 2e-4, -3e-4, 1e-5, 0.0, 2e-5)),
    "Zernike standard": ZernikeStandardSag(tuple(RNG.uniform(-0.01, 0.01, 13)), 9.0),
    "Zernike fringe": ZernikeFringeSag(tuple(RNG.uniform(-0.02, 0.02, 13)), 9.0),
}
GLASS = ConstantIndex(1.52)


def freeform_singlet(shape, rim: float = 4.0) -> Lens:
    surfaces = (
        Surface(thickness=3.0),
        Surface(40.0, 4.0, GLASS, conic=-0.4, aspheric=(1e-6, -1e-9), shape=shape),
        Surface(-70.0, 50.0, shape=shape.turned(40.0)),
    )
    return Lens(surfaces, Aperture("stop_semi_diameter", rim), 1)


@pytest.fixture(params=SHAPES.values(), ids=SHAPES)
def shape(request):
    return request.param


def places(count: int = 40, half: float = 6.0) -> tuple[np.ndarray, np.ndarray]:
    x, y = np.random.default_rng(1).uniform(-half, half, (2, count))
    x[:2] = 0.0
    y[:3] = 0.0
    return x, y


def test_the_sag_is_that_of_its_definition(shape):
    x, y = places()
    known = [float(freeform_rays.shape_sag(shape, mpf(a), mpf(b))) for a, b in zip(x, y, strict=True)]
    assert shape.sag_and_gradient(x, y)[0] == pytest.approx(known, abs=1e-16 * 50)


@pytest.mark.parametrize("count", range(1, 7))
def test_the_first_terms_are_powers_of_x_before_those_of_y(count):
    """Of places over the normalisation radius, by degrees: x, y, x², xy, y², x³."""
    (x, y), each = places(), np.arange(1, count + 1) * 1e-3
    u, v = x / 2, y / 2
    powers = np.stack([u, v, u * u, u * v, v * v, u**3])[:count]
    assert XYPolynomial(tuple(each), 2.0).sag_and_gradient(x, y)[0] == pytest.approx(each @ powers, abs=1e-15)


def test_the_gradient_is_the_derivative_of_the_sag(shape):
    """Central differences: the third derivative, below 0.01 per mm², adds 2e-13; rounding 1e-11."""
    (x, y), step = places(), 1e-5
    _, (across, up) = shape.sag_and_gradient(x, y)
    ahead, behind = (shape.sag_and_gradient(x + way * step, y)[0] for way in (1, -1))
    assert across == pytest.approx((ahead - behind) / (2 * step), abs=2e-10)
    ahead, behind = (shape.sag_and_gradient(x, y + way * step)[0] for way in (1, -1))
    assert up == pytest.approx((ahead - behind) / (2 * step), abs=2e-10)


def test_a_turned_shape_is_the_shape_at_turned_places(shape):
    (x, y), angle = places(), np.deg2rad(37.0)
    back = x * np.cos(angle) + y * np.sin(angle), y * np.cos(angle) - x * np.sin(angle)
    assert shape.turned(37.0).sag_and_gradient(x, y)[0] == pytest.approx(shape.sag_and_gradient(*back)[0], abs=1e-15)


def test_the_mean_is_the_mean_over_all_azimuths_but_for_piston(shape):
    theta, r = np.linspace(0, 2 * np.pi, 64, endpoint=False), np.array([1.0, 3.0, 6.0])[:, None]
    around = shape.sag_and_gradient(r * np.cos(theta), r * np.sin(theta))[0].mean(axis=1)
    piston = float(shape.sag_and_gradient(np.zeros(1), np.zeros(1))[0][0])
    mean, _ = shape.mean.sag_and_slope(r[:, 0] ** 2, 0.0)
    assert mean == pytest.approx(around - piston, abs=1e-15)


def test_rays_are_those_of_a_tracer_in_forty_digits(shape):
    """Points, directions and paths to 1e-12 mm, through glass and from a freeform mirror."""
    mirror = (Surface(-150.0, -50.0, MIRROR, shape=shape), Surface(300.0, -60.0, GLASS, shape=shape))
    for lens in (freeform_singlet(shape), Lens(mirror, Aperture("stop_semi_diameter", 6.0), 1)):
        origins = np.array([[0.3, -1.0, -8.0], [-2.5, 1.7, -8.0], [3.3, 2.1, -8.0], [0.0, 0.0, -8.0]])
        way = np.array([0.05, -0.08, 1.0])
        found = trace(lens, origins, way, 0.55)
        assert not found.status.any()
        for ray, origin in enumerate(origins):
            points, direction, path = freeform_rays.fly(lens, origin, way, 0.55)
            assert found.points[1:, ray] == pytest.approx(np.array(points, float), abs=1e-12)
            assert found.cosines[ray] == pytest.approx(np.array(direction, float), abs=1e-14)
            assert found.path[ray] == pytest.approx(float(path), abs=1e-12)


def test_a_zernike_surface_in_the_stop_is_that_zernike_of_the_wavefront():
    """W = (n′ − n)·sag in waves, up to the square of a slope of 1e-4."""
    from p2sf.pupil.zernike_fit import zernike_fit

    numbers = (0.0, 0.0, 0.0, 0.0, 3e-5, -2e-5, 4e-5, 1e-5, -3e-5, 2e-5, 1e-5)
    lens = in_the_stop(ConstantIndex(1.5), None)
    first = replace(lens.surfaces[0], shape=ZernikeStandardSag(numbers, 5.0))
    fit = zernike_fit(replace(lens, surfaces=(first, *lens.surfaces[1:])), Source(wavelength_um=0.5))
    expected = 0.5 * 1000 / 0.5 * np.array(numbers)
    assert fit.waves[4:11] == pytest.approx(expected[4:], abs=2e-3 * np.abs(expected).max())


def test_every_method_but_six_coefficients_forms_the_picture_of_a_freeform():
    """A weak one, some two waves: huygens, traced and fitted agree; seidel refuses with one sentence."""
    lens = freeform_singlet(XYPolynomial((0, 0, 2e-3, -1e-3, -1e-3, 1e-3, 0, 5e-4), 5.0), rim=2.0)
    lens = with_sensor(lens, 47.0)
    source = Source(field_deg=(2.0, 1.0), wavelength_um=0.55)
    psfs = {
        name: p2sf.render(lens, source, name, pixels=48, pixel_um=1.5).values
        for name in ("huygens", "traced", "fitted")
    }
    for name in ("traced", "fitted"):
        reference = psfs["huygens"]
        apart = ((psfs[name] - reference) ** 2).sum() / ((reference - reference.mean()) ** 2).sum()
        assert apart < 1e-4, name
    with pytest.raises(GeometryError, match=r"surface 2 has a shape that is not of revolution \(XY polynomial\)"):
        p2sf.render(lens, source, "seidel")
    assert p2sf.render(lens, source, "auto", pixels=48, pixel_um=1.5).method != "seidel"


@pytest.mark.slow
def test_databases_and_plans_of_a_freeform_are_fitted():
    """From the database as from rays: at places between its nodes, to the error that it states."""
    lens = with_sensor(freeform_singlet(XYPolynomial((0, 0, 2e-3, -1e-3, -1e-3, 1e-3), 5.0), rim=2.0), 47.0)
    fields = [-1.0, 0.0, 1.0]
    database = p2sf.build_database(lens, [np.inf], fields, [550], method="fitted", fields_x_deg=fields)
    source = Source(field_deg=(0.4, -0.3), wavelength_um=0.55)
    reference = p2sf.render(lens, source, "huygens", pixels=32, pixel_um=2.0)
    found = database.psf(source, pixels=32, pixel_um=2.0).values
    off = ((found - reference.values) ** 2).sum() / ((reference.values - reference.values.mean()) ** 2).sum()
    assert off < 1e-3
    scene = p2sf.Scene(p2sf.Sensor(rows=8, columns=12, pixel_um=40.0), rtol=0.2)
    assert p2sf.plan(lens, scene)


def test_a_freeform_tilted_by_breaks_is_the_freeform_turned():
    shape, angle = SHAPES["Zernike standard"], 30.0
    lens = freeform_singlet(shape)
    placed = {"before": (Placement(tilt_z_deg=angle),), "after": (Placement(tilt_z_deg=-angle),)}
    one, two = (
        replace(lens, surfaces=(lens.surfaces[0], replace(lens.surfaces[1], **change), lens.surfaces[2]))
        for change in ({"shape": shape.turned(angle)}, placed)
    )
    origins = np.array([[0.3, -1.0, -8.0], [-2.5, 1.7, -8.0]])
    found, other = (trace(each, origins, [0.05, -0.08, 1.0], 0.55) for each in (one, two))
    assert found.points == pytest.approx(other.points, abs=1e-12)


ZMX = """VERS 181122 258 36214
MODE SEQ
UNIT MM X W X CM MR CPMM
FLOA
WAVM 1 0.55 1
SURF 0
  TYPE STANDARD
  CURV 0.0
  DISZ INFINITY
SURF 1
  STOP
  TYPE {kind}
  CURV 0.025
  CONI -0.5
{lines}
  DISZ 4
  GLAS ___BLANK 1 0 1.5 0 0 0 0 0 0 0
  DIAM 5 1 0 0 1
SURF 2
  TYPE STANDARD
  CURV 0.0
  DISZ 70
SURF 3
  TYPE STANDARD
  CURV 0.0
  DISZ 0
"""


def read_zmx(kind: str, lines: list[str]) -> Surface:
    text = ZMX.format(kind=kind, lines="\n".join(f"  {line}" for line in lines))
    return import_text(LensText("a.zmx", "utf-8", text), GlassSources()).lens.surfaces[0]


def test_the_twelfth_term_of_an_extended_polynomial_is_x2y2_and_extra_data_14():
    """As OpticStudio's manual says of "Extended Polynomial"; the heights are over the normalisation radius."""
    shape = read_zmx("XPOLYNOM", ["XDAT 1 13", "XDAT 2 4.0", "XDAT 14 0.2"]).shape
    assert shape.sag_and_gradient(3.0, 2.0)[0] == pytest.approx(0.2 * (3 / 4) ** 2 * (2 / 4) ** 2, rel=1e-14)


def test_zernike_sags_of_opticstudio_have_even_terms_and_angles_from_x():
    lines = ["PARM 2 1e-5", "XDAT 1 6", "XDAT 2 5.0", "XDAT 4 0.1", "XDAT 8 0.03"]
    standard = read_zmx("SZERNSAG", lines)
    assert standard.aspheric == (1e-5,)
    # Z2 = 2ρ cos A, Z6 = √6ρ² cos 2A: at (3, 0) and (0, 3)
    known = 0.1 * 2 * 0.6 + 0.03 * np.sqrt(6) * 0.36, -0.03 * np.sqrt(6) * 0.36
    for place, value in zip(((3.0, 0.0), (0.0, 3.0)), known, strict=True):
        assert standard.shape.sag_and_gradient(*place)[0] == pytest.approx(value, rel=1e-14)
    fringe = read_zmx("FZERNSAG", lines).shape
    # Z2 = ρ cos A, Z6 = ρ² sin 2A
    assert fringe.sag_and_gradient(3.0, 2.0)[0] == pytest.approx(0.1 * 0.6 + 0.03 * 2 * 0.6 * 0.4, rel=1e-14)
    with pytest.raises(LensFileError, match="decentred"):
        read_zmx("SZERNSAG", [*lines, "PARM 9 0.1"])


SEQ = "RDM;LEN\nDIM M\nEPD 8\nWL 550\nSO 0 1e13\nS 40 4 1.5:60\nSTO\n{lines}\nS 0 70\nSI 0 0\nGO\n"


def read_seq(lines: str) -> Surface:
    return import_text(LensText("a.seq", "utf-8", SEQ.format(lines=lines)), GlassSources()).lens.surfaces[0]


def test_code_v_counts_polynomials_from_c2():
    """C2 x, C3 y, C4 x², …, C13 x²y², over NRADIUS."""
    surface = read_seq("SPS XYP 4.0\nSCO K -0.5\nSCO NRADIUS 4.0\nSCO C3 0.1\nSCO C13 0.2")
    assert surface.conic == -0.5
    assert surface.shape.sag_and_gradient(3.0, 2.0)[0] == pytest.approx(0.1 * 0.5 + 0.2 * 0.75**2 * 0.25, rel=1e-14)


# What a lens that is symmetric in x uses of ZRN in a file of CODE V 2025: piston, and what is even in x up to degree 8
# but for tilt, power and coma.
EVEN_IN_X = (2, 5, 10, 11, 12, 13, 14, *range(20, 27), *range(34, 43))


def test_zernike_terms_of_code_v_are_even_in_x_where_a_lens_of_that_symmetry_has_them():
    for place in range(2, 68):
        shape = read_seq(f"SPS ZRN 5.0\nSCO NRADIUS 5.0\nSCO C{place} 0.1").shape
        values = [float(shape.sag_and_gradient(x, 2.0)[0]) for x in (1.5, -1.5)]
        if place in EVEN_IN_X:
            assert values[0] == pytest.approx(values[1], abs=1e-15)
        assert abs(shape.sag_and_gradient(5.0, 0.0)[0]) <= 0.1 + 1e-13, "each is 1 on the edge at most"
    # C5 ρ² cos 2θ, C10 (3ρ³ − 2ρ) sin θ
    assert read_seq("SPS ZRN 5\nSCO C5 0.1").shape.sag_and_gradient(3.0, 2.0)[0] == pytest.approx(
        0.1 * 5 / 25, rel=1e-13
    )
    coma = 0.1 * (3 * 0.52 - 2) * 0.4
    assert read_seq("SPS ZRN 5\nSCO C10 0.1").shape.sag_and_gradient(3.0, 2.0)[0] == pytest.approx(coma, rel=1e-13)


@pytest.mark.parametrize("write", [lens_to_zmx, lens_to_seq, lens_to_toml])
def test_a_written_freeform_is_read_as_the_same_surface(shape, write):
    lens = freeform_singlet(shape)
    plain = tuple(replace(s, aspheric=()) for s in lens.surfaces)
    lens, (x, y) = replace(lens, surfaces=plain), places()
    if write is lens_to_toml:
        assert parse_toml(write(lens), "lens.toml") == replace(lens, name="lens")
        return
    name = "a.zmx" if write is lens_to_zmx else "a.seq"
    read = import_text(LensText(name, "utf-8", write(lens)), GlassSources()).lens
    for before, after in zip(lens.surfaces, read.surfaces, strict=True):
        assert after.sag(x, y) == pytest.approx(before.sag(x, y), abs=1e-15)


def test_what_a_file_cannot_hold_of_a_freeform_is_refused():
    high = ZernikeStandardSag((0.0,) * 66 + (1e-3,), 9.0)  # of degree 11
    with pytest.raises(LensFileError, match="surface 2 has even terms beside its shape"):
        lens_to_seq(Lens((Surface(), Surface(40.0, shape=high)), Aperture("f_number", 8.0), 1))
    with pytest.raises(LensFileError, match="surface 2 has even terms or diffraction beside its shape"):
        lens_to_zmx(freeform_singlet(SHAPES["XY polynomial"]))


def test_drawings_and_3d_show_the_sag_itself():
    from p2sf_explorer.compute.glass_outlines import clear_rims, profile
    from p2sf_explorer.scene3d.meshes import elements

    lens = freeform_singlet(SHAPES["Zernike fringe"])
    lens = replace(lens, surfaces=tuple(replace(s, semi_diameter=5.0) for s in lens.surfaces))
    front = lens.surfaces[1]
    z, y = profile(front, 0.0, clear_rims(lens)[1])
    assert z == pytest.approx(front.sag(0.0, y), abs=1e-15) and np.ptp(z - z[::-1]) > 1e-3
    (glass,) = elements(lens)
    points = glass.mesh.points[: len(glass.mesh.points) // 2]
    assert points[:, 2] - 3.0 == pytest.approx(front.sag(points[:, 0], points[:, 1]), abs=1e-14)


@pytest.mark.parametrize(("kind", "last"), [("XYP", 66), ("ZRN", 67), ("ZFR", 40)])
def test_a_coefficient_of_code_v_beyond_its_last_is_refused(kind, last):
    """Ten degrees of x and y make 65 terms from C2 on; so begin the 66 of Zernike's orders, and Fringe's 37 at C4."""
    read_seq(f"SPS {kind} 4.0\nSCO NRADIUS 4.0\nSCO C{last} 1e-9")
    with pytest.raises(LensFileError, match="is not known"):
        read_seq(f"SPS {kind} 4.0\nSCO NRADIUS 4.0\nSCO C{last + 1} 1e-9")
