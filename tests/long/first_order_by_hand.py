"""Compare first-order data of every lens file in a folder with a paraxial trace of numbers read by another road.

``python -m tests.long.first_order_by_hand FOLDER [CATALOGUE.agf …]`` reads curvatures, distances and r² terms of Zemax,
CODE V, OSLO and ray-optics files, and powers of ideal lenses, by patterns of its own, takes the indices from the lens
that the program read, and traces in 50 digits. Focal length and back focus have to agree to 1e-12, or it
exits with 1.
"""

import json
import re
import sys
from math import inf, pi
from pathlib import Path

from mpmath import mp, mpf

from p2sf.errors import P2SFError
from p2sf.lens.lens import Lens, indices
from p2sf.lensfile.importing import import_lens
from p2sf.lensfile.source_text import read_source
from p2sf.paraxial.first_order import cardinal_points
from tests.support.rays.paraxial_by_hand import first_order

AGREEMENT = 1e-12
mp.dps = 50
Row = tuple[mpf, mpf, mpf]  # curvature, thickness and the power of an ideal lens in the file's unit
Rows = list[Row]  # object and image left out
UNITS = {"MM": "1", "M": "1", "CM": "10", "C": "10", "IN": "25.4", "I": "25.4", "INCH": "25.4"}


def zemax(text: str) -> Rows:
    blocks = re.split(r"(?m)^SURF \d+\s*$", text)[1:]
    rows = []
    for block in blocks:
        curvature = mpf(re.search(r"\bCURV (\S+)", block)[1])
        square = re.search(r"TYPE EVENASPH.*?\bPARM 1 (\S+)", block, re.S)
        thickness = re.search(r"\bDISZ (\S+)", block)[1]
        plain = mpf(0) if "INF" in thickness.upper() else mpf(thickness)
        ideal = re.search(r"TYPE PARAXIAL.*?\bPARM 1 (\S+)", block, re.S)
        power = 1 / mpf(ideal[1]) if ideal else mpf(0)
        rows.append((curvature + (2 * mpf(square[1]) if square else 0) + forbes(block), plain, power))
    return rows[1:-1]


def forbes(block: str) -> mpf:
    """Return what Qbfs adds to the curvature at the vertex, 2Σ aₘQₘ(0)/R²."""
    numbers = [mpf(x) for x in re.findall(r"\bXDAT \d+ (\S+)", block)]
    if "TYPE QED_TYPE" not in block or numbers[0]:
        return mpf(0)
    terms = numbers[3 : 3 + int(numbers[1])]
    return 2 * sum(a * q for a, q in zip(terms, at_vertex(len(terms)), strict=True)) / numbers[2] ** 2


def at_vertex(count: int) -> list[mpf]:
    """Return Qₘ(0) of Qbfs: the slopes of u²(1 − u²)Qₘ(u²) are orthonormal with the weight 2/π√(1 − u²) (Forbes 2007).

    By Gram and Schmidt from powers of u², whose moments are (2j − 1)!!/(2j)!!; Qₘ(0) is positive.
    """
    moment = [mpf(1)]
    for j in range(1, 2 * count + 4):
        moment.append(moment[-1] * (2 * j - 1) / (2 * j))

    def product(p: list[mpf], q: list[mpf]) -> mpf:
        slopes = [(2 * k + 2, -(2 * k + 4)) for k in range(count)]
        parts = (
            (a * b * s * t, k + i + other + j + 1)
            for k, a in enumerate(p)
            for other, b in enumerate(q)
            for i, s in enumerate(slopes[k])
            for j, t in enumerate(slopes[other])
        )
        return sum(value * moment[power] for value, power in parts)

    found: list[list[mpf]] = []
    for m in range(count):
        new = [mpf(k == m) for k in range(count)]
        for old in found:
            share = product(new, old)
            new = [a - share * b for a, b in zip(new, old, strict=True)]
        length = mp.sqrt(product(new, new))
        found.append([a / length for a in new])
    return [abs(row[0]) for row in found]


