"""First-order data of the lens as it is set, in three columns of (name, value, definition)."""

from collections.abc import Callable
from math import inf, isfinite, isinf

import numpy as np

from p2sf.lens.lens import Lens
from p2sf.lens.meridians import meridians
from p2sf.lens.positions import Kind
from p2sf.messages import Message, Number
from p2sf.paraxial.first_order import cardinal_points, image_distance, magnification
from p2sf.paraxial.pupils import Stop, f_number, pupils
from p2sf.paraxial.seidel import coefficients
from p2sf.raytrace.focusing import focused_vergence
from p2sf_explorer.compute.caption import caption
from p2sf_explorer.compute.live import Live, View
from p2sf_explorer.compute.pupil import written_rms
from p2sf_explorer.compute.setup import ParaxialSetup
from p2sf_explorer.state.scales import MM_PER_UNIT, significant

Row = tuple[str, Message, str]
"""A name, a value with its unit, a definition."""

FARTHEST_MM = 1e6  # a focus beyond a kilometre is one at infinity
INFINITE, NONE = Message("∞"), Message("–")
OF_A: Row = ("A", Message(""), "The figures below and the sentence above are those of A, which the controls move.")

IMAGE_TIP = "Paraxial image of this depth, from the last vertex; from the principal points 1/s′ = 1/f′ − 1/s."
SENSOR_TIP = "Position of the sensor from the last vertex: at the image of the focus distance, shifted by Δz."
STOP_TIP = (
    "The surface whose rim limits the light: the smallest |rim/y| along the marginal ray, or the one that the file "
    "names."
)
ENTRANCE_TIP = (
    "The stop seen from the object: its diameter D = |f′|/N for a far object, its place from the first vertex."
)
OBJECT_TIP = (
    "y of the source, negative below the axis; none at infinity. A field stated as an object height counts towards −y."
)
STREHL_TIP = "Peak of the PSF over that of the same pupil with W = 0; near 1 it is about exp(−(2πσ)²), σ the RMS of W."
RMS_TIP = "Root mean square of the wavefront over the pupil, without piston and tilt, which do not blur."
EXIT_TIP = "The stop seen from the sensor: its diameter, and its place from the last vertex."


def rows(live: Live) -> tuple[Row, ...]:
    """Return what a person asks first and the caption does not say; *First order* has the others."""
    na, chosen, found = live.setup.cone.na, live.state.display.caption, list[Row]()
    if "strehl" not in chosen:
        strehl = live.psf.strehl
        value = NONE if strehl is None else Message("{value}", value=Number(significant(float(strehl), 2)))
        found.append(("Strehl ratio", value, STREHL_TIP))
    if "rms" not in chosen:
        found.append(("RMS wavefront", Message("{value} λ", value=written_rms(live.pupil)), RMS_TIP))
    found.append(("Focal length", focal_length(live.setup), "Effective focal length f′ = −1/C of the system matrix."))
    working = aperture(0.5 / na if na else inf)
    if str(working) != caption(live).get("f_number"):
        found.append(("Working f-number", working, "Working f-number 1/(2 NA) at this depth."))
    return tuple(found)


def in_each_meridian(setup: ParaxialSetup, figure: Callable[[Lens], Message]) -> Message:
    """Return what paraxial rays say of a lens, of each of its meridians where these differ."""
    along_y, along_x = meridians(setup.lens)
    in_y = figure(along_y)
    if along_x == along_y or str(in_x := figure(along_x)) == str(in_y):
        return in_y
    return Message("{y} in y, {x} in x", y=in_y, x=in_x)


def focal_length(setup: ParaxialSetup) -> Message:
    """Return the focal length, or both."""
    wavelength = setup.source.wavelength_um
    return in_each_meridian(setup, lambda lens: length(float(cardinal_points(lens, wavelength).effective_focal_length)))


def paraxial_image(setup: ParaxialSetup) -> Message:
    """Return where the paraxial image of this depth is, or where its lines are."""
    depth, wavelength = setup.source.depth_mm, setup.source.wavelength_um
    return in_each_meridian(setup, lambda lens: length(float(image_distance(lens, depth, wavelength))))


def entrance_pupil(setup: ParaxialSetup) -> Message:
    """Return diameter and place of the entrance pupil."""

    def figure(lens: Lens) -> Message:
        found = pupils(lens, setup.source.wavelength_um, setup.stop)
        return pupil(found.entrance_from_first, found.entrance_diameter)

    return in_each_meridian(setup, figure)


