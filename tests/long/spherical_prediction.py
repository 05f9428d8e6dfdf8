"""Predicted against measured difference of plane and spherical waves: ``python -m tests.long.spherical_prediction``.

A state is a shipped lens, its field, wavelength, Fresnel number from 1 to 10 000 and a defocus of up to the smaller of
10 and the Fresnel number in waves, drawn at random. Both sums converge in a window of 64 samples that shows the light.
Counted are the predictions within a factor of two, and the largest ratio of 1 − R² to (2π)² times the variance of the
bound that `auto` looks at first.
"""

import argparse
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from p2sf.errors import P2SFError
from p2sf.lens.lens import Lens, with_f_number, with_sensor
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.paraxial.first_order import image_distance
from p2sf.psf.compare import r_squared
from p2sf.psf.methods import render
from p2sf.psf.spherical import BOUND, fresnel_number, half_window_um, plane_wave_bound, plane_wave_error
from p2sf.raytrace.exit_sphere import exit_sphere
from p2sf.raytrace.fit import level_rays, levels_for
from p2sf.raytrace.pencil import pencil
from p2sf.raytrace.ray_field import steepness

LENSES = (
    *("achromat_f6", "cooke_triplet", "double_gauss_28", "eye_navarro", "landscape", "macro_floating", "periskop"),
    *("petzval", "plano_convex", "reverse_telephoto", "singlet_f6", "telephoto", "tessar", "wide_angle_35"),
)
PIXELS = 64
FEWEST, MOST = 1.0, 1e4  # Fresnel numbers
SMALLEST = 1e-9  # 1 − R² that both sums resolve


@dataclass(frozen=True)
class State:
    """One state, with 1 − R² of plane against spherical waves: predicted, measured, and its bound."""

    lens: str
    fresnel: float
    waves: float
    predicted: float
    difference: float
    bound: float


def with_fresnel_number(lens: Lens, source: Source, number: float) -> tuple[Lens, Source]:
    """Return a lens with its sensor in the Gaussian image on the axis, stopped down to a Fresnel number there."""
    lens = with_sensor(lens, float(image_distance(lens, source.depth_mm, source.wavelength_um)))
    axis, trial = replace(source, field_slope=0.0), 20.0
    found = fresnel_number(with_f_number(lens, trial), axis)
    return with_f_number(lens, trial * float(np.sqrt(found / number))), source


def defocused(lens: Lens, source: Source, number: float, waves: float) -> Lens:
    """Return a focused lens with its sensor where the spherical wave is off by so many waves at the rim.

    a²(1/R − 1/d)/2λ, for a sensor d from the pupil and an image R from there, which is λNR = a² in waves.
    """
    sphere = exit_sphere(lens, replace(source, field_slope=0.0))
    assert sphere is not None
    distance = sphere.distance
    return with_sensor(lens, lens.sensor_mm + distance / (1 - 2 * waves / number) - distance)


def states(count: int, seed: int = 1) -> Iterator[State]:
    """Yield so many random states whose light reaches the sensor; those without a difference are left out."""
    rng, found = np.random.default_rng(seed), 0
    while found < count:
        name = str(rng.choice(LENSES))
        lens = find_lens(name)
        angle = rng.uniform(0, max(np.abs(lens.fields_deg), default=0.0))
        source = Source(field_deg=float(angle), wavelength_um=float(rng.uniform(0.45, 0.65)))
        number = float(10 ** rng.uniform(np.log10(FEWEST), np.log10(MOST)))
        waves = float(rng.choice([-1, 1]) * min(10.0, number) * 10 ** rng.uniform(-2, 0))
        try:
            one = state(name, lens, source, number, waves)
        except P2SFError:
            continue
        if one is not None:
            found += 1
            yield one


def state(name: str, lens: Lens, source: Source, number: float, waves: float) -> State | None:
    """Return the state of a lens; None where the sensor would be at infinity, or no difference can be resolved."""
    if 2 * waves >= 0.95 * number:  # the sensor would be at infinity, or before the pupil
        return None
    lens = defocused(*with_fresnel_number(lens, source, number), number, waves)
    pitch = 2 * half_window_um(lens, source) / PIXELS
    own, plane = (render(lens, source, method, PIXELS, pitch) for method in ("spherical", "huygens"))
    difference = 1 - r_squared(plane.values, own.values)
    if difference < SMALLEST:
        return None
    xi, eta, weight = level_rays(levels_for(lens)[0])
    rays = pencil(lens, source, xi, eta)
    bound = plane_wave_bound(lens, source, rays, weight, steepness(rays, xi, eta).light_um)
    return State(name, number, waves, plane_wave_error(lens, source), difference, bound)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--states", type=int, default=300)
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()
    found = []
    for state in states(given.states, given.seed):
        found.append(state)
        print(
            f"{state.lens:18} N {state.fresnel:8.3g}  W {state.waves:7.3f}  predicted {state.predicted:.2e}  "
            f"measured {state.difference:.2e}  of the bound {state.difference / state.bound:.2g}",
            flush=True,
        )
    ratio = np.array([state.predicted / state.difference for state in found])
    within = ((ratio > 0.5) & (ratio < 2)).mean()
    most = max(BOUND * state.difference / state.bound for state in found)
    print(
        f"{len(found)} states: {100 * within:.1f} % within a factor of two; 1 - R² at most {most:.2f} of (2π)²·variance"
    )


if __name__ == "__main__":
    main()
