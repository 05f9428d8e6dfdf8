"""Tilts and decentres in files of other programs: their conventions, their own rays, and files written back."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from p2sf.errors import LensFileError
from p2sf.glass.media import MIRROR, catalogue_glass, model_glass
from p2sf.lens.lens import Aperture, Lens, Surface
from p2sf.lens.misalignment import displaced, folding, with_tilted_sensor
from p2sf.lens.placement import Motion, Placement
from p2sf.lens.tilts import break_rows, coordinate_break, decentred_surface
from p2sf.lensfile.importing import import_lens
from p2sf.lensfile.writing import write_lens
from p2sf.raytrace.trace import trace
from tests.support.lenses.misaligned import random_placement, random_system

PEERS = json.loads((Path(__file__).parents[1] / "data" / "tilted_rays.json").read_text(encoding="utf-8"))


@pytest.mark.parametrize("name", PEERS["ray_optics"])
def test_codev_files_of_tilts_have_the_rays_of_ray_optics(name, tmp_path):
    """DAR, REV, BEN and basic decentres; 1e-12 mm are some tens of roundings of 400 mm."""
    peer = PEERS["ray_optics"][name]
    (tmp_path / f"{name}.seq").write_text(peer["file"], encoding="utf-8")
    lens = import_lens(tmp_path / f"{name}.seq").lens
    for ray in peer["rays"]:
        found = trace(lens, [ray["origin"]], [ray["direction"]], PEERS["wavelength_um"])
        assert found.points[1:, 0] == pytest.approx(np.array(ray["points"]), abs=1e-12)
        assert found.cosines[0] == pytest.approx(ray["last_direction"], abs=1e-14)


@pytest.mark.parametrize("system", PEERS["batoid"], ids=lambda system: f"seed {system['seed']}")
def test_rays_through_misaligned_systems_are_those_of_batoid(system):
    lens = random_system(system["seed"])
    for ray in system["rays"]:
        found = trace(lens, [ray["origin"]], [ray["direction"]], PEERS["wavelength_um"])
        assert found.points[1:, 0] == pytest.approx(np.array(ray["points"]), abs=1e-9)
        assert found.cosines[0] == pytest.approx(ray["last_direction"], abs=1e-13)
        assert found.path[0] == pytest.approx(ray["path"], abs=max(1e-9 * 5.5e-4, 1e-14 * abs(ray["path"])))


def test_codev_turns_to_the_left_about_x_and_y_and_to_the_right_about_z():
    """A positive ADE turns z towards +y, a positive BDE x towards z, a positive CDE x towards y."""
    (alpha,), _ = decentred_surface("", (0, 0, 0), (10.0, 0, 0))
    (beta,), _ = decentred_surface("", (0, 0, 0), (0, 10.0, 0))
    (gamma,), _ = decentred_surface("", (0, 0, 0), (0, 0, 10.0))
    sine = np.sin(np.deg2rad(10.0))
    assert alpha.motion.rotation[1, 2] == pytest.approx(sine)
    assert beta.motion.rotation[2, 0] == pytest.approx(sine)
    assert gamma.motion.rotation[1, 0] == pytest.approx(sine)


def test_opticstudio_turns_to_the_right_and_its_flag_turns_first():
    """First x and y, then about x, y, z; with the flag first about z, y, x, then x and y."""
    numbers = dict(enumerate((1.0, 2.0, 10.0, 20.0, 30.0), 1))
    assert coordinate_break(numbers) == Placement(1.0, 2.0, 0.0, 10.0, 20.0, 30.0)
    assert coordinate_break(numbers | {6: 1.0}) == Placement(1.0, 2.0, 0.0, 10.0, 20.0, 30.0, True)
    assert coordinate_break({3: 10.0}).motion.rotation[1, 2] == pytest.approx(-np.sin(np.deg2rad(10.0)))


def test_any_break_is_some_coordinate_breaks_and_thicknesses():
    rng = np.random.default_rng(3)
    for _ in range(20):
        placement = random_placement(rng, 5.0, 50.0)
        end = Motion(np.eye(3), np.zeros(3))
        for *numbers, thickness in break_rows(placement, 7.0):
            one = coordinate_break(dict(enumerate(numbers, 1)))
            end = end.then(one.motion).then(Motion(np.eye(3), np.array([0.0, 0.0, thickness])))
        there = placement.motion.then(Motion(np.eye(3), np.array([0.0, 0.0, 7.0])))
        assert end.rotation == pytest.approx(there.rotation, abs=1e-14)
        assert end.origin == pytest.approx(there.origin, abs=1e-12)


FOLD = """UNIT MM X W X CM MR CPMM
ENPD 1.0E+1
GCAT SCHOTT
FTYP 0 0 1 1 0 0 0
YFLN 0
WAVM 1 0.55 1
SURF 0
  TYPE STANDARD
  DISZ INFINITY
