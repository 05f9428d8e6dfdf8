"""Whole pictures against the kernel of every pixel: ``python -m tests.long.picture_crops 60 --keep FILE``.

Pictures of 200 × 300 pixels with edges of depth, highlights of fifty times white and colour, random scenes of
`tests.support.depth_scenes` through the lenses of `tests.benchmarks.image_simulation`, are formed by plans of a random
tolerance. One channel of 12 × 16 pixels somewhere in each, about an edge of depth where it can be, is compared with the
sum over single pixels, whose own kernels are right to some 0.002 (the benchmark prints it). The error is the L2
difference, and the allowed one the tolerance times the L2 norm of: the part's *light*; the contrast of the *object*
about its mean, in the part and as far around as kernels reach, which is what bounds the error (handbook, *Plans*, *What
this means for a picture*); the *contrast* of the part, which blur may leave little of and no tolerance of kernels
bounds. Pictures in FILE, JSON lines, are not made again.
"""

import argparse
import json
from itertools import product
from pathlib import Path

import numpy as np

from p2sf.image import form_image
from tests.benchmarks.image_simulation import BLUR, CAMERAS, for_reference, picture_of
from tests.support.depth_scenes import SCENES
from tests.support.per_pixel import Region, per_pixel_picture, widest_half

SHAPE, PART = (200, 300), (12, 16)
TOLERANCES = 0.2, 0.1, 0.05, 0.02
QUANTILES = 0.5, 0.95, 1.0
MEASURES = "light", "object", "contrast"


def crop_errors(number: int, shape: tuple[int, int] = SHAPE, part: tuple[int, int] = PART) -> dict[str, object]:
    """Return one picture's error over what is allowed of each of MEASURES, and what picture it is."""
    random = np.random.default_rng(number)
    camera = CAMERAS[int(random.integers(len(CAMERAS)))]
    scene, rtol = str(random.choice(list(SCENES))), float(random.choice(TOLERANCES))
    channel = int(random.integers(3))
    values, depth = picture_of(camera, scene, shape, number)
    made, exact = camera.plan(rtol, shape), for_reference(camera, shape)
    half = widest_half(exact, made.scene.vergences(2))
    region = _region(depth, part, 2 * half, random)
    truth = per_pixel_picture(exact, values[..., channel], depth, region, channel)
    off = form_image(made, values, depth, BLUR)[region][..., channel] - truth
    around = tuple(slice(side.start - half, side.stop + half) for side in region)
    spread = float(values[*around, channel].std()) * np.sqrt(truth.size)
    norms = np.linalg.norm(truth), spread, np.linalg.norm(truth - truth.mean())
    return {
        **{"number": number, "lens": camera.lens, "scene": scene, "rtol": rtol, "channel": channel},
        **{name: float(np.linalg.norm(off) / norm / rtol) for name, norm in zip(MEASURES, norms, strict=True)},
        "largest": float(np.abs(off).max()),
        "edge": _jumps(depth[region]),
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
    parts = {
        "all": found,
        "with an edge of depth": [each for each in found if each["edge"]],
        "without": [each for each in found if not each["edge"]],
    }
    for (words, some), measure in product(parts.items(), MEASURES):
        shares = np.quantile([each[measure] for each in some], QUANTILES) if some else []
        text = ", ".join(f"{q:.0%} {s:.2f}" for q, s in zip(QUANTILES, shares, strict=False))
        print(f"{len(some)} pictures, {words}: error / allowed of {measure}: {text}")


if __name__ == "__main__":
    main()
