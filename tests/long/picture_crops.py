"""Whole pictures against the kernel of every pixel: ``python -m tests.long.picture_crops 60 --keep FILE``.

Pictures of 200 × 300 pixels with edges of depth, highlights of fifty times white and colour, random scenes of
`tests.support.depth_scenes` through the lenses of `tests.benchmarks.image_simulation`, are formed by plans of a random
tolerance, every other one for the depths of its map alone. One channel of 12 × 16 pixels somewhere in each,
about an edge of depth where it can be, is compared with the sum over single pixels, whose own kernels are right to some
0.002 (the benchmark prints it). The error is the L2 difference, and the allowed one the tolerance times the L2 norm of:
the part's *light*; the contrast of the *object* about its mean, in the part and as far around as kernels reach, which
is what bounds the error (handbook, *Plans*, *What ε means for a picture*); the *contrast* of the part, of which blur
may leave little and which no tolerance of kernels bounds. Pictures in FILE, JSON lines, are not made again.
"""

import argparse
import json
from functools import partial
from itertools import product
from pathlib import Path

import numpy as np

from p2sf.image.form import form_image
from tests.benchmarks.image_simulation import BLUR, CAMERAS, for_reference, picture_of
from tests.support.depth_scenes import SCENES
from tests.support.per_pixel import Region, per_pixel_picture, widest_half

SHAPE, PART = (200, 300), (12, 16)
TOLERANCES = 0.2, 0.1, 0.05, 0.02
QUANTILES = 0.5, 0.95, 1.0
MEASURES = "light", "object", "contrast"
PLANS = "a range of depths", "the map's depths"


def crop_errors(number: int, shape: tuple[int, int] = SHAPE, part: tuple[int, int] = PART) -> dict[str, object]:
    """Return which picture this is, and its error over what is allowed of each of MEASURES."""
    random = np.random.default_rng(number)
    camera = CAMERAS[int(random.integers(len(CAMERAS)))]
    scene, rtol = str(random.choice(list(SCENES))), float(random.choice(TOLERANCES))
    channel = int(random.integers(3))
    values, depth = picture_of(camera, scene, shape, number)
    exact, name = for_reference(camera, shape), PLANS[number % len(PLANS)]
    made = camera.plan(rtol, shape, depth if name == PLANS[1] else None)
    half = widest_half(exact, exact.scene.vergences(2))
    region = _region(depth, part, 2 * half, random)
    truth = per_pixel_picture(exact, values[..., channel], depth, region, channel)
    off = form_image(made, values, depth, BLUR)[region][..., channel] - truth
    around = tuple(slice(side.start - half, side.stop + half) for side in region)
    contrast = float(values[..., channel][around].std()) * np.sqrt(truth.size)
    norms = np.linalg.norm(truth), contrast, np.linalg.norm(truth - truth.mean())
    errors = {name: float(np.linalg.norm(off) / norm / rtol) for name, norm in zip(MEASURES, norms, strict=True)}
    return {
        **{"number": number, "lens": camera.lens, "scene": scene, "rtol": rtol, "channel": channel},
        **{"plan": name, **errors, "largest": float(np.abs(off).max()), "edge": _jumps(depth[region])},
    }


def _jumps(depth: np.ndarray) -> bool:
    return bool((depth != depth[0, 0]).any())


def _region(depth: np.ndarray, part: tuple[int, int], margin: int, random: np.random.Generator) -> Region:
    """Return a random part farther than ``margin`` from the edge, the first of ten tries that has two depths."""
    for _ in range(10):
        top, left = (int(random.integers(margin, n - margin - size)) for n, size in zip(depth.shape, part, strict=True))
        region = slice(top, top + part[0]), slice(left, left + part[1])
        if _jumps(depth[region]):
            break
    return region


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("pictures", type=int, nargs="?", default=60)
    parser.add_argument("--keep", type=Path, required=True)
    asked = parser.parse_args()
    lines = asked.keep.read_text(encoding="utf-8").splitlines() if asked.keep.exists() else []
    found = [json.loads(line) for line in lines]
    for number in sorted(set(range(asked.pictures)) - {each["number"] for each in found}):
        found.append(crop_errors(number))
        with asked.keep.open("a", encoding="utf-8") as file:
            file.write(json.dumps(found[-1]) + "\n")
        print(json.dumps(found[-1]), flush=True)
    kinds = {
        "all": lambda each: True,
        **{f"plans of {name}": partial(lambda name, each: each["plan"] == name, name) for name in PLANS},
        "with an edge of depth": lambda each: each["edge"],
        "without": lambda each: not each["edge"],
    }
    for (words, holds), measure in product(kinds.items(), MEASURES):
        shares = [each[measure] for each in found if holds(each)]
        if shares:
            text = ", ".join(f"{q:.0%} {s:.2f}" for q, s in zip(QUANTILES, np.quantile(shares, QUANTILES), strict=True))
            print(f"{words}, {len(shares)} parts: error / allowed of {measure}: {text}")


if __name__ == "__main__":
    main()
