"""Light that glass absorbs: plates by Snell's law, pictures by Hankel integrals, energies by sums of their own."""

import json
from dataclasses import replace

import numpy as np
import pytest
from scipy.special import j0

import p2sf
from p2sf.cli import main
from p2sf.colour.spectrum import spectrum_of
from p2sf.disc.quadrature import whole_disc
from p2sf.errors import GeometryError, GlassError
from p2sf.glass.media import ConstantIndex, ShiftedIndex
from p2sf.glass.transmittance import InternalTransmittance
from p2sf.lens.lens import Aperture, Lens, Surface, with_absorption
from p2sf.lens.misalignment import displaced
from p2sf.lens.placement import Placement
from p2sf.lens.source import Source
from p2sf.lensfile.agf import FormulaGlass, read_agf_text
from p2sf.lensfile.library import find_lens
from p2sf.lensfile.source_text import LensText
from p2sf.lensfile.toml.lens import lens_to_toml, parse_toml
from p2sf.paraxial.lens_checks import lens_checks
from p2sf.paraxial.seidel import coefficients
from p2sf.pixel_kernels.illumination import light_collected
from p2sf.psf.geometric import geometric_psf
from p2sf.psf.polychromatic import bands_through
from p2sf.pupil.landing import landing
from p2sf.raytrace.pencil import pencil
from p2sf.raytrace.trace import trace

UM, RIM, N = 0.5, 5.0, 1.5
# Half passes 10 mm at 400 nm, all at 600: 0.75 at 500, by a straight line.
GREY = InternalTransmittance(((0.4, 0.5, 10.0), (0.6, 1.0, 10.0)))


def glass(passed: InternalTransmittance | None = GREY, n: float = N) -> FormulaGlass:
    """Return a glass of one index, by the first formula of the AGF format, n² = c₁."""
    return FormulaGlass("GREY", 1, (n * n,), (0.3, 1.0), transmittance=passed)


def plate(thickness: float, *more: Surface) -> Lens:
    """Return a plane-parallel plate, its front the stop, and an ideal lens behind it."""
    sides = (Surface(thickness=thickness, medium=glass()), Surface(thickness=1.0), *more)
    lens = (*sides, Surface(thickness=50.0, ideal_focal_length=50.0))
    return Lens(lens, Aperture("stop_semi_diameter", RIM), 1, wavelengths_nm=(500.0,), absorption=True)


def absorbing(name: str = "double_gauss_28", f_number: float = 4.0, per_mm: float = 0.03) -> Lens:
    """Return a shipped lens whose glasses absorb: constant indices of its own at 500 nm, the same α in all."""
    lens = find_lens(name)
    passed = InternalTransmittance(((0.5, float(np.exp(-per_mm)), 1.0),))
    media = {s.medium for s in lens.surfaces if float(s.medium.index(UM)) > 1.1}
    grey = {medium: glass(passed, float(medium.index(UM))) for medium in media}
    surfaces = tuple(replace(s, medium=grey.get(s.medium, s.medium)) for s in lens.surfaces)
    return replace(
        lens, surfaces=surfaces, aperture=Aperture("f_number", f_number), wavelengths_nm=(500.0,), absorption=True
    )


def clear(lens: Lens) -> Lens:
    return with_absorption(lens, False)


@pytest.mark.parametrize("depth_mm", [np.inf, 15.0])
@pytest.mark.parametrize("field_deg", [0.0, 35.0])
def test_a_plate_passes_the_share_of_its_oblique_thickness(depth_mm, field_deg):
    """T^(t/(t₀ cos θ′)) with sin θ′ = sin θ/n, for every ray of its own."""
    lens, thickness = plate(8.0), 8.0
    xi, eta, _ = whole_disc(6, 12)
    source = Source(depth_mm, wavelength_um=UM, field_deg=field_deg)
    rays = pencil(lens, source, xi, eta)
    slope = np.tan(np.deg2rad(field_deg))
    across, along = RIM * xi / depth_mm, RIM * eta / depth_mm + slope
    tangent = across**2 + along**2
    sine = np.sqrt(tangent / (1 + tangent)) / N
    assert rays.transmission == pytest.approx(0.75 ** (thickness / 10 / np.sqrt(1 - sine**2)), rel=1e-12)
    assert rays.light == pytest.approx(rays.launch * rays.transmission, rel=1e-14)


