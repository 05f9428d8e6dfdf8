"""Fields of lens files: signed, along x and y, wherever a lens that is not symmetric tells them apart."""

from dataclasses import replace

import numpy as np
import pytest

from p2sf import Source
from p2sf.errors import GeometryError, LensFileError
from p2sf.lens.lens import Lens, with_aim
from p2sf.lensfile.library import load_lens
from p2sf.lensfile.real_heights import landing
from p2sf.lensfile.writing import write_lens
from p2sf.tolerance.differentials import usual_sources
from tests.support.lenses.lens_files import FOLDER, read

TILTED = "tilted_fields.zmx"
PLACES = ((0.0, -5.0), (0.0, 5.0), (3.0, 0.0))
INDEX = 1.5168000345005885  # N-BK7 at the d line


def spot_mm(x_deg: float, y_deg: float) -> float:
    """Return the RMS spot of the file's tilted singlet, mm, by a tracer in space that shares nothing with the package.

    Everything stands in the axes of the glass, which are turned by 12° about x from those of the pupil and the sensor.
    """
    turn = np.deg2rad(12.0)
    frame = np.array([[1, 0, 0], [0, np.cos(turn), np.sin(turn)], [0, -np.sin(turn), np.cos(turn)]]).T
    radius, around = np.meshgrid(4 * np.sqrt((np.arange(6) + 0.5) / 6), 2 * np.pi * np.arange(12) / 12)
    start = np.stack([radius * np.cos(around), radius * np.sin(around), 0 * radius], -1).reshape(-1, 3)
    to_lens = np.array([1.0, 1.0, 1.0])
    place = (start - [0, 0, 2]) @ frame
    ray = np.array([np.tan(np.deg2rad(x_deg)), np.tan(np.deg2rad(y_deg)), 1.0]) * to_lens
    ray = np.broadcast_to(ray / np.linalg.norm(ray) @ frame, place.shape)
    for vertex, curved, before, behind in ((0.0, 50.0, 1.0, INDEX), (4.0, -50.0, INDEX, 1.0)):
        middle = np.array([0.0, 0.0, vertex + curved])
        along = ((middle - place) * ray).sum(-1)
        root = np.sqrt(along**2 - ((place - middle) ** 2).sum(-1) + curved**2)
        place = place + (along - np.sign(curved) * root)[:, None] * ray
        normal = (middle - place) / curved
        cosine = (ray * normal).sum(-1)
        bent = np.sqrt(1 - (before / behind) ** 2 * (1 - cosine**2))
        ray = before / behind * ray + (bent - before / behind * cosine)[:, None] * normal
    place, ray = (place - [0, 0, 4]) @ frame.T, ray @ frame.T
    lands = (place + ((46.5 - place[:, 2]) / ray[:, 2])[:, None] * ray)[:, :2]
    return float(np.sqrt(((lands - lands.mean(0)) ** 2).sum(-1).mean()))


def own_spot_mm(lens: Lens, field: tuple[float, float]) -> float:
    from p2sf.raytrace.trace import trace

    radius, around = np.meshgrid(4 * np.sqrt((np.arange(6) + 0.5) / 6), 2 * np.pi * np.arange(12) / 12)
    start = np.stack([radius * np.cos(around), radius * np.sin(around), 0 * radius], -1).reshape(-1, 3)
    slopes = np.array([*Source(field_deg=field).slopes_xy, 1.0])
    lands = trace(lens, start, slopes, 0.5875618).points[-1][:, :2]
    return float(np.sqrt(((lands - lands.mean(0)) ** 2).sum(-1).mean()))


def test_fields_keep_sign_and_azimuth():
    lens = load_lens(FOLDER / TILTED)
    assert (lens.fields_x_deg, lens.fields_deg) == tuple(zip(*PLACES, strict=True))
    assert lens.field_places_deg == ((3.0, 0.0), (0.0, -5.0), (0.0, 5.0)) and lens.widest_field_deg == 5
    spots = [spot_mm(*place) for place in PLACES]
    for place, spot in zip(PLACES, spots, strict=True):
        assert own_spot_mm(lens, place) == pytest.approx(spot, rel=1e-9)
    assert max(spots) > 1.2 * min(spots)


@pytest.mark.parametrize("ending", ["toml", "zmx", "seq"])
def test_fields_come_back_from_every_format(ending, tmp_path):
    lens = load_lens(FOLDER / TILTED)
    write_lens(lens, tmp_path / f"out.{ending}")
    again = load_lens(tmp_path / f"out.{ending}")
    assert again.fields_deg == pytest.approx(lens.fields_deg, abs=1e-11)
    assert again.fields_x_deg == pytest.approx(lens.fields_x_deg, abs=1e-11)


def test_a_symmetric_lens_shows_each_angle_once():
    lens = read("doublet.zmx", ("XFLN 0 0", "XFLN -1.0 0")).lens
    assert (lens.fields_x_deg, lens.fields_deg) == ((-1.0, 0.0), (0.0, 1.0))
    assert lens.field_places_deg == ((0.0, 1.0),) and lens.widest_field_deg == 1


def test_an_object_above_the_axis_has_a_chief_ray_downwards():
    """Object heights point the other way than angles, image heights of an image turned upside down the same way."""
    near = read(TILTED, ("FTYP 0", "FTYP 1"), ("DISZ INFINITY", "DISZ 100.0"), ("YFLN -5 5 0", "YFLN 10 0 0")).lens
    assert near.fields_deg[0] == pytest.approx(-np.rad2deg(np.arctan(0.1)), rel=1e-12)
    assert near.fields_x_deg[2] == pytest.approx(-np.rad2deg(np.arctan(0.03)), rel=1e-12)
    image = read(TILTED, ("FTYP 0", "FTYP 2")).lens
    assert image.fields_deg[0] < 0 < image.fields_deg[1] and image.fields_x_deg[2] > 0


