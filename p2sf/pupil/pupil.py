"""The pupil of a source, whatever made it: as many of its waves as a picture needs, and all its light."""

from abc import ABC, abstractmethod
from dataclasses import dataclass
from math import inf, prod

from p2sf.errors import SamplingError
from p2sf.messages import Message
from p2sf.pupil.plane_waves import Counts, Waves
from p2sf.pupil.watch import Watch

MOST_FOR_PEAK = 2**18  # radii × directions, for the peak alone, which is otherwise sought only in the window


@dataclass(frozen=True, eq=False)
class PupilWaves:
    """The waves of a pupil, the node counts they took, and the numbers of rays traced and lost for them."""

    waves: Waves
    counts: Counts
    traced: int
    lost: int = 0


class Pupil(ABC):
    """What the light of a source has over a pupil: phase, direction and amplitude, and what of the pupil is open.

    A method makes it, of polynomials (`FittedPencil`) or of rays that are traced anew at any nodes (`RayPupil`).
    """

    @property
    @abstractmethod
    def method(self) -> str:
        """Return the method that made it."""

    @property
    @abstractmethod
    def wavelength_um(self) -> float:
        """Return the wavelength of its light, µm."""

    @property
    def numbers(self) -> int:
        """Return how many numbers describe it, 0 of rays."""
        return 0

    @property
    def error_waves(self) -> float:
        """Return the RMS phase error of its description, waves."""
        return 0.0

    @property
    def interpolated(self) -> bool:
        """Return whether its rays are interpolated where they are smooth."""
        return False

    @property
    @abstractmethod
    def edges(self) -> bool:
        """Return whether rims or lost rays end it."""

    @property
    @abstractmethod
    def resolved(self) -> bool:
        """Return whether `counts` are known to resolve it, so that one sum suffices."""

    @property
    def remarks(self) -> tuple[Message, ...]:
        """Return what is to be said of how its nodes were made."""
        return ()

    def smooth(self, reach_um: float) -> bool:
        """Return whether no ray has to be traced for each node, up to a distance from the chief ray, µm."""
        return True

    @abstractmethod
    def counts(self, reach_um: float, quality: str = "settled") -> Counts:
        """Return the node counts that resolve the phase up to a distance from the chief ray, µm.

        Raises SamplingError for too many, GeometryError where no light passes.
        """

    @abstractmethod
    def sample(self, counts: Counts, reach_um: float = inf, watch: Watch | None = None) -> PupilWaves:
        """Return the waves of these nodes, valid up to a distance from the chief ray; `Cancelled` by the watch."""

    @abstractmethod
    def light_um2(self) -> float | None:
        """Return ∫|field|²dx over the plane in µm² at unit unaberrated peak; None where nothing tells it."""

    def waves_reaching(self, reach_um: float) -> Waves | None:
        """Return waves that resolve the phase up to a distance from the chief ray, µm; None of too many."""
        try:
            counts = self.counts(reach_um)
        except SamplingError:
            return None
        return self.sample(counts, reach_um).waves if prod(counts) <= MOST_FOR_PEAK else None
