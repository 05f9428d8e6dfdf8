"""Lenses with shapes beyond conics and even terms, and with diffractive surfaces, for tests."""

from p2sf.glass.media import MIRROR, ConstantIndex, catalogue_glass
from p2sf.lens.lens import Aperture, Lens, Surface
from p2sf.lens.shapes import Diffraction, Qbfs, Qcon, RadialPolynomial

GLASS = ConstantIndex(1.52)
PHASE = Diffraction((-2500.0, 140.0, -13.0), 10.0)
OTHER_PHASE = Diffraction((-700.0, -90.0, 3.0), 8.0, 2.0)
QBFS, QCON = Qbfs((0.05, -0.02, 0.01), 9.0), Qcon((0.05, -0.02), 9.0)
EXTENDED = RadialPolynomial((0.0, 0.03, 0.0, 0.05, 0.0, -0.01), 9.0)
ODD = RadialPolynomial((0.0, 2e-4, 3e-5, -1e-5, 1e-6))
CONE = RadialPolynomial((2e-3, 2e-4))


def singlet(first: dict, second: dict | None = None, rim: float = 4.0) -> Lens:
    """Return a biconvex lens behind its stop, with what its two surfaces are besides."""
    surfaces = Surface(thickness=3.0), Surface(40.0, 4.0, GLASS, **first), Surface(-70.0, 50.0, **(second or {}))
    return Lens(surfaces, Aperture("stop_semi_diameter", rim), 1)


def two_shaped_mirrors(first: dict, second: dict | None = None, rim: float = 4.0) -> Lens:
    """Return two mirrors whose light goes to the right again, with what they are besides."""
    surfaces = Surface(-300.0, -60.0, MIRROR, **first), Surface(-200.0, 90.0, MIRROR, **(second or {}))
    return Lens(surfaces, Aperture("stop_semi_diameter", rim), 1)


def hybrid() -> Lens:
    """Return a singlet of real glass with a diffractive back and a Qbfs front."""
    glass = catalogue_glass("SCHOTT N-BK7")
    surfaces = (
        Surface(thickness=2.0),
        Surface(60.0, 5.0, glass, shape=QBFS),
        Surface(-300.0, 80.0, diffraction=Diffraction((-400.0, 30.0), 10.0)),
    )
    return Lens(surfaces, Aperture("stop_semi_diameter", 6.0), 1)


PARTS = {
    "phase": ({"diffraction": PHASE}, {"diffraction": OTHER_PHASE}),
    "Qbfs": ({"shape": QBFS}, {}),
    "Qcon": ({"shape": QCON, "conic": -0.7}, {}),
    "extended and phase": ({"shape": EXTENDED, "conic": 0.3, "diffraction": OTHER_PHASE}, {}),
    "Qbfs with terms and phase": ({}, {"shape": QBFS, "aspheric": (1e-5, -2e-8), "diffraction": PHASE}),
}
UNSEEN_BY_SEIDEL = {"odd": ({"shape": ODD}, {}), "cone": ({"shape": CONE, "diffraction": PHASE}, {})}
