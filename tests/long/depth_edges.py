"""Edges of depth against what every part of the pupil sees: ``python -m tests.long.depth_edges``.

Twenty configurations of two depths, 2 m and 8 m, through the Double Gauss at f/4 on pixels of 20 µm: an edge with the
near side on the left, one on the right, a window in the near plane, a wire, a slit, a fence, with the focus on the near
depth, between them and on the far one; and a pane of 50 % transparency given as layers. Each is compared with a sum
over the pupil in which every ray is looked up in the scene by itself (`tests.support.visibility`), in a band of nine
pixels about the edges: the former way, in which the blurred layers are added and divided by what they cover, and this
program's. So are random stacks of two and three layers through four lenses, with blurs of 3 to 12 pixels, by this
program alone. Kernels are densities of rays on both sides, so that occlusion alone is compared.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from itertools import product

import numpy as np
from scipy.ndimage import gaussian_filter, maximum_filter

from p2sf.conventions import vergence
from p2sf.image.form import Forming, form_image
from p2sf.image.preview import BY_RAYS, preview_plan
from p2sf.lensfile.library import find_lens
from p2sf.scene.planning.plan import Plan
from p2sf.scene.scene import Channel, Scene
from p2sf.scene.sensor import Sensor
from tests.support.visibility import seen_through_layers, seen_through_pupil

SIDE, MARGIN, BAND = 61, 14, 9
WIDE, STACKS = 81, 40
LENSES = "double_gauss_28", "achromat_f6", "cooke_triplet", "tessar"
NEAR_MM, FAR_MM, BETWEEN_MM = 2000.0, 8000.0, 3500.0
FOCI = {"near": NEAR_MM, "between": BETWEEN_MM, "far": FAR_MM}
GREEN = (Channel("green", (540.0,), (1.0,)),)
BLUR = Forming(geometry=False)
GOAL = 0.01  # rms of white in the band

Silhouette = Callable[[np.ndarray, np.ndarray], np.ndarray]
SHAPES: dict[str, Silhouette] = {
    "near over far, left": lambda x, y: x < SIDE // 2,
    "near over far, right": lambda x, y: x > SIDE // 2,
    "far through a window": lambda x, y: np.maximum(abs(x - SIDE // 2), abs(y - SIDE // 2)) > 10,
    "wire": lambda x, y: abs(x - SIDE // 2) <= 1,
    "slit": lambda x, y: abs(x - SIDE // 2) > 2,
    "fence": lambda x, y: x % 12 < 3,
}
PANE = "pane of 50 %"


@dataclass(frozen=True)
class EdgeErrors:
    """Differences from the sum over the pupil in the band: root mean square and largest, of white."""

    rms: float
    largest: float


def configurations() -> list[tuple[str, str]]:
    """Return shapes and foci."""
    return [*product(SHAPES, FOCI), (PANE, "near"), (PANE, "far")]


def edge_plan(focus: str) -> Plan:
    """Return the plan of two depths by rays, the same kernel everywhere."""
    scene = Scene(Sensor(SIDE, SIDE, 20.0), GREEN, NEAR_MM, FAR_MM, focus_mm=FOCI[focus], f_number=4.0)
    made = preview_plan(scene.camera(find_lens("double_gauss_28")), scene)
    return replace(made, recipe=BY_RAYS, counts=(1, 1), vergences=(1 / FAR_MM, 1 / NEAR_MM))


def textured(near: np.ndarray) -> np.ndarray:
    """Return a texture, lighter on the near side, and lit so that nothing in it is darker than no light."""
    texture = gaussian_filter(np.random.default_rng(3).normal(size=near.shape), 3)
    found: np.ndarray = np.where(near, 1.0, 0.6) + 0.15 * texture / texture.std()
    return found


def coverage_divided_out(made: Plan, picture: np.ndarray, depth: np.ndarray) -> np.ndarray:
    """Return the former picture: blurred layers, each with the pixels of its own depth, over what they cover."""
    total = np.zeros((*picture.shape, 2))
    for node in made.vergences:
        own = np.isclose(vergence(depth), node)
        for k, plane in enumerate((picture * own, own.astype(float))):
            total[..., k] += form_image(replace(made, vergences=(node,)), plane[..., None], None, BLUR)[..., 0]
    found: np.ndarray = total[..., 0] / total[..., 1]
    return found


def band_of(near: np.ndarray) -> np.ndarray:
    """Return which pixels are within four of an edge and far enough from the picture's edge."""
    edge = np.zeros(near.shape, bool)
    edge[:, 1:] |= near[:, 1:] != near[:, :-1]
    edge[1:] |= near[1:] != near[:-1]
    band: np.ndarray = maximum_filter(edge, BAND)
    band[:MARGIN], band[-MARGIN:], band[:, :MARGIN], band[:, -MARGIN:] = False, False, False, False
    return band


