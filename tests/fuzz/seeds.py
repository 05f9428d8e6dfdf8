"""What the fuzzing starts from: every sample file of the tests, a database, and ordinary command lines."""

from functools import cache
from io import BytesIO
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import tifffile
from PIL import Image

from p2sf.database.build import build_database
from p2sf.database.files.npz import database_bytes
from p2sf.database.files.packing import MARK
from p2sf.database.files.sealed import seal
from p2sf.database.space import Space
from p2sf.io.photo_files import write_photo
from p2sf.io.png_text import with_text
from p2sf.io.psf_files import write_psf
from p2sf.lensfile.library import find_lens, lenses_folder
from p2sf.lensfile.toml.lens import lens_to_toml
from p2sf.psf.seidel import seidel_psf
from p2sf_explorer.files.embedded_state import KEYWORD
from p2sf_explorer.lessons.lesson import lesson_files
from p2sf_explorer.state.link import link
from p2sf_explorer.state.state import State, change
from p2sf_explorer.state.state_files import state_to_json
from tests.fuzz.targets import ENDINGS, PSF_ENDINGS, good_database
from tests.support.lenses.lens_files import FILES, FOLDER
from tests.support.waves import waves

LINES = (
    b"\x00\x00",
    b"\x01\x01\n\x001000\n\x015",
    b"\x02\x02\n\x00300\n\x0915\n\x0a0.5\n\x0cmdft",
    b"\x01\x00\n\x00inf\n\x0310\n\x04656.2725\n\x052000\n\x06-20\n\x078",
    b"\x02\x03\n\x0916\n\x0bseidel\n\x0cfft\n\x08auto",
)


SCENE = b"""tolerance = 0.1
measure = "r2"
f_number = 5.6
[sensor]
rows = 40
columns = 60
pixel_um = 6.0
centre_mm = [1.0, 2.0]
[depth]
near_mm = 800.0
far_mm = inf
[[channel]]
name = "green"
wavelengths_nm = [520.0, 550.0]
weights = [1.0, 2.0]
"""


def seeds(target: str) -> list[bytes]:
    """Return the first inputs of a target."""
    tomls = [path.read_bytes() for path in sorted(lenses_folder().glob("*.toml"))]
    if target == "toml":
        return tomls
    if target == "lens_file":
        files = [(FOLDER / name).read_bytes() for name in FILES]
        endings = [bytes([ENDINGS.index("." + name.rsplit(".", 1)[1])]) for name in FILES]
        return [*(a + b for a, b in zip(endings, files, strict=True)), *(b"\x00" + x for x in tomls[:3])]
    if target == "glass_catalogue":
        return [(FOLDER / "own.agf").read_bytes()]
    if target == "database":
        lens = find_lens("singlet_f6")
        raw = database_bytes(build_database(lens, Space((300.0,), (0.0,), (0.5, 0.6)), "table1"), lens)
        plain = seal({MARK: np.array("{}"), "series": np.zeros((2, 3))})
        head = str(good_database()[MARK]).encode()
        return [b"\x00" + raw, b"\x01" + raw, b"\x01" + plain, b"\x02" + head]
    more = {"psf_file": psf_files, "picture": pictures, "scene": scenes, "state": states, "lesson": lessons}
    return more[target]() if target in more else list(LINES)


@cache
def psf_files() -> list[bytes]:
    """Return one PSF in every ending that is read, and a picture with a state in it."""
    psf, found, picture = seidel_psf(waves(w40=0.5), 8, 1.0), [], BytesIO()
    with TemporaryDirectory() as folder:
        for number, ending in enumerate(PSF_ENDINGS):
            path = write_psf(psf, Path(folder) / f"psf{ending}", {"state": "{}"})
            found.append(bytes([number]) + path.read_bytes())
    Image.new("L", (8, 8)).save(picture, "PNG")
    return [*found, b"\x00" + with_text(picture.getvalue(), KEYWORD, "{}")]


@cache
def pictures() -> list[bytes]:
    """Return one picture in every depth and ending, with three colours and with one, and a packed TIFF."""
    values, found = np.linspace(0, 1, 8 * 9 * 3, dtype=np.float32).reshape(8, 9, 3), []
    with TemporaryDirectory() as folder:
        for ending, depth in ((".png", "8"), (".png", "16"), (".tif", "8"), (".tif", "16"), (".tif", "float")):
            for channels in (1, 3):
                path = write_photo(Path(folder) / f"p{ending}", values[..., :channels], depth=depth)
                found.append(path.read_bytes())
    packed = BytesIO()
    tifffile.imwrite(packed, (255 * values).astype(np.uint8), rowsperstrip=2, compression="zlib", predictor=True)
    return [*found, packed.getvalue()]


def scenes() -> list[bytes]:
    return [SCENE]


def states() -> list[bytes]:
    edited = change(State(), field_deg=3.0, lens_text=lens_to_toml(find_lens("singlet_f6")), windows=("mtf",))
    pinned = change(State(), pinned=edited)
    saved = [b"\1" + state_to_json(state).encode() for state in (State(), edited, pinned)]
    return saved + [b"\0" + link(state).encode() for state in (State(), edited, pinned)]


def lessons() -> list[bytes]:
    return [path.read_bytes() for path in lesson_files()]
