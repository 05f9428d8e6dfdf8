"""Rows that state a glass by its name and by nd and vd: the named glass if it is what the numbers say, else these."""

from p2sf.errors import GlassError
from p2sf.glass.media import Medium
from p2sf.lensfile.agf import nd_and_vd
from p2sf.lensfile.glass_lookup import GlassSources, Resolution, nd_of, resolve
from p2sf.lensfile.raw import RawGlass, RawSurface
from p2sf.lensfile.report import Notebook

SAME_ND, SAME_VD = 2e-5, 5e-3  # what melts and old data sheets of one glass differ by; vd as a share


def glass_of_row(
    named: RawGlass, written_nd: str, vd: float, surface: RawSurface, sources: GlassSources, notes: Notebook
) -> RawGlass:
    """Return the medium of a row with a name, nd in the digits that are written, and vd, 0 where there is none."""
    nd = float(written_nd)
    stated = RawGlass(model=(nd, vd), line=named.line) if vd else RawGlass(index=nd, line=named.line)
    if not named.name:
        return stated
    found = _exactly(named, sources)
    if found and _agrees(found.medium, written_nd, nd, vd):
        return RawGlass(medium=found.medium, line=named.line)
    name, values = named.name[:30], {"nd": nd, "vd": vd}
    if found:
        told = "glass {name} is {own:.5f} at d; nd {nd:g} and vd {vd:g} of the same row are taken"
        notes.add("caution", told, surface.number, named.line, name=name, own=nd_of(found.medium), **values)
    else:
        told = "glass {name} is not known by name; its nd {nd:g} and vd {vd:g} of the same row are taken"
        notes.add("read", told, surface.number, named.line, name=name, **values)
    return stated


def _agrees(medium: Medium, written: str, nd: float, vd: float) -> bool:
    """Return whether a glass has nd to the digits that are written, and vd, where there is one, to `SAME_VD`."""
    own_nd, own_vd = nd_and_vd(medium)
    rounding = 0.5 * 10.0 ** -len(written.partition(".")[2])
    return abs(own_nd - nd) <= max(rounding, SAME_ND) and (not vd or abs(own_vd / vd - 1) <= SAME_VD)


def _exactly(glass: RawGlass, sources: GlassSources) -> Resolution | None:
    try:
        return resolve(glass, GlassSources(sources.catalogues, sources.private, accept_substitutes=False))
    except GlassError:
        return None
