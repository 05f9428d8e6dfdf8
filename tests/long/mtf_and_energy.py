"""MTF and encircled energy against the referee: ``python -m tests.long.mtf_and_energy --keep FOLDER``.

Every shipped lens × 3 fields × {∞, a near depth} × {sensor as focused, autofocused} × {full aperture, stopped down to
f/8}, at the middle wavelength. For each: the largest difference of the MTF at the referee's frequencies up to the
cut-off, the differences of R50 and R80 in per cent and of the energy within some radii, and by how much the MTF lies
above the same pupil's perfect curve: above the program's own, and above the referee's. The energy above that of the
same pupil without phase is listed beside them.
The referee (`tests.support.pupil_sums`) states its own convergence; a state in which it has none is listed and not
judged. With ``--keep`` its sums are kept in a folder, since they take most of the time.
"""

import argparse
from collections.abc import Iterator
from dataclasses import dataclass, replace
from math import inf
from pathlib import Path

import numpy as np

from p2sf.errors import P2SFError
from p2sf.lens.lens import Lens, with_aim, with_f_number, with_sensor
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens, shipped_lenses
from p2sf.paraxial.pupils import f_number
from p2sf.psf.measures import energy_in, mtf_of, parts_of
from tests.support.depths import NEAR_MM, RELAYS_MM
from tests.support.pupil_sums import LostRays, best_shift_mm, sums

MTF_ERROR, RADIUS_PERCENT, ENERGY = 2e-3, 0.5, 3e-3
ABOVE_OWN, ABOVE = 1e-6, 5e-4  # above the own perfect curve, and above the referee's, which is known to that
CONVERGED = 1e-3  # the change of the referee's OTF from half as many cells, some three times its error
FITTED = 1e-3  # waves
FREQUENCIES = 64
SHARES = 0.5, 0.8
RADII = np.array([0.2, 0.4, 0.7, 1.0, 1.4, 2.0])  # in units of R80, at which the energy is compared
FIELDS_DEG = {"relay": (0.0, 0.2, 0.5)}
BESIDE_MM = {"relay": 110.0, "telecentric_relay": 92.0}  # the second depth of a relay


@dataclass(frozen=True)
class State:
    """What is asked: a lens as set up, and a source."""

    name: str
    lens: Lens
    source: Source


@dataclass(frozen=True)
class Truth:
    """What the referee says: frequencies in cycles/mm, moduli of the OTF, of the perfect pupil too, and radii in µm."""

    frequency: np.ndarray
    x: np.ndarray
    y: np.ndarray
    perfect_x: np.ndarray
    perfect_y: np.ndarray
    radii: np.ndarray
    energy: np.ndarray
    error: float
    slope: float
    fitted: float


@dataclass(frozen=True)
class Verdict:
    """Differences of the MTF, of R50 and R80 in per cent, of the energy; how far MTF and energy lie above the perfect.

    ``above_own``: above the program's own perfect curve, ``above``: above the referee's; ``energy_above``: above the
    energy of the same pupil without phase.
    """

    mtf: float = 0.0
    radii: tuple[float, float] = (0.0, 0.0)
    energy: float = 0.0
    above_own: float = 0.0
    above: float = 0.0
    energy_above: float = 0.0

    def __str__(self) -> str:
        radii = f"R50 {self.radii[0]:.3f} %, R80 {self.radii[1]:.3f} %"
        above = (
            f"above perfect: MTF {self.above_own:.0e} own, {self.above:.0e} referee's; energy {self.energy_above:.0e}"
        )
        return f"MTF {self.mtf:.1e}, {radii}, energy {self.energy:.1e}, {above}"

    @property
    def good(self) -> bool:
        """Return whether all are within their limits.

        Of the energy there is no bound by the perfect curve: it is one for the MTF alone, where it is Schwarz's
        inequality. Between two dark rings a little more light can fall within a radius than with no aberration.
        """
        limits = (self.mtf, MTF_ERROR), (max(self.radii), RADIUS_PERCENT), (self.energy, ENERGY)
        above = (self.above_own, ABOVE_OWN), (self.above, ABOVE)
        return all(value <= limit for value, limit in limits + above)

    def worse(self, other: "Verdict") -> "Verdict":
        """Return the larger of each."""
        radii = (max(self.radii[0], other.radii[0]), max(self.radii[1], other.radii[1]))
        rest = ("energy", "above_own", "above", "energy_above")
        return Verdict(
            max(self.mtf, other.mtf), radii, *(max(getattr(self, name), getattr(other, name)) for name in rest)
        )


