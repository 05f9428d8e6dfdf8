"""Provenance stored with a database: lens, glasses, method, units, conventions, versions."""

import hashlib
from dataclasses import dataclass
from functools import cached_property, partial, reduce
from math import inf
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from p2sf.arguments import check_arguments
from p2sf.conventions import NM_PER_UM, degrees_from_slope
from p2sf.database.accuracy import DatabaseAccuracy, accuracy, accuracy_from
from p2sf.database.files.packing import pack
from p2sf.database.files.sealed import write_sealed
from p2sf.database.points import points_of, psfs_into
from p2sf.database.render import Database, Sampling, pixels_psf
from p2sf.database.space import Space
from p2sf.disc.mask import PupilMask
from p2sf.figures.record import versions
from p2sf.files.writing import check_ending, plain
from p2sf.glass.media import Medium
from p2sf.glass.pages import data_version
from p2sf.html import html_table
from p2sf.io.record import MAPS, mask_numbers, setting
from p2sf.lens.lens import Lens, with_aim
from p2sf.lens.positions import without_positions
from p2sf.lens.source import Source, check_one
from p2sf.lensfile.toml.lens import lens_to_toml, parse_toml
from p2sf.messages import Message
from p2sf.parameters import check_samples
from p2sf.paraxial.pupils import Stop, find_stop
from p2sf.paraxial.seidel import Coefficients
from p2sf.psf.result import Psf, warn_of_window
from p2sf.raytrace.focusing import object_distance

if TYPE_CHECKING:
    import xarray

COEFFICIENT_UNITS = {
    "w40 w31 w22 w20 w11 wd errors": "waves",
    "stored numbers": "mm of optical path at unit field slope",
    "depths": "mm from the first vertex",
    "field": "slope of the chief ray at the entrance pupil",
    "wavelengths": "µm",
}
CONVENTIONS = (
    "Welford's signs; W = (chief path − ray path)/λ; rows +y up the sensor, columns +x, sample N//2 is the chief ray, "
    "unit sum; a positive field's chief ray lands at +y; W11 moves the image and is not rendered"
)

AZIMUTH = (
    "the mask stands as a field lands at +y sees it; a field at another azimuth sees it turned the other way, and its "
    "PSF is rendered so, not turned as a picture"
)
SETTING = "sensor_mm", "focus_mm", "f_number", "stop", "aim", "absorption", "position", "mask"
OF_LOOKED_UP = "method", "interpolant", "errors_waves", "predicted_error"
RECTANGLE = (
    "field x and field y are the chief ray's slopes along x and y at the entrance pupil; numbers of fits stand in the "
    "axes of the sensor, and the PSF of a source is turned so that its field points to +y"
)


