"""What the fuzzing starts from: every sample file of the tests, a database, and ordinary command lines."""

from functools import cache
from io import BytesIO
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from PIL import Image

from app.embedded import with_state
from p2sf.database import Space, build_database
from p2sf.databasefile.npz import MARK, database_bytes
from p2sf.databasefile.sealed import sealed
from p2sf.export import write_psf
from p2sf.library import find_lens, lenses_folder
from p2sf.psf import seidel_psf
from tests.fuzz.targets import ENDINGS, PSF_ENDINGS, good_database
from tests.imports import FILES, FOLDER
from tests.waves import waves

LINES = (
    b"\x00\x00",
    b"\x01\x01\n\x001000\n\x015",
    b"\x02\x02\n\x00300\n\x0915\n\x0a0.5\n\x0cmdft",
    b"\x01\x00\n\x00inf\n\x0310\n\x04656.2725\n\x052000\n\x06-20\n\x078",
    b"\x02\x03\n\x0916\n\x0bseidel\n\x0cfft\n\x08auto",
)


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
        plain = sealed({MARK: np.array("{}"), "series": np.zeros((2, 3))})
        head = str(good_database()[MARK]).encode()
        return [b"\x00" + raw, b"\x01" + raw, b"\x01" + plain, b"\x02" + head]
    return psf_files() if target == "psf_file" else list(LINES)


@cache
def psf_files() -> list[bytes]:
    """Return one PSF in every ending that is read, and a picture with a state in it."""
    psf, found, picture = seidel_psf(waves(w40=0.5), 8, 1.0), [], BytesIO()
    with TemporaryDirectory() as folder:
        for number, ending in enumerate(PSF_ENDINGS):
            path = write_psf(psf, Path(folder) / f"psf{ending}", {"state": "{}"})
            found.append(bytes([number]) + path.read_bytes())
    Image.new("L", (8, 8)).save(picture, "PNG")
    return [*found, b"\x00" + with_state(picture.getvalue(), "{}")]
