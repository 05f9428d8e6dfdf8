"""Depth in layers: the share of each pixel in every layer, and the layers merged into one picture."""

import numpy as np

from p2sf.conventions import vergence
from p2sf.errors import RequestError
from p2sf.pixel_kernels.nodes import hats

LEAST_COVERAGE = 1e-6  # keeps the quotient finite if no layer covers a pixel


def layer_weights(depth_mm: np.ndarray, vergences: np.ndarray, shape: tuple[int, ...]) -> np.ndarray:
    """Return every pixel's share of each layer, (rows, columns, layers) float32, summing to 1.

    Between two nodes the share is linear in 1/depth, so a pixel's kernel is interpolated; beyond them it is that of the
    end. ``vergences`` increase: the farthest layer comes first. Raises RequestError for a map that does not fit.
    """
    if depth_mm.shape != tuple(shape):
        raise RequestError(
            "the depth map has the shape ({shape}), but the picture ({picture}); resize it",
            shape=depth_mm.shape,
            picture=tuple(shape),
        )
    if not (depth_mm > 0).all():
        raise RequestError(
            "the depth map holds depths that are not positive; give mm from the first vertex, inf allowed"
        )
    flat = hats(np.asarray(vergences), vergence(depth_mm).ravel())
    return np.moveaxis(flat.reshape(len(vergences), *shape), 0, -1).astype(np.float32)


def merge(layers: list[np.ndarray], numbers: list[int]) -> np.ndarray:
    """Return one picture of blurred layers, far to near; each is (rows, columns, channels + 1), its coverage last.

    ``numbers`` are the indices of the layers among all layers. A layer is hidden by the blurred coverage of nearer ones
    except its direct neighbour, with which it shares the pixels between the two. The remaining light is divided by the
    remaining coverage, so that a uniform object stays uniform.
    """
    light: np.ndarray = np.zeros_like(layers[0][..., :-1])
    covered: np.ndarray = np.zeros_like(layers[0][..., -1:])
    for position, (layer, number) in enumerate(zip(layers, numbers, strict=True)):
        seen = np.ones_like(layer[..., -1:])
        for nearer, other in zip(layers[position + 1 :], numbers[position + 1 :], strict=True):
            if other > number + 1:
                seen = seen * np.clip(1 - nearer[..., -1:], 0, 1)
        light = light + seen * layer[..., :-1]
        covered = covered + seen * layer[..., -1:]
    picture: np.ndarray = light / np.maximum(covered, LEAST_COVERAGE)
    return picture
