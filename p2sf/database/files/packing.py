"""A coefficient database as the arrays and the JSON of its file, and back."""

import json
from collections.abc import Callable
from os import PathLike
from typing import Any

import numpy as np

from p2sf.database.exact import NUMBERS, ExactDatabase
from p2sf.database.fitted import FittedDatabase, fields_of
from p2sf.database.grid import PER_WAVELENGTH, STORED, GridDatabase, NodeGrid
from p2sf.database.render import Database
from p2sf.database.space import Space
from p2sf.disc.basis import PupilBasis
from p2sf.disc.mask import CLEAR, PupilMap, PupilMask
from p2sf.errors import DatabaseError, RequestError
from p2sf.files.reading import parse_json
from p2sf.io.record import MAPS
from p2sf.lens.lens import AIMS
from p2sf.pupil.fit import Level

# The newest schema, and those of files that say nothing which came with a later one.
SCHEMA, WITH_MASK, WITHOUT_MASK = 3, 2, 1
MARK = "p2sf_database"

Arrays = dict[str, np.ndarray]
Meta = dict[str, Any]
"""What JSON holds about a database."""


def stated_meta(mark: np.ndarray) -> Meta:
    """Return what a file says about its database; one from before `Lens.aim` filled the paraxial entrance pupil."""
    stated: Meta = parse_json(str(mark))
    stated.setdefault("aim", "paraxial")
    return stated


def pack(database: Any, meta: Meta) -> Arrays:
    """Return the arrays of a file that holds a database and its provenance, ``meta``."""
    own = {"schema", "kind", "numbers"}
    pack_kind, _ = _KINDS[type(database).__name__]
    arrays, numbers = pack_kind(database)
    mask = database.mask
    arrays |= {name: table.values for name in MAPS if (table := getattr(mask, name)) is not None}
    space = database.space
    axes = {"depths_mm": space.depths_mm, "field_slopes": space.field_slopes, "wavelengths_um": space.wavelengths_um}
    schema = WITHOUT_MASK if mask.clear else WITH_MASK
    if space.field_x_slopes is not None:
        axes["field_x_slopes"], schema = space.field_x_slopes, SCHEMA
    about = {name: value for name, value in meta.items() if name not in own}
    head = {"schema": schema, "kind": type(database).__name__, **about, "numbers": numbers}
    return {MARK: np.array(json.dumps(head, ensure_ascii=False)), **axes, **arrays}


def unpack(arrays: Arrays, name: str | PathLike[str]) -> tuple[Database, Meta]:
    """Return the database and the provenance in the arrays of a file, which errors call ``name``.

    Raises DatabaseError for arrays that hold none, or one of a newer schema.
    """
    try:
        meta = stated_meta(arrays[MARK])
        if meta["schema"] > SCHEMA:
            raise DatabaseError(
                "{name} has schema {schema}, newer than {newest}, the newest this P2SF reads; update P2SF",
                name=str(name),
                schema=meta["schema"],
                newest=SCHEMA,
            )
        if meta["aim"] not in AIMS:
            raise KeyError(f"an aim that is one of {AIMS}")
        axes = arrays["depths_mm"], arrays["field_slopes"], arrays["wavelengths_um"], arrays.get("field_x_slopes")
        space = Space(*axes)
        _, unpack_kind = _KINDS[meta["kind"]]
        mask = _mask(arrays, meta) if "mask" in meta else CLEAR
        return unpack_kind(space, arrays, meta, mask), meta
    except (KeyError, TypeError, IndexError, ValueError, RequestError) as error:
        raise DatabaseError(
            "{name} lacks what a P2SF database holds, {reason}; build it again", name=str(name), reason=repr(error)
        ) from error


def _mask(arrays: Arrays, meta: Meta) -> PupilMask:
    """Return the mask of a file; RequestError, TypeError and KeyError where that is none."""
    stated: dict[str, Any] = {**meta["mask"], "zernike_um": tuple(meta["mask"].get("zernike_um", ()))}
    stated |= {name: PupilMap(arrays[name]) for name in MAPS if name in arrays}
    if None in stated.values():
        raise TypeError("a mask of numbers only")
    return PupilMask(**stated)