def test_two_plates_are_one_and_a_plane_inside_takes_nothing():
    """8 mm in one, as 3 and 5, and with a plane from which rays run back 2 mm and on again."""
    source, points = Source(wavelength_um=UM, field_deg=20.0), ([0.3, 0.0], [0.5, -0.2])
    inside = Surface(thickness=5.0, medium=glass())
    parts = replace(plate(3.0), surfaces=(plate(3.0).surfaces[0], inside, *plate(3.0).surfaces[1:]))
    back = (Surface(thickness=-2.0, medium=glass()), Surface(thickness=7.0, medium=glass()))
    folded = replace(parts, surfaces=(parts.surfaces[0], *back, *parts.surfaces[2:]))
    whole = pencil(plate(8.0), source, *points).transmission
    for lens in (parts, folded):
        assert pencil(lens, source, *points).transmission == pytest.approx(whole, rel=1e-12)
    other = replace(parts.surfaces[1], medium=glass(None))  # of the same index, and clear: the plane counts
    mixed = pencil(replace(parts, surfaces=(parts.surfaces[0], other, *parts.surfaces[2:])), source, *points)
    assert mixed.transmission == pytest.approx(whole ** (3 / 8), rel=1e-12)


def test_a_mirror_sends_light_through_its_glass_twice():
    """A plane mirror behind 4 mm of glass: 8 mm on the axis, the lengths of both ways off it."""
    mirror = Surface(thickness=-4.0, medium=p2sf.glass.media.MIRROR)
    surfaces = Surface(thickness=4.0, medium=glass()), mirror, Surface(thickness=-1.0), *plate(1.0).surfaces[2:]
    last = replace(surfaces[-1], thickness=-50.0)
    lens = replace(plate(1.0), surfaces=(*surfaces[:-1], last))
    found = pencil(lens, Source(wavelength_um=UM, field_deg=30.0), [0.0, 0.4], [0.1, 0.4]).transmission
    assert found == pytest.approx(0.75 ** (0.8 / np.sqrt(1 - (np.sin(np.deg2rad(30)) / N) ** 2)), rel=1e-12)


def test_what_passes_a_lens_is_the_product_over_its_own_points():
    """Every segment's length from the points of a trace, tilted pieces included."""
    lens = displaced(absorbing(), 3, 4, Placement(decentre_y=0.05, tilt_x_deg=0.2))
    source, xi, eta = Source(field_deg=7.0, wavelength_um=UM), np.array([0.0, 0.6, -0.5]), np.array([0.1, -0.7, 0.4])
    entering = p2sf.raytrace.pencil.pupil_rays(lens, source, xi, eta)
    points = trace(lens, entering.origins, entering.directions, UM).points
    lengths = np.linalg.norm(np.diff(points[1:], axis=0), axis=-1)
    inside = [float(medium.index(UM)) > 1.1 for medium in lens.media[1:]]
    known = np.exp(-0.03 * lengths[inside].sum(0))
    assert pencil(lens, source, xi, eta).transmission == pytest.approx(known, rel=1e-8)  # rays aimed by differences


def focused(per_mm: float) -> Lens:
    """Return an ellipsoid that focuses an infinitely far point sharply inside its glass, K = −1/n²."""
    passed = InternalTransmittance(((0.5, float(np.exp(-per_mm)), 1.0),))
    front = Surface(100.0, 100.0 * N / (N - 1), glass(passed), conic=-1 / N**2)
    return Lens((front,), Aperture("stop_semi_diameter", 40.0), 1, wavelengths_nm=(500.0,), absorption=True)


