"""The .roa files of ray-optics: its model as JSON, and what is refused by surface and name."""

import json

import numpy as np
import pytest

from p2sf.errors import LensFileError
from p2sf.lens.anamorphic import Toroid
from p2sf.lens.lens import indices
from p2sf.lens.placement import Placement
from p2sf.lensfile.glass_lookup import GlassSources
from p2sf.lensfile.importing import import_text
from p2sf.lensfile.library import load_lens
from p2sf.lensfile.source_text import LensText
from p2sf.paraxial.first_order import cardinal_points, image_distance
from tests.support.lenses.lens_files import FOLDER, text_of
from tests.support.rays.paraxial_by_hand import first_order

MIRRORS = "mirrors.roa"
HOLOGRAM = {"__instance_type__": ["m", "DiffractiveElement"], "attributes": {}}
CURVATURES, GAPS = (-0.00125, -0.004, 0.01, 0.008), (-300.0, 280.0, 6.0, 90.0)


def changed(change) -> LensText:
    """Return the test file after ``change`` of its model, a tree of dicts without the wrappers of classes' names."""
    model = json.loads(text_of(MIRRORS))
    change(model["optical_model"]["attributes"])
    return LensText(MIRRORS, "utf-8", json.dumps(model))


def lens_of(change):
    return import_text(changed(change), GlassSources()).lens


def surface(model, number):
    return model["seq_model"]["attributes"]["ifcs"][number]["attributes"]


def tilt(kind, euler, dec=(0.0, 0.0, 0.0)):
    arrays = {"dec": {"__ndarray__": list(dec)}, "euler": {"__ndarray__": list(euler)}}
    return {"__instance_type__": ["rayoptics.elem.surface", "DecenterData"], "attributes": {"dtype": kind, **arrays}}


@pytest.mark.parametrize(
    ("kind", "command"), [("decenter", ""), ("reverse", "REV"), ("dec and return", "DAR"), ("bend", "BEN")]
)
def test_decentres_are_those_of_the_same_numbers_in_a_code_v_file(kind, command):
    """Whose rays are compared with ray-optics' own in `test_tilts`."""
    euler, dec = (1.5, 0.0, 0.0) if kind == "bend" else (1.5, -2.0, 3.0), (0.1, -0.2, 0.0)
    lens = lens_of(lambda model: surface(model, 2).update(decenter=tilt(kind, euler, dec)))
    numbers = "\n".join(
        f"{name} {x}" for name, x in zip("XDE YDE ADE BDE CDE".split(), (*dec[:2], *euler), strict=True)
    )
    text = f"RDM\nSO 0 1e20\nS 0 5\nSTO\nS 50 5\n{numbers}\n{command}\nSI 0 0\nEPD 1\n"
    other = import_text(LensText("a.seq", "utf-8", text), GlassSources()).lens
    assert lens.surfaces[1].before == other.surfaces[1].before and lens.surfaces[1].after == other.surfaces[1].after
    assert lens.misaligned
    sensor = lens_of(lambda model: surface(model, -1).update(decenter=tilt("decenter", (1.0, 0.0, 0.0))))
    assert sensor.sensor_before == (Placement(tilt_x_deg=-1.0),)


def test_the_prescription_is_read_as_it_stands():
    lens = load_lens(FOLDER / MIRRORS)
    first, second, third, fourth = lens.surfaces
    assert lens.title == "Two mirrors and a corrector"
    assert [s.radius for s in lens.surfaces] == [1 / c for c in CURVATURES]
    assert tuple(s.thickness for s in lens.surfaces) == GAPS
    assert first.reflects and second.reflects and third.medium.label == "SCHOTT N-BK7" and fourth.medium.label == "1.0"
    assert [s.conic for s in lens.surfaces] == [-1.0, -2.5, -0.5, 0.0]  # ec = 1 + K
    assert second.aspheric == (1e-9, 0.0, -2e-15) and third.aspheric == (3e-8,)
    assert [s.semi_diameter for s in lens.surfaces] == [50.0, 15.0, 12.0, 12.0]
    assert (lens.stop_surface, lens.aperture.kind, lens.aperture.value) == (1, "entrance_pupil_diameter", 100.0)
    assert lens.fields_deg == (0.0, 0.5)  # fractions of 0.5°
    assert lens.wavelengths_nm[1] == 587.5618


def test_first_order_data_are_those_of_the_numbers():
    """1e-12: rounding of a dozen operations, a thousand times over."""
    lens = load_lens(FOLDER / MIRRORS)
    glass = float(indices(lens, 0.5875618)[3])
    by_hand = first_order(CURVATURES, GAPS, [1.0, -1.0, 1.0, glass, 1.0])
    assert float(cardinal_points(lens, 0.5875618).effective_focal_length) == pytest.approx(by_hand[0], rel=1e-12)
    assert float(image_distance(lens, np.inf, 0.5875618)) == pytest.approx(by_hand[1], rel=1e-12)


def test_media_by_numbers():
    def glass(model, **attributes):
        model["seq_model"]["attributes"]["gaps"][3]["attributes"]["medium"] = {
            "__instance_type__": ["m", "ModelGlass"],
            "attributes": attributes,
        }

    pair = lens_of(lambda model: glass(model, n=1.6, v=40.0)).surfaces[2].medium
    assert (pair.nd, pair.vd) == (1.6, 40.0)
    assert lens_of(lambda model: glass(model, n=1.33)).surfaces[2].medium.label == "1.33"


