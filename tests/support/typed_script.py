"""Some sixty lines that use what is public, which `mypy --strict` and pyright accept: see tests/test_typing.py."""

from math import inf
from pathlib import Path

import numpy as np

import p2sf


def build() -> p2sf.Lens:
    """Return a doublet."""
    glass: p2sf.Medium = p2sf.medium("N-BK7")
    surfaces = (
        p2sf.Surface(61.3, 6.0, glass),
        p2sf.Surface(-44.7, 2.5, p2sf.medium("N-SF5")),
        p2sf.Surface(-129.5, 95.5),
    )
    lens = p2sf.Lens(surfaces, p2sf.Aperture("f_number", 5.6), stop_surface=1)
    return p2sf.displaced(lens, 1, 3, p2sf.Placement(decentre_y=0.1))


def figures(camera: p2sf.Camera) -> dict[str, float]:
    """Return a number of every figure."""
    point = camera.at(depth_mm=3000, field_deg=10.0, wavelength_nm=550)
    psf: p2sf.Psf = point.psf("auto", pixels=32, min_r2=0.99)
    mtf: p2sf.Mtf = point.mtf([10, 20])
    energy: p2sf.Energy = psf.encircled_energy(10.0)
    lines: p2sf.LineSpread = point.line_spread()
    six: p2sf.Coefficients = point.coefficients()
    fit: p2sf.ZernikeFit = point.zernike("noll", 15)
    choice: p2sf.Choice = point.choose_method()
    found = {"mtf": mtf.tangential[0], "energy": energy.fraction[0], "edge": lines.edge_x[0], "w40": six.w40}
    return {name: float(value) for name, value in found.items()} | {"rms": fit.rms, "1 - R²": choice.predicted_error}


def over_axes(camera: p2sf.Camera) -> np.ndarray:
    """Return contrasts over field and wavelength."""
    points = camera.at(field_deg=np.linspace(0, 14, 3), wavelength_nm=[450, 550], threads=1)
    contrast: p2sf.NamedArrays = points.mtf(20, "traced", turn_deg=0.0)
    found: np.ndarray = contrast["tangential"] + points.strehl()["strehl"]
    return found


def databases(lens: p2sf.Lens, folder: Path) -> float:
    """Return a coefficient looked up, and write what is written."""
    database: p2sf.Stored = p2sf.build_database(lens, [2000, inf], [0, 7], [450, 650], method="auto")
    again = p2sf.open_database(database.save(folder / "lens.npz"))
    p2sf.write_lens(lens, folder / "lens.toml")
    p2sf.write_psf(again.psf(p2sf.Source(3000, wavelength_nm=550)), folder / "psf.npz")
    return float(again.coefficients(depth_mm=np.linspace(2000, 5000, 10), field_deg=3.0).w31.mean())


def arrays(opd: np.ndarray) -> tuple[float, float]:
    """Return figures of a wavefront of one's own."""
    pupil = p2sf.Pupil.from_opd(opd, na=0.1, wavelength_nm=550)
    fitted: p2sf.PointFit = p2sf.fit_psf(np.asarray(pupil.psf(33, 0.5)), na=0.1, wavelength_nm=550, pixel_um=0.5)
    return pupil.strehl + float(p2sf.fit_zernike(opd, terms=11).marechal), float(fitted.r2[0])


def main(folder: Path) -> None:
    """Use it all."""
    camera = p2sf.Camera(p2sf.load_lens("double_gauss_28"), focus_mm=3000, f_number=5.6, pixel_um=4, aim="stop")
    green = p2sf.Channel("green", (540.0,), (1.0,))
    scene = p2sf.Scene(p2sf.Sensor(6, 8, 60.0), (green,), 2800, 3200, rtol=0.4, focus_mm=3000, f_number=8)
    planned: p2sf.Plan = p2sf.plan(camera.its_lens, scene)
    study: p2sf.ToleranceStudy = camera.tolerances({"mtf20": 0.5}, builds=100)
    picture: np.ndarray = p2sf.form_image(planned, np.ones((6, 8, 1)), np.full((6, 8), 3000.0))
    try:
        print(figures(camera), over_axes(camera), databases(camera.its_lens, folder), arrays(np.zeros((64, 64))))
        print(build(), study.yields["all"], picture.shape, p2sf.tradeoff(camera.its_lens, fields_deg=[0.0], pixels=16))
    except p2sf.P2SFError as error:
        print(error.message)
