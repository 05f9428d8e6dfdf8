"""Where the light of a source lands: exact rays through nodes of what is open, and means over them (handbook 8.3)."""

from dataclasses import dataclass, replace
from functools import lru_cache
from math import inf

import numpy as np

from p2sf.disc.domain import PupilDomain
from p2sf.disc.mask import PupilMask
from p2sf.disc.mask_nodes import outline_radius
from p2sf.disc.open_part import OpenPart
from p2sf.errors import GeometryError
from p2sf.lens.lens import Lens, check_rays
from p2sf.lens.source import Source
from p2sf.pupil.clear_curves import CLIPPED, LOST
from p2sf.pupil.seen_mask import mask_seen
from p2sf.pupil.smooth_pupil import all_reach
from p2sf.pupil.vignetting import open_part
from p2sf.raytrace.aiming import Sources
from p2sf.raytrace.pencil import rays_through

RINGS = 16  # Gauss–Legendre, of twice as many rays each: RMS to 1e-5 for every shipped lens, whole pupils
RIM_RAYS = 48  # on half the rim
ON_RIM = 1e-9  # beyond it, and still on it
JUST_INSIDE = 1 - 1e-9  # of the radius of an outline, which itself may count as covered
MEAN_ROUNDING = 1e-14  # of the largest term: some fifty roundings, all that a mean over symmetric rays consists of
WEIGHT_ROUNDING = 1e-6  # of the largest term: the weights of aimed rays are differences, good to that


@dataclass(frozen=True, eq=False)
class Landing:
    """Where rays through quadrature nodes meet the sensor, µm from the chief ray, and their light, (…, ray).

    ``light``: share of the pupil's area times energy per unit of it, of unit sum; 0 on rims, which have no area, and
    of rays that do not arrive, whose places are NaN. ``domain``: of the pupil, which may be half of one.
    ``rounding``: the share of the largest place below which a mean is nothing but rounding.
    """

    x_um: np.ndarray
    y_um: np.ndarray
    light: np.ndarray
    domain: PupilDomain
    rounding: float

    def mean(self, values: np.ndarray) -> np.ndarray:
        """Return the mean by light of values (…, ray), (…,)."""
        mean: np.ndarray = (np.where(self.light != 0, values, 0.0) * self.light).sum(-1)
        return mean

    @property
    def centroid_um(self) -> tuple[np.ndarray, np.ndarray]:
        """Return x and y of the light's centroid, (…,); 0 where they are nothing but rounding."""
        share = np.where(self.light != 0, self.light, 0.0)
        x, y = (np.where(self.light != 0, place, 0.0) for place in (self.x_um, self.y_um))
        return self._without_rounding(self.domain.mean_across(share, x), x), self._without_rounding(
            (share * y).sum(-1), y
        )

    @property
    def rms_um(self) -> tuple[np.ndarray, np.ndarray]:
        """Return the RMS of x and of y about the centroid, (…,)."""
        across, up = self._from_centroid()
        return _root(self.mean(across * across)), _root(self.mean(up * up))

    @property
    def farthest_um(self) -> np.ndarray:
        """Return the largest distance of a ray from the centroid, (…,)."""
        return np.asarray(np.fmax.reduce(np.hypot(*self._from_centroid()), -1))

    def _from_centroid(self) -> tuple[np.ndarray, np.ndarray]:
        centre_x, centre_y = self.centroid_um
        return self.x_um - centre_x[..., None], self.y_um - centre_y[..., None]

    def _without_rounding(self, mean: np.ndarray, place: np.ndarray) -> np.ndarray:
        return np.where(np.abs(mean) > self.rounding * np.abs(place).max(-1), mean, 0.0)


def _root(square: np.ndarray) -> np.ndarray:
    root: np.ndarray = np.sqrt(np.maximum(square, 0.0))  # weights behind a vane may be negative
    return root


def landing(
    lens: Lens, source: Source | Sources, clip: bool = False, follow_rims: bool = True, rings: int = RINGS
) -> Landing:
    """Return where the light of a source lands, by nodes of about ``rings`` radii over what is open of the pupil.

    Of several `Sources`, unless ``follow_rims``, and without it of any, rays at rims are in or out, so that means are
    coarser. Raises GeometryError where no ray reaches the sensor, or the mask in the stop bends them.
    """
    if isinstance(source, Sources) or not follow_rims:
        mask = mask_of_rays(lens, source)
        part = OpenPart(domain=lens.pupil_domain).behind(mask)
        return _trace(lens, source, part, clip, rings)
    return _kept_landing(lens, source, clip, rings)


@lru_cache(maxsize=32)
def _kept_landing(lens: Lens, source: Source, clip: bool, rings: int) -> Landing:
    mask_of_rays(lens, source)
    return _trace(lens, source, open_part(lens, source, clip, all_reach(lens, source)), False, rings)


def mask_of_rays(lens: Lens, source: Source | Sources) -> PupilMask:
    """Return the mask that rays of a source meet, several `Sources` standing in the plane of the fields.

    Raises GeometryError for one that bends them.
    """
    check_rays(lens)
    wave = lens.reference_wavelength_um
    return mask_seen(lens, source if isinstance(source, Source) else Source(inf, 0.0, wave))


def _rim_points(part: OpenPart) -> tuple[np.ndarray, np.ndarray]:
    """Return ξ and η of points on the outline of what is open, and of an obscuration."""
    mask, domain, rim = part.mask, part.domain, part.rim
    theta = np.linspace(0, domain.turn, RIM_RAYS * len(domain.halves) + 1)
    radius = outline_radius(mask, theta) * (1.0 if mask.clear else JUST_INSIDE)
    drawn = [np.stack([radius * np.sin(theta), radius * np.cos(theta)])] if rim is None or mask.iris else []
    if rim is not None:
        drawn.append(np.stack(rim.points(RIM_RAYS, domain)))
    if mask.obscured:
        drawn.append(np.stack(replace(mask.disc, radius=mask.disc.radius / JUST_INSIDE).outline(theta)))
    xi, eta = np.concatenate(drawn, axis=1)
    inside = (part.beyond(xi, eta) <= ON_RIM) & mask.opens(xi, eta) & (mask.amplitude(xi, eta) > 0)
    return xi[inside], eta[inside]


def _trace(lens: Lens, source: Source | Sources, part: OpenPart, clip: bool, rings: int) -> Landing:
    """Return where rays through nodes and through points of the rim land. Raises GeometryError where none arrives."""
    nodes = part.nodes((rings, 2 * rings))
    rays = rays_through(lens, source, nodes.with_points(*_rim_points(part)), clip)
    light = rays.share * rays.light
    with np.errstate(invalid="ignore"):
        light = light / light.sum(-1, keepdims=True)
    if not np.isfinite(light).any():
        raise GeometryError(CLIPPED if clip else LOST, parameter="clip")
    rounding = WEIGHT_ROUNDING if lens.aim == "stop" else MEAN_ROUNDING
    return Landing(rays.x_um, rays.y_um, light, nodes.domain, rounding)