def test_a_phase_of_coefficients_of_path_is_read():
    """A path c·r² at the reference wavelength λ₀ is a lens of power −2c λ/λ₀ on a plane without glass."""

    def phase(model):
        model["seq_model"]["attributes"]["ifcs"] = [model["seq_model"]["attributes"]["ifcs"][i] for i in (0, 3, 5)]
        model["seq_model"]["attributes"]["gaps"] = [model["seq_model"]["attributes"]["gaps"][i] for i in (0, 4)]
        surface(model, 1).update(
            profile_id="11",
            phase_element={
                "__instance_type__": ["rayoptics.oprops.doe", "DiffractiveElement"],
                "attributes": {
                    "coefficients": [-0.005, 1e-8],
                    "ref_wl": 587.5618,
                    "order": 1,
                    "phase_fct_name": "radial_phase_fct",
                },
            },
        )

    lens = lens_of(phase)
    assert float(cardinal_points(lens, 0.5875618).effective_focal_length) == pytest.approx(100.0, rel=1e-12)
    blue = float(cardinal_points(lens, 0.4861327).effective_focal_length)
    assert blue == pytest.approx(100.0 * 0.5875618 / 0.4861327, rel=1e-12)


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (lambda m: surface(m, 2).update(decenter={"attributes": {"dtype": "spin"}}), "surface 2 is tilted .* by spin"),
        (lambda m: surface(m, 2).update(decenter=tilt("bend", (1, 2, 0))), "surface 2.*: a bend .* than one axis"),
        (lambda m: surface(m, 0).update(decenter=tilt("decenter", (1, 0, 0))), "the object is tilted or decentred"),
        (
            lambda m: surface(m, 3).update(
                phase_element={"__instance_type__": ["m", "DiffractiveElement"], "attributes": {}}
            ),
            r"surface 3 \(corrector\) diffracts \(DiffractiveElement\) and not by a phase",
        ),
        (
            lambda m: m["profile_dict"]["12"].update(__instance_type__=["m", "Spline"]),
            r"surface 1 \(primary\) has a shape \(Spline\)",
        ),
        (
            lambda m: m["seq_model"]["attributes"]["ifcs"][1].update(__instance_type__=["m", "ThinLens"]),
            "the file's model is incomplete",
        ),
        (lambda m: m["system_spec"]["attributes"].update(_dimensions="furlong"), 'lens unit "furlong"'),
        (lambda m: m.pop("optical_spec"), "the file's model is incomplete"),
        (lambda m: surface(m, 1).pop("profile_id"), "the file's model is incomplete"),
    ],
)
def test_what_cannot_be_read_is_refused_by_surface(change, said):
    with pytest.raises(LensFileError, match=said) as caught:
        lens_of(change)
    assert caught.value.line


TOROID = {"cv": 0.02, "cR": -0.01, "cc": -0.5, "coefs": [1e-4, 2e-6, 0.0]}


@pytest.mark.parametrize(("kind", "turn"), [("YToroid", 0.0), ("XToroid", 90.0)])
def test_a_toroid_is_a_curve_that_is_swept(kind, turn):
    """Rays through lenses that ray-optics 0.9.8 saved with these numbers agree with its own to 1e-15 mm."""
    profile = {"__instance_type__": ["rayoptics.elem.profiles", kind], "attributes": TOROID}
    first = lens_of(lambda model: model["profile_dict"].update({"12": profile})).surfaces[0]
    numbers = {"radius_x": -100.0, "radius_y": 50.0, "conic_y": -0.5, "coefficients": (1e-4, 2e-6)}
    assert first.shape == Toroid(**numbers, turn_deg=turn) and first.radius == np.inf


@pytest.mark.parametrize(("way", "sign"), [("transmit", -1.0), ("reflect", 1.0)])
def test_a_plane_grating_turns_rays_as_in_ray_optics(way, sign):
    """Whose positive order turns rays that pass away from the grating's normal, and others towards it (0.9.8)."""
    numbers = {"_grating_lpmm": 50.0, "order": 2, "grating_normal": {"__ndarray__": [0.6, 0.8, 0.0]}}
    element = {"__instance_type__": ["rayoptics.oprops.doe", "DiffractionGrating"], "attributes": numbers}

    def ruled(model, cv):
        surface(model, 3).update(phase_element=element, interact_mode=way)
        number = str(surface(model, 3)["profile_id"])
        plane = {"__instance_type__": ["rayoptics.elem.profiles", "Spherical"], "attributes": {"cv": cv}}
        model["profile_dict"].update({number: plane})

    found = lens_of(lambda model: ruled(model, 0.0)).surfaces[2].diffraction
    assert (found.lines_per_mm, found.order) == (50.0, 2 * sign)
    _, (across, up) = found.phase_and_gradient(0.0, 0.0)
    assert across / up == pytest.approx(0.75, rel=1e-14) and np.sign(up) == sign
    with pytest.raises(LensFileError, match=r"surface 3.* grating on a curved surface"):
        lens_of(lambda model: ruled(model, 0.01))


def test_newer_files_have_an_underscore_before_some_names():
    def renamed(model):
        view = model["optical_spec"]["attributes"]["field_of_view"]["attributes"]
        for each in (*(f["attributes"] for f in view["fields"]), view):
            for name in ("x", "y", "value", "key"):
                if name in each:
                    each[f"_{name}"] = each.pop(name)

    assert lens_of(renamed) == lens_of(lambda model: None)


def test_a_thin_lens_is_an_ideal_one_of_its_power():
    def thin(model):
        interface = model["seq_model"]["attributes"]["ifcs"][3]
        interface["__instance_type__"] = ["rayoptics.oprops.thinlens", "ThinLens"]
        interface["attributes"].update(_power=0.02, profile_id=None)

    third = lens_of(thin).surfaces[2]
    assert (third.ideal_focal_length, third.radius) == (50.0, np.inf)
