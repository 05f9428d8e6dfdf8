"""What is unknown of a whole frame: a few numbers that change the wavefront of every point (handbook 11.3)."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from math import pi

import numpy as np

from p2sf.conventions import NM_PER_UM, UM_PER_MM
from p2sf.disc.disc_function import DiscFunction
from p2sf.disc.mask import CLEAR
from p2sf.errors import RequestError
from p2sf.lens.lens import Lens, with_mask, with_sensor
from p2sf.lens.source import Source
from p2sf.measure.fitting.lens_pupil import clear_part
from p2sf.measure.fitting.perturbation import perturb, perturbation, unit_of
from p2sf.measure.fitting.point_model import PictureOptics
from p2sf.measure.fitting.point_problem import PointPicture
from p2sf.measure.fitting.pupil_model import rotate
from p2sf.measure.fitting.pupil_nodes import PupilNodes, counts_for, lens_nodes, paraxial_nodes
from p2sf.paraxial.pupils import with_fixed_stop
from p2sf.paraxial.seidel import coefficients
from p2sf.pixel_kernels.sensor_points import SensorMap, sensor_map
from p2sf.pupil.fit import PHASE, FittedPencil, fit
from p2sf.pupil.seen_mask import mask_seen
from p2sf.tolerance.errors_of_build import UNITS, Tolerance

FOCUS = ("sensor_shift_um", "tilt_x_deg", "tilt_y_deg")
FIELD = ("w40", "w31", "w22", "w20")
F_NUMBER = "f_number"
F_NUMBER_ERROR = 3.0  # percent, one standard deviation: f-numbers are rounded, and stops stepped in thirds
WIDEST = 20.0  # percent, by which a f-number may differ: beyond, no series of the pupil holds
STOP_STEP = 0.02  # of the stop's radius, for the series of a wavefront over a wider pupil
SHIFT_MM = 0.01  # step of differences of rays, so small that W changes linearly
RESIDUAL_WAVES = 1e-3  # of fits to the lens's rays
UM_PER_DEGREE_MM = pi / 180 * UM_PER_MM  # by which a place 1 mm away recedes when tilted by 1°
UNIT = {"sensor_shift_um": "µm", "tilt_x_deg": "°", "tilt_y_deg": "°", **dict.fromkeys(FIELD, "waves"), F_NUMBER: "%"}


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

    ``terms``: (unknowns, nodes), waves per unit. ``focus``: waves per µm by which the sensor recedes. ``landing_um``:
    how far the chief ray moves, (2,), and per unit of each unknown, (unknowns, 2); 0 for those that bend none.
    ``series``: of phase, focus and terms by what the stop's radius grows in proportion, its first and second power,
    (2, 2 + unknowns, nodes); None where the f-number is none of the unknowns.
    """

    nodes: PupilNodes
    phase: np.ndarray
    terms: np.ndarray
    focus: np.ndarray
    landing_um: tuple[np.ndarray, np.ndarray]
    series: np.ndarray | None = None

    def stopped(self, ratio: float) -> "PointPupil":
        """Return the pupil of a stop whose radius is ``ratio`` times as large, its nodes at the same shares of it.

        Directions are taken to grow in proportion, so the lens is set up anew at the f-number found (`FrameModel`).
        """
        if self.series is None or ratio == 1:
            return self
        grown, nodes = ratio - 1, self.nodes
        phase, focus, *terms = (
            np.concatenate([self.phase[None], self.focus[None], self.terms])
            + grown * self.series[0]
            + grown**2 * self.series[1]
        )
        wider = replace(nodes, fx=ratio * nodes.fx, fy=ratio * nodes.fy)
        return replace(self, nodes=wider, phase=phase, focus=focus, terms=np.array(terms))

    def by_stop(self, ratio: float) -> np.ndarray:
        """Return the derivatives of phase, focus and terms by the ratio of the stop's radius, (2 + unknowns, nodes)."""
        assert self.series is not None
        slopes: np.ndarray = self.series[0] + 2 * (ratio - 1) * self.series[1]
        return slopes


