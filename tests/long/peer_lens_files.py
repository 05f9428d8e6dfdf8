"""Read the public .zmx and .seq files inside the ``rayoptics`` and ``KrakenOS`` wheels and compare with rayoptics.

``python -m tests.long.peer_lens_files``, with the extra ``.[peers]`` installed. Every file gets a verdict: read,
or refused with a reason. Where it is read, the focal length is compared twice: with each program's own
glass data, and with rayoptics's indices in this program's lens. The second has to agree to 1e-6; what the
first differs by more is then the difference in index, which is shown. Exit code 1 where a file that P2SF
should read is refused, or a focal length disagrees.
"""

import contextlib
import importlib.util
import io
import logging
import shutil
import sys
import tempfile
import warnings
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from p2sf.errors import GlassError, LensFileError
from p2sf.glass.media import ConstantIndex
from p2sf.lens.lens import Lens, indices
from p2sf.lensfile.importing import Import, import_lens
from p2sf.lensfile.library import find_lens, shipped_lenses
from p2sf.lensfile.writing import write_lens
from p2sf.paraxial.first_order import cardinal_points

AGREEMENT = 1e-6
# What a file holds that P2SF is right to refuse, in the words of the error.
RIGHT_REASONS = ("mirror", "tilted or decentred", "diffracts", "coordinate break", "QED_TYPE")


@dataclass(frozen=True)
class Row:
    """What became of one file; ``own`` and ``same`` are relative differences of EFL, ``index`` of n."""

    name: str
    verdict: str
    ok: bool
    efl: float | None = None
    own: float | None = None
    same: float | None = None
    index: float | None = None

    def __str__(self):
        numbers = ""
        if self.efl is not None:
            numbers = f" EFL {self.efl:.6f} mm, own glass {shown(self.own)}, same indices {shown(self.same)}"
            numbers += f", largest Δn {shown(self.index)}"
        return f"{'ok  ' if self.ok else 'FAIL'} {self.name}: {self.verdict}{numbers}"


def shown(value: float | None) -> str:
    return "–" if value is None else f"{value:.1e}"


def packages() -> tuple[Path, ...]:
    """Return the folders of rayoptics and KrakenOS without importing them."""
    return tuple(Path(importlib.util.find_spec(name).origin).parent for name in ("rayoptics", "KrakenOS"))


def lens_files() -> list[Path]:
    found = [path for folder in packages() for path in folder.rglob("*") if path.suffix.lower() in (".zmx", ".seq")]
    return sorted(found, key=lambda path: (path.suffix.lower(), path.name.lower()))


def read(path: Path) -> tuple[Import, str]:
    """Return a lens, by exact glasses, else by KrakenOS's catalogues, else with substitutes; and how."""
    catalogues = [packages()[1] / "Cat" / name for name in ("lightpath.agf", "rpo.agf", "SCHOTT.AGF")]
    try:
        return import_lens(path), "read"
    except LensFileError as failure:
        if not isinstance(failure.__cause__, GlassError):
            raise
    try:
        return import_lens(path, catalogues=catalogues), "refused without its glass catalogue; read with it"
    except LensFileError:
        return import_lens(path, accept_substitutes=True), "refused for its glass; read with accepted substitutes"


def row(path: Path) -> Row:
    try:
        found, how = read(path)
    except LensFileError as failure:
        reason = str(failure.message.values["message"])
        line = f"line {failure.line}: " if failure.line else ""
        return Row(path.name, f"refused, {line}{reason}", any(right in reason for right in RIGHT_REASONS))
    return compared(path, found.lens, how)


