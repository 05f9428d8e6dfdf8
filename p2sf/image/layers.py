"""Depth in layers: how much of each pixel belongs to a layer, and which layers hide which."""

import numpy as np

from p2sf.conventions import vergence
from p2sf.errors import RequestError
from p2sf.pixel_kernels.nodes import hats

THIN = 1e-6  # coverage below which nothing is known of what stands behind


def layer_weights(depth_mm: np.ndarray, vergences: np.ndarray, shape) -> np.ndarray:
    """Return every pixel's share of each layer, (rows, columns, layers) float32, summing to 1.

    Between two nodes the share is linear in 1/depth, so a pixel's kernel is interpolated; beyond them it is the end's.
    ``vergences`` increase: the farthest layer comes first. Raises RequestError for a map that does not fit.
    """
    if depth_mm.shape != tuple(shape):
        raise RequestError(f"the depth map has the shape {depth_mm.shape}, but the picture {tuple(shape)}; resize it")
    if not (depth_mm > 0).all():
        raise RequestError(
            "the depth map holds depths that are not positive; give mm from the first vertex, inf allowed"
        )
    flat = hats(np.asarray(vergences), vergence(depth_mm).ravel())
    return np.moveaxis(flat.reshape(len(vergences), *shape), 0, -1).astype(np.float32)


def merged(layers: list[np.ndarray], numbers: list[int]) -> np.ndarray:
    """Return one picture of blurred layers, far to near; each is (rows, columns, channels + 1), its coverage last.

    A layer is hidden by the blurred coverage of nearer ones, but not of its direct neighbour, with which it shares
    the pixels between the two; what is left is divided by the coverage that is left, so that an even object stays even.
    """
    light, covered = 0.0, 0.0
    for position, (layer, number) in enumerate(zip(layers, numbers, strict=True)):
        seen = np.ones_like(layer[..., -1:])
        for nearer, other in zip(layers[position + 1 :], numbers[position + 1 :], strict=True):
            if other > number + 1:
                seen = seen * np.clip(1 - nearer[..., -1:], 0, 1)
        light = light + seen * layer[..., :-1]
        covered = covered + seen * layer[..., -1:]
    return light / np.maximum(covered, THIN)