@dataclass(frozen=True, eq=False)
class Stored:
    """A database together with ``meta``, the provenance stored with it."""

    database: Any  # an ExactDatabase, GridDatabase or FittedDatabase: `method` and `interpolant` say which
    meta: dict[str, Any]

    @cached_property
    def lens(self) -> Lens:
        """Return the lens the database was built from; LensFileError or GlassError where it cannot be read."""
        return with_aim(parse_toml(self.meta["lens"]["toml"], self.meta["lens"]["name"]), self.meta["aim"])

    @cached_property
    def accuracy(self) -> DatabaseAccuracy:
        """Return the predicted 1 − R² of the PSFs against exact rays, from the file or else computed from the lens."""
        stated = self.meta.get("predicted_error")
        return accuracy_from(stated, self.meta["method"]) if stated else accuracy(self.database, self.lens)

    @property
    def depths_mm(self) -> np.ndarray:
        """Return the nodes along depth, (n,), mm from the first vertex."""
        return self._space.depths_mm

    @property
    def object_distance_mm(self) -> float:
        """Return the distance of the lens's object, mm, infinite in files before 0.3: the depth unless one is given."""
        stated = self.meta.get("object_distance_mm")
        return inf if stated is None else float(stated)

    @property
    def fields_deg(self) -> np.ndarray:
        """Return the nodes along the field, (n,), degrees; for a rectangle of fields those along y."""
        return degrees_from_slope(self._space.field_slopes)

    @property
    def fields_x_deg(self) -> np.ndarray | None:
        """Return the nodes along x of fields that fill a rectangle, (n,), degrees; None of others."""
        slopes = self._space.field_x_slopes
        return None if slopes is None else degrees_from_slope(slopes)

    @property
    def wavelengths_nm(self) -> np.ndarray:
        """Return the nodes along wavelength, (n,), nm."""
        return self._space.wavelengths_um * NM_PER_UM

    @property
    def _space(self) -> Space:
        space: Space = self.database.space
        return space

    @check_arguments
    def coefficients(
        self,
        source: Source | None = None,
        *,
        depth_mm: ArrayLike | None = None,
        field_deg: ArrayLike = 0.0,
        wavelength_nm: ArrayLike | None = None,
        field_x_deg: ArrayLike | None = None,
    ) -> Coefficients:
        """Return the six coefficients of one source, or of arrays of depths, fields and wavelengths, looked up.

        Parameters
        ----------
        source : Source, optional
            One source, in place of the arrays.
        depth_mm, field_deg, wavelength_nm, field_x_deg : array_like
            Object distances, mm, by default the lens's own; angles, degrees, by default on the axis; wavelengths, nm,
            by default the middle one. Of any shapes that broadcast, which is the shape of every coefficient.

        Raises
        ------
        DatabaseError
            Outside what is covered.
        RequestError
            For what are no numbers or do not broadcast.

        Examples
        --------
        >>> import p2sf
        >>> nodes = [500, float("inf")], [0, 7, 14], [400, 550, 700]
        >>> database = p2sf.build_database(p2sf.load_lens("double_gauss_28"), *nodes, interpolant="exact")
        >>> database.coefficients(depth_mm=[[500], [3000]], field_deg=[0, 2, 5]).w31.shape
        (2, 3)
        """
        if source is not None:
            check_one(source)
            place = source.depth_mm, source.field_slope, source.wavelength_um
            one: Coefficients = self.database.coefficients(*map(float, place))
            return one
        own_depth = self.object_distance_mm if depth_mm is None else depth_mm
        depth, *slopes, wavelength = points_of(self._space, own_depth, field_deg, wavelength_nm, field_x_deg)
        many: Coefficients = self.database.coefficients(depth, reduce(np.hypot, slopes), wavelength)
        return Coefficients(**dict(zip(vars(many), np.broadcast_arrays(*vars(many).values()), strict=True)))

    @check_arguments
    def psfs(
        self,
        *,
        depth_mm: ArrayLike | None = None,
        field_deg: ArrayLike = 0.0,
        wavelength_nm: ArrayLike | None = None,
        field_x_deg: ArrayLike | None = None,
        pixels: int = 64,
        pixel_um: float | None = None,
        out: Any = None,
    ) -> np.ndarray:
        """Return PSFs of arrays of depths, fields and wavelengths, each of unit sum, looked up and not traced.

        The work is distributed over all cores, or as many threads as the environment variable P2SF_THREADS states.

        Parameters
        ----------
        depth_mm, field_deg, wavelength_nm, field_x_deg : array_like
            As for `coefficients`.
        pixels : int
            Samples along each side.
        pixel_um : float, optional
            Distance between samples, µm, by default λ/(4 NA) of the finest PSF; wider pixels hold the light that falls
            on each.
        out : array, optional
            Where they are written, an array of numpy, a memory map or one of zarr; by default a new one of float32.

        Returns
        -------
        numpy.ndarray
            ``out``, the shape to which the arrays broadcast and behind it (pixels, pixels).

        Raises
        ------
        DatabaseError, RequestError
            As for `coefficients`; RequestError also for an ``out`` of another shape.
        GeometryError, SamplingError
            Where there is no PSF to sample.
        """
        own_depth = self.object_distance_mm if depth_mm is None else depth_mm
        points = points_of(self._space, own_depth, field_deg, wavelength_nm, field_x_deg)
        check_samples(pixels, pixel_um)
        found: np.ndarray = psfs_into(self.database, points, Sampling(pixels, pixel_um), out)
        return found

    def to_xarray(self) -> "xarray.Dataset":
        """Return the six coefficients at all nodes, in waves, and ``na`` as a dataset of xarray, with what it is of.

        ExportError without xarray. `psfs` looks up the PSFs.
        """
        from p2sf.named_arrays import NamedArrays, along

        across = {} if self.fields_x_deg is None else {"field_x_deg": self.fields_x_deg}
        nodes = {"depth_mm": self.depths_mm, "field_deg": self.fields_deg} | across
        nodes |= {"wavelength_nm": self.wavelengths_nm}
        every: dict[str, Any] = dict(zip(nodes, np.ix_(*nodes.values()), strict=True))
        found = self.coefficients(**every)
        names = "w40", "w31", "w22", "w20", "w11", "wd", "na"
        coords = {key: part for name, values in nodes.items() for key, part in along(name, values).items()}
        arrays = {name: (tuple(nodes), getattr(found, name)) for name in names}
        return NamedArrays(arrays, coords, self.record).to_xarray()

    def save(self, path: str | PathLike[str]) -> Path:
        """Write the database as a .npz file, which `p2sf.open_database` opens; ExportError where that is impossible."""
        check_ending("path", path, ".npz", Message("a database is a .npz file"))
        return write_sealed(path, pack(self.database, self.meta))

    @check_arguments
    def psf(
        self, source: Source, pixels: int = 64, pixel_um: float | None = None, *, integrated: bool | None = None
    ) -> Psf:
        """Return the PSF of one source, looked up and not traced.

        Without ``pixel_um`` the samples, ``pixels`` along each side, are as far apart as shows the whole PSF;
        ``integrated`` as `p2sf.render` has it. Raises
        DatabaseError outside what is covered, GeometryError and SamplingError where there is no PSF to sample.
        """
        check_one(source)
        psf = pixels_psf(self.database, source, pixels, pixel_um, integrated)
        return warn_of_window(psf.with_figures(provenance=partial(self.describe, source)), 4)

    @property
    def record(self) -> dict[str, Any]:
        """Return ``meta`` without the text of the lens and what only a database needs, for files of other programs."""
        lens = {key: value for key, value in self.meta["lens"].items() if key != "toml"}
        return {key: value for key, value in self.meta.items() if key != "numbers"} | {"lens": lens}

    def describe(self, source: Source) -> dict[str, Any]:
        """Return what the PSF of a source is of, as `p2sf.io.record.describe` does for a lens."""
        record = self.record
        place = {
            "depth_mm": source.depth_mm,
            "field_deg": source.field_deg,
            **({"azimuth_deg": source.azimuth_deg} if source.azimuth_deg else {}),
            "wavelength_nm": source.wavelength_um * NM_PER_UM,
        }
        return {
            "lens": record["lens"],
            "setup": plain(place) | {name: record[name] for name in SETTING if name in record},
            "database": {name: record[name] for name in OF_LOOKED_UP if name in record},
            "versions": record["versions"],
        }

    def __repr__(self) -> str:
        nodes = " × ".join(map(str, self.meta["nodes"]))
        kind, axes = f"{self.meta['method']}, {self.meta['interpolant']}", f"({axis_names(self.meta)})"
        name = self.meta["lens"]["name"] + (f", {self.meta['position']}" if self.meta.get("position") else "")
        return f"<PSF database of {name}: {kind}, {nodes} nodes {axes}, aim {self.meta['aim']}>"

    def _repr_html_(self) -> str:
        covers = [(name, low, inf if high is None else high) for name, (low, high) in self.meta["covers"].items()]
        return html_table(repr(self), ("covers", "from", "to"), covers)


