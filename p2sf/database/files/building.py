"""The database that a script builds: `p2sf.build_database`."""

import warnings
from math import inf
from os import PathLike
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from p2sf.arguments import check_arguments, real_array
from p2sf.conventions import NM_PER_UM, slope_from_degrees
from p2sf.database.accuracy import build_by, check_kind
from p2sf.database.files.provenance import Stored, provenance
from p2sf.database.space import Space
from p2sf.errors import P2SFWarning
from p2sf.files.writing import check_ending, check_place
from p2sf.lens.lens import Lens
from p2sf.messages import Message
from p2sf.parameters import check_angle
from p2sf.setting import AS_IN_FILE, AimChoice, CameraData, Request, StopChoice, explicit_values, set_up, with_camera


@check_arguments
@with_camera
def build_database(
    lens: Lens,
    depths_mm: ArrayLike,
    fields_deg: ArrayLike,
    wavelengths_nm: ArrayLike,
    *,
    method: Literal["auto", "seidel", "fitted"] = "auto",
    interpolant: Literal["exact", "table1", "linear"] = "exact",
    fields_x_deg: ArrayLike | None = None,
    path: str | PathLike[str] | None = None,
    camera: CameraData = AS_IN_FILE,
    focus_mm: float | None = None,
    sensor_shift_um: float = 0.0,
    f_number: float | None = None,
    stop: StopChoice = "file",
    aim: AimChoice | None = None,
) -> Stored:
    """Describe all PSFs of a lens within a range of depths, fields and wavelengths by a few numbers.

    Parameters
    ----------
    lens : Lens
        The lens, see `load_lens`.
    depths_mm, fields_deg, wavelengths_nm : array_like
        Nodes along each axis, ascending: object distances from the first vertex, mm, of which the last may be inf;
        field angles, degrees; wavelengths, nm. The database covers everything between the outermost nodes.
    method : {"auto", "seidel", "fitted"}
        The method whose numbers are stored; "auto" takes the six coefficients where they keep R² ≥ 0.99 everywhere, and
        fits to exact rays elsewhere.
    interpolant : {"exact", "table1", "linear"}
        For "seidel", which "auto" then is: polynomials exact to round-off, the rule of Pieroni et al. 2015, table 1, or
        linear interpolation.
    fields_x_deg : array_like, optional
        For "fitted", which "auto" then is: angles along x, degrees, ascending, where ``fields_deg`` are those along y.
        A lens with tilts or decentres needs them, since its PSFs depend on both.
    path : str or path, optional
        A .npz file to which the database is also written.
    camera, focus_mm, sensor_shift_um, f_number, stop, aim
        As for `render`; the stop "auto" is that for an object at infinity.

    Returns
    -------
    Stored
        ``.psf(source)`` and ``.coefficients(source)`` look up a source, ``.psfs`` and ``.coefficients`` of arrays of
        depths, fields and wavelengths many at once. ``.accuracy`` is the predicted 1 − R² of its
        PSFs against exact rays, and above 1e-3 a ``P2SFWarning`` says so; ``.meta`` says where the numbers come from,
        and ``.meta["errors_waves"]`` how exactly they are looked up.

    Raises
    ------
    DatabaseError
        If nodes are not ascending, or if the data of a glass cannot be interpolated.
    RequestError, GeometryError, GlassError
        As for `render`.
    ExportError
        If the name does not end in .npz, or if the file cannot be written.

    Examples
    --------
    >>> import p2sf
    >>> lens = p2sf.load_lens("double_gauss_28")
    >>> database = p2sf.build_database(lens, [2000, 5000, float("inf")], [0, 7, 14], [450, 550, 650])
    >>> database.psf(p2sf.Source(3000, field_deg=5, wavelength_nm=500)).method
    'fitted'
    """
    if path is not None:
        check_ending("path", path, ".npz", Message("a database is a .npz file"))
        check_place(path)
    check_kind(method, interpolant, fields_x_deg is not None)
    fields = _slopes("fields_deg", fields_deg)
    fields_x = None if fields_x_deg is None else _slopes("fields_x_deg", fields_x_deg)
    setup = set_up(lens, Request(depth_mm=inf, **explicit_values(camera)))
    depths, waves = real_array("depths_mm", depths_mm), real_array("wavelengths_nm", wavelengths_nm)
    space = Space(depths, fields, waves / NM_PER_UM, fields_x)
    database = build_by(setup.lens, space, method, interpolant, setup.stop)
    stored = Stored(database, provenance(database, setup.lens, setup.stop))
    if path is not None:
        stored.save(path)
    if stored.accuracy.caution:
        warnings.warn(str(stored.accuracy.caution), P2SFWarning, stacklevel=4)
    return stored


def _slopes(name: str, angles_deg: ArrayLike) -> np.ndarray:
    """Return the slopes of field angles in degrees; RequestError, naming the parameter, for one that cannot be."""
    angles = real_array(name, angles_deg)
    for angle in angles.ravel().tolist():
        check_angle(name, angle)
    return slope_from_degrees(angles)
