"""Read every lens file of a folder twice, by the program and by a reader and a tracer written for this comparison.

``python -m tests.long.public_lens_files FOLDER`` prints a verdict for every .zmx, .seq and .roa file in it: right, the
reason for which it is refused, or *wrong* with what differs. Compared are the number of surfaces, the focal length, the
back focal distance and the entrance pupil at the reference wavelength, that wavelength, the fields, the stop, and five
real rays. The reader here takes the simplest road through each format, a line at a time, and stops at what it does not
know (tilts, freeforms, gratings …): such a file counts as *not compared*. Only indices are the program's own; these are
compared with the makers' catalogues by `tests.long.glass_catalogues`. Exit code 1 where anything is wrong.
"""

import json
import re
import sys
from collections import Counter
from dataclasses import dataclass, field
from math import hypot, inf, isfinite, nan, radians, sqrt, tan
from pathlib import Path

import numpy as np

from p2sf.errors import P2SFError
from p2sf.lens.lens import Lens, indices
from p2sf.lensfile.importing import import_lens
from p2sf.paraxial.first_order import cardinal_points
from p2sf.paraxial.pupils import pupils
from p2sf.raytrace.trace import trace

SAME = 1e-9  # of lengths, as a share; rays are some twenty refractions of 1e-16
UNITS = {"MM": 1.0, "M": 1.0, "CM": 10.0, "C": 10.0, "IN": 25.4, "I": 25.4}


class UnknownError(Exception):
    """What this simple reader does not follow."""


@dataclass
class Plain:
    """A lens as rows of curvature, thickness, conic constant and terms by power; mm, µm, degrees or heights."""

    rows: list[dict] = field(default_factory=list)
    stop: int | None = None
    fields: list[tuple[float, float]] = field(default_factory=list)
    angles: bool = True
    wave_um: float | None = None
    object_mm: float = inf
    unit: float = 1.0


def plain_of(path: Path) -> Plain:
    text = path.read_bytes()
    code = "utf-16" if text[:2] in (b"\xff\xfe", b"\xfe\xff") else "latin-1"
    readers = {".zmx": zemax, ".seq": codev, ".roa": ray_optics}
    return readers[path.suffix.lower()](text.decode(code))


def row(**values) -> dict:
    return {"c": 0.0, "t": 0.0, "k": 0.0, "terms": {}, "mirror": False} | values


ZEMAX_UNKNOWN = "MNUM SCBD OBDC SQAP XDAT RAIM_ GFAC_".split()


def zemax(text: str) -> Plain:
    found, rows, waves, primary, y, x, count, angle = Plain(), [], [], 0, [], [], 0, True
    for line in text.splitlines():
        words = line.split()
        if not words:
            continue
        key, rest = words[0], words[1:]
        if key in ZEMAX_UNKNOWN and (key != "MNUM" or rest[0] != "1"):
            raise UnknownError(key)
        if key == "UNIT":
            found.unit = UNITS[rest[0]]
        elif key == "SURF":
            rows.append(row(kind="STANDARD"))
        elif key == "TYPE":
            rows[-1]["kind"] = rest[0]
        elif key == "CURV":
            rows[-1]["c"] = float(rest[0])
        elif key == "DISZ":
            rows[-1]["t"] = inf if rest[0].startswith("INF") else float(rest[0])
        elif key == "CONI":
            rows[-1]["k"] = float(rest[0])
        elif key == "PARM" and float(rest[1]):
            rows[-1]["terms"][int(rest[0])] = float(rest[1])
        elif key == "STOP":
            found.stop = len(rows) - 1
        elif key == "GLAS":
            rows[-1]["mirror"] = rest[0] == "MIRROR"
        elif key == "WAVM":
            waves.append(float(rest[1]))
        elif key == "PWAV":
            primary = int(rest[0]) - 1
        elif key == "FTYP":
            angle, count = rest[0] == "0", int(rest[2])
        elif key in ("XFLN", "YFLN"):
            (x if key[0] == "X" else y)[:] = map(float, rest)
    for each in rows[1:-1]:
        step = {"STANDARD": 0, "EVENASPH": 2, "ODDASPHE": 1}.get(each["kind"])
        if step is None:
            raise UnknownError(each["kind"])
        each["terms"] = {step * place: value for place, value in each["terms"].items() if step and place}
    found.rows, found.object_mm, found.angles = rows[1:-1], rows[0]["t"] * found.unit, angle
    if rows[-1]["c"]:
        raise UnknownError("curved image")
    found.wave_um = waves[primary] if waves else None
    count = count or max(len(x), len(y))
    found.fields = list(zip([*x, *[0.0] * count][:count], [*y, *[0.0] * count][:count], strict=True))
    return found