class Ellipsoid:
    """The shaded pupil of `focused`, written anew: amplitude √light·h dh over the frequency n·sine/λ of each height.

    All rays have one optical path, n·length + sag, and reach the focus; a ray's sine is its height over its length.
    """

    def __init__(self, per_mm: float):
        far, c, k = 100.0 * N / (N - 1), 1 / 100.0, 1 - 1 / N**2
        node, share = np.polynomial.legendre.leggauss(600)
        self.h, self.share = 40.0 * (node + 1) / 2, 40.0 * share / 2
        sag = c * self.h**2 / (1 + np.sqrt(1 - k * c**2 * self.h**2))
        length = np.hypot(self.h, far - sag)
        assert N * length + sag == pytest.approx(N * far, rel=1e-12)
        self.light, self.frequency = np.exp(-per_mm * length), N / UM * self.h / length
        slope = np.gradient(self.frequency, self.h, edge_order=2)
        self.top = N / UM * 40.0 / np.hypot(40.0, far - c * 40.0**2 / (1 + np.sqrt(1 - k * c**2 * 40.0**2)))
        self.density = np.sqrt(self.light) * self.h / (self.frequency * slope)  # of the frequencies' area

    def field(self, radius: np.ndarray) -> np.ndarray:
        """Return ∫√light·J₀(2π f r)·h dh."""
        weight = self.share * np.sqrt(self.light) * self.h
        return (weight @ j0(2 * np.pi * np.multiply.outer(self.frequency, radius.ravel()))).reshape(radius.shape)

    @property
    def whole(self) -> float:
        """Return ∫|field|² r dr over the plane, by Parseval."""
        return float((self.share * np.sqrt(self.light) * self.h * self.density).sum()) / (2 * np.pi) ** 2

    def contrast(self, shift: float) -> float:
        """Return the autocorrelation of the density over the part that two discs share, over that of none."""
        node, share = np.polynomial.legendre.leggauss(200)

        def summed(shift: float) -> float:
            angle = np.pi / 2 * node[:, None]
            tall = np.sqrt(self.top**2 - shift**2 / 4)
            y = tall * np.sin(angle)
            half = np.sqrt(self.top**2 - y**2) - shift / 2
            x = half * node
            ends = (np.interp(np.hypot(x + side, y), self.frequency, self.density) for side in (-shift / 2, shift / 2))
            return float((np.prod([*ends], axis=0) * share * half * (share[:, None] * tall * np.cos(angle))).sum())

        return summed(shift) / summed(0.0)


def test_the_picture_is_the_hankel_integral_of_the_shaded_pupil():
    """A fit to what it predicts to miss of the amplitude's shape, sums of rays to their steps."""
    lens, known = focused(0.15), Ellipsoid(0.15)
    for method, most in (("huygens", 2e-5), ("traced", 2e-5), ("fitted", 1e-3)):
        psf = p2sf.render(lens, Source(wavelength_um=UM), method, pixels=33, pixel_um=0.2)
        field = known.field(np.hypot(*np.meshgrid(psf.x_um, psf.y_um)))
        square = np.square(field / np.abs(field).max())
        assert np.abs(psf.values / psf.values.max() - square).max() < most, method
        plain = p2sf.render(clear(lens), Source(wavelength_um=UM), method, pixels=33, pixel_um=0.2)
        assert np.abs(plain.values / plain.values.max() - square).max() > 0.02


def test_energy_and_contrast_are_those_of_the_shaded_pupil():
    """∫₀ᴿ|field|² r dr over the whole by Parseval, and the autocorrelation over two discs."""
    lens, known, source = focused(0.15), Ellipsoid(0.15), Source(wavelength_um=UM)
    radius = np.array([0.4, 0.8, 1.6])
    node, share = np.polynomial.legendre.leggauss(200)
    within = [(share * r / 2 * known.field(at := r * (node + 1) / 2) ** 2 * at).sum() / known.whole for r in radius]
    assert p2sf.Camera(lens).at(source).energy(radius).fraction == pytest.approx(within, abs=1e-4)
    frequency = np.array([0.1, 0.4, 0.9]) * known.top
    contrast = [known.contrast(one) for one in frequency]
    found = p2sf.Camera(lens).at(source).mtf(1e3 * frequency)
    assert found.tangential == pytest.approx(contrast, abs=1e-4) == found.sagittal
    plain = p2sf.Camera(clear(lens)).at(source).mtf(1e3 * frequency)
    assert np.abs(plain.tangential - contrast).max() > 0.01


