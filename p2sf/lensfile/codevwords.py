"""CODE V commands that describe no lens, why leaving each out does no harm, and commands refused by surface."""

from p2sf.lensfile.report import Notebook, note_vignetting

TILTS = "is tilted or decentred"
SHAPES = "has a shape that is not a sphere, a conic or an even asphere"
REFUSED = {
    **dict.fromkeys("XDE YDE ZDE ADE BDE CDE XOD YOD ZOD GLB".split(), TILTS),
    **dict.fromkeys("DIF GRT HOE HOR HCO HX1 HWL GRO GRS".split(), "diffracts"),
    **dict.fromkeys("XTO YTO AAS CYL SPS XYP ZRN RDX CUX UDS ODD ANA BIC SPL".split(), SHAPES),
    **dict.fromkeys("GRN GIR URN".split(), "is followed by a gradient index"),
    **dict.fromkeys("NSS NSE ENT EXI".split(), "begins a non-sequential part"),
    **dict.fromkeys("CUF FRE".split(), "is a Fresnel surface"),
    **dict.fromkeys("MOD LMO".split(), "is a lens module that hides its surfaces"),
    **dict.fromkeys("INS".split(), "reads another file, which is not at hand"),
}

HARMLESS = {
    "control codes of the optimiser": "CCY THC KC AC BC CC DC EC FC GC HC GLC CUM THM CCX DEL CCF",
    "solves and pickups, whose stored values are read": "PIM PIK SOL UMY CUS RED",
    "weights": "WTW WTF WTA",
    "edge and rectangle rims, obscurations in other shapes": "REX REY ELX ELY ADX ADY ARO",
    "titles, sessions and computing settings": "LEN INI TEM PRE GO DER CLS VER OUT CON ASP SPH POL CA APE ROT REV DAR "
    "BEN PIV RET CMT WID AFI AFC RFO RSI PFR PTP POR HCT HCC",
}
REASON = {name: reason for reason, names in HARMLESS.items() for name in names.split()}


VIGNETTING = ("VUY", "VLY", "VUX", "VLX", "SET")


def note(notes: Notebook, name: str, words: tuple[str, ...], surface: int | None, line: int) -> None:
    """Note a command that is not read: harmless ones once per reason, unknown ones by name."""
    if name in VIGNETTING:
        note_vignetting(notes, words)
    elif name in REASON:
        notes.add("ignored", REASON[name])
    else:
        notes.add("ignored", f"{name[:20]}, which is not known to describe the lens", surface, line)