SURF 1
  STOP
  TYPE STANDARD
  CURV 0.02
  DISZ 5.0
  GLAS N-BK7 0 0 1.5 4.0E+1
SURF 2
  TYPE STANDARD
  CURV 0.0
  DISZ 20.0
SURF 3
  TYPE COORDBRK
  PARM 3 45
  PARM 6 0
  DISZ 0
SURF 4
  TYPE STANDARD
  DISZ 0
  GLAS MIRROR
SURF 5
  TYPE COORDBRK
  PARM 3 45
  DISZ -75.0
SURF 6
  TYPE STANDARD
  DISZ 0
"""


def test_a_zemax_file_that_folds_the_axis(tmp_path):
    """Tilted by +45° about x, twice: the axis then is along −y, and light, which runs against it, goes up."""
    (tmp_path / "fold.zmx").write_text(FOLD, encoding="utf-8")
    lens = import_lens(tmp_path / "fold.zmx").lens
    assert [len(s.before) for s in lens.surfaces] == [0, 0, 1, 0, 1] and lens.sensor_mm == -75.0
    found = trace(lens, [[0.0, 0.0, -5.0]], [[0.0, 0.0, 1.0]], 0.55)
    assert found.points[-1, 0] == pytest.approx([0.0, 75.0, 25.0], abs=1e-12)
    assert found.cosines[0] == pytest.approx([0.0, 1.0, 0.0], abs=1e-14)
    write_lens(lens, tmp_path / "again.zmx")
    again = import_lens(tmp_path / "again.zmx").lens
    assert replace(again, name=lens.name, title=lens.title) == lens


def test_a_misaligned_lens_written_for_zemax_has_the_same_rays(tmp_path):
    glass = catalogue_glass("SCHOTT N-BK7")
    tilt = Placement(0.3, -0.2, 0.1, 20.0, -10.0, 5.0, True)
    surfaces = (
        Surface(40.0, 5.0, glass, semi_diameter=12.0),
        Surface(-60.0, 20.0),
        Surface(thickness=30.0),
        Surface(-300.0, -40.0, MIRROR, **folding(tilt)),
        Surface(80.0, -4.0, model_glass(1.6, 40.0)),
        Surface(-80.0, -30.0),
    )
    lens = Lens(surfaces, Aperture("entrance_pupil_diameter", 8.0), 3)
    lens = displaced(lens, 1, 2, Placement(0.1, 0.2, 0.05, 1.0, 2.0, 3.0, False, (0.0, 0.0, 3.0)))
    lens = displaced(lens, 5, 6, Placement(0.1, -0.2, 0.0, 1.0, -1.0, 0.0, True, (1.0, 0.0, -2.0)))
    lens = with_tilted_sensor(displaced(lens, 5, 5, Placement(decentre_x=0.1)), Placement(tilt_y_deg=3.0))
    write_lens(lens, tmp_path / "lens.zmx")
    again = import_lens(tmp_path / "lens.zmx").lens
    starts = [[0.0, 0.0, -2.0], [1.0, -2.0, -2.0]]
    one, two = (trace(each, starts, [0.01, 0.02, 1.0], 0.5876) for each in (lens, again))
    assert (one.status == 0).all()
    assert two.points[-1] == pytest.approx(one.points[-1], abs=1e-12)
    assert two.path == pytest.approx(one.path, rel=1e-14)


def test_what_files_cannot_tilt_is_refused(tmp_path):
    bend = "so 0 1e14\ns 0 10\nade 30\nbde 20\nben\nsi 0 0\nepd 1"
    moved = "so 0 10\nyde 3\ns 0 10\nsi 0 0\nepd 1"
    for text, said in ((bend, "surface 1: a bend .* more than one axis"), (moved, "the object is tilted or decentred")):
        (tmp_path / "a.seq").write_text(text, encoding="utf-8")
        with pytest.raises(LensFileError, match=said):
            import_lens(tmp_path / "a.seq")
    with pytest.raises(LensFileError, match="surface 3: a tilt of 95° about x"):
        (tmp_path / "a.zmx").write_text(FOLD.replace("PARM 3 45\n  PARM 6", "PARM 3 95\n  PARM 6"), encoding="utf-8")
        import_lens(tmp_path / "a.zmx")
    with pytest.raises(LensFileError, match=r"surface 2: .* cannot express its tilt or decentre; save as TOML"):
        write_lens(random_system(0), tmp_path / "a.json")