def _pack_exact(database: ExactDatabase) -> tuple[Arrays, Meta]:
    numbers = {name: getattr(database, name) for name in ("middle", "half", "sensor_mm", "sensor_curvature")}
    return {"series": database.series}, numbers


def _unpack_exact(space: Space, arrays: Arrays, meta: Meta, mask: PupilMask) -> ExactDatabase:
    series, numbers = _check_shape(arrays["series"], (None, NUMBERS)), meta["numbers"]
    made = series, numbers["middle"], numbers["half"], numbers["sensor_mm"], meta["errors_waves"]
    return ExactDatabase(space, *made, mask=mask, sensor_curvature=numbers.get("sensor_curvature", 0.0))


def _pack_grid(database: GridDatabase) -> tuple[Arrays, Meta]:
    return {"depth": database.grid.depth, "wavelength": database.grid.wavelength}, {}


def _unpack_grid(space: Space, arrays: Arrays, meta: Meta, mask: PupilMask) -> GridDatabase:
    depths, _, wavelengths = space.shape
    grid = NodeGrid(
        _check_shape(arrays["depth"], (depths, wavelengths, len(STORED))),
        _check_shape(arrays["wavelength"], (wavelengths, len(PER_WAVELENGTH))),
    )
    return GridDatabase(space, grid, meta["interpolant"], meta["errors_waves"], mask=mask)


def _pack_fitted(database: FittedDatabase) -> tuple[Arrays, Meta]:
    arrays, numbers = _pack_exact(database.seidel)
    numbers = {**numbers, "level": _level_numbers(database.level), "seidel_errors_waves": database.seidel.errors}
    return {**arrays, "fits": database.series}, {**numbers, "residual_waves": database.residual_waves}


def _level_numbers(level: Level) -> list[int]:
    """Return orders and rays, 1 where these have weights, and behind it the orders of terms that symmetry forbids."""
    orders = [level.basis.wave_order, level.basis.map_order]
    forbidden = [order for _ in level.basis.phase.parities[1:] for order in orders]
    return [*orders, level.radii, level.directions, *[1] * level.weighted, *forbidden]


def _unpack_fitted(space: Space, arrays: Arrays, meta: Meta, mask: PupilMask) -> FittedDatabase:
    numbers = meta["numbers"]
    wave_order, map_order, radii, directions, *others = (int(count) for count in numbers["level"])
    fields = fields_of(space)
    level = Level(PupilBasis(wave_order, map_order, fields.domain), radii, directions, weighted=bool(others))
    if _level_numbers(level) != [int(count) for count in numbers["level"]]:
        raise KeyError("a level that fits its fields")
    fits = _check_shape(arrays["fits"], (*(None for _ in space.nodes), level.numbers + fields.chief_numbers))
    seidel = _unpack_exact(space, arrays, {**meta, "errors_waves": numbers["seidel_errors_waves"]}, mask)
    return FittedDatabase(seidel, fits, level, meta["errors_waves"], numbers["residual_waves"])


def _check_shape(array: np.ndarray, shape: tuple[int | None, ...]) -> np.ndarray:
    """Return an array as it is; KeyError unless it has this shape, None being any length."""
    if array.ndim != len(shape) or any(want not in (None, have) for want, have in zip(shape, array.shape, strict=True)):
        raise KeyError(f"an array of shape {shape}")
    return array


_KINDS: dict[str, tuple[Callable[..., tuple[Arrays, Meta]], Callable[[Space, Arrays, Meta, PupilMask], Database]]] = {
    "ExactDatabase": (_pack_exact, _unpack_exact),
    "GridDatabase": (_pack_grid, _unpack_grid),
    "FittedDatabase": (_pack_fitted, _unpack_fitted),
}
