"""Zemax keywords that describe no lens, why leaving each out does no harm, and surface types refused by name."""

from p2sf.lensfile.report import Notebook, note_vignetting

REFUSED_TYPES = {
    "TOROIDAL": "a toroid that is not round",
    "BICONICX": "a surface that is not round",
    "BICONICZ": "a surface that is not round",
    "IRREGULA": "a surface that is not round",
    "DGRATING": "a grating that diffracts",
    "BINARY_1": "a diffractive surface",
    "BINARY_2": "a diffractive surface",
    "BINARY_3": "a diffractive surface",
    "PARAXIAL": "an ideal lens without a prescription",
    "PARAX_XY": "an ideal lens without a prescription",
    "NONSEQCO": "a non-sequential part",
    "BLACKBOX": "a black box that hides its surfaces",
    "BLCKBOX1": "a black box that hides its surfaces",
    "ODDASPHE": "an asphere with odd powers",
    "QED_TYPE": "an asphere in Forbes's polynomials",
    "XOSPHERE": "an extended odd asphere",
    "XASPHERE": "an extended asphere",
    "FRESNELS": "a Fresnel surface",
    "GRINSUR1": "a gradient index",
    "ALTERNAT": "the root of the sphere on its other side",
}

HARMLESS = {
    "drawing and editor settings": "MIRR HIDE SLAB PICB BLNK LANG PUSH SDMA OMMA MEMA OEMA DRAW CBOR COLR ECON",
    "tolerances and merit function": "TOL TOLE MOFF DMFS OPDX EFLY EFFL REAY REAX TRAC MNCA MNEA MNCG MNEG MXCA MXCG "
    "TCMM PMAG TOTR TCED RGLA WFNO GLCB ACOS ISNA DBDT",
    "coatings, polarisation, scatter": "COAT COFN POLS FIMP FLAP PFIL GFAC",
    "computing settings": "VERS GSTD NSCD RAIM ROPD POPS PUPD CONF HYPR RCMF ENVD GLRS XDAT YDAT SCBD AUTH NOTE",
    "variables, pickups and solves, whose stored values are read": "VCON VDSZ VPAR PPAR PKUP PZUP MAZH EDGE VCUR SOLV",
    "weights of fields and wavelengths": "FWGN FWGT WWGT WWGN WAVN",
}
REASON = {keyword: reason for reason, keywords in HARMLESS.items() for keyword in keywords.split()}
VIGNETTING = ("VDXN", "VDYN", "VCXN", "VCYN", "VANN", "ZVDX", "ZVDY", "ZVCX", "ZVCY", "ZVAN")
RIMS = ("SQAP", "RECA", "ELAP", "SPID", "UDAD", "USAP")


def note(notes: Notebook, words: list[str], surface: int | None, line: int) -> None:
    """Note a keyword that is not read: harmless ones once per reason, rims and unknown ones by name."""
    keyword = words[0].upper()
    if keyword in REASON:
        notes.add("ignored", REASON[keyword])
    elif keyword in VIGNETTING:
        note_vignetting(notes, words[1:])
    elif keyword in RIMS:
        notes.add("caution", f"its rim ({keyword}) is not round; the round semi-diameter stands in", surface, line)
    else:
        notes.add("ignored", f"{keyword[:20]}, which is not known to describe the lens", None, line)
