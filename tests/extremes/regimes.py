"""The systematic sweep: where lens programs usually break, as (regime, lens, depth, field slope, wavelength)."""

from dataclasses import dataclass, replace
from functools import cache
from math import inf, isinf, pi, tan

import numpy as np
from mpmath import binomial, mpf, sqrt

from p2sf.glass.media import MIRROR, ConstantIndex
from p2sf.lens.lens import Aperture, Lens, Surface
from p2sf.lens.shapes import Qbfs, Qcon, RadialPolynomial, Shape
from p2sf.paraxial.first_order import basis_rays, cardinal_points
from tests.support.lenses.mirrors import aplanatic, classical, folded, mangin, mirror, two_mirrors
from tests.support.lenses.mirrors import telescope as corrected_telescope
from tests.support.lenses.simple_lenses import simple, telescope
from tests.support.reference import prescription_lens, reference

WAVELENGTH = 0.5875618
BASES = ("double_gauss_28", "achromat_f6", "eye_navarro", "asphere")


@dataclass(frozen=True)
class Case:
    regime: str
    lens: Lens
    depth: float = inf
    slope: float = 0.1
    wavelength: float = WAVELENGTH
    field: str = "slope"


def system_of(case: Case) -> dict:
    """Return the plain numbers of a case for the witness."""
    lens, surfaces = case.lens, case.lens.surfaces
    shapes = [vertex_of(s) for s in surfaces]
    return {
        "radius": [radius for radius, _, _ in shapes],
        "thickness": [s.thickness for s in surfaces],
        "index": signed_indices(lens, case.wavelength),
        "conic": [conic for _, conic, _ in shapes],
        "a4": [a4 for _, _, a4 in shapes],
        "stop": lens.stop_surface - 1,
        "rim": lens.aperture.value,
        "depth": case.depth,
        "slope": case.slope,
        "field": case.field,
        "wavelength_mm": case.wavelength / 1000,
        "sensor_radius": lens.sensor_radius,
    }


def signed_indices(lens: Lens, wavelength: float) -> list[float]:
    """Return the index of every space, negative where light goes back: behind an odd number of mirrors."""
    found = [float(lens.object_medium.index(wavelength))]
    for surface in lens.surfaces:
        reflects = surface.medium == MIRROR
        new = abs(found[-1]) if reflects else float(surface.medium.index(wavelength))
        found.append(new if (found[-1] > 0) != reflects else -new)
    return found


def vertex_of(surface: Surface) -> tuple:
    """Return radius, conic and A4 of the plain surface with the same r² and r⁴ terms, in 50 digits for a shape."""
    a4 = surface.aspheric[0] if surface.aspheric else 0.0
    if surface.shape is None:
        return surface.radius, surface.conic, a4
    c = mpf(0) if isinf(surface.radius) else 1 / mpf(surface.radius)
    second, fourth = vertex_terms(surface.shape, c)
    bent = c + 2 * second
    whole = (1 + mpf(surface.conic)) * c**3 / 8 + mpf(a4) + fourth
    return (1 / bent if bent else inf), 0.0, whole - bent**3 / 8


def vertex_terms(shape: Shape, c) -> tuple:
    """Return the coefficients of r² and r⁴ in 50 digits, by closed forms (Forbes 2007) of up to three terms of Qbfs."""
    terms, edge = [mpf(a) for a in shape.coefficients], mpf(shape.normalisation_mm)
    if isinstance(shape, Qcon):
        return mpf(0), sum((-1) ** m * binomial(m + 4, 4) * a for m, a in enumerate(terms)) / edge**4
    if isinstance(shape, RadialPolynomial):
        return terms[1] / edge**2, (terms[3] if len(terms) > 3 else 0) / edge**4
    known = (1, 0), (13 / sqrt(mpf(19)), -16 / sqrt(mpf(19))), (29 * sqrt(mpf(2) / 95), -100 * sqrt(mpf(2) / 95))
    value, slope = (sum(a * q[k] for a, q in zip(terms, known, strict=False)) for k in (0, 1))
    return value / edge**2, (slope - value) / edge**4 + value * c * c / (2 * edge**2)