@dataclass(frozen=True)
class FrameModel:
    """Which unknowns a frame is explained by, and the lens, if any, that they are departures from.

    ``unknowns``: of ``sensor_shift_um``, ``tilt_x_deg``, ``tilt_y_deg`` (by which the sensor recedes towards +x, +y);
    ``w40``, ``w31``, ``w22``, ``w20``, waves at ``height_mm``, growing with the field as 1, h, h² and h²; and errors of
    the lens such as ``decentre_y:3-4`` (`perturbation`), the sensor staying at its distance from the last surface.
    Without a lens the pupil is the paraxial one of the numerical aperture, and W has no other terms. ``about``: values
    of all unknowns near which those errors are taken to be linear, and the f-number about, 0 when not given.
    ``alone``: the model is of one
    point, and field polynomials are waves at it, wherever it lies. ``clip``: the lens's rims end pupils.
    """

    optics: PictureOptics
    height_mm: float
    unknowns: tuple[str, ...] = (*FOCUS, *FIELD)
    lens: Lens | None = None
    depth_mm: float = float("inf")
    about: tuple[float, ...] = ()
    alone: bool = False
    clip: bool = False
    f_number_error: float = F_NUMBER_ERROR

    def __post_init__(self) -> None:
        surfaces = len(self.lens.surfaces) if self.lens is not None else 0
        for name in self.unknowns:
            if name not in (*FOCUS, *FIELD, F_NUMBER) and not (surfaces and perturbation(name, surfaces)):
                raise RequestError(
                    '"{name}" is nothing that a frame tells here; choose from {choices}',
                    name=name,
                    choices=(*FOCUS, *FIELD, F_NUMBER, *(f"{kind}:1" for kind in UNITS if surfaces)),
                )

    @cached_property
    def errors(self) -> dict[str, Tolerance]:
        """Return the errors of the lens among the unknowns, by name."""
        surfaces = len(self.lens.surfaces) if self.lens is not None else 0
        every = {name: perturbation(name, surfaces) for name in self.unknowns}
        return {name: error for name, error in every.items() if error is not None}

    @property
    def prior(self) -> np.ndarray:
        """Return what is known of each unknown beforehand, 1/variance about 0, (unknowns,)."""
        known: np.ndarray = np.array([name == F_NUMBER for name in self.unknowns]) / self.f_number_error**2
        return known

    def stop_radius(self, values: np.ndarray) -> float:
        """Return the stop's radius under some values, over that near which the pupils are (``about``)."""
        if F_NUMBER not in self.unknowns:
            return 1.0
        return _stop_radius(float(values[self.unknowns.index(F_NUMBER)])) / self._about_radius

    def stop_slope(self, values: np.ndarray) -> float:
        """Return the derivative of `stop_radius` by the f-number, per percent."""
        percent = float(values[self.unknowns.index(F_NUMBER)])
        return -self.stop_radius(values) / (100 + percent) if abs(percent) < WIDEST else 0.0

    @cached_property
    def _about_radius(self) -> float:
        """Return the stop's radius near which the pupils are, over that of the f-number as stated."""
        return _stop_radius(dict(zip(self.unknowns, self.about, strict=False)).get(F_NUMBER, 0.0))

    @cached_property
    def near(self) -> Lens | None:
        """Return the lens as designed, at the f-number near which the pupils are."""
        return self.lens if self.lens is None else _with_stop(self.lens, self._about_radius)

    @property
    def near_optics(self) -> PictureOptics:
        """Return the scale of PSFs at the f-number near which the pupils are."""
        return replace(self.optics, na=self._about_radius * self.optics.na)

    def at(self, values: np.ndarray) -> "FrameModel":
        """Return the model of the same light through the stop that values of the unknowns tell; it is known then."""
        radius = self.stop_radius(values) * self._about_radius
        unknowns = tuple(name for name in self.unknowns if name != F_NUMBER)
        lens = self.lens if self.lens is None else _with_stop(self.lens, radius)
        return replace(
            self, unknowns=unknowns, lens=lens, optics=replace(self.optics, na=radius * self.optics.na), about=()
        )

    @property
    def focus_waves_per_um(self) -> float:
        """Return Wd per µm of a paraxial pupil in air, NA²Δz/(2λ)."""
        return self.optics.na**2 / (2 * self.optics.wavelength_um)

    def unit(self, name: str) -> str:
        """Return the unit of an unknown."""
        unit = unit_of(name)
        return UNIT[name] if unit is None else unit

    def pupils(self, x_mm: float, y_mm: float, half_um: float) -> tuple[PointPupil, ...]:
        """Return the pupil in every colour of a point whose chief ray lands at (x, y); for a window of ±``half_um``."""
        azimuth, height = float(np.arctan2(x_mm, y_mm)), float(np.hypot(x_mm, y_mm))
        place = x_mm, y_mm, height
        return tuple(self._pupil(colour, place, azimuth, half_um) for colour in self.near_optics.colours)

    def _pupil(
        self, colour: PictureOptics, place: tuple[float, float, float], azimuth: float, half_um: float
    ) -> PointPupil:
        counts = counts_for(1.2 * colour.cycles * half_um, colour.cycles, half_um)
        if self.lens is not None:
            return self._of_lens(colour, place, azimuth, counts)
        nodes = paraxial_nodes(counts, colour.cycles, colour.mask, colour.wavelength_um)
        across, along = rotate(nodes.xi, nodes.eta, azimuth)
        focus = (across**2 + along**2) * (colour.na**2 / (2 * colour.wavelength_um))

        def waves(ratio: float) -> np.ndarray:
            phases = np.zeros_like(focus), ratio**2 * focus
            return self._with_terms(colour, nodes, phases, place, (across, along))

        return self._point_pupil(nodes, waves)

    def _of_lens(
        self, colour: PictureOptics, place: tuple[float, float, float], azimuth: float, counts: tuple[int, int]
    ) -> PointPupil:
        lens, height = self.near, place[-1]
        assert lens is not None
        found, moved = self.pencil(height, colour.wavelength_um)
        source = self.source(height, azimuth, colour.wavelength_um)
        clear = clear_part(lens, source, counts) if self.clip else None
        nodes = lens_nodes(found, azimuth, counts, clear)
        # Lateral colour, along the field.
        shift = 0.0
        if len(self.optics.light):
            shift = UM_PER_MM * self._map().shift_mm(0.0, height, colour.wavelength_um)[1]
        about = dict(zip(self.unknowns, self.about, strict=False))
        values = np.array([about.get(name, 0.0) for name in self.errors])
        points = (source, self.source(height, azimuth)) if self.errors else ()
        errors = [perturb(lens, one, tuple(self.errors.values()), tuple(values.tolist())) for one in points]

        def waves(ratio: float) -> np.ndarray:
            wide = replace(nodes, **{name: ratio * getattr(nodes, name) for name in ("xi", "eta", "fx", "fy")})
            phase, focus = (-one.channels(PHASE).at(wide.xi, wide.eta)[0] for one in (found.function, moved))
            phase = phase - shift * (np.sin(azimuth) * wide.fx + np.cos(azimuth) * wide.fy)
            if not errors:
                return self._with_terms(colour, nodes, (phase, focus), place, (nodes.xi, nodes.eta))
            change, slopes = errors[0].at(wide, errors[1])
            phases = phase + change - values @ slopes, focus
            return self._with_terms(colour, nodes, phases, place, (nodes.xi, nodes.eta), slopes)

        made = self._point_pupil(nodes, waves)
        if not errors:
            return made
        landed = errors[1]
        each = dict(zip(self.errors, landed.landing_slopes, strict=True))
        landing = np.array([each.get(name, np.zeros(2)) for name in self.unknowns])
        return replace(made, landing_um=(landed.landing_um - values @ landed.landing_slopes, landing))

    def _point_pupil(self, nodes: PupilNodes, waves: Callable[[float], np.ndarray]) -> PointPupil:
        """Return a pupil of phase, focus and terms, (2 + unknowns, nodes), that ``waves`` gives for a stop's radius."""
        here, series = waves(1.0), None
        if F_NUMBER in self.unknowns:
            more, less = (waves(1 + sign * STOP_STEP) for sign in (1, -1))
            both = (more - less) / (2 * STOP_STEP), (more + less - 2 * here) / (2 * STOP_STEP**2)
            series = np.array(both, np.float32)
        phase, focus, terms = here[0], here[1], here[2:]
        return PointPupil(nodes, phase, terms, focus, (np.zeros(2), np.zeros((len(terms), 2))), series)

    def _with_terms(
        self,
        colour: PictureOptics,
        nodes: PupilNodes,
        phases: tuple[np.ndarray, np.ndarray],
        place: tuple[float, float, float],
        meridional: tuple[np.ndarray, np.ndarray],
        slopes: np.ndarray | Sequence[np.ndarray] = (),
    ) -> np.ndarray:
        """Return phase, focus, and what each unknown adds per unit, (2 + unknowns, nodes)."""
        (x, y, height), (phase, focus), (across, along) = place, phases, meridional
        square, h = across**2 + along**2, 1.0 if self.alone else height / self.height_mm
        ratio = self.optics.wavelength_um / colour.wavelength_um  # of waves here to those that the unknowns are in
        made = {
            "sensor_shift_um": focus,
            "tilt_x_deg": focus * (x * UM_PER_DEGREE_MM),
            "tilt_y_deg": focus * (y * UM_PER_DEGREE_MM),
            "w40": ratio * square**2,
            "w31": ratio * h * square * along,
            "w22": ratio * h * h * along**2,
            "w20": ratio * h * h * square,
            F_NUMBER: np.zeros_like(square),  # it scales the others (`PointPupil.stopped`)
            **dict(zip(self.errors, slopes, strict=True)),
        }
        return np.stack([phase + nodes.waves, focus, *(made[name] for name in self.unknowns)])

    def six_of_lens(self, height_mm: float) -> np.ndarray:
        """Return W40, W31, W22 and W20 + Wd of the lens where a chief ray lands at a height; 0 without a lens."""
        if self.lens is None:
            return np.zeros(4)
        source = self._map().source(0.0, height_mm, self.optics.wavelength_um)
        c = coefficients(self.lens, source.depth_mm, source.field_slope, source.wavelength_um)
        return np.array([c.w40, c.w31, c.w22, c.w20 + c.wd], float)

    def pencil(self, height_mm: float, wavelength_um: float) -> tuple[FittedPencil, DiscFunction]:
        """Return the fit of a point at a height, and by what its functions change per µm of the sensor."""
        lens = self.near
        assert lens is not None
        source = self._map().source(0.0, height_mm, wavelength_um)
        found = fit(lens, source, residual_waves=RESIDUAL_WAVES)
        places = (lens.sensor_mm + sign * SHIFT_MM for sign in (1, -1))
        more, less = (fit(with_sensor(lens, place), source, found.numbers).function for place in places)
        return found, replace(more, values=(more.values - less.values) / (2 * SHIFT_MM * UM_PER_MM))

    def source(self, height_mm: float, azimuth: float, wavelength_um: float | None = None) -> Source:
        """Return the source whose chief ray lands at a height, at ``azimuth`` radians from +y towards +x.

        In another wavelength it is the same point, which lands elsewhere.
        """
        seen = self._map().source(0.0, height_mm, wavelength_um or self.optics.wavelength_um)
        return replace(seen, azimuth_deg=float(np.rad2deg(azimuth)))

    def _map(self) -> SensorMap:
        assert self.lens is not None
        return chief_rays(self.lens, self.depth_mm, self.optics.wavelength_um, self.height_mm * 1.02)


