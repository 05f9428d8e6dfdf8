"""What is unknown of a whole frame: a few numbers that change the wavefront of every point (handbook 11.3)."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from math import pi

import numpy as np

from p2sf.conventions import NM_PER_UM, UM_PER_MM
from p2sf.errors import RequestError
from p2sf.lens.lens import Lens, with_mask, with_sensor
from p2sf.lens.source import Source
from p2sf.measure.lens_pupil import clear_part, lens_nodes
from p2sf.measure.point_model import Optics
from p2sf.measure.point_problem import PointPicture
from p2sf.measure.pupil_model import turned
from p2sf.measure.pupil_nodes import PupilNodes, counts_for, paraxial_nodes
from p2sf.paraxial.seidel import coefficients
from p2sf.pixel_kernels.sensor_points import SensorMap, sensor_map
from p2sf.pupil.mask import CLEAR
from p2sf.pupil.zernike import basis
from p2sf.raytrace.fit import FittedPencil, fit
from p2sf.raytrace.seen_mask import mask_seen

FOCUS = ("sensor_shift_um", "tilt_x_deg", "tilt_y_deg")
FIELD = ("w40", "w31", "w22", "w20")
SPACING = "spacing_um:"
SHIFT_MM, SPACING_MM = 0.01, 0.005  # steps of differences of rays, so small that W changes linearly
RESIDUAL_WAVES = 1e-3  # of fits to the lens's rays
UM_PER_DEGREE_MM = pi / 180 * UM_PER_MM  # by which a place 1 mm away recedes when tilted by 1°
UNIT = {"sensor_shift_um": "µm", "tilt_x_deg": "°", "tilt_y_deg": "°", **dict.fromkeys(FIELD, "waves")}


@dataclass(frozen=True, eq=False)
class FramePoint:
    """One point of a frame: its window, where in mm its chief ray lands, about, and the frame's known focus.

    ``focus_um``: how much farther from the lens the sensor was than at the frame that the numbers are of.
    """

    picture: PointPicture
    x_mm: float
    y_mm: float
    focus_um: float = 0.0


@dataclass(frozen=True, eq=False)
class PointPupil:
    """The pupil of one point of a frame: nodes, its wavefront in waves, (nodes,), and what each unknown adds.

    ``terms``: (unknowns, nodes), waves per unit. ``focus``: waves per µm by which the sensor recedes.
    """

    nodes: PupilNodes
    phase: np.ndarray
    terms: np.ndarray
    focus: np.ndarray


@dataclass(frozen=True)
class FrameModel:
    """Which unknowns a frame is explained by, and the lens, if any, that they are departures from.

    ``unknowns``: of ``sensor_shift_um``, ``tilt_x_deg``, ``tilt_y_deg`` (by which the sensor recedes towards +x, +y);
    ``w40``, ``w31``, ``w22``, ``w20``, waves at ``height_mm``, growing with the field as 1, h, h² and h²; and
    ``spacing_um:k``, of the space behind surface k, the sensor staying at its distance from the last surface. Without a
    lens the pupil is the paraxial one of the numerical aperture, and W has no other terms. ``alone``: the model is of
    one point, and field polynomials are waves at it, wherever it lies. ``clip``: the lens's rims end pupils.
    """

    optics: Optics
    height_mm: float
    unknowns: tuple[str, ...] = (*FOCUS, *FIELD)
    lens: Lens | None = None
    depth_mm: float = float("inf")
    alone: bool = False
    clip: bool = False

    def __post_init__(self) -> None:
        surfaces = len(self.lens.surfaces) if self.lens is not None else 0
        spacings = tuple(f"{SPACING}{k}" for k in range(1, surfaces))
        for name in self.unknowns:
            if name not in (*FOCUS, *FIELD, *spacings):
                raise RequestError(
                    '"{name}" is nothing that a frame tells here; choose from {choices}',
                    name=name,
                    choices=(*FOCUS, *FIELD, *spacings),
                )

    @property
    def focus_waves_per_um(self) -> float:
        """Return Wd per µm of a paraxial pupil in air, NA²Δz/(2λ)."""
        return self.optics.na**2 / (2 * self.optics.wavelength_um)

    def unit(self, name: str) -> str:
        """Return the unit of an unknown."""
        return UNIT.get(name, "µm")

    def pupil(self, x_mm: float, y_mm: float, half_um: float) -> PointPupil:
        """Return the pupil of a point whose chief ray lands at (x, y); its nodes serve a window of ±``half_um``."""
        azimuth, height = float(np.arctan2(x_mm, y_mm)), float(np.hypot(x_mm, y_mm))
        if self.lens is None:
            return self._paraxial(x_mm, y_mm, azimuth, height, half_um)
        return self._of_lens(x_mm, y_mm, azimuth, height, half_um)

    def _paraxial(self, x: float, y: float, azimuth: float, height: float, half_um: float) -> PointPupil:
        counts = counts_for(1.2 * self.optics.cycles * half_um, self.optics.cycles, half_um)
        nodes = paraxial_nodes(counts, self.optics.cycles, self.optics.mask, self.optics.wavelength_um)
        square = nodes.xi**2 + nodes.eta**2
        focus = square * self.focus_waves_per_um
        across, along = turned(nodes.xi, nodes.eta, azimuth)
        return self._with_terms(nodes, np.zeros_like(nodes.xi), focus, (x, y, height), (across, along), {})

    def _of_lens(self, x: float, y: float, azimuth: float, height: float, half_um: float) -> PointPupil:
        assert self.lens is not None
        found, moved = self.fits(height)
        counts = counts_for(1.2 * self.optics.cycles * half_um, self.optics.cycles, half_um)
        clear = clear_part(self.lens, self.source(height, azimuth), counts) if self.clip else None
        nodes = lens_nodes(found, azimuth, counts, clear)
        forms = np.stack([found.phase, *(change for change in moved.values())])
        phase, focus, *others = -(forms @ basis(found.level.wave_order, nodes.xi, nodes.eta))
        spacings = dict(zip(tuple(moved)[1:], others, strict=True))
        return self._with_terms(nodes, phase, focus, (x, y, height), (nodes.xi, nodes.eta), spacings)

    def _with_terms(
        self,
        nodes: PupilNodes,
        phase: np.ndarray,
        focus: np.ndarray,
        place: tuple[float, float, float],
        meridional: tuple[np.ndarray, np.ndarray],
        spacings: dict[str, np.ndarray],
    ) -> PointPupil:
        x, y, height = place
        across, along = meridional
        square, h = across**2 + along**2, 1.0 if self.alone else height / self.height_mm
        made = {
            "sensor_shift_um": focus,
            "tilt_x_deg": focus * (x * UM_PER_DEGREE_MM),
            "tilt_y_deg": focus * (y * UM_PER_DEGREE_MM),
            "w40": square**2,
            "w31": h * square * along,
            "w22": h * h * along**2,
            "w20": h * h * square,
            **spacings,
        }
        return PointPupil(nodes, phase + nodes.waves, np.stack([made[name] for name in self.unknowns]), focus)

    def six_of_lens(self, height_mm: float) -> np.ndarray:
        """Return W40, W31, W22 and W20 + Wd of the lens where a chief ray lands at a height; 0 without a lens."""
        if self.lens is None:
            return np.zeros(4)
        source = self._map().source(height_mm, self.optics.wavelength_um)
        c = coefficients(self.lens, source.depth_mm, source.field_slope, source.wavelength_um)
        return np.array([c.w40, c.w31, c.w22, c.w20 + c.wd], float)

    def fits(self, height_mm: float) -> tuple[FittedPencil, dict[str, np.ndarray]]:
        """Return the fit of a point at a height, and how its phase's coefficients change per µm of what moves.

        The first change is the sensor's.
        """
        assert self.lens is not None
        source = self._map().source(height_mm, self.optics.wavelength_um)
        found = fit(self.lens, source, residual_waves=RESIDUAL_WAVES)
        numbers = found.numbers
        moves: dict[str, Callable[[float], Lens]] = {"sensor_shift_um": self._shifted}
        for name in self.unknowns:
            if name.startswith(SPACING):
                moves[name] = partial(self._respaced, int(name.removeprefix(SPACING)))
        changes = {}
        for name, moved in moves.items():
            step = SPACING_MM if name.startswith(SPACING) else SHIFT_MM
            more, less = (fit(moved(sign * step), source, numbers).phase for sign in (1, -1))
            changes[name] = (more - less) / (2 * step * UM_PER_MM)
        return found, changes

    def _shifted(self, step_mm: float) -> Lens:
        assert self.lens is not None
        return with_sensor(self.lens, self.lens.sensor_mm + step_mm)

    def _respaced(self, surface: int, step_mm: float) -> Lens:
        assert self.lens is not None
        surfaces = list(self.lens.surfaces)
        surfaces[surface - 1] = replace(surfaces[surface - 1], thickness=surfaces[surface - 1].thickness + step_mm)
        return replace(self.lens, surfaces=tuple(surfaces))

    def source(self, height_mm: float, azimuth: float) -> Source:
        """Return the source whose chief ray lands at a height, at ``azimuth`` radians from +y towards +x."""
        seen = self._map().source(height_mm, self.optics.wavelength_um)
        return replace(seen, azimuth_deg=float(np.rad2deg(azimuth)))

    def _map(self) -> SensorMap:
        assert self.lens is not None
        return chief_rays(self.lens, self.depth_mm, self.optics.wavelength_um, self.height_mm * 1.02)


def six_of_unknowns(x_mm: float, y_mm: float, model: FrameModel) -> np.ndarray:
    """Return W40, W31, W22 and W20 + Wd of a point per unit of every unknown, (4, unknowns); 0 for a spacing."""
    h = float(np.hypot(x_mm, y_mm)) / model.height_mm
    focus = model.focus_waves_per_um
    tilt = focus * UM_PER_DEGREE_MM
    made = {
        "w40": (1, 0, 0, 0),
        "w31": (0, h, 0, 0),
        "w22": (0, 0, h * h, 0),
        "w20": (0, 0, 0, h * h),
        "sensor_shift_um": (0, 0, 0, focus),
        "tilt_x_deg": (0, 0, 0, tilt * x_mm),
        "tilt_y_deg": (0, 0, 0, tilt * y_mm),
    }
    return np.array([made.get(name, (0, 0, 0, 0)) for name in model.unknowns], float).T


def chief_rays(lens: Lens, depth_mm: float, wavelength_um: float, height_mm: float) -> SensorMap:
    """Return where chief rays land up to a height; they pass the middle of the stop, whatever mask stands there."""
    return sensor_map(with_mask(lens, CLEAR), depth_mm, wavelength_um, height_mm)


def lens_optics(lens: Lens, depth_mm: float, wavelength_um: float, pixel_um: float, fill: float = 1.0) -> Optics:
    """Return the scale of a lens's PSFs. Raises GeometryError where the lens forms no image."""
    c = coefficients(lens, depth_mm, 0.0, wavelength_um)
    mask = mask_seen(lens, Source(depth_mm=depth_mm, wavelength_nm=wavelength_um * NM_PER_UM))
    return Optics(abs(float(c.reduced_slope)), wavelength_um, pixel_um, fill, mask)