@cache
def base(name: str) -> Lens:
    """Return a reference lens with the indices listed at the wavelength nearest to the d line."""
    wavelength_nm = min((float(key) for key in reference(name)["indices"]), key=lambda x: abs(x - 587.5618))
    return prescription_lens(name, wavelength_nm)


def random_lens(count: int, seed: int, figured: bool = False) -> Lens:
    """Return a random lens of ``count`` surfaces whose rays stay of the size of the lens."""
    rng = np.random.default_rng([count, seed])
    weak = 20 + 8 * count
    rows = []
    for j in range(count):
        radius = weak * float(np.exp(rng.uniform(0, 2))) * (1 if rng.random() < 0.5 else -1)
        medium = ConstantIndex(1.0 if j % 2 or j == count - 1 else float(rng.uniform(1.45, 1.9)))
        conic, a4 = (float(rng.uniform(-3, 1)), float(rng.normal(0, 1e-7))) if figured else (0.0, 0.0)
        rows.append(Surface(radius, float(rng.uniform(0.2, 6)), medium, conic, (a4,) if figured else ()))
    return Lens(tuple(rows), Aperture("stop_semi_diameter", 3.0), int(rng.integers(1, count + 1)))


def with_surface(lens: Lens, j: int, **changes) -> Lens:
    surfaces = list(lens.surfaces)
    surfaces[j] = replace(surfaces[j], **changes)
    return replace(lens, surfaces=tuple(surfaces))


def scaled(lens: Lens, k: float) -> Lens:
    def grown(s: Surface) -> Surface:
        a = tuple(x / k ** (3 + 2 * i) for i, x in enumerate(s.aspheric))
        return replace(s, radius=s.radius * k, thickness=s.thickness * k, aspheric=a)

    rim = replace(lens.aperture, value=lens.aperture.value * k)
    return replace(lens, surfaces=tuple(grown(s) for s in lens.surfaces), aperture=rim)


def depth_cases():
    for name in BASES:
        for depth in (1e-3, 1e-1, 1.0, 30.0, 1e3, 1e6, 1e9, 1e12, 1e15, inf):
            yield Case("depth 1e-3 … 1e15 mm, ∞", base(name), depth)


def focal_plane_cases():
    for name in BASES:
        front = -float(cardinal_points(base(name), WAVELENGTH).front_focal_distance)
        if front > 0:
            for shift in (-1e-6, -1e-9, -1e-12, 1e-12, 1e-9, 1e-6):
                yield Case("front focal plane ± 1e-12", base(name), front * (1 + shift))


def field_cases():
    for name in BASES:
        for degrees in (0.0, 1e-12, 1e-6, 1e-3, 1.0, 45.0, 80.0, 89.9):
            yield Case("field 0 … 89.9°", base(name), 500.0, tan(degrees * pi / 180))


def aperture_cases():
    for name in BASES:
        efl = abs(float(cardinal_points(base(name), WAVELENGTH).effective_focal_length))
        a = abs(float(basis_rays(base(name), WAVELENGTH).a[base(name).stop_surface - 1]))
        for number in (0.5, 1.4, 22.0, 1e3, 1e4):
            rim = Aperture("stop_semi_diameter", efl / (2 * number) * a)
            yield Case("f/0.5 … f/10 000", replace(base(name), aperture=rim), 700.0)


def wavelength_cases():
    for name in BASES:
        for wavelength in (0.2, 0.4, 1.0, 12.0):
            yield Case("wavelength 0.2 … 12 µm", base(name), 800.0, 0.1, wavelength)