def states(aim: str, names: tuple[str, ...] = shipped_lenses()) -> Iterator[State]:
    """Yield every state of the lenses named."""
    for name in names:
        lens = with_aim(find_lens(name), aim)
        full = float(f_number(lens, lens.reference_wavelength_um))
        down = with_f_number(lens, 8.0 if full < 8 else 2 * full)  # a lens slower than f/8 by two stops
        for field in FIELDS_DEG.get(name, lens.fields_deg):
            for depth in (RELAYS_MM.get(name, inf), float((NEAR_MM | BESIDE_MM)[name])):
                source = Source(depth, float(np.tan(np.deg2rad(field))), lens.reference_wavelength_um)
                for opened, word in ((lens, "full"), (down, "down")):
                    label = f"{name} {field:g}° {depth:g} mm {word}"
                    yield State(f"{label} as focused", opened, source)
                    shift = best_shift_mm(opened, source, aim)
                    yield State(f"{label} autofocused", with_sensor(opened, opened.sensor_mm + shift), source)


def kept_file(state: State, folder: Path) -> Path:
    """Return where a state's sums are kept."""
    return folder / f"{state.lens.aim} {state.name}.npz"


def truth(state: State, folder: Path | None = None) -> Truth:
    """Return the referee's sums of a state; LostRays where it has none."""
    kept = kept_file(state, folder) if folder else None
    if kept and kept.is_file():
        with np.load(kept) as file:
            return Truth(**{name: file[name] for name in file.files})
    real, ideal = (sums(state.lens, state.source, state.lens.aim, perfect) for perfect in (False, True))
    some = np.unique(np.linspace(0, real.frequency.size - 1, FREQUENCIES).astype(int))
    on = (real.frequency, np.abs(real.x), np.abs(real.y), np.abs(ideal.x), np.abs(ideal.y))
    radii = np.array([real.radius(share) for share in SHARES])
    energy = np.array([real.energy(times * radii[1]) for times in RADII])
    found = Truth(*(a[some] for a in on), radii, energy, real.error, real.slope, real.fitted)
    if kept:
        np.savez(kept, **vars(found))
    return found


def verdict(state: State, known: Truth) -> Verdict:
    """Return how the program's MTF and energy differ from the referee's. Raises P2SFError."""
    parts, method = parts_of(state.lens, state.source, "traced")
    found = mtf_of(parts, method, known.frequency)
    light, at = energy_in(parts, method), energy_in(parts, method, RADII * known.radii[1])
    sagittal, tangential = np.abs(found.sagittal - known.x), np.abs(found.tangential - known.y)
    above_own = max(
        (found.sagittal - found.perfect_sagittal).max(), (found.tangential - found.perfect_tangential).max()
    )
    above = max((found.sagittal - known.perfect_x).max(), (found.tangential - known.perfect_y).max())
    ideal = energy_in([replace(part, pupil=part.pupil.without_phase()) for part in parts], method, light.radius_um)
    radii = 100 * np.abs(np.array([light.radius_50_um, light.radius_80_um]) / known.radii - 1)
    return Verdict(
        float(max(sagittal.max(), tangential.max())),
        (float(radii[0]), float(radii[1])),
        float(np.abs(at.fraction - known.energy).max()),
        float(above_own),
        float(above),
        float((light.fraction - ideal.fraction).max()),
    )


def main() -> None:
    asked = argparse.ArgumentParser(description=__doc__)
    asked.add_argument("--keep", type=Path, help="a folder for the referee's sums")
    asked.add_argument("--aim", choices=("stop", "paraxial"), default="stop")
    asked.add_argument("--known", action="store_true", help="only states whose sums are in that folder")
    asked.add_argument("lenses", nargs="*", default=shipped_lenses())
    given = asked.parse_args()
    worst, unjudged, bad = Verdict(), 0, 0
    for state in states(given.aim, tuple(given.lenses)):
        if given.known and not kept_file(state, given.keep).is_file():
            continue
        try:
            known = truth(state, given.keep)
            if known.error > CONVERGED or known.fitted > FITTED:
                raise LostRays(f"referee not converged: {known.error:.0e}, {known.slope:.0f} waves per radius")
            found = verdict(state, known)
        except (LostRays, P2SFError) as why:
            unjudged += 1
            print(f"{state.name}: not judged, {why}", flush=True)
            continue
        bad += not found.good
        print(f"{state.name}: {found}, {known.slope:.0f} waves per radius{'' if found.good else ' BAD'}", flush=True)
        worst = worst.worse(found)
    print(f"worst: {worst}; {bad} outside the limits, {unjudged} not judged")
    raise SystemExit(bool(bad))


if __name__ == "__main__":
    main()
