"""Measuring what was simulated: ``python -m tests.long.measure points 200``, and others of ``main``.

The long ones run in parts: ``points 50 2`` takes 50 trials from the seed 2, and so do ``faint``, ``free``,
``frames``, ``coverage`` and ``misaligned``; give each part a seed of its own and pool what they print.

Pictures of points come from a sum over other pupil nodes, with other points across a pixel, than a fit takes; frames go
the whole way from the picture: points are found, cut out and fitted. Every table states its counts. CPU seconds.
"""

import sys
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from time import process_time

import numpy as np

import p2sf
from p2sf.disc.mask import PupilMask
from p2sf.disc.quadrature import disc_nodes
from p2sf.disc.transform import sum_plane_waves
from p2sf.image.charts import draw_chart
from p2sf.image.deblur import psnr
from p2sf.image.form import Forming, form_image
from p2sf.io.photo_files import write_photo
from p2sf.lens.lens import with_f_number, with_mask, with_sensor
from p2sf.lensfile.library import find_lens
from p2sf.lensfile.toml.lens import read_toml
from p2sf.measure.fitting.frame_terms import F_NUMBER, FIELD, FOCUS, FrameModel, lens_optics
from p2sf.measure.fitting.point_fit import PointFit, fit_point
from p2sf.measure.fitting.point_model import PictureOptics, PixelSum
from p2sf.measure.fitting.point_problem import PointPicture
from p2sf.measure.fitting.pupil_model import PupilModel, pupil_model
from p2sf.measure.frame import FrameGeometry
from p2sf.measure.listings import read_listing
from p2sf.measure.measurement import FrameRequest, measure_frame
from p2sf.measure.reading import read_frame
from p2sf.measure.simulation import Exposure, grid_of_points, simulated_frame
from p2sf.scene.planning.plan import plan
from p2sf.scene.scene import Channel, Scene
from p2sf.scene.sensor import Sensor
from p2sf.studies import validate
from p2sf.tolerance.errors_of_build import Tolerance, build
from p2sf_explorer.compute.live import live
from p2sf_explorer.compute.views import image
from p2sf_explorer.compute.views.measured import answer, into_image, question, with_file_date
from p2sf_explorer.state.state import State, change, new_state
from tests.support.huygens_frames import cross_of_points, huygens_frame

OPTICS = PictureOptics(0.125, 0.55, 2.2)  # pixels of λ/2NA
PIXELS = 40
SECOND_FOCUS = 1.5  # waves
NOISE, PEAK = 0.01, 1000.0
FAINT_NOISE = 0.01, 0.03, 0.05, 0.1
MOST_WAVES = 3.0
NODES = 48, 144
LISTED = Path(__file__).parents[1] / "data" / "opticstudio"
CELLS = 15  # of a listed wavefront, from the middle to the rim
PARTS = 6  # points across a pixel
TIMED = 5
# RDMPy's calibration of its own simulated lens, as published: spherical, coma, astigmatism, field curvature, waves.
RDMPY_GIVEN, RDMPY_FOUND = np.array([1.58, -1.12, -2.1, 1.6]), np.array([0.72, 0.11, 1.78, 1.60])


@dataclass(frozen=True)
class Nodes:
    """Nodes of the whole disc."""

    xi: np.ndarray
    eta: np.ndarray
    weight: np.ndarray


def whole_disc() -> Nodes:
    half = disc_nodes(*NODES)
    return Nodes(np.append(half.xi, -half.xi), np.append(half.eta, half.eta), np.tile(half.weight / 2, 2))


