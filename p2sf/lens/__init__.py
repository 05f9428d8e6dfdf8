"""The lens and the point source as plain frozen data: surfaces, media, sensor, aperture. Nothing here traces a ray."""

from p2sf.lens.anamorphic import Biconic, Toroid
from p2sf.lens.freeform import XYPolynomial, ZernikeFringeSag, ZernikeStandardSag
from p2sf.lens.grating import Grating
from p2sf.lens.irregularity import Irregularity
from p2sf.lens.lens import Aperture, Lens, Surface, indices, lens_range_um, with_f_number, with_mask, with_sensor
from p2sf.lens.placement import Placement
from p2sf.lens.rim import Rim
from p2sf.lens.shapes import Diffraction, Qbfs, Qcon, RadialPolynomial
from p2sf.lens.source import Source
from p2sf.lens.transmission import Transmission

__all__ = [
    "Aperture",
    "Biconic",
    "Diffraction",
    "Grating",
    "Irregularity",
    "Lens",
    "Placement",
    "Qbfs",
    "Qcon",
    "RadialPolynomial",
    "Rim",
    "Source",
    "Surface",
    "Toroid",
    "Transmission",
    "XYPolynomial",
    "ZernikeFringeSag",
    "ZernikeStandardSag",
    "indices",
    "lens_range_um",
    "with_f_number",
    "with_mask",
    "with_sensor",
]
