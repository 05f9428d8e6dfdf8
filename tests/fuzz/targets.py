"""What hostile bytes are fed to. Each target takes bytes and may end in a `P2SFError` only.

A target returns "accepted" or "refused"; any other exception is a finding.
"""

import contextlib
import hashlib
import io
import tempfile
import warnings
from collections.abc import Callable
from functools import cache

import numpy as np

from p2sf.cli import main
from p2sf.database.build import build_database
from p2sf.database.files.npz import database_bytes, database_from_bytes
from p2sf.database.files.packing import MARK
from p2sf.database.files.sealed import DIGITS, SEAL, seal, unseal
from p2sf.database.space import Space
from p2sf.errors import P2SFError
from p2sf.io.photo_files import read_photo
from p2sf.lensfile.agf import read_agf_text
from p2sf.lensfile.glass_lookup import GlassSources
from p2sf.lensfile.importing import import_text
from p2sf.lensfile.library import find_lens
from p2sf.lensfile.source_text import source_of
from p2sf.lensfile.toml.lens import lens_to_toml, parse_toml
from p2sf.paraxial.first_order import cardinal_points
from p2sf.paraxial.pupils import pupils
from p2sf.paraxial.seidel import coefficients
from p2sf.psf.reading import read_psf
from p2sf.scene.files import read_scene
from p2sf.setting import Request, set_up
from p2sf_explorer.files.embedded_state import text_inside
from p2sf_explorer.lessons.lesson import parse_lesson
from p2sf_explorer.state.link import state_of_link
from p2sf_explorer.state.state_files import state_from_json, state_to_json

LAST = "last-input"  # the file with what a fuzzing process tried last, beside its folder of inputs
ENDINGS = (".toml", ".zmx", ".seq", ".csv", ".json", ".txt", ".dat", ".roa", ".len", ".fx")
OPTIONS = (
    "--depth-mm",
    "--field-deg",
    "--object-height-mm",
    "--image-height-mm",
    "--wavelength-nm",
    "--focus-mm",
    "--sensor-shift-um",
    "--f-number",
    "--stop",
    "--pixels",
    "--pixel-um",
    "--method",
    "--sampling",
)
LENSES = ("double_gauss_28", "eye_navarro", "relay", "plano_convex")
PSF_ENDINGS = (".npz", ".tiff", ".csv", ".fits")
COMMANDS = ("info", "coefficients", "psf")