def radius_cases():
    for sign in (1, -1):
        for radius in (1e-3, 1e-2, 1.0, 1e2, 1e6, 1e9, 1e12, inf):
            small = min(5.0, radius / 4)
            for depth in (inf, 20.0):
                singlet = simple([(sign * radius, 3.0, 1.5), (-60.0, 50.0, 1.0)], 2, small)
                yield Case("radius 1e-3 … 1e12 mm, plane", singlet, depth)
                lens = with_surface(base("double_gauss_28"), 3, radius=sign * radius)
                yield Case("radius 1e-3 … 1e12 mm, plane", lens, depth)


def thickness_cases():
    for thickness in (0.0, 1e-9, 1e-6, 1e-3, 1.0, 1e3, 1e6):
        for name in ("double_gauss_28", "achromat_f6"):
            lens = base(name)
            for j in range(len(lens.surfaces)):
                yield Case("thickness 0 … 1e6 mm", with_surface(lens, j, thickness=thickness), 400.0)


def index_step_cases():
    for step in (1e-3, 1e-6, 1e-9, -1e-9, 0.0):
        yield Case("index step 1e-9", simple([(50.0, 3.0, 1 + step), (-40.0, 1e3, 1.0)], 1, 2.0))
        yield Case(
            "index step 1e-9", simple([(50.0, 3.0, 1.5), (-40.0, 2.0, 1.5 + step), (90.0, 40.0, 1.0)], 3, 2.0), 99.0
        )


def many_surface_cases():
    for count in (1, 2, 3, 5, 10, 20, 50, 100, 400):
        for seed in range(3 if count < 50 else 1):
            for depth in (inf, 250.0):
                yield Case("1 … 400 surfaces", random_lens(count, seed, figured=seed == 1), depth)


def afocal_cases():
    for lens in (telescope(-40.0, 3.0), telescope(25.0, 3.0), telescope(100.0, 3.0), telescope(-33.3, 0.7)):
        for depth in (inf, 1e6, 150.0, 1.0):
            yield Case("afocal: Galilean, Keplerian, relay", lens, depth)


def stop_cases():
    for name in BASES:
        for stop in (1, len(base(name).surfaces)):
            for depth in (inf, 300.0):
                yield Case("stop first, last, near a vertex", replace(base(name), stop_surface=stop), depth)
    for gap in (0.0, 1e-12, 1e-9, 1e-6):
        lens = simple(
            [(40.0, 5.0, 1.6), (-70.0, gap, 1.0), (inf, gap, 1.0), (-30.0, 3.0, 1.5), (80.0, 60.0, 1.0)], 3, 2.0
        )
        for depth in (inf, 200.0):
            yield Case("stop first, last, near a vertex", lens, depth)


def telecentric_cases():
    for shift in (0.0, 1e-13, 1e-9, 1e-3):
        front = simple([(inf, 100.0 * (1 + shift), 1.0), (50.0, 3.0, 1.5), (inf, 98.0, 1.0)], 1, 3.0)
        back = simple([(50.0, 3.0, 1.5), (inf, 98.0 * (1 + 1e-3 + shift), 1.0), (inf, 20.0, 1.0)], 3, 3.0)
        for depth in (inf, 300.0):
            yield Case("telecentric, both ways", front, depth)
            yield Case("telecentric, both ways", back, depth)
        yield Case("object height as field", back, 300.0, 2.0, field="height")
    for name in BASES:
        yield Case("object height as field", base(name), 300.0, 20.0, field="height")


def cemented_cases():
    for lens in (base("double_gauss_28"), base("achromat_f6")):
        for j in range(len(lens.surfaces)):
            extra = Surface(35.0, 0.0, lens.surfaces[j].medium)
            surfaces = (*lens.surfaces[: j + 1], extra, *lens.surfaces[j + 1 :])
            surfaces = (
                *surfaces[:j],
                replace(surfaces[j], thickness=0.0),
                replace(extra, thickness=lens.surfaces[j].thickness),
                *surfaces[j + 2 :],
            )
            stop = lens.stop_surface + (lens.stop_surface > j + 1)
            yield Case("cemented zero gaps", replace(lens, surfaces=surfaces, stop_surface=stop), 350.0)