def edge_errors(shape: str, focus: str) -> tuple[EdgeErrors, EdgeErrors]:
    """Return the errors of the former way and of this program."""
    made, (y, x) = edge_plan(focus), np.indices((SIDE, SIDE))
    near = SHAPES.get(shape, SHAPES["near over far, left"])(x, y)
    if shape == PANE:
        pictures = _pane(made, near)
    else:
        picture, depth = textured(near), np.where(near, NEAR_MM, FAR_MM)
        formed = form_image(made, picture[..., None], depth, BLUR)[..., 0]
        pictures = coverage_divided_out(made, picture, depth), formed, seen_through_pupil(made, near, picture)
    *found, seen = (each[band_of(near)] for each in pictures)
    former, now = (
        EdgeErrors(float(np.sqrt(np.mean((each - seen) ** 2))), float(np.abs(each - seen).max())) for each in found
    )
    return former, now


def _pane(made: Plan, near: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return pictures of a half-transparent pane before a wall: former, formed from layers, and through the pupil.

    The former way has no transparency: the pane and what is seen in it have its depth.
    """
    pane, wall, alpha = textured(near), textured(~near), 0.5 * near
    mixed = alpha * pane + (1 - alpha) * wall
    former = coverage_divided_out(made, mixed, np.where(near, NEAR_MM, FAR_MM))
    stack = np.stack([np.stack([pane * alpha, alpha], -1), np.stack([wall, np.ones_like(wall)], -1)])
    formed = form_image(made, stack, np.array([NEAR_MM, FAR_MM]), BLUR)[..., 0]
    return former, formed, seen_through_layers(made, [(alpha, pane), (np.ones_like(wall), wall)])


def random_stack(seed: int) -> tuple[str, EdgeErrors]:
    """Return what a random stack is, and this program's errors.

    Its layers are half planes, bars and discs, a fourth of them as glass is, each with an edge of its own in colour.
    """
    random = np.random.default_rng(seed)
    lens, f_number = str(random.choice(LENSES)), float(random.choice((5.6, 8.0)))
    count, focus_mm = int(random.integers(2, 4)), float(1 / random.uniform(1 / 12000, 1 / 1200))
    depths = np.sort(1 / random.choice(np.linspace(1 / FAR_MM, 1 / NEAR_MM, 5), count, replace=False))

    def made(pixel_um: float) -> Plan:
        sensor = Sensor(WIDE, WIDE, pixel_um)
        scene = Scene(sensor, GREEN, *depths[[0, -1]].tolist(), focus_mm=focus_mm, f_number=f_number)
        found = preview_plan(scene.camera(find_lens(lens)), scene)
        return replace(found, recipe=BY_RAYS, counts=(1, 1), vergences=tuple((1 / depths[::-1]).tolist()))

    rays = [made(20.0).kernels(0, float(v)).lights(0.0, 0.0)[0][0] for v in 1 / depths]
    widest = max(float(np.hypot(each.x_um, each.y_um).max()) for each in rays)
    planned = made(widest / random.uniform(3, 12))
    masks = [_shape(random) for _ in depths[1:]]
    alphas = [mask * (random.uniform(0.3, 0.9) if random.random() < 0.25 else 1.0) for mask in masks]
    layers = [(alpha, textured(mask)) for alpha, mask in zip(alphas, masks, strict=True)]
    layers.append((np.ones((WIDE, WIDE)), textured(_shape(random))))
    stack = np.stack([np.stack([alpha * colour, alpha], -1) for alpha, colour in layers])
    band = np.any([band_of(mask) for mask in masks], axis=0)
    off = (form_image(planned, stack, depths, BLUR)[..., 0] - seen_through_layers(planned, layers))[band]
    return f"{lens}, {count} layers", EdgeErrors(float(np.sqrt(np.mean(off**2))), float(np.abs(off).max()))


def _shape(random: np.random.Generator) -> np.ndarray:
    """Return where a half plane, a bar or a disc near the middle is."""
    y, x = np.indices((WIDE, WIDE)) - WIDE // 2
    angle, aside, wide = random.uniform(0, np.pi), random.uniform(-6, 6), random.uniform(2, 10)
    across = x * np.cos(angle) + y * np.sin(angle) - aside
    shapes = across > 0, abs(across) < wide / 2, np.hypot(x - aside, y) < wide
    found: np.ndarray = shapes[int(random.integers(3))]
    return found


def main() -> None:
    print("| edge | focus | before: rms | largest | now: rms | largest |\n|---|---|---|---|---|---|")
    every = []
    for shape, focus in configurations():
        former, now = edge_errors(shape, focus)
        every.append((focus, now.rms))
        print(
            f"| {shape} | {focus} | {former.rms:.3f} | {former.largest:.2f} | {now.rms:.4f} | {now.largest:.3f} |",
            flush=True,
        )
    beyond = [rms for _, rms in every if rms > GOAL]
    print(f"{len(every)} edges, worst {max(rms for _, rms in every):.3f} rms; {len(beyond)} beyond {GOAL}")
    stacks = [random_stack(seed)[1] for seed in range(STACKS)]
    for name in ("rms", "largest"):
        middle, most = np.quantile([getattr(each, name) for each in stacks], (0.5, 1.0))
        print(f"{STACKS} random stacks of layers, {name}: median {middle:.4f}, worst {most:.4f}")


if __name__ == "__main__":
    main()
