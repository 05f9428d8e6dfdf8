"""The first-order figures of the present point, as a small table. No Qt in here."""

from math import isinf

from p2sf_explorer.state.scales import signed, significant, written_distance

OF_A = ("A", "", "The figures below and the sentence above are those of A, which the controls move.")

IMAGE_TIP = "Paraxial image of this depth, from the last vertex; from the principal points 1/s′ = 1/f′ − 1/s."
SENSOR_TIP = "Where the sensor stands, from the last vertex: in the image of the focus distance, shifted by Δz."
STOP_TIP = (
    "The surface whose rim limits the light: the least |rim/y| on the way of the marginal ray, or the file's choice."
)
ENTRANCE_TIP = "The stop seen from the object: its diameter D = f′/N for a far object, its place from the first vertex."
EXIT_TIP = "The stop seen from the sensor: its diameter, and its place from the last vertex."


def rows(live) -> tuple[tuple[str, str, str], ...]:
    """Return (name, value with unit, definition) of what a person asks first."""
    s = live.setting
    c, p = s.coefficients, s.pupils
    na = float(c.na)
    return (
        ("Focal length f′", length(s.focal_length_mm), "Effective focal length f′ = −1/C of the system matrix."),
        (
            "Working f-number",
            f"f/{significant(0.5 / na, 3)}" if na else "∞",
            "Working f-number 1/(2 NA) at this depth.",
        ),
        ("Numerical aperture", f"{na:.4f}", "NA = n′|u′|, image-space slope of the marginal ray."),
        ("Airy radius", f"{significant(live.airy_radius_um, 3)} µm", "First dark ring of a perfect lens, 0.61 λ/NA."),
        ("Paraxial image", length(float(c.image_distance)), IMAGE_TIP),
        ("Sensor", length(s.lens.sensor_mm), SENSOR_TIP),
        (
            "Entrance pupil",
            pupil(p.entrance_from_first, p.entrance_diameter),
            ENTRANCE_TIP,
        ),
        ("Exit pupil", pupil(p.exit_from_last, p.exit_diameter), EXIT_TIP),
        ("Stop", f"surface {int(s.stop.surface)} ({s.stop.chosen_by})", STOP_TIP),
        (
            "Strehl ratio",
            significant(float(live.psf.strehl), 2),
            "Peak of the PSF over that of the same pupil with W = 0; near 1 it is about exp(−(2πσ)²), σ the RMS of W.",
        ),
    )


def length(mm: float) -> str:
    """Return a length in mm with its sign."""
    return "∞" if isinf(mm) else f"{signed(mm, 3)} mm"


def pupil(place, diameter) -> str:
    """Return a pupil's diameter and place."""
    if isinf(float(place)):
        return "at infinity"
    return f"⌀ {significant(float(diameter), 4)} at {signed(float(place), 2)} mm"


def described_depth(mm: float) -> str:
    """Return a depth in words."""
    return "object at infinity" if isinf(mm) else f"object at {written_distance(mm)}"