def axis_names(meta: dict[str, Any]) -> str:
    """Return the names of the axes of a database."""
    fields = "field y × field x" if "field_x_deg" in meta["covers"] else "field"
    return f"depth × {fields} × wavelength"


def provenance(database: Database, lens: Lens, stop: Stop | None = None) -> dict[str, Any]:
    """Return the provenance of a database of this lens as plain JSON values."""
    stop, toml, space = stop or find_stop(lens), lens_to_toml(without_positions(lens)), database.space
    fields = {"field_deg": _ends_deg(space.field_slopes)}
    if space.field_x_slopes is not None:
        fields["field_x_deg"] = _ends_deg(space.field_x_slopes)
    record: dict[str, Any] = plain(
        {
            "method": database.method,
            "interpolant": database.interpolant,
            "errors_waves": database.errors,
            "predicted_error": accuracy(database, lens).record,
            "lens": {
                "name": lens.name,
                "title": lens.title,
                "source": lens.source,
                "sha256_of_toml": hashlib.sha256(toml.encode()).hexdigest(),
                "toml": toml,
            },
            "glasses": [{"glass": label, "data": source} for label, source in _glasses(lens)],
            "stop": {"surface": int(stop.surface), "semi_diameter_mm": float(stop.semi_diameter)},
            **setting(lens, stop),
            "object_distance_mm": object_distance(lens),
            **_mask_record(database.mask),
            "covers": {
                "depth_mm": [space.depths_mm[0], space.depths_mm[-1]],
                **fields,
                "wavelength_nm": [space.wavelengths_um[0] * NM_PER_UM, space.wavelengths_um[-1] * NM_PER_UM],
            },
            "nodes": space.shape,
            "units": COEFFICIENT_UNITS,
            "conventions": CONVENTIONS,
            **({} if space.field_x_slopes is None else {"fields": RECTANGLE}),
            "versions": versions(),
        }
    )
    return record


def _ends_deg(slopes: np.ndarray) -> list[float]:
    return [float(degrees_from_slope(slopes[k])) for k in (0, -1)]


def _mask_record(mask: PupilMask) -> dict[str, Any]:
    """Return what a file says about the mask that its PSFs are rendered through, but for its maps: nothing if clear."""
    if mask.clear:
        return {}
    stated = {name: value for name, value in mask_numbers(mask)["mask"].items() if name not in MAPS}
    return {"mask": stated, **({} if mask.round else {"azimuth": AZIMUTH})}


def _glasses(lens: Lens) -> dict[tuple[str, str], None]:
    """Return (name, source of its data) of every medium once, in the order of the light path."""
    return dict.fromkeys((medium.label, data_source(medium)) for medium in lens.media)


def data_source(medium: Medium) -> str:
    """Return the source of the index of a medium in a few words."""
    entry = getattr(medium, "entry", None)
    if entry is not None:
        return f"{data_version()}, {entry.label}"
    return {"ConstantIndex": "stated index", "TabulatedIndex": "stated table", "ModelGlass": "model of nd and vd"}.get(
        type(medium).__name__, type(medium).__name__
    )