def light(waves: np.ndarray, fx: np.ndarray, fy: np.ndarray, nodes: Nodes, place: np.ndarray) -> np.ndarray:
    """Return the light on pixels, (y, x), with Gauss–Legendre points across each: a plain sum over nodes."""
    point, share = np.polynomial.legendre.leggauss(PARTS)
    axis = ((np.arange(PIXELS) - PIXELS // 2)[:, None] + point / 2).ravel() * OPTICS.pixel_um
    amplitude = nodes.weight * np.exp(2j * np.pi * waves)
    field = sum_plane_waves(amplitude, fx, fy, axis - place[0], axis - place[1], even=False)
    square = (np.abs(field) ** 2).reshape(PIXELS, PARTS, PIXELS, PARTS)
    return np.einsum("ypxq,p,q->yx", square, share / 2, share / 2)


def pictures(
    model: PupilModel,
    numbers: np.ndarray,
    place: np.ndarray,
    foci: tuple[float, ...],
    rng: np.random.Generator,
    noise: float = NOISE,
) -> list[PointPicture]:
    """Return pictures of a point at known focus positions, their noise a share of the peak."""
    nodes = whole_disc()
    parts, across, along = model.split(numbers)
    waves = parts @ model.waves(nodes.xi, nodes.eta)
    fx, fy = OPTICS.cycles * nodes.xi, OPTICS.cycles * nodes.eta
    if model.mapped:
        odd, even = model.maps(nodes.xi, nodes.eta)
        fx, fy = OPTICS.cycles * (across @ odd), OPTICS.cycles * (along @ even)
    made = []
    for focus in foci:
        found = light(waves + focus * (nodes.xi**2 + nodes.eta**2), fx, fy, nodes, place)
        counts = found * (PEAK / found.max()) + 100 + rng.normal(0, noise * PEAK, found.shape)
        made.append(PointPicture(counts, (noise * PEAK) ** 2, focus))
    return made


def random_six(rng: np.random.Generator) -> np.ndarray:
    """Return W40, W31, W22 and W20 + Wd, each within 3 waves, whose wavefront stays within 3 waves too."""
    nodes = whole_disc()
    terms = pupil_model("seidel").waves(nodes.xi, nodes.eta)
    while True:
        six = rng.uniform(-MOST_WAVES, MOST_WAVES, 4)
        if np.abs(six @ terms).max() <= MOST_WAVES:
            return six


def six_coefficients(trials: int, seed: int) -> None:
    """Print errors of the six model, with one focus and with two, beside the Cramér–Rao bound."""
    for foci in ((0.0,), (0.0, SECOND_FOCUS)):
        rng, errors, bounds, seconds, wrong = np.random.default_rng(1 + seed), [], [], [], 0
        for trial in range(trials):
            six, place = random_six(rng), rng.uniform(-1, 1, 2) * OPTICS.pixel_um
            taken = pictures(pupil_model("seidel"), six, place, foci, rng)
            began = process_time()
            found = fit_point(taken, OPTICS)
            seconds.append(process_time() - began)
            solutions = [found.numbers, *found.others[:1]] if len(foci) == 1 else [found.numbers]
            best = min(solutions, key=lambda numbers: float(np.abs(numbers - six).max()))
            errors.append(best - six)
            bounds.append(found.bounds)
            wrong += int((np.sign(best) != np.sign(six))[np.abs(six) > 0.1].any())
            told = f"{np.round(errors[-1], 4)} bounds {np.round(bounds[-1], 4)}"
            print(f"  {trial}: {told}, {seconds[-1]:.2f} s", flush=True)
        report(f"six, {len(foci)} focus, {trials} trials", np.array(errors), np.array(bounds), seconds)
        print(f"  wrong signs (of numbers over 0.1 waves; with one focus in both twins): {wrong}")


def faint(count: int, seed: int) -> None:
    """Print which answers of `p2sf.fit_psf` on noisy frames of one point are wrong without a word.

    Four random coefficients and noise of 1, 3, 5 and 10 % of the peak, which is not stated. A frame is wrong where no
    solution has all numbers within 5 of its own standard deviations, and silent where the one warning is that which
    every single focus has, that the sign of the even terms is open; a warning beyond that one is needless where the
    answer is right.
    """
    model = pupil_model("seidel")
    for noise in FAINT_NOISE:
        rng, seconds = np.random.default_rng([seed, round(1000 * noise)]), []
        wrong = silent = needless = 0
        for trial in range(count):
            six, place = random_six(rng), rng.uniform(-1, 1, 2) * OPTICS.pixel_um
            (taken,) = pictures(model, six, place, (0.0,), rng, noise)
            began = process_time()
            found = p2sf.fit_psf(taken.values, 0.125, 550.0, OPTICS.pixel_um)
            seconds.append(process_time() - began)
            off = [float(np.abs((numbers - six) / found.errors).max()) for numbers in (found.numbers, *found.others)]
            warned = len(found.warnings) > 1
            needless += warned and min(off) <= 5
            if min(off) > 5:
                wrong, silent = wrong + 1, silent + (not warned)
                print(f"  {noise:.0%} {trial}: {np.round(six, 3)} found {found}, {min(off):.1f} sigma", flush=True)
        print(
            f"noise {noise:.0%}, {count} frames: {wrong} beyond 5 sigma, {silent} of them silent; {needless} of "
            f"{count - wrong} right ones warned of; CPU median {np.median(seconds):.2f}, largest {max(seconds):.2f} s",
            flush=True,
        )


def report(title: str, errors: np.ndarray, bounds: np.ndarray, seconds: list[float]) -> None:
    size = np.abs(errors)
    print(
        f"{title}: error median {np.median(size):.4f}, 95 % {np.quantile(size, 0.95):.4f} waves; bound median "
        f"{np.median(bounds):.4f}, expected median of |error| at the bound {0.6745 * np.median(bounds):.4f}; within "
        f"1σ {np.mean(size < bounds):.0%}; CPU median {np.median(seconds):.2f}, 95 % {np.quantile(seconds, 0.95):.2f} s"
    )


def free_pupils(trials: int, seed: int) -> None:
    """Print RMS wavefront errors of 26 numbers at two foci, over directions: what a picture tells."""
    model, rng, errors, seconds, bounds = pupil_model("26"), np.random.default_rng(2 + seed), [], [], []
    orders = np.array([int(name[2]) for name in model.wave_names])
    for trial in range(trials):
        waves = rng.normal(0, 0.25, orders.size) / (orders - 1) ** 2
        maps = model.paraxial_map + rng.normal(0, 0.005, len(model.map_names))
        numbers = np.concatenate([waves, maps])
        taken = pictures(model, numbers, rng.uniform(-1, 1, 2) * OPTICS.pixel_um, (0.0, SECOND_FOCUS), rng)
        began = process_time()
        found = fit_point(taken, OPTICS, "26")
        seconds.append(process_time() - began)
        errors.append(rms_over_directions(found, numbers))
        count = len(model.wave_names)
        bounds.append(float(np.sqrt(np.trace(found.covariance[:count, :count]))))
        print(f"  {trial}: {errors[-1]:.4f} bound {bounds[-1]:.4f}, {seconds[-1]:.2f} s", flush=True)
    print(
        f"26 numbers, 2 foci, {trials} trials: RMS wavefront error median {np.median(errors):.4f}, 95 % "
        f"{np.quantile(errors, 0.95):.4f} waves; bound median {np.median(bounds):.4f}; CPU median "
        f"{np.median(seconds):.2f}, 95 % {np.quantile(seconds, 0.95):.2f} s"
    )


def rms_over_directions(found: PointFit, truth: np.ndarray) -> float:
    """Return the RMS difference of two wavefronts where light goes the same way, without piston and tilt."""
    model, nodes = found.model, whole_disc()

    def at(numbers: np.ndarray, xi: np.ndarray, eta: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        waves, across, along = model.split(numbers)
        odd, even = model.maps(xi, eta)
        return waves @ model.waves(xi, eta), across @ odd, along @ even

    wanted, fx, fy = at(truth, nodes.xi, nodes.eta)
    xi, eta = nodes.xi.copy(), nodes.eta.copy()
    for _ in range(8):
        _, gx, gy = at(found.numbers, xi, eta)
        xi, eta = xi - (gx - fx), eta - (gy - fy)
    rest = at(found.numbers, xi, eta)[0] - wanted
    root = np.sqrt(nodes.weight)
    planes = np.stack([np.ones_like(fx), fx, fy]) * root
    rest = rest * root - np.linalg.lstsq(planes.T, rest * root, rcond=None)[0] @ planes
    return float(np.linalg.norm(rest))


def rdmpy() -> None:
    """Print RDMPy's published case beside ours: its numbers on one picture, with one focus and with two."""
    model, rng = pupil_model("seidel"), np.random.default_rng(0)
    six = np.array([RDMPY_GIVEN[0], RDMPY_GIVEN[1], RDMPY_GIVEN[2], RDMPY_GIVEN[3]])
    print("W40, W31, W22, W20 in waves           error (largest)   wrong signs   CPU s")
    print(f"given            {np.round(RDMPY_GIVEN, 2)}")
    lost = int((np.sign(RDMPY_FOUND) != np.sign(RDMPY_GIVEN)).sum())
    print(f"RDMPy, published {RDMPY_FOUND}   {np.abs(RDMPY_FOUND - RDMPY_GIVEN).max():.2f}   {lost}   8 to 11 (s)")
    for foci in ((0.0,), (0.0, SECOND_FOCUS)):
        taken = pictures(model, six, np.array([0.4, -0.7]), foci, rng)
        began = process_time()
        found = fit_point(taken, OPTICS)
        took = process_time() - began
        for name, numbers in (("ours", found.numbers), *(("  twin", twin) for twin in found.others[:1])):
            wrong = int((np.sign(numbers) != np.sign(six)).sum())
            print(
                f"{name}, {len(foci)} focus   {np.round(numbers, 3)}   {np.abs(numbers - six).max():.3f}   {wrong}   "
                f"{took:.2f}"
            )


def listing() -> None:
    """Print the statistics of a wavefront fitted to a PSF that OpticStudio listed, beside those that it listed."""
    psf, wavefront = LISTED / "huygens_psf_0_1.75.txt", read_listing(LISTED / "wavefront_0_1.75.txt")
    frame, lens = read_frame(psf), read_toml(Path(validate.__file__).with_name("telescope.toml"))
    optics = lens_optics(lens, np.inf, 0.5, frame.geometry.pixel_um)
    began = process_time()
    (found,) = measure_frame([frame], optics, FrameRequest(lens=lens, model="46", clip=True)).fits
    took = process_time() - began
    rows, columns = np.nonzero(wavefront.inside)
    eta, xi = ((part - middle) / CELLS for part, middle in zip((rows, columns), wavefront.centre, strict=True))
    waves, listed = found.waves(xi, eta), wavefront.values[wavefront.inside]
    print(f"listed PSF: R² {found.r2[0]:.5f}, CPU {took:.1f} s")
    for name, one, other in (("peak to valley", np.ptp(waves), np.ptp(listed)), ("RMS", waves.std(), listed.std())):
        print(f"  {name}: fitted {one:.4f}, listed {other:.4f} waves, {one / other - 1:+.2%}")
    print(f"  RMS difference {(waves - listed).std():.4f} waves, of the opposite sign {(waves + listed).std():.4f}")


def frames(trials: int, seed: int, columns: int = 9, rows: int = 7, size_mm: tuple[float, float] = (12.0, 9.0)) -> None:
    """Print what points through the Cooke triplet at f/4 tell of the sensor and the field, 1 % noise."""
    lens, pitch = with_f_number(find_lens("cooke_triplet"), 4.0), 3.45
    optics = lens_optics(lens, np.inf, lens.reference_wavelength_um, pitch)
    width, height = size_mm
    places = grid_of_points(columns, rows, width, height)
    geometry = FrameGeometry(round(1000 * height / pitch) + 290, round(1000 * width / pitch) + 320, pitch)
    rng, misses, sizes, stated, seconds = np.random.default_rng(3 + seed), [], [], [], []
    for trial in range(trials):
        shift, tilt = rng.uniform(-30, 30), rng.uniform(-0.1, 0.1, 2)
        exposure = Exposure(sensor_shift_um=shift, tilt_deg=tuple(tilt.tolist()), seed=trial + 1000 * seed)
        frame = simulated_frame(lens, places, geometry, exposure)
        began = process_time()
        found = measure_frame([frame], optics, FrameRequest(lens=lens, singly=False)).whole
        seconds.append(process_time() - began)
        misses.append(found.values - np.array([shift, *tilt, 0.0, 0.0, 0.0, 0.0, 0.0]))
        sizes.append(found.bounds)
        stated.append(found.errors)
        print(f"  {trial}: {np.round(misses[-1], 4)} bounds {np.round(sizes[-1], 4)} χ² {found.chi2:.3f}", flush=True)
    miss, size, within = np.array(misses), np.array(sizes), np.abs(misses) < np.array(stated)
    print(f"frames of {columns * rows} points, {trials} trials, CPU median {np.median(seconds):.1f} s")
    for k, name in enumerate((*FOCUS, *FIELD, F_NUMBER)):
        print(
            f"  {name:16} RMS error {np.sqrt(np.mean(miss[:, k] ** 2)):.4f}, mean {miss[:, k].mean():.4f}, bound "
            f"{np.median(size[:, k]):.4f}, within the stated 1σ {within[:, k].mean():.0%}"
        )
    print(
        f"  errors within the stated 1σ: {within.mean():.1%} of {within.size}, within 2σ "
        f"{np.mean(np.abs(miss) < 2 * np.array(stated)):.1%}"
    )


def masked() -> None:
    """Print what a point's light and its derivatives take behind masks and rims."""
    clear = with_f_number(find_lens("cooke_triplet"), 4.0)
    spider = PupilMask(obscuration=0.3, vanes=3, vane_width=0.05)
    iris = with_mask(clear, PupilMask(blades=7))
    cases = {"clear": clear, "blades": iris, "vanes": with_mask(clear, spider), "rims": clear}
    for name, lens in cases.items():
        optics = lens_optics(lens, np.inf, 0.55, 3.45)
        pupil = FrameModel(optics, 6.0, lens=lens, clip=name == "rims").pupils(3.0, 5.0, 70.0)[0]
        columns = np.concatenate([pupil.terms, -pupil.nodes.fx[None], -pupil.nodes.fy[None]]).astype(np.float32)
        made = PixelSum(pupil.nodes, (41, 41), optics)
        began = process_time()
        for _ in range(TIMED):
            made.light_and_slopes(pupil.phase, columns)
        took = (process_time() - began) / TIMED
        print(f"{name}: {pupil.nodes.xi.size} nodes, {1000 * took:.0f} ms of CPU")


def misaligned(trials: int, seed: int) -> None:
    """Print what nine points through the Cooke triplet at f/4 tell of its second element, decentred, and the sensor.

    The pictures are sums over other rays and nodes than the fit's.
    """
    lens, pitch = with_f_number(find_lens("cooke_triplet"), 4.0), 3.45
    errors = [Tolerance("decentre_x", 3, 0.1, 4), Tolerance("decentre_y", 3, 0.1, 4)]
    truth = np.array([15.0, 0.0, 0.0, 0.04, -0.06])
    built = with_sensor(build(lens, errors, truth[3:].tolist()), lens.sensor_mm + truth[0] / 1000)
    optics = lens_optics(lens, np.inf, lens.reference_wavelength_um, pitch)
    unknowns = (*FOCUS, "decentre_x:3-4", "decentre_y:3-4")
    geometry = FrameGeometry(2100, 2100, pitch)
    for trial in range(seed, seed + trials):
        frame = huygens_frame(built, cross_of_points(1.5, 3.0) / 50, geometry, seed=trial)
        began = process_time()
        found = measure_frame([frame], optics, FrameRequest(lens=lens, unknowns=unknowns, singly=False)).whole
        took = process_time() - began
        print(f"misaligned triplet, seed {trial}: reduced χ² {found.chi2:.3f}, CPU {took:.1f} s")
        columns = zip((*unknowns, F_NUMBER), found.values, np.append(truth, 0.0), found.errors, strict=True)
        for name, value, wanted, error in columns:
            print(f"  {name:16} {value:.5f} ± {error:.5f}, put in {wanted}, {(value - wanted) / error:+.1f}σ")


def deblur() -> None:
    """Print what sharpening loses by the lens as measured: points photographed, measured, taken into Image, a photo."""
    lens, pitch, shape, noise, shift = with_f_number(find_lens("cooke_triplet"), 4.0), 3.45, (240, 360), 0.005, 60.0
    frame = simulated_frame(
        lens, grid_of_points(5, 4, 6.0, 4.5), FrameGeometry(1500, 2000, pitch), Exposure(sensor_shift_um=shift)
    )
    built = with_sensor(lens, lens.sensor_mm + shift / 1000)
    truth = draw_chart("landscape", *shape)[..., 1:2]
    scene = Scene(Sensor(*shape, pitch), (Channel("green", (550.0,), (1.0,)),))
    blurred = form_image(plan(built, scene), truth, how=Forming(geometry=False))
    with TemporaryDirectory() as folder:
        points, photo = Path(folder) / "points.npy", Path(folder) / "photo.tif"
        np.save(points, frame.values)
        write_photo(photo, blurred + np.random.default_rng(1).normal(0, noise, blurred.shape), "linear")
        entries = {"lens": "cooke_triplet", "f_number": 4.0, "wavelength_nm": 550.0, "field_deg": 2.0}
        state = new_state(**entries, measured_picture=str(points), method="seidel")
        found = answer(with_file_date(question(live(state)).question), lambda: False, lambda share: None).whole
        taken = change(state, **into_image(found, pitch, state), photo_source=str(photo))
        print(f"deblurring, sensor {shift:g} µm too far, measured {taken.optics.sensor_shift_um:.2f} µm")
        for name, um in (("measured", taken.optics.sensor_shift_um), ("it is", shift), ("designed", 0.0)):
            sharp, unsharp = levels(change(taken, sensor_shift_um=um), truth)
            print(f"  by PSFs of the lens as {name}: {sharp:.2f} dB, unsharpened {unsharp:.2f} dB")


def levels(state: State, truth: np.ndarray) -> tuple[float, float]:
    """Return the PSNR of a photo sharpened in the Image panel, and of the photo, without their borders."""
    asked = image.question(live(state)).question
    made = image.planned_picture(asked)
    top = round((truth.shape[0] - asked.shape[0]) / 2 - 1000 * asked.centre_mm / asked.pixel_um)
    left = (truth.shape[1] - asked.shape[1]) // 2
    wanted = truth[top : top + asked.shape[0], left : left + asked.shape[1]]
    inside = (slice(24, -24),) * 2
    after, before = (psnr(values[inside][..., :1], wanted[inside]) for values in (made.after, made.before))
    return after, before


def main(arguments: list[str]) -> None:
    """Run one trial, or all with few counts."""
    count, seed = (int(arguments[k]) if len(arguments) > k else usual for k, usual in ((1, 20), (2, 0)))
    trials = {
        "points": lambda: six_coefficients(count, seed),
        "faint": lambda: faint(count if len(arguments) > 1 else 50, seed),
        "free": lambda: free_pupils(count, seed),
        "rdmpy": rdmpy,
        "listing": listing,
        "frames": lambda: frames(count, seed),
        "coverage": lambda: frames(count, seed, 3, 3, (6.0, 4.5)),
        "misaligned": lambda: misaligned(count if len(arguments) > 1 else 1, seed),
        "masked": masked,
        "deblur": deblur,
    }
    for name in arguments[:1] or trials:
        trials[name]()


if __name__ == "__main__":
    main(sys.argv[1:])