def exit_pupil(setup: ParaxialSetup) -> Message:
    """Return diameter and place of the exit pupil."""

    def figure(lens: Lens) -> Message:
        found = pupils(lens, setup.source.wavelength_um, setup.stop)
        return pupil(found.exit_from_last, found.exit_diameter)

    return in_each_meridian(setup, figure)


def speed(setup: ParaxialSetup) -> Message:
    """Return the f-number."""
    wavelength = setup.source.wavelength_um
    return in_each_meridian(setup, lambda lens: aperture(float(f_number(lens, wavelength, setup.stop))))


def _peak(live: Live) -> Message:
    """Return where the PSF is brightest."""
    if live.psf.peak_um is None:
        return NONE
    x, y = (float(place) for place in live.psf.peak_um)
    return Message("x {x:z.2f}, y {y:z.2f} µm", x=x, y=y)


def ring_note(live: Live, kind: Kind) -> Message:
    """Return what follows from a ring of the lens: its column, focal length and f-number, or the distance in focus."""
    s = live.setup
    axis = s.lens.positions.axis(kind) if s.lens.positions else None
    place = s.lens.positions.at(kind) if s.lens.positions else None
    if axis is None or place is None:
        return NONE
    between = Message("between two positions of the file")
    column = Message("{name}", name=axis.words(place)) if place in axis.at else between
    if kind == "zoom":
        focal = Number(significant(s.focal_length_mm, 3))
        return Message("EFL {focal} mm, {speed} · {column}", focal=focal, speed=speed(s), column=column)
    vergence = focused_vergence(s.lens)
    focused = distance(1 / vergence) if vergence > 1 / FARTHEST_MM else INFINITE
    return Message("focused at {distance} · {column}", distance=focused, column=column)


def length(mm: float) -> Message:
    """Return a length in mm with its sign."""
    return INFINITE if isinf(mm) else Message("{value:z.3f} mm", value=mm)


def distance(mm: float) -> Message:
    """Return a distance: metres from 1 m on, else millimetres."""
    if isinf(mm):
        return INFINITE
    if abs(mm) >= MM_PER_UNIT["m"]:
        return Message("{value} m", value=Number(significant(mm / MM_PER_UNIT["m"], 4)))
    return Message("{value} mm", value=Number(significant(mm, 4)))


def aperture(f_number: float) -> Message:
    """Return an f-number."""
    return Message("f/{value}", value=Number(significant(f_number, 3))) if isfinite(f_number) else INFINITE


def airy_radius(live: Live) -> Message:
    """Return the radius of the Airy disc."""
    return Message("{value} µm", value=Number(significant(live.airy_radius_um, 3)))


def pupil(place: np.ndarray | float, diameter: np.ndarray | float) -> Message:
    """Return a pupil's diameter and place."""
    if isinf(float(place)):
        return Message("at infinity")
    diameter_mm = Number(significant(float(diameter), 4))
    return Message("⌀ {diameter} at {place:z.2f} mm", diameter=diameter_mm, place=float(place))


def stop(found: Stop) -> Message:
    """Return the surface of a stop, and who chose it."""
    number = int(found.surface)
    if found.chosen_by == "auto":
        return Message("surface {number} (auto)", number=number)
    return Message("surface {number} (file)", number=number)


def described_depth(mm: float) -> Message:
    """Return a depth in words."""
    return Message("object at infinity") if isinf(mm) else Message("object at {distance}", distance=distance(mm))


def first_order(live: Live) -> View[tuple[tuple[Row, ...], ...]]:
    """Return the columns: the lens by itself, its pupils and rays, this source."""
    return View((lens_rows(live), pupil_rows(live), source_rows(live)))


def lens_rows(live: Live) -> tuple[Row, ...]:
    """Return focal, principal and nodal points, Petzval radius and track of the lens."""
    s = live.setup

    def point(name: str) -> Message:
        return in_each_meridian(
            s, lambda lens: length(float(getattr(cardinal_points(lens, s.source.wavelength_um), name)))
        )

    return (
        ("Focal length f′", focal_length(s), "f′ = −1/C of the system matrix."),
        (
            "Back focus F′",
            point("back_focal_distance"),
            "Rear focal point, where light from a far axial point meets, from the last vertex: f′·A.",
        ),
        (
            "Front focus F",
            point("front_focal_distance"),
            "Front focal point, whose light leaves as a parallel beam, from the first vertex: D/C.",
        ),
        (
            "Principal point H",
            point("front_principal_from_first"),
            "Front principal plane, imaged onto H′ at magnification 1; from the first vertex.",
        ),
        (
            "Principal point H′",
            point("rear_principal_from_last"),
            "Rear principal plane, from which f′ is measured to F′; from the last vertex.",
        ),
        (
            "Nodal point N",
            point("front_nodal_from_first"),
            "A ray aimed at N leaves from N′ in its old direction; from the first vertex.",
        ),
        (
            "Nodal point N′",
            point("rear_nodal_from_last"),
            "A ray aimed at N leaves from N′ in its old direction; from the last vertex.",
        ),
        ("Petzval radius", length(petzval_radius(s)), "1/(n′ΣcΔ(1/n)): the image's curvature without astigmatism."),
        ("Track", length(track(s)), "Length of the lens with its air: from the first vertex to the sensor."),
    )