def codev(text: str) -> Rows:
    text = re.sub(r"&\s*\n", " ", re.sub(r"!.*", "", text))
    stated = re.search(r"(?im)\bRDM\b[ \t]*(\w?)", text)
    lines = re.findall(r"(?im)(?:^|;)\s*S(O|I|\d*)[ \t]+(\S+)[ \t]+(\S+)", text)
    radii = stated and stated[1].upper() != "N"
    values = [(kind.upper(), mpf(a), b) for kind, a, b in lines]
    if not stated:
        radii = any(abs(a) > 10 for kind, a, _ in values if kind != "O")
    rows = [(1 / a if radii and a else a, mpf(b), mpf(0)) for kind, a, b in values if kind not in ("O", "I")]
    defocus = next((mpf(b) for kind, _, b in values if kind == "I"), mpf(0))
    return [*rows[:-1], (rows[-1][0], rows[-1][1] + defocus, mpf(0))]


def oslo(text: str) -> Rows:
    rows = []
    for block in re.split(r"(?m)^NXT\b.*$", text):
        radius, curvature, gap = (re.search(rf"(?m)^{key}\s+(\S+)", block) for key in ("RD", "CV", "TH"))
        bent = 1 / mpf(radius[1]) if radius and mpf(radius[1]) else mpf(curvature[1]) if curvature else mpf(0)
        rows.append((bent, mpf(gap[1]) if gap else mpf(0), mpf(0)))
    return rows[1:-1]


def ray_optics(text: str) -> Rows:
    model = json.loads(text)["optical_model"]["attributes"]
    sequence = model["seq_model"]["attributes"]
    rows = []
    for interface, gap in zip(sequence["ifcs"][1:-1], sequence["gaps"][1:], strict=True):
        values, thickness = interface["attributes"], mpf(gap["attributes"]["thi"])
        if "_power" in values:
            rows.append((mpf(0), thickness, mpf(values["_power"])))
        else:
            rows.append((mpf(model["profile_dict"][str(values["profile_id"])]["attributes"]["cv"]), thickness, mpf(0)))
    return rows


def phase_powers(lens: Lens) -> list[mpf]:
    """Return what diffractive surfaces add to the power, −2A₁λ/2π per radius squared, 1/mm."""
    wave = lens.reference_wavelength_um / 1000
    phases = [(s.diffraction.coefficients[0], s.diffraction) if s.diffraction else (0.0, None) for s in lens.surfaces]
    return [-mpf(first) * d.order * wave / pi / d.normalisation_mm**2 if d else mpf(0) for first, d in phases]


PARSERS = {".zmx": zemax, ".seq": codev, ".len": oslo, ".roa": ray_optics}


def unit_of(path: Path, text: str) -> mpf:
    found = re.search(r"(?im)^\s*UNIT\s+(\w+)" if path.suffix.lower() == ".zmx" else r"(?im)\bDIM\s+(\w+)", text)
    return mpf(UNITS[found[1].upper()]) if found and found[1].upper() in UNITS else mpf(1)


def compared(path: Path, catalogues: list[Path]) -> tuple[bool, str]:
    """Return whether a file agrees, and a line about it."""
    try:
        lens = import_lens(path, True, catalogues).lens
    except P2SFError:
        return True, "refused"
    text = read_source(path).text
    unit = unit_of(path, text)
    rows = [(c / unit, t * unit, p / unit) for c, t, p in PARSERS[path.suffix.lower()](text)]
    wave = lens.reference_wavelength_um
    index = [float(n) for n in indices(lens, wave)]
    if len(rows) != len(lens.surfaces):
        return False, f"{len(rows)} surfaces by hand, {len(lens.surfaces)} by the program"
    bent, gaps, powers = zip(*rows, strict=True)
    by_hand = first_order(bent, gaps, index, [p + more for p, more in zip(powers, phase_powers(lens), strict=True)])
    points = cardinal_points(lens, wave)
    found = float(points.effective_focal_length), float(points.back_focal_distance)
    pairs = [(a, b) for a, b in zip(found, by_hand, strict=True) if not a == b == inf]
    worst = max((abs(a - b) / max(abs(b), 1e-3 * abs(by_hand[0])) for a, b in pairs), default=0.0)
    return worst < AGREEMENT, f"f = {found[0]:.15g} mm, back focus {found[1]:.15g} mm, off by {worst:.1e}"


if __name__ == "__main__":
    folder, *catalogues = map(Path, sys.argv[1:])
    paths = sorted(path for path in folder.rglob("*") if path.suffix.lower() in PARSERS)
    results = [(path, *compared(path, catalogues)) for path in paths]
    for path, good, line in results:
        print("ok  " if good else "FAIL", path.relative_to(folder), line)
    print(f"{sum(line != 'refused' for _, _, line in results)} of {len(results)} read")
    sys.exit(not all(good for _, good, _ in results))