def six_of_unknowns(x_mm: float, y_mm: float, model: FrameModel) -> np.ndarray:
    """Return W40, W31, W22 and W20 + Wd of a point per unit of every unknown, (4, unknowns); 0 for errors of a lens."""
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


def _stop_radius(percent: float) -> float:
    """Return the stop's radius, over that as stated, of a f-number so many percent higher."""
    return 1 / (1 + float(np.clip(percent, -WIDEST, WIDEST)) / 100)


def _with_stop(lens: Lens, ratio: float) -> Lens:
    """Return the lens with the radius of its stop so many times as large."""
    if ratio == 1:
        return lens
    fixed = with_fixed_stop(lens)
    return replace(fixed, aperture=replace(fixed.aperture, value=ratio * fixed.aperture.value))


def chief_rays(lens: Lens, depth_mm: float, wavelength_um: float, height_mm: float) -> SensorMap:
    """Return where chief rays land up to a height; they pass the middle of the stop, whatever mask stands there."""
    return sensor_map(with_mask(lens, CLEAR), depth_mm, wavelength_um, height_mm)


def lens_optics(lens: Lens, depth_mm: float, wavelength_um: float, pixel_um: float, fill: float = 1.0) -> PictureOptics:
    """Return the scale of a lens's PSFs. Raises GeometryError where the lens forms no image."""
    c = coefficients(lens, depth_mm, 0.0, wavelength_um)
    mask = mask_seen(lens, Source(depth_mm=depth_mm, wavelength_nm=wavelength_um * NM_PER_UM))
    return PictureOptics(abs(float(c.reduced_slope)), wavelength_um, pixel_um, fill, mask)