def pupil_rows(live: Live) -> tuple[Row, ...]:
    """Return stop, pupils, apertures and the invariant."""
    s = live.setup
    na = s.cone.na
    invariant = float(s.rays.invariant) * s.source.field_slope
    return (
        ("Stop", stop(s.stop), STOP_TIP),
        ("Stop radius", length(float(s.stop.semi_diameter)), "Half the free diameter of the stop."),
        ("Entrance pupil", entrance_pupil(s), ENTRANCE_TIP),
        ("Exit pupil", exit_pupil(s), EXIT_TIP),
        ("f-number", speed(s), "|f′| over the entrance pupil."),
        ("Working f-number", aperture(0.5 / na if na else inf), "1/(2 NA) at this depth."),
        ("Numerical aperture", Message("{value:.4f}", value=na), "NA = n′|u′| of the marginal ray."),
        (
            "Lagrange invariant",
            Message("{value:z.4f} mm", value=invariant),
            "H = n(ūy − uȳ), the same at every surface.",
        ),
        ("Airy radius", airy_radius(live), "First dark ring of a perfect lens, 0.61 λ/NA."),
    )


def source_rows(live: Live) -> tuple[Row, ...]:
    """Return what the lens makes of this source."""
    s = live.setup
    height, depth, wavelength = s.object_y_mm, s.source.depth_mm, s.source.wavelength_um

    def ratio(lens: Lens) -> Message:
        return Message("{value:z.5f}", value=float(magnification(lens, depth, wavelength)))

    def gap(lens: Lens) -> Message:
        gap = s.lens.sensor_mm - float(image_distance(lens, depth, wavelength))
        return Message("{value:z.1f} µm", value=1e3 * gap) if isfinite(gap) else INFINITE

    return (
        ("Wavelength", Message("{value:.1f} nm", value=live.state.optics.wavelength_nm), "In vacuum."),
        ("Depth", distance(s.source.depth_mm), "Source to first vertex."),
        (
            "Field",
            Message("{value:z.2f}°", value=live.state.optics.field_deg),
            "Angle of the chief ray at the entrance pupil.",
        ),
        ("Object height", NONE if height is None else length(height), OBJECT_TIP),
        ("Magnification", in_each_meridian(s, ratio), "Image over object height; 0 from infinity."),
        ("Paraxial image", paraxial_image(s), IMAGE_TIP),
        ("Sensor", length(s.lens.sensor_mm), SENSOR_TIP),
        (
            "Sensor − image",
            in_each_meridian(s, gap),
            "Δz: what Wd = NA²Δz/(2n′λ) has.",
        ),
        (
            "Image height",
            length(image_height(s)),
            "y of the paraxial chief ray on the sensor; in focus, the magnification times the object height.",
        ),
        ("Peak of the PSF", _peak(live), "Where it is on the sensor: x and y from the chief ray."),
    )


def image_height(setup: ParaxialSetup) -> float:
    """Return y of the paraxial chief ray on the sensor, mm."""
    source, along_y = setup.source, meridians(setup.lens).y
    if along_y is setup.lens:
        return float(setup.own.image_height)
    return float(
        coefficients(along_y, source.depth_mm, source.field_slope, source.wavelength_um, setup.stop).image_height
    )


def petzval_radius(setup: ParaxialSetup) -> float:
    """Return the Petzval radius in mm, negative when it bends towards the lens (Welford 1986, eq. 8.47)."""
    index = setup.rays.index
    curvature = np.array([surface.vertex_curvature for surface in setup.lens.surfaces])
    total = float((curvature * (1 / index[1:] - 1 / index[:-1])).sum()) * float(index[-1])
    return 1 / total if total else inf


def track(setup: ParaxialSetup) -> float:
    """Return first vertex to sensor, mm."""
    return setup.lens.vertices[-1]