CODEV_UNKNOWN = "XDE YDE ZDE ADE BDE CDE DAR BEN REV SPS DIF GRT ZOO XTO YTO CYL XYP HOE GRN UMY".split()
ORDERS = {letter: 4 + 2 * place for place, letter in enumerate("ABCDEFGHJ")}


def codev(text: str) -> Plain:
    found, rows, waves, reference, x, y, radii = Plain(), [], [], None, [], [], False
    lines = re.sub(r"&\s*\n", " ", re.sub(r"![^\n]*", "", text))
    for part in re.split(r"[;\n]", lines):
        words = re.findall(r"'[^']*'|\"[^\"]*\"|\S+", part)
        if not words:
            continue
        key, rest = words[0].upper(), words[1:]
        if key in CODEV_UNKNOWN or any(word.upper() in CODEV_UNKNOWN for word in rest):
            raise UnknownError(key)
        if key == "RDM":
            radii = not rest or rest[0].upper() == "Y"
        elif key == "DIM":
            found.unit = UNITS[rest[0].upper()]
        elif re.fullmatch(r"S[OI]?|S\d+", key) and rest:
            number, glass = float(rest[0]), (rest[2:] or [""])[0].upper()
            curvature = (1 / number if number else 0.0) if radii else number
            rows.append(row(c=curvature, t=float(rest[1]) if len(rest) > 1 else 0.0, mirror=glass == "REFL", name=key))
        elif key == "STO" and not rest:
            found.stop = len(rows) - 1
        elif key == "STO":
            raise UnknownError("STO S…")
        elif key == "K":
            rows[-1]["k"] = float(rest[0])
        elif key in ORDERS and rest and rows:
            rows[-1]["terms"][ORDERS[key]] = float(rest[0])
        elif key == "WL":
            waves = [float(word) / 1000 for word in rest]
        elif key == "REF":
            reference = int(rest[0]) - 1
        elif key in ("XAN", "XOB", "XIM", "XRI"):
            x = [float(word) for word in rest]
        elif key in ("YAN", "YOB", "YIM", "YRI"):
            y, found.angles = [float(word) for word in rest], key == "YAN"
    inside = rows[1:-1] if rows[-1]["name"] == "SI" else rows[1:]
    if rows[-1]["name"] == "SI":
        inside[-1]["t"] += rows[-1]["t"]  # defocus
    found.rows, found.object_mm = inside, rows[0]["t"] * found.unit
    found.wave_um = waves[reference if reference is not None else len(waves) // 2] if waves else None
    count = max(len(x), len(y))
    found.fields = list(zip([*x, *[0.0] * count][:count], [*y, *[0.0] * count][:count], strict=True))
    return found


def ray_optics(text: str) -> Plain:
    def inside(value):
        return value.get("attributes", value)

    model = inside(json.loads(text)["optical_model"])
    sequence, optics = inside(model["seq_model"]), inside(model["optical_spec"])
    found = Plain(stop=sequence["stop_surface"])
    for interface, gap in list(zip(sequence["ifcs"], [*sequence["gaps"], None], strict=False))[1:-1]:
        values = inside(interface)
        kind = interface["__instance_type__"][1]
        diffracts = values.get("phase_element") and kind == "Surface"
        if values.get("decenter") or diffracts or kind not in ("Surface", "ThinLens"):
            raise UnknownError(kind)
        if kind == "ThinLens":
            found.rows.append(row(t=inside(gap)["thi"], power=values["_power"]))
            continue
        profile = values.get("profile") or model["profile_dict"][str(values["profile_id"])]
        shape, kind = inside(profile), profile["__instance_type__"][1]
        step = {"Spherical": 0, "Conic": 0, "EvenPolynomial": 2, "RadialPolynomial": 1}[kind]
        conic = shape["ec"] - 1 if "ec" in shape else shape.get("cc", 0.0)
        terms = {step * place: value for place, value in enumerate(shape.get("coefs", ()), 1) if value and step}
        mirror = values.get("interact_mode") == "reflect"
        found.rows.append(row(c=shape["cv"], t=inside(gap)["thi"], k=conic, terms=terms, mirror=mirror))
    found.object_mm = inside(sequence["gaps"][0])["thi"]
    light, view = inside(optics["spectral_region"]), inside(optics["field_of_view"])
    found.wave_um = light["wavelengths"][light["reference_wvl"]] / 1000
    *_, side, name = view["key"] if "key" in view else view["_key"]
    found.angles = (side, name) == ("object", "angle")
    scale = view["value"] if view.get("is_relative") else 1.0
    found.fields = [(scale * inside(f)["x"], scale * inside(f)["y"]) for f in view["fields"]]
    return found


def signed(plain: Plain, lens: Lens) -> list[float]:
    """Return the program's indices, negative after an odd number of reflections."""
    values, signs = indices(lens, lens.reference_wavelength_um), [1]
    for each in plain.rows:
        signs.append(-signs[-1] if each["mirror"] else signs[-1])
    return [float(abs(value)) * sign for value, sign in zip(values, signs, strict=True)]


def first_order(plain: Plain, index: list[float]) -> tuple[float, float, float]:
    """Return focal length −1/C, back focal distance and entrance pupil by two rays traced by y and u."""
    results = []
    for y, u in ((1.0, 0.0), (0.0, 1.0)):
        at_stop = nan
        for number, each in enumerate(plain.rows, 1):
            before, behind = index[number - 1], index[number]
            c = each["c"] / plain.unit + 2 * each["terms"].get(2, 0.0) / plain.unit
            u = (before * u - y * ((behind - before) * c + each.get("power", 0.0))) / behind
            if number == plain.stop:
                at_stop = y
            last = y
            y += each["t"] * plain.unit * u
        results.append((at_stop, last, u))
    (stop_a, last_a, u_a), (stop_b, _, _) = results
    efl = -1 / (index[-1] * u_a) if u_a else inf
    return efl, -last_a / u_a if u_a else inf, stop_b / stop_a if stop_a else inf


def sag_and_slope(each: dict, unit: float, r2: float) -> tuple[float, float]:
    """Return the sag, and its derivative by r divided by r, of one surface in mm."""
    c, k = each["c"] / unit, each["k"]
    root = sqrt(1 - (1 + k) * c * c * r2)
    sag, slope = c * r2 / (1 + root), c / root
    r = sqrt(r2)
    for power, value in each["terms"].items():
        a = value * unit ** (1 - power)
        sag += a * r**power
        slope += a * power * r ** (power - 2) if r else (2 * a if power == 2 else 0.0)
    return sag, slope


def real_ray(plain: Plain, index: list[float], origin: list[float], direction: list[float]) -> tuple[float, float]:
    """Return where a ray meets the sensor's plane: Newton's method on each surface, and Snell's law in vectors."""
    p, d = np.array(origin), np.array(direction) / hypot(*direction)
    for number, each in enumerate(plain.rows, 1):
        s = -p[2] / d[2]
        for _ in range(60):
            q = p + s * d
            sag, slope = sag_and_slope(each, plain.unit, q[0] ** 2 + q[1] ** 2)
            normal = np.array([-q[0] * slope, -q[1] * slope, 1.0])
            step = (q[2] - sag) / (normal @ d)
            s -= step
            if abs(step) < 1e-14:
                break
        p = p + s * d
        normal /= hypot(*normal)
        if each["mirror"]:
            d = d - 2 * (d @ normal) * normal
        else:
            ratio = abs(index[number - 1] / index[number])
            normal = normal if d @ normal > 0 else -normal
            cosine = d @ normal
            root = 1 - ratio**2 * (1 - cosine**2)
            if root < 0:
                return nan, nan
            d = ratio * d + (sqrt(root) - ratio * cosine) * normal
        p[2] -= each["t"] * plain.unit
    p = p - p[2] / d[2] * d
    return float(p[0]), float(p[1])


def rays(lens: Lens, pupil_mm: float, half: float) -> list[tuple[list[float], list[float]]]:
    """Return five rays: two along the axis, three at the largest field that starts below 60°, through the pupil."""
    angles = [value for value in map(abs, lens.fields_deg) if value < 60]
    slope = tan(radians(max(angles, default=0.0)))
    far = pupil_mm if isfinite(pupil_mm) else 0.0
    points = [(0.0, 0.3, 0.0), (0.2, 0.6, 0.0), (0.0, 0.0, slope), (0.1, 0.5, slope), (0.2, -0.5, slope)]
    return [([x * half, y * half - far * up, 0.0], [0.0, up, 1.0]) for x, y, up in points]


def different(plain: Plain, lens: Lens) -> list[str]:
    """Return what differs between the two readings."""
    if len(plain.rows) != len(lens.surfaces):
        return [f"{len(lens.surfaces)} surfaces for {len(plain.rows)}"]
    wave, wrong = lens.reference_wavelength_um, []

    def compare(what: str, ours: float, theirs: float, scale: float = 1.0) -> None:
        if isfinite(theirs) and abs(theirs) < 1e9 and not abs(ours - theirs) <= SAME * max(scale, abs(theirs)):
            wrong.append(f"{what} {ours:.9g} for {theirs:.9g}")

    if plain.wave_um:
        compare("wavelength", wave, plain.wave_um)
    if plain.stop:
        compare("stop", float(lens.stop_surface or 0), plain.stop)
    index = signed(plain, lens)
    efl, back, pupil = first_order(plain, index)
    points = cardinal_points(lens, wave)
    compare("focal length", float(points.effective_focal_length), efl)
    compare("back focal distance", float(points.back_focal_distance), back)
    ours = float(pupils(lens, wave).entrance_from_first) if plain.stop else nan
    if plain.stop and isfinite(pupil):
        compare("entrance pupil", ours, pupil)
    if plain.angles:
        listed = list(zip(lens.fields_x_deg or [0.0] * len(lens.fields_deg), lens.fields_deg, strict=True))
        for stated in plain.fields:
            if not any(hypot(stated[0] - x, stated[1] - y) < 1e-9 for x, y in listed):
                wrong.append(f"field {stated} is not among {listed}")
    if any("power" in each for each in plain.rows):
        return wrong  # how an ideal lens bends real rays is a matter of definition
    rim = abs(float(pupils(lens, wave).entrance_diameter)) / 2 if plain.stop else 1.0
    for origin, direction in rays(lens, pupil, min(rim, 1e3) if isfinite(rim) else 1.0):
        theirs = real_ray(plain, index, origin, direction)
        found = trace(lens, [origin], [direction], wave).points[-1, 0, :2]
        for one, other in zip(found, theirs, strict=True):
            if isfinite(one) != isfinite(other):
                wrong.append(f"a ray ends at {one:g} for {other:g}")
            elif isfinite(other):
                compare("ray", float(one), other, 10.0)
    return wrong


def verdict(path: Path) -> tuple[str, str]:
    """Return right, wrong, refused or not compared, with the reason."""
    try:
        lens = import_lens(path).lens
    except P2SFError as refusal:
        return "refused", str(refusal.message).rpartition(f"{path}")[2][:150].lstrip(", ")
    try:
        plain = plain_of(path)
    except UnknownError as unknown:
        return "not compared", str(unknown)
    try:
        wrong = different(plain, lens)
    except ValueError as failure:  # a ray that misses a surface
        return "not compared", str(failure)
    return ("wrong", "; ".join(wrong[:3])) if wrong else ("right", "")


def main(folder: str) -> int:
    paths = sorted(path for path in Path(folder).rglob("*") if path.suffix.lower() in (".zmx", ".seq", ".roa"))
    rows = [(path, *verdict(path)) for path in paths]
    for path, what, why in rows:
        print(f"{what:13} {path.relative_to(folder)}  {why}")
    for ending in (".zmx", ".seq", ".roa"):
        print(ending, dict(Counter(what for path, what, _ in rows if path.suffix.lower() == ending)))
    return int(any(what == "wrong" for _, what, _ in rows))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