def index_space_cases():
    for before, after in ((1.0, 1.3377), (1.33, 1.0), (1.52, 1.52), (1.0, 4.0)):
        for depth in (inf, 60.0):
            rows = [(20.0, 4.0, 1.7), (-25.0, 2.0, 1.4), (inf, 3.0, 1.4), (-15.0, 30.0, after)]
            yield Case("n, n' ≠ 1", simple(rows, 3, 2.0, before), depth)


def virtual_cases():
    for name in BASES:
        for depth in (0.5, 5.0, 15.0):
            yield Case("virtual images", base(name), depth)
    for depth in (inf, 100.0, 3.0):
        yield Case("virtual images", simple([(-30.0, 2.0, 1.5), (40.0, -25.0, 1.0)], 1, 3.0), depth)


def scaling_cases():
    for name in BASES:
        for k in (1e-6, 1e-3, 1e3, 1e6):
            yield Case("lens and λ × 1e-6 … 1e6", scaled(base(name), k), 900.0 * k, 0.1, WAVELENGTH * k)


def shape_cases():
    for name in ("double_gauss_28", "eye_navarro"):
        for strength in (1e-15, 1e-4, 1e-2):
            for edge in (1e-2, 10.0, 1e4):
                depart = strength * min(edge, 1.0)
                shapes = (
                    Qbfs((depart, -depart / 2, depart / 3), edge),
                    Qcon(tuple(depart * (-1) ** m / (m + 1) for m in range(10)), edge),
                    RadialPolynomial((0.0, depart, 0.0, -depart), edge),
                )
                for number, shape in enumerate(shapes):
                    lens = with_surface(base(name), number % 2, shape=shape, conic=0.0)
                    yield Case("Qbfs, Qcon and r² terms", lens, inf if number else 300.0)


def mirror_cases():
    """Yield systems that light goes back in: from a bare mirror to three of them before a corrector of lenses."""
    systems = [
        *(mirror(radius, radius / 2, conic) for radius in (-1e-2, -1e3, -1e9, 1e3) for conic in (0.0, -1.0, 30.0)),
        *(mangin(conic) for conic in (0.0, -0.5, 1e3)),
        *(two_mirrors(conics) for conics in ((0.0, 0.0), classical(), aplanatic())),
        *(two_mirrors(classical(), magnified=m) for m in (1 + 1e-9, 1.01, 1e3)),
        *(two_mirrors(classical(), behind=behind) for behind in (-1e2, 1e-9, 1e5)),
        *(folded(base(name)) for name in BASES),
        corrected_telescope(),
    ]
    for lens in systems:
        for depth in (inf, 1e6, 150.0):
            yield Case("mirrors", lens, depth, 0.01)
        yield Case("mirrors", replace(lens, stop_surface=len(lens.surfaces)), inf, 0.01)


def curved_sensor_cases():
    for name in BASES:
        for radius in (1e-3, 0.1, 10.0, 1e3, 1e9, 1e15):
            for sign, depth, slope in ((1, inf, 0.1), (-1, inf, 0.1), (1, 500.0, 1e-9), (-1, 1.0, 3.0)):
                yield Case(
                    "curved sensor 1e-3 … 1e15 mm", replace(base(name), sensor_radius=sign * radius), depth, slope
                )
    yield Case("curved sensor 1e-3 … 1e15 mm", replace(mirror(-1e3, 500.0, -1.0), sensor_radius=-250.0), inf, 0.01)


REGIMES = (
    *(depth_cases, focal_plane_cases),
    *(field_cases, aperture_cases, wavelength_cases),
    radius_cases,
    thickness_cases,
    index_step_cases,
    many_surface_cases,
    afocal_cases,
    stop_cases,
    telecentric_cases,
    cemented_cases,
    index_space_cases,
    virtual_cases,
    scaling_cases,
    shape_cases,
    mirror_cases,
    curved_sensor_cases,
)


@cache
def cases_of(regime) -> tuple[Case, ...]:
    return tuple(regime())
