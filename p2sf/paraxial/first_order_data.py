"""First-order data of a lens as one record: what `p2sf info` and `ObjectPoints.first_order` show."""

from dataclasses import dataclass

from p2sf.lens.lens import Lens
from p2sf.lens.meridians import meridians
from p2sf.paraxial.first_order import abcd, cardinal_points, image_distance, magnification
from p2sf.paraxial.pupils import Stop, f_number, find_stop, numerical_aperture, pupils


@dataclass(frozen=True)
class FirstOrder:
    """First-order data of a lens at one depth and wavelength, by paraxial rays in yz (Welford 1986, ch. 3).

    Distances are in mm, positive to the right of the vertex that their name ends in, the first or the last.

    Attributes
    ----------
    focal_length_mm : float
        Effective focal length −1/C; infinite for an afocal lens.
    back_focal_from_last_mm, front_focal_from_first_mm : float
        Focal points.
    front_principal_from_first_mm, rear_principal_from_last_mm : float
        Principal points.
    front_nodal_from_first_mm, rear_nodal_from_last_mm : float
        Nodal points.
    stop_surface : int
        Number of the surface that is the stop, from 1.
    stop_semi_diameter_mm : float
        Its radius.
    entrance_pupil_from_first_mm, entrance_pupil_diameter_mm, exit_pupil_from_last_mm, exit_pupil_diameter_mm : float
        Pupils.
    numerical_aperture : float
        n'u' of the marginal ray at this depth, without its sign.
    f_number : float
        Focal length over the diameter of the entrance pupil.
    image_from_last_mm : float
        Image of this depth.
    magnification : float
        Transverse magnification at this depth.
    abcd : tuple of float
        System matrix A, B, C, D from the first vertex to the last in reduced angles.
    in_x : FirstOrder or None
        The same of rays in xz, where cylinders, toroids or biconics make it another.
    """

    focal_length_mm: float
    back_focal_from_last_mm: float
    front_focal_from_first_mm: float
    front_principal_from_first_mm: float
    rear_principal_from_last_mm: float
    front_nodal_from_first_mm: float
    rear_nodal_from_last_mm: float
    stop_surface: int
    stop_semi_diameter_mm: float
    entrance_pupil_from_first_mm: float
    entrance_pupil_diameter_mm: float
    exit_pupil_from_last_mm: float
    exit_pupil_diameter_mm: float
    numerical_aperture: float
    f_number: float
    image_from_last_mm: float
    magnification: float
    abcd: tuple[float, float, float, float]
    in_x: "FirstOrder | None" = None


def first_order(lens: Lens, depth_mm: float, wavelength_um: float, stop: Stop | None = None) -> FirstOrder:
    """Return the first-order data of a lens; GeometryError for a depth or a stop that has none."""
    stop = find_stop(lens, depth_mm, wavelength_um) if stop is None else stop
    along_y, along_x = meridians(lens)
    beside = None if along_x == along_y else _of_meridian(along_x, depth_mm, wavelength_um, stop)
    return _of_meridian(along_y, depth_mm, wavelength_um, stop, beside)


def _of_meridian(
    lens: Lens, depth_mm: float, wavelength_um: float, stop: Stop, in_x: FirstOrder | None = None
) -> FirstOrder:
    """Return what paraxial rays say of one meridian of a lens."""
    points, ends = cardinal_points(lens, wavelength_um), pupils(lens, wavelength_um, stop)
    a, b, c, d = abcd(lens, wavelength_um).ravel().tolist()
    return FirstOrder(
        float(points.effective_focal_length),
        float(points.back_focal_distance),
        float(points.front_focal_distance),
        float(points.front_principal_from_first),
        float(points.rear_principal_from_last),
        float(points.front_nodal_from_first),
        float(points.rear_nodal_from_last),
        int(stop.surface),
        float(stop.semi_diameter),
        float(ends.entrance_from_first),
        float(ends.entrance_diameter),
        float(ends.exit_from_last),
        float(ends.exit_diameter),
        float(numerical_aperture(lens, depth_mm, wavelength_um, stop)),
        float(f_number(lens, wavelength_um, stop)),
        float(image_distance(lens, depth_mm, wavelength_um)),
        float(magnification(lens, depth_mm, wavelength_um)),
        (a, b, c, d),
        in_x,
    )
