"""Pictures of one point, and what a model leaves of them: residuals over the noise, with derivatives."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from p2sf.disc.domain import ClearNodes
from p2sf.disc.mask import PupilMask, mask_slopes
from p2sf.measure.fitting.point_model import PictureOptics, SpectralSum
from p2sf.measure.fitting.pupil_model import PupilModel
from p2sf.measure.fitting.pupil_nodes import PupilNodes, counts_for, mapped_nodes, open_nodes, paraxial_nodes

PER_FRAME = 4  # x and y of the point, all of its light, background
# A map that moves pupil points along the rim's inside, areas unchanged, leaves every PSF as it is; what is known of
# maps decides: they differ from the paraxial one by a few per cent of the NA.
MAP_DEVIATION = 0.05
WAVES_SCALE = 0.3  # how far a step may go at first
MARGIN = 1.15  # of the wavefront's slope, which a fit may raise


@dataclass(frozen=True, eq=False)
class PointPicture:
    """A window (y, x) around one point, rows towards +y, and the variance of each pixel's noise.

    ``defocus_waves``: what is known to be added to W20 + Wd here, as by a second focus: NA²Δz/(2n'λ), Δz away from
    the lens. ``good``: pixels that count, all when None. ``computed``: a PSF without noise, for which some is assumed.
    """

    values: np.ndarray
    variance: float | np.ndarray = 1.0
    defocus_waves: float = 0.0
    good: np.ndarray | None = None
    computed: bool = False

    @property
    def usable(self) -> np.ndarray:
        """Return which pixels count."""
        finite = np.isfinite(self.values)
        good: np.ndarray = finite if self.good is None else finite & self.good
        return good


class Problem:
    """Residuals over the noise of all pictures and their derivatives, as functions of one vector of unknowns.

    Unknowns: the model's numbers, then x, y (µm), all light and background of every picture. ``clear``: nodes over the
    open pupil, where rims end it; the optics' mask does otherwise.
    """

    def __init__(
        self,
        pictures: Sequence[PointPicture],
        optics: PictureOptics,
        model: PupilModel,
        azimuth: float,
        coarse: bool = False,
        clear: ClearNodes | None = None,
    ):
        self.pictures, self.optics, self.model, self.azimuth, self.clear = pictures, optics, model, azimuth, clear
        self.parts = optics.coarse_parts if coarse else optics.parts
        self.numbers = len(model.even)
        self.good = [picture.usable for picture in pictures]
        self.data = [np.where(good, p.values, 0.0) for p, good in zip(pictures, self.good, strict=True)]
        self.root = [
            np.where(good, 1 / np.sqrt(np.broadcast_to(p.variance, p.values.shape)), 0.0)
            for p, good in zip(pictures, self.good, strict=True)
        ]
        self.half_um = max(max(p.values.shape) for p in pictures) / 2 * optics.pixel_um
        self.counts, self._at = (0, 0), np.empty(0)
        self._found = np.empty(0), np.empty(0)

    def frame(self, unknowns: np.ndarray, number: int) -> np.ndarray:
        """Return x, y, flux and background of a picture."""
        start = self.numbers + PER_FRAME * number
        return unknowns[start : start + PER_FRAME]

    @property
    def freedom(self) -> int:
        """Return how many more pixels count than there are unknowns."""
        pixels = sum(int(good.sum()) for good in self.good)
        return max(1, pixels - self.numbers - PER_FRAME * len(self.pictures))

    def scales(self, unknowns: np.ndarray) -> np.ndarray:
        """Return a step of every unknown that changes a picture clearly."""
        out = np.full(unknowns.size, WAVES_SCALE)
        out[len(self.model.wave_names) : self.numbers] = MAP_DEVIATION
        for number, root in enumerate(self.root):
            place = WAVES_SCALE / self.optics.cycles
            start = self.numbers + PER_FRAME * number
            noise = 1 / max(float(root.max()), 1e-300)
            out[start : start + PER_FRAME] = place, place, max(abs(unknowns[start + 2]), noise), noise
        return out

    def modelled(self, unknowns: np.ndarray) -> tuple[np.ndarray, ...]:
        """Return the windows (y, x) as the model has them."""
        self.evaluate(unknowns)
        lights = [self.light(unknowns, number)[0] for number in range(len(self.pictures))]
        frames = [self.frame(unknowns, number) for number in range(len(self.pictures))]
        return tuple(frame[2] * light + frame[3] for frame, light in zip(frames, lights, strict=True))

    def squares(self, unknowns: np.ndarray) -> float:
        """Return Σ(model − mean)²/variance over the pixels that count: what of the pictures is no background."""
        total = 0.0
        for model, good, root in zip(self.modelled(unknowns), self.good, self.root, strict=True):
            total += float(np.sum(((model - model[good].mean()) * root) ** 2))
        return total

    def r2(self, modelled: Sequence[np.ndarray]) -> np.ndarray:
        """Return 1 − Σ(picture − model)²/Σ(picture − mean)² over the pixels that count, (pictures,)."""
        out = []
        for data, good, model in zip(self.data, self.good, modelled, strict=True):
            inside = data[good]
            out.append(1 - np.sum((inside - model[good]) ** 2) / np.sum((inside - inside.mean()) ** 2))
        return np.array(out)

    def prepare(self, unknowns: np.ndarray) -> None:
        """Take as many nodes as the wavefront at these unknowns needs, and light all over the windows."""
        slope = max(self._slope(unknowns), 0.5 * self.optics.cycles * self.half_um)
        self.counts, self._at = self._counts(MARGIN * slope), np.empty(0)
        if not self.model.mapped:
            self._take(paraxial_nodes(self.counts, *self._pupil))

    @property
    def _pupil(self) -> tuple[float, PupilMask, float, ClearNodes | None, float]:
        """Return NA/λ, mask, wavelength, the nodes that rims leave open, and azimuth, as nodes are asked for."""
        optics = self.optics
        return optics.cycles, optics.mask, optics.wavelength_um, self.clear, self.azimuth

    def needs_more(self, unknowns: np.ndarray) -> bool:
        """Return whether the wavefront has become too steep for its nodes."""
        return self._counts(self._slope(unknowns))[0] > self.counts[0]

    def _counts(self, slope: float) -> tuple[int, int]:
        """Return rows and columns of nodes that carry a slope, in waves per unit radius, in every colour."""
        finest = self.optics.finest
        return counts_for(slope * self.optics.wavelength_um / finest.wavelength_um, finest.cycles, self.half_um)

    def _slope(self, unknowns: np.ndarray) -> float:
        """Return about the steepest slope of the wavefront over the pupil, waves per unit radius."""
        line = np.linspace(-1, 1, 33)
        eta, xi = np.meshgrid(line, line, indexing="ij")
        waves, _, _ = self.model.split(unknowns[: self.numbers])
        down, across = np.gradient(np.tensordot(waves, self.model.waves(xi, eta, self.azimuth), 1), line, line)
        known = 2 * max(abs(p.defocus_waves) for p in self.pictures) + self._filter_slope()
        return float(np.hypot(down, across)[np.hypot(xi, eta) <= 1.0].max()) + known

    def _filter_slope(self) -> float:
        """Return about the steepest slope of the phase of a filter in the pupil, waves per unit radius."""
        if not self.optics.mask.phased:
            return 0.0
        slopes = mask_slopes(self.optics.mask)
        return float(np.hypot(slopes.path_radial_um, slopes.path_angular_um)) / self.optics.wavelength_um

    def _take(self, nodes: PupilNodes) -> None:
        """Compute what does not change while the nodes stay."""
        self.nodes = nodes
        self.sums = [SpectralSum(nodes, p.values.shape, self.optics, self.parts) for p in self.pictures]
        # Nodes of a map are given in the field's own axes.
        self.terms = self.model.waves(nodes.xi, nodes.eta, 0.0 if self.model.mapped else self.azimuth)
        self.square = nodes.xi**2 + nodes.eta**2
        maps = self.model.maps(nodes.xi, nodes.eta) if self.model.mapped else ()
        scaled = [self.optics.cycles * part for part in maps]
        self.columns = np.concatenate([-nodes.fx[None], -nodes.fy[None], self.terms, *scaled]).astype(np.float32)

    def light(self, unknowns: np.ndarray, number: int) -> tuple[np.ndarray, np.ndarray]:
        """Return the share of all light on each pixel of a picture, (y, x), and its derivatives by x, y and numbers."""
        waves, across, along = self.model.split(unknowns[: self.numbers])
        x, y = self.frame(unknowns, number)[:2]
        phase = waves @ self.terms + self.pictures[number].defocus_waves * self.square + self.nodes.waves
        phase -= self.nodes.fx * x + self.nodes.fy * y
        return self.sums[number].light_and_slopes(phase, self.columns, (len(across), len(along)), (x, y), self.azimuth)

    def evaluate(self, unknowns: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return residuals, (pixels,), and their derivatives, (pixels, unknowns)."""
        if np.array_equal(unknowns, self._at):
            return self._found
        if self.model.mapped:
            numbers = unknowns[: self.numbers]
            cycles, mask, wavelength, clear, azimuth = self._pupil
            nodes = open_nodes(mask, self.counts, clear, azimuth)
            self._take(mapped_nodes(self.model, numbers, nodes, cycles, wavelength, azimuth))
        rest, slopes = [], []
        for number, (data, root) in enumerate(zip(self.data, self.root, strict=True)):
            _, _, flux, background = self.frame(unknowns, number)
            light, found = self.light(unknowns, number)
            rest.append(((flux * light + background - data) * root).ravel())
            block = np.zeros((data.size, unknowns.size))
            start = self.numbers + PER_FRAME * number
            block[:, : self.numbers] = (flux * found[2:] * root).reshape(self.numbers, -1).T
            block[:, start : start + 2] = (flux * found[:2] * root).reshape(2, -1).T
            block[:, start + 2], block[:, start + 3] = (light * root).ravel(), root.ravel()
            slopes.append(block)
        if self.model.mapped:
            maps = slice(len(self.model.wave_names), self.numbers)
            block = np.zeros((self.numbers - maps.start, unknowns.size))
            block[:, maps] = np.eye(len(block)) / MAP_DEVIATION
            rest.append((unknowns[maps] - self.model.paraxial_map) / MAP_DEVIATION)
            slopes.append(block)
        self._at, self._found = unknowns.copy(), (np.concatenate(rest), np.concatenate(slopes))
        return self._found

    def residuals(self, unknowns: np.ndarray) -> np.ndarray:
        """Return (model − picture)/noise, (pixels,); 0 where a pixel does not count."""
        return self.evaluate(unknowns)[0]

    def slopes(self, unknowns: np.ndarray) -> np.ndarray:
        """Return the derivatives of the residuals, (pixels, unknowns)."""
        return self.evaluate(unknowns)[1]
