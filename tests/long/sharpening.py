"""What sharpening gains or loses: ``python -m tests.long.sharpening``, half a minute of one core.

Six pictures through seven states of lenses, from blurs below a pixel to blurs wider than a third of the picture, with
noise of 0.001, 0.02 and 0.05 of white. Pictures are blurred with far more kernels than sharpening has. For each: the
PSNR in dB of the picture as blurred, sharpened with the noise as estimated and as stated, and by Wiener's filter with
one kernel and a constant in the place of noise over signal, the constant with the best result. Lines where a sharpened
picture is farther from its scene than before by more than 0.05 dB, what one draw of noise may do, end in *worse*.
"""

from dataclasses import replace

import numpy as np

from p2sf.camera import Camera
from p2sf.image.charts import draw_chart
from p2sf.image.deblur import photo_statistics, psnr, wiener
from p2sf.image.form import Forming, form_image, plan_lattice
from p2sf.image.lattice import Lattice

SIDE, BY_CHANCE = 160, 0.05
STATES = {
    "Cooke triplet f/5, 12 µm": ("cooke_triplet", {"f_number": 5.0, "pixel_um": 12.0}, None),
    "Cooke triplet f/5, 6 µm": ("cooke_triplet", {"f_number": 5.0, "pixel_um": 6.0}, None),
    "Double Gauss f/4, 8 µm": ("double_gauss_28", {"f_number": 4.0, "pixel_um": 8.0}, None),
    "achromat f/8, 8 µm": ("achromat_f6", {"f_number": 8.0, "pixel_um": 8.0}, None),
    "landscape lens, 40 µm": ("landscape", {"pixel_um": 40.0}, None),
    "Double Gauss, blur 27 px": ("double_gauss_28", {"f_number": 4.0, "pixel_um": 20.0, "focus_mm": 8000.0}, 3000.0),
    "Double Gauss, blur 61 px": ("double_gauss_28", {"f_number": 2.8, "pixel_um": 20.0, "focus_mm": 8000.0}, 2000.0),
}


def texture(side: int, seed: int = 0) -> np.ndarray:
    """Return a texture whose amplitude falls with 1/f, (side, side), mean 0.5 and standard deviation 0.15."""
    frequency = np.hypot(np.fft.fftfreq(side)[:, None], np.fft.fftfreq(side))
    frequency[0, 0] = 1
    noise = np.random.default_rng(seed).normal(size=(side, side))
    values = np.fft.ifft2(np.fft.fft2(noise) / frequency).real
    values -= values.mean()
    return np.clip(0.5 + 0.15 * values / values.std(), 0, 1)


def pictures() -> dict[str, np.ndarray]:
    """Return the pictures, (SIDE, SIDE, 1)."""
    charts = {name: draw_chart(name, SIDE, SIDE) for name in ("landscape", "text", "siemens_star", "checkerboard")}
    own = {"1/f": texture(SIDE), "bimodal": 0.1 + 0.8 * (texture(SIDE, 3) > 0.5)}
    return {name: values[..., :1].astype(np.float32) for name, values in charts.items()} | {
        name: values[..., None].astype(np.float32) for name, values in own.items()
    }


def plain_filters(photo: np.ndarray, lattice: Lattice, truth: np.ndarray) -> list[float]:
    """Return the PSNR of Wiener's filter by the middle kernel, with constants half a decade apart."""
    kernel, margin = lattice.at(SIDE / 2, SIDE / 2)[0], 3 * lattice.half
    padded = np.pad(photo[..., 0], margin, mode="symmetric")
    plane = np.zeros(padded.shape)
    plane[: len(kernel), : len(kernel)] = kernel
    transfer = np.fft.fft2(np.roll(plane, (-lattice.half, -lattice.half), (0, 1)))
    found, inner = [], np.s_[margin : margin + SIDE, margin : margin + SIDE]
    for constant in 10 ** np.arange(-7, 0.5, 0.5):
        gain = np.conj(transfer) / (np.abs(transfer) ** 2 + constant)
        found.append(psnr(np.fft.ifft2(np.fft.fft2(padded) * gain).real[inner], truth[..., 0]))
    return found


def main() -> None:
    """Print the table in Markdown."""
    print("| state | picture | noise | as blurred | estimated | stated | plain, its best | |")
    print("|---|---|---|---|---|---|---|---|")
    for state, (lens, settings, depth_mm) in STATES.items():
        camera = Camera(lens, **settings)
        planned = camera.picture_plan(np.ones((SIDE, SIDE)), depth_mm)
        lattice, fine = plan_lattice(planned, planned.vergences[0]), replace(planned, counts=(9, 9))
        for name, truth in pictures().items():
            blurred = form_image(fine, truth, how=Forming(geometry=False))
            for noise in (0.001, 0.02, 0.05):
                photo = blurred + np.random.default_rng(1).normal(0, noise, blurred.shape).astype(np.float32)
                estimated = wiener(photo, lattice, photo_statistics(photo, lattice))
                before, *after = (psnr(x, truth) for x in (photo, estimated, wiener(photo, lattice, noise)))
                worse = "*worse*" if min(after) < before - BY_CHANCE else ""
                row = (before, *after, max(plain_filters(photo, lattice, truth)))
                print(f"| {state} | {name} | {noise:g} | {' | '.join(f'{x:.1f}' for x in row)} | {worse} |", flush=True)


if __name__ == "__main__":
    main()