def test_the_light_is_the_mean_over_the_pupil():
    """∫exp(−α·length)·2ρdρ, of rays and of the light that illumination collects."""
    lens, known = focused(0.02), Ellipsoid(0.02)
    mean = (known.share * known.light * 2 * known.h).sum() / 40.0**2
    xi, eta, weight = whole_disc(16, 32)
    source = Source(wavelength_um=UM)
    rays, plain = (pencil(one, source, xi, eta) for one in (lens, clear(lens)))
    assert (weight * rays.light).sum() / (weight * plain.light).sum() == pytest.approx(mean, rel=1e-8)
    assert light_collected(lens, source) / light_collected(clear(lens), source) == pytest.approx(mean, rel=1e-8)


@pytest.mark.parametrize("clip", [False, True], ids=["open", "clipped"])
@pytest.mark.parametrize("change", ["", "tilted", "masked"])
def test_every_road_takes_the_same_light(clip, change):
    """Huygens sums, exact rows and fits, with rims, masks and tilts: the fit to the error of its amplitude."""
    lens = absorbing(per_mm=0.3)
    if change == "tilted":
        lens = displaced(lens, 3, 4, Placement(decentre_y=0.05, tilt_x_deg=0.1))
    if change == "masked":
        lens = p2sf.with_mask(lens, p2sf.PupilMask(obscuration=0.3, vanes=3, vane_width=0.03))
    source = Source(field_deg=10.0, wavelength_um=UM)

    def picture(one: Lens, method: str) -> np.ndarray:
        return p2sf.render(one, source, method, pixels=48, pixel_um=1.5, clip=clip).values

    def missed(values: np.ndarray) -> float:
        return float(((values - reference) ** 2).sum() / ((reference - reference.mean()) ** 2).sum())

    reference = picture(lens, "huygens")
    for method, most in (("traced", 1e-5), ("fitted", 1e-3)):
        assert missed(picture(lens, method)) < most
    assert missed(picture(clear(lens), "huygens")) > 3e-3


def test_ray_density_and_spots_weigh_rays_by_their_light():
    """The centroid of a picture of the density is that of rays summed by hand; a coarse pixel is 3 µm."""
    source, middles = Source(field_deg=10.0, wavelength_um=UM), []
    xi, eta, weight = whole_disc(40, 80)
    for lens in (absorbing(per_mm=0.3), clear(absorbing())):
        rays, picture = pencil(lens, source, xi, eta), geometric_psf(lens, source, (64, 3.0), "settled")
        middles.append((weight * rays.light * rays.y_um).sum() / (weight * rays.light).sum())
        assert picture.values.sum(1) @ picture.y_um / picture.values.sum() == pytest.approx(middles[-1], abs=0.03)
        assert landing(lens, source).centroid_um[1] == pytest.approx(middles[-1], abs=1e-3)
    assert abs(middles[0] - middles[1]) > 0.3


def test_colours_are_weighed_by_what_passes():
    """White through grey that ends at 600 nm is redder, as the share that passes says of each band."""
    lens, spectrum = plate(8.0), spectrum_of("equal")
    waves, weights = bands_through(lens, Source(wavelength_um=UM), spectrum, 5)
    usual = bands_through(clear(lens), Source(wavelength_um=UM), spectrum, 5)
    assert np.array_equal(waves, usual[0]) and weights[:, 1].sum() == pytest.approx(1)
    passed = np.interp(waves, [0.4, 0.6], [0.5, 1.0]) ** 0.8
    known = usual[1] * passed[:, None] / (usual[1][:, 1] @ passed)
    assert weights == pytest.approx(known, rel=1e-12)


def test_shares_between_wavelengths_and_thicknesses():
    table = InternalTransmittance(((0.6, 0.9, 5.0), (0.4, 0.5, 10.0), (0.5, 0.0, 10.0), (0.4, 0.1, 10.0)))
    passed = np.exp(-5.0 * table.absorption(np.array([0.3, 0.4, 0.55, 0.6, 0.9])))
    assert passed == pytest.approx([0.5**0.5, 0.5**0.5, 0.45, 0.9, 0.9], rel=1e-12)
    assert np.exp(-10 * table.absorption(0.5)) == 0 or np.exp(-10 * table.absorption(0.5)) < 1e-20
    for wrong in ((), ((0.5, 1.2, 10.0),), ((0.5, 0.9, 0.0),), ((-0.5, 0.9, 1.0),)):
        with pytest.raises(GlassError):
            InternalTransmittance(wrong)