def compared(path: Path, lens: Lens, how: str) -> Row:
    """Return the row of a lens that was read, beside rayoptics at P2SF's reference wavelength."""
    wave = lens.reference_wavelength_um
    efl = focal_length(lens, wave)
    model = peer_model(path)
    theirs, their_n = peer_focal_length(model, wave), peer_indices(model, wave)
    if path.suffix.lower() == ".seq" and len(their_n) == len(lens.media) - 1:
        their_n = np.append(their_n, their_n[-1])  # without SI, rayoptics takes the last S for the image
    if len(their_n) != len(lens.media):
        return Row(path.name, f"{how}; rayoptics has {len(their_n)} media", False, efl)
    theirs = theirs / their_n[-1]  # rayoptics's focal length is −n'/C, this program's −1/C; n' is the eye's 1.336
    swapped = with_indices(lens, their_n)
    same = relative(focal_length(swapped, wave), theirs)
    index = float(np.abs(indices(lens, wave) - their_n).max())
    own = relative(efl, theirs)
    return Row(path.name, how, same <= AGREEMENT, efl, own, same, index)


def exported(name: str, folder: Path) -> Row:
    """Return the row of a shipped lens written as .zmx and read by rayoptics."""
    path = folder / f"{name}.zmx"
    try:
        write_lens(find_lens(name), path)
    except LensFileError as failure:
        return Row(path.name, f"not written: {failure}", "has no line in a Zemax file" in str(failure))
    return compared(path, find_lens(name), "written by P2SF, read by rayoptics")


def focal_length(lens: Lens, wavelength_um: float) -> float:
    return float(cardinal_points(lens, wavelength_um).effective_focal_length)


def relative(ours: float, theirs: float) -> float:
    if np.isinf(ours) and (np.isinf(theirs) or theirs == 0):
        return 0.0  # rayoptics writes 0 for the focal length of an afocal lens
    return abs(ours / theirs - 1)


def with_indices(lens: Lens, values: np.ndarray) -> Lens:
    media = [ConstantIndex(float(value)) for value in values]
    surfaces = tuple(replace(s, medium=m) for s, m in zip(lens.surfaces, media[1:], strict=True))
    return replace(lens, surfaces=surfaces, object_medium=media[0])


def peer_model(path: Path):
    """Return rayoptics's model of a file; its printing and log files are kept out of the way."""
    from rayoptics.codev import cmdproc
    from rayoptics.zemax import zmxread

    logging.disable(logging.CRITICAL)
    quiet = contextlib.redirect_stdout(io.StringIO())
    # In a folder of its own: beside the file it would load glass replacements from the network, and write some.
    with quiet, warnings.catch_warnings(), tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder):
        warnings.simplefilter("ignore")
        copy = Path(shutil.copy(path, folder))
        return (cmdproc.read_lens if path.suffix.lower() == ".seq" else zmxread.read_lens_file)(copy)[0]


def peer_focal_length(model, wavelength_um: float) -> float:
    """Return rayoptics's focal length in mm at a wavelength."""
    from rayoptics.parax.firstorder import compute_first_order

    sequence = model["seq_model"]
    model["optical_spec"]["wvls"].set_from_list([[wavelength_um * 1000, 1.0]])
    model["optical_spec"]["wvls"].reference_wvl = 0
    model.update_model()
    first_order = compute_first_order(model, sequence.stop_surface or 1, wavelength_um * 1000).fod
    return first_order.efl * model["system_spec"].nm_to_sys_units(1e6) ** -1


def peer_indices(model, wavelength_um: float) -> np.ndarray:
    gaps = model["seq_model"].gaps
    return np.array([gap.medium.rindex(wavelength_um * 1000) for gap in gaps])


if __name__ == "__main__":
    rows = [row(path) for path in lens_files()]
    with tempfile.TemporaryDirectory() as scratch:
        exports = [exported(name, Path(scratch)) for name in shipped_lenses()]
    print("\n".join(map(str, [*rows, *exports])))
    counts = {suffix: sum(r.name.lower().endswith(suffix) for r in rows) for suffix in (".zmx", ".seq")}
    print(counts, f"{sum(r.efl is not None for r in rows)} read, {sum(r.efl is None for r in rows)} refused")
    sys.exit(not all(r.ok for r in [*rows, *exports]))