def refused_or(work: Callable[[], None]) -> str:
    """Run the work; say whether it went through or ended in an error that a user can read."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # numpy's overflow notes on 1e308 mm are not the subject
            work()
    except P2SFError as failure:
        assert str(failure).strip(), "an error without a sentence"
        return "refused"
    return "accepted"


def lens_file(data: bytes) -> str:
    """Read the bytes as a lens file (the first byte picks the ending) and, if it is one, use and rewrite it."""
    ending = ENDINGS[data[0] % len(ENDINGS)] if data else ".toml"
    return refused_or(
        lambda: use(import_text(source_of(data[1:], f"hostile{ending}"), GlassSources((), {}, True)).lens)
    )


def toml(data: bytes) -> str:
    return refused_or(lambda: use(parse_toml(data.decode("utf-8", "replace"), "hostile.toml")))


def use(lens) -> None:
    """Ask a lens that was accepted for everything paraxial, and write it again."""
    assert parse_toml(lens_to_toml(lens), "again.toml") == lens
    wavelength = lens.reference_wavelength_um
    cardinal_points(lens, wavelength)
    pupils(lens, wavelength)
    setup = set_up(lens, Request(field_deg=lens.fields_deg[-1]))
    coefficients(setup.lens, setup.source.depth_mm, setup.source.field_slope, wavelength, setup.stop)


def glass_catalogue(data: bytes) -> str:
    return refused_or(lambda: read_agf_text(source_of(data, "hostile.agf")))


def database(data: bytes) -> str:
    """Read the bytes as a database; by the first byte as they are, or with a seal, or as the head of a good one.

    Anybody can compute a seal, and behind one a mutated archive is no longer one: hence the head by itself.
    """
    raw, kind = data[1:], data[0] % 3 if data else 0
    if kind == 1:
        raw = raw.removesuffix(raw[-DIGITS:]) + SEAL
        raw += hashlib.sha256(raw).hexdigest().encode()
    if kind == 2:
        raw = seal({**good_database(), MARK: np.array(raw.decode("utf-8", "replace"))})
    return refused_or(lambda: database_from_bytes(raw, "hostile.npz"))


@cache
def good_database() -> dict:
    """Return the arrays of a small database, its head among them."""
    lens = find_lens("singlet_f6")
    return unseal(
        database_bytes(build_database(lens, Space((300.0,), (0.0,), (0.5, 0.6)), "exact"), lens), MARK, "good"
    )


def psf_file(data: bytes) -> str:
    """Read the bytes as a PSF that was exported, the first byte picks the ending, and as a snapshot with a state."""
    ending = PSF_ENDINGS[data[0] % len(PSF_ENDINGS)] if data else ".npz"
    return refused_or(lambda: read_file(lambda path: (text_inside(path), read_psf(path)), data[1:], ending))


def picture(data: bytes) -> str:
    """Read the bytes as a picture to be imaged; its ending does not matter."""
    return refused_or(lambda: read_file(read_photo, data, ".png"))


def scene(data: bytes) -> str:
    return refused_or(lambda: read_file(read_scene, data, ".toml"))


def state(data: bytes) -> str:
    """Read the bytes as a saved state, with an even first byte as a link; what is accepted is written again."""
    text, is_saved = data[1:].decode("utf-8", "replace"), bool(data) and data[0] % 2 == 1

    def read() -> None:
        found = state_from_json(text) if is_saved else state_of_link(text)
        assert state_from_json(state_to_json(found)) == found

    return refused_or(read)


def lesson(data: bytes) -> str:
    return refused_or(lambda: parse_lesson(data.decode("utf-8", "replace"), "hostile", "hostile.md"))


def read_file(read: Callable, data: bytes, ending: str):
    with tempfile.NamedTemporaryFile(suffix=ending) as file:
        file.write(data)
        file.flush()
        return read(file.name)


def command_line(data: bytes) -> str:
    """Run a command with options made of the bytes; exit code 0 or 2 with one sentence, nothing else."""
    output, error = Stream(), Stream()
    with contextlib.redirect_stdout(output), contextlib.redirect_stderr(error), warnings.catch_warnings():
        warnings.simplefilter("ignore")
        code = main(arguments(data))
    if code == 0:
        return "accepted"
    sentences = [line for line in error.getvalue().splitlines() if not line.startswith("warning: ")]
    assert code == 2 and len(sentences) == 1, (code, error.getvalue())
    return "refused"


def arguments(data: bytes) -> list[str]:
    """Return a command line: two bytes pick command and lens, then lines of an option byte and its value."""
    head, *lines = data.split(b"\n")
    head += b"\0\0"
    words = [COMMANDS[head[0] % len(COMMANDS)], LENSES[head[1] % len(LENSES)]]
    for line in lines[:6]:
        if line:
            value = line[1:].decode("utf-8", "replace").replace("\0", "")
            words += [OPTIONS[line[0] % len(OPTIONS)], value]
    return words


class Stream(io.StringIO):
    """A captured stream that can be reconfigured, as a real one can."""

    def reconfigure(self, **_options) -> None:
        """Accept what the command line asks of its streams."""


TARGETS = {
    "lens_file": lens_file,
    "toml": toml,
    "glass_catalogue": glass_catalogue,
    "database": database,
    "psf_file": psf_file,
    "picture": picture,
    "scene": scene,
    "state": state,
    "lesson": lesson,
    "command_line": command_line,
}

# Reading takes no longer than 2 s; a command line may ask for a PSF of thousands of waves, which is work, not a hang.
SECONDS = {name: 20 if name == "command_line" else 2 for name in TARGETS}
