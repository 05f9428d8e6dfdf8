"""Predicted against measured difference of plane and spherical waves: ``python -m tests.long.spherical_prediction``.

A state is a shipped lens, its field, wavelength, Fresnel number from 1 to 10 000 and a defocus of up to the smaller of
10 and the Fresnel number in waves, drawn at random. Both sums converge in a window of 64 samples that shows the light.
Counted are the predictions within a factor of two, over all states and over each half of them, and the largest ratio of
1 − R² to the bound that `auto` looks at first. ``--keep FILE`` adds every state to a file
as it is found, and goes on where that file ends.
"""

import argparse
import json
from collections.abc import Iterator
from dataclasses import asdict, dataclass, replace
from itertools import count
from pathlib import Path

import numpy as np

from p2sf.errors import GeometryError, P2SFError, SamplingError
from p2sf.figures.compare import r_squared
from p2sf.lens.lens import Lens, with_f_number, with_sensor
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.paraxial.first_order import image_distance
from p2sf.psf.methods import render
from p2sf.psf.spherical import fresnel_number, half_window_um, plane_wave_bound, plane_wave_error
from p2sf.pupil.fit import level_rays, levels_for
from p2sf.pupil.smooth_pupil import all_reach
from p2sf.raytrace.exit_sphere import exit_sphere
from p2sf.raytrace.pencil import pencil
from p2sf.raytrace.ray_field import steepness

LENSES = (
    *("achromat_f6", "cooke_triplet", "double_gauss_28", "eye_navarro", "landscape", "macro_floating", "periskop"),
    *("petzval", "plano_convex", "reverse_telephoto", "singlet_f6", "telephoto", "tessar", "wide_angle_35"),
)
PIXELS = 64
FEWEST, MOST = 1.0, 1e4  # Fresnel numbers
LOST = "rays are lost"
SMALLEST = 1e-9  # 1 − R² that both sums resolve
NONE = "no light", "lost rays", "unresolved", "without prediction"


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


def draw(place: int, seed: int = 1) -> tuple[str, Lens, Source, float, float]:
    """Return a random lens by name and prescription, source, Fresnel number and defocus in waves."""
    rng = np.random.default_rng([seed, place])
    name = str(rng.choice(LENSES))
    lens = find_lens(name)
    angle = rng.uniform(0, max(np.abs(lens.fields_deg), default=0.0))
    source = Source(field_deg=float(angle), wavelength_um=float(rng.uniform(0.45, 0.65)))
    number = float(10 ** rng.uniform(np.log10(FEWEST), np.log10(MOST)))
    waves = float(rng.choice([-1, 1]) * min(10.0, number) * 10 ** rng.uniform(-2, 0))
    return name, lens, source, number, waves


def outcomes(seed: int = 1, first: int = 0) -> Iterator[State | str]:
    """Yield random states, or why there is none, as NONE has it; sums over what lost rays leave converge slowly."""
    for place in count(first):
        try:
            yield state(*draw(place, seed)) or "unresolved"
        except SamplingError:
            yield "without prediction"  # which refuses more than some nodes
        except P2SFError as reason:
            yield "lost rays" if reason.message.template == LOST else "no light"


def state(name: str, lens: Lens, source: Source, number: float, waves: float) -> State | None:
    """Return the state of a lens; None where the sensor would be at infinity, or no difference can be resolved."""
    if 2 * waves >= 0.95 * number:  # the sensor would be at infinity, or before the pupil
        return None
    lens = defocused(*with_fresnel_number(lens, source, number), number, waves)
    if not all_reach(lens, source):
        raise GeometryError(LOST)
    predicted = plane_wave_error(lens, source)  # first, since it refuses what would take long
    pitch = 2 * half_window_um(lens, source) / PIXELS
    own, plane = (render(lens, source, method, PIXELS, pitch) for method in ("spherical", "huygens"))
    difference = 1 - r_squared(plane.values, own.values)
    if difference < SMALLEST:
        return None
    xi, eta, weight = level_rays(levels_for(lens)[0])
    rays = pencil(lens, source, xi, eta)
    bound = plane_wave_bound(lens, source, rays, weight, steepness(rays, xi, eta))
    return State(name, number, waves, predicted, difference, bound)


def within(states: list[State]) -> float:
    """Return the share of predictions within a factor of two."""
    ratio = np.array([state.predicted / state.difference for state in states])
    return float(((ratio > 0.5) & (ratio < 2)).mean())


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--states", type=int, default=300)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--keep", type=Path)
    given = parser.parse_args()
    kept = given.keep.read_text().splitlines() if given.keep and given.keep.exists() else []
    tried: list[State | str] = [one if isinstance(one := json.loads(line), str) else State(**one) for line in kept]
    found = [one for one in tried if isinstance(one, State)]
    for one in outcomes(given.seed, len(tried)):
        if len(found) >= given.states:
            break
        tried.append(one)
        if given.keep:
            with given.keep.open("a") as file:
                file.write(json.dumps(one if isinstance(one, str) else asdict(one)) + "\n")
        if isinstance(one, str):
            continue
        found.append(one)
        print(
            f"{one.lens:18} N {one.fresnel:8.3g}  W {one.waves:7.3f}  predicted {one.predicted:.2e}  "
            f"measured {one.difference:.2e}  of the bound {one.difference / one.bound:.2g}",
            flush=True,
        )
    shares = "  ".join(f"{100 * within(part):.1f}" for part in (found, found[::2], found[1::2]))
    print(f"{len(found)} states: within a factor of two {shares} % (all, each half)")
    print(f"1 − R² at most {max(one.difference / one.bound for one in found):.2f} of the bound")
    print({why: tried.count(why) for why in NONE})


if __name__ == "__main__":
    main()