def test_a_table_may_state_fields_along_x():
    lens = read("singlet.csv", ("# fields_deg: 0, 5", "# fields_x_deg: 1, -2\n# fields_deg: 0, 5")).lens
    assert (lens.fields_x_deg, lens.fields_deg) == ((1.0, -2.0), (0.0, 5.0))


def test_tolerances_look_at_the_field_that_is_stated():
    lens = replace(load_lens(FOLDER / TILTED), fields_deg=(0.0, -4.0), fields_x_deg=(0.0, 3.0))
    assert usual_sources(lens, Source())[-1].field_xy_deg == pytest.approx((3.0, -4.0), rel=1e-12)


def test_there_are_as_many_angles_along_x_as_along_y():
    lens = load_lens(FOLDER / TILTED)
    with pytest.raises(GeometryError):
        replace(lens, fields_x_deg=(1.0,))


@pytest.mark.parametrize(("ending", "aim"), [("toml", "paraxial"), ("zmx", "paraxial"), ("seq", "stop")])
def test_reference_weights_and_aim_come_back(ending, aim, tmp_path):
    lens = with_aim(load_lens(FOLDER / "microscope_cone.zmx"), aim)
    write_lens(lens, tmp_path / f"out.{ending}")
    again = load_lens(tmp_path / f"out.{ending}")
    assert again.reference_wavelength_nm == pytest.approx(656.2725)
    assert (again.wavelength_weights, again.aim) == (lens.wavelength_weights, lens.aim)


def test_a_reference_is_one_of_the_wavelengths_and_each_of_these_has_a_weight():
    lens = load_lens(FOLDER / "microscope_cone.zmx")
    for wrong in ({"reference_nm": 500.0}, {"wavelength_weights": (1.0,)}, {"wavelength_weights": (0.0, 0.0, 0.0)}):
        with pytest.raises(GeometryError):
            replace(lens, **wrong)


HEIGHTS = "../lens_files/real_image_height.zmx"


def chief_height_mm(angle_deg: float) -> float:
    """Return where the chief ray of the plano-convex singlet of `HEIGHTS` lands, mm, by Snell's law in its plane.

    It goes through the middle of the stop, meets a plane 6 mm behind, a sphere of radius −25 mm 5 mm behind that, and
    the sensor 48.4 mm behind the sphere's vertex.
    """
    slope = np.tan(np.deg2rad(angle_deg))
    inside = np.arcsin(np.sin(np.deg2rad(angle_deg)) / INDEX)
    y, ray = 6 * slope, np.array([np.cos(inside), np.sin(inside)])  # z and y
    place, middle = np.array([0.0, y]), np.array([5.0 - 25.0, 0.0])
    along = (middle - place) @ ray
    place = place + (along + np.sqrt(along**2 - ((place - middle) ** 2).sum() + 625)) * ray
    normal = (place - middle) / 25.0
    cosine = normal @ ray
    ray = INDEX * ray + (np.sqrt(1 - INDEX**2 * (1 - cosine**2)) - INDEX * cosine) * normal
    return float(place[1] + (5.0 + 48.4 - place[0]) * ray[1] / ray[0])


def of_cases(*changes: tuple[str, str]) -> Lens:
    return read(HEIGHTS, *changes).lens


@pytest.mark.parametrize("height", [20.0, -20.0, 5.0])
def test_a_real_image_height_is_where_the_chief_ray_lands(height):
    """At 20 mm first order would say 22.46°, whose ray lands at 19.28 mm."""
    lens = of_cases(("YFLN 0 20", f"YFLN 0 {height:g}"))
    assert chief_height_mm(lens.fields_deg[1]) == pytest.approx(height, abs=1e-8)


def test_real_image_heights_along_x_and_y_lie_in_their_direction():
    lens = of_cases(("XFLN 0 0", "XFLN 0 12"), ("YFLN 0 20", "YFLN 0 16"))
    slopes = np.tan(np.deg2rad([lens.fields_x_deg[1], lens.fields_deg[1]]))
    assert slopes[0] / slopes[1] == pytest.approx(12 / 16, rel=1e-9)
    assert chief_height_mm(np.rad2deg(np.arctan(np.hypot(*slopes)))) == pytest.approx(20.0, abs=1e-8)


def test_real_image_heights_of_a_tilted_lens_are_met_in_both_directions():
    angles = read(TILTED).lens
    landed = [landing(angles, tuple(np.tan(np.deg2rad(place))), np.inf) for place in PLACES]
    across, up = (" ".join(f"{each[k]:.12f}" for each in landed) for k in (0, 1))
    lens = read(TILTED, ("FTYP 0", "FTYP 3"), ("XFLN 0 0 3", f"XFLN {across}"), ("YFLN -5 5 0", f"YFLN {up}")).lens
    np.testing.assert_allclose(np.transpose([lens.fields_x_deg, lens.fields_deg]), PLACES, atol=1e-8)


def test_a_real_image_height_that_no_chief_ray_meets_is_refused_with_its_line():
    with pytest.raises(LensFileError, match=r"no chief ray lands 90 mm from the axis") as refused:
        of_cases(("YFLN 0 20", "YFLN 0 90"))
    assert refused.value.line is not None
