"""Six lenses of isetrtf: the edge spread of rays on the axis at two depths, and relative illumination.

Listed from Zemax OpticStudio (ISET, MIT licence); numbers only. Their tables round the indices, and neither the
wavelength nor the aperture of the files is stated.
"""

from collections.abc import Iterator
from dataclasses import replace
from functools import lru_cache
from math import inf
from typing import Any

import numpy as np

from p2sf.errors import GeometryError
from p2sf.glass.media import AIR, ConstantIndex
from p2sf.lens.lens import Aperture, Lens, Surface, with_sensor
from p2sf.lens.source import Source
from p2sf.pixel_kernels.illumination import relative_illumination
from p2sf.pixel_kernels.sensor_points import sensor_map
from p2sf.pupil.landing import landing
from p2sf.studies.listings.row import ListedNumber, numbers_of

UM = 0.55
SOURCE = "Zemax OpticStudio, listed in isetrtf"
RINGS = 128
HEIGHTS = 6  # of the listed ones
TABLES = "neither wavelength nor aperture of the file is stated: a focus 0.1 % away and a stop 4 % smaller make as much"
LIGHT = "what ends the pencils, and the object's distance, are not stated; rims 4 % smaller make as much"
RAYS = 2e-3  # of the light: as a listing of a few thousand rays is off
FOCUS = 1e-3  # of the film's distance: by so much a wavelength some 20 nm away moves the focus
UNSTATED = 0.04  # of the rims: by so much the lists of the double Gauss are narrower than its table
LEAST_UM = 1e-12  # of the radius of a ring of light
LEAST_MM = 1e-3  # of a sensor's corner


def rows() -> Iterator[ListedNumber]:
    """Yield every curve of the listings."""
    for name, case in numbers_of("edges").items():
        for edge in case["esf"]:
            yield _edge(name, case, edge)
        yield _illumination(name, case)


@lru_cache(maxsize=8)
def lens_of(name: str) -> Lens:
    """Return a lens of the tables; radius 0 marks the plane of the stop, index 0 the medium before it."""
    rows = numbers_of("edges")[name]["prescription"]
    surfaces, medium, stop = [], AIR, 0
    for number, (radius, thickness, index, half) in enumerate(rows, 1):
        if not index:
            stop = number
        elif index == 1:
            medium = AIR
        else:
            medium = ConstantIndex(index)
        surfaces.append(Surface(radius or inf, thickness, medium, semi_diameter=half))
    aperture = Aperture("stop_semi_diameter", rows[stop - 1][3])
    return Lens(tuple(surfaces), aperture, stop, name=f"{name} (isetrtf)", wavelengths_nm=(1000 * UM,))


def _narrower(lens: Lens) -> Lens:
    """Return the lens with its stop and its rims smaller by `UNSTATED`."""
    part = 1 - UNSTATED
    surfaces = tuple(replace(surface, semi_diameter=part * surface.semi_diameter) for surface in lens.surfaces)
    aperture = Aperture("stop_semi_diameter", part * lens.aperture.value)
    return replace(lens, surfaces=surfaces, aperture=aperture)


def _edge(name: str, case: dict[str, Any], edge: dict[str, Any]) -> ListedNumber:
    """Return the row of one edge: the share of the light of a point that lies below each place."""
    lens = with_sensor(lens_of(name), case["film_mm"])
    places = edge["first_um"] + edge["step_um"] * np.arange(len(edge["esf"]))
    lenses = lens, _narrower(lens), *(with_sensor(lens, lens.sensor_mm * (1 + part)) for part in (FOCUS, -FOCUS))
    ours, *others = (_below(one, edge["depth_mm"], places) for one in lenses)
    apart, *doubts = (float(np.abs(ours - other).max()) for other in (np.array(edge["esf"]), *others))
    doubt = doubts[0] + max(doubts[1:])
    quantity = f"edge spread at {edge['depth_mm']:g} mm, {len(places)} places"
    words = f"{name} (isetrtf)", SOURCE, 0.0, apart, RAYS, "of the listing's rays", "", TABLES, doubt + RAYS
    return ListedNumber("edges", quantity, *words)


def _below(lens: Lens, depth_mm: float, places_um: np.ndarray) -> np.ndarray:
    """Return the share of the light that lies below places, µm.

    A ring of light of radius r lies below x in the share 1/2 + arcsin(x/r)/π.
    """
    found = landing(lens, Source(depth_mm, 0.0, UM), clip=True, rings=RINGS)
    radius = np.maximum(np.hypot(found.x_um, found.y_um), LEAST_UM)
    share = 0.5 + np.arcsin(np.clip(places_um[:, None] / radius, -1, 1)) / np.pi
    below: np.ndarray = share @ found.light
    return below


def _illumination(name: str, case: dict[str, Any]) -> ListedNumber:
    """Return the row of one curve, over its value on the axis, at the heights that chief rays reach."""
    listed = case["illumination"]
    lens = with_sensor(lens_of(name), listed["film_mm"] or case["film_mm"])
    heights, stated = (np.array(listed[key]) for key in ("height_mm", "relative"))
    some = np.unique(np.linspace(0, len(heights) - 1, HEIGHTS).astype(int))
    apart, doubt, count = 0.0, 0.0, 0
    for height, value in zip(heights[some].tolist(), (stated[some] / stated[0]).tolist(), strict=True):
        ours, smaller = (_light_at(one, height) for one in (lens, _narrower(lens)))
        if ours is not None:
            apart, count = max(apart, abs(ours - value)), count + 1
            doubt = max(doubt, abs(ours - (smaller or 0.0)))
    quantity = f"relative illumination, {count} of {len(heights)} heights"
    words = f"{name} (isetrtf)", SOURCE, 0.0, apart, RAYS, "of the listing's rays", "", LIGHT, doubt + RAYS
    return ListedNumber("illumination", quantity, *words)


def _light_at(lens: Lens, height_mm: float) -> float | None:
    """Return the illumination over that on the axis; None where no field of less than 90° lands there."""
    try:
        seen = sensor_map(lens, inf, UM, max(height_mm, LEAST_MM), clip=True)
        return float(relative_illumination(seen, np.zeros(1), np.array([height_mm]))[0])
    except GeometryError:
        return None