CATALOGUE = """NM {name} 1 0 1.5 60 0 0
CD 2.25 0 0 0 0 0
LD 0.3 2.0
IT 0.4 0.5 10
IT 0.6 {share} 10
"""


def test_a_catalogue_states_it_and_files_keep_it():
    def read(share: str = "1.0003", name: str = "GREY"):
        text = CATALOGUE.format(name=name, share=share)
        return read_agf_text(LensText("grey.agf", "utf-8", text)).glasses

    found = read()["GREY"]
    assert found.transmittance == GREY  # a measurement above 1 by its noise is all of it
    for wrong in ("99.8", "-999"):  # a percentage, no measurement: the index is good all the same
        assert read(wrong)["GREY"].transmittance is None
    lens = replace(plate(8.0), surfaces=(replace(plate(8.0).surfaces[0], medium=found), *plate(8.0).surfaces[1:]))
    again = parse_toml(lens_to_toml(lens), "lens.toml")
    assert again == lens and again.surfaces[0].medium.transmittance == GREY and again.absorption
    assert not parse_toml(lens_to_toml(clear(lens)), "lens.toml").absorption
    melt = replace(lens, surfaces=(replace(lens.surfaces[0], medium=ShiftedIndex(found, 1e-4)), *lens.surfaces[1:]))
    assert pencil(melt, Source(wavelength_um=UM), [0.0], [0.0]).transmission == pytest.approx(0.75**0.8)


def test_it_is_a_choice_that_is_off():
    """The same lens without it gives the very figures of a lens of which no transmittance is known."""
    lens = absorbing()
    dumb = replace(lens, surfaces=tuple(replace(s, medium=unknown(s.medium)) for s in lens.surfaces))
    source = Source(field_deg=7.0, wavelength_um=UM)
    for method in ("seidel", "fitted", "traced"):
        one, two = (p2sf.render(x, source, method, pixels=32, pixel_um=1.0).values for x in (clear(lens), clear(dumb)))
        assert np.array_equal(one, two)
    assert not Lens(lens.surfaces, lens.aperture).absorption
    said = [message.values["glasses"] for message in lens_checks(dumb) if "glasses" in message.values]
    assert said == [("GREY",)]
    assert not [message for message in lens_checks(lens) if "glasses" in message.values]


def unknown(medium: object) -> object:
    return replace(medium, transmittance=None) if isinstance(medium, FormulaGlass) else medium


def test_what_takes_the_pupil_for_even_refuses_it():
    lens, source = absorbing(), Source(wavelength_um=UM)
    for wrong, method in ((replace(lens, aim="paraxial"), "traced"), (lens, "seidel")):
        with pytest.raises(GeometryError) as caught:
            p2sf.render(wrong, source, method)
        assert caught.value.message.values["shading"].values["surface"] == 1
    assert p2sf.render(lens, source, min_r2=0.5).method != "seidel"
    assert float(coefficients(lens, np.inf, 0.0, UM).w40)  # of the wavefront, which absorption leaves as it is
    database = p2sf.build_database(lens, depths_mm=(1e4, 1e5), fields_deg=(0, 2), wavelengths_nm=(500, 501))
    assert database.database.method == "fitted" and database.lens == lens


def test_the_command_line_turns_it_on_and_off(tmp_path, capsys):
    (tmp_path / "lens.toml").write_text(lens_to_toml(absorbing(per_mm=0.3)), encoding="utf-8")

    def strehl(*words: str) -> float:
        assert main(["psf", str(tmp_path / "lens.toml"), "--method", "traced", *words, "--json"]) == 0
        return json.loads(capsys.readouterr().out)["strehl"]

    assert strehl("--absorption") == strehl() != strehl("--no-absorption")


def test_air_is_clear_and_the_object_is_not_part_of_the_lens():
    lens = plate(8.0)
    under = replace(lens, object_medium=glass(), surfaces=lens.surfaces)
    found = pencil(under, Source(1000.0, wavelength_um=UM), [0.0], [0.0]).transmission
    assert found == pytest.approx(0.75**0.8)
    assert ConstantIndex(1.0) == lens.surfaces[1].medium
