"""Write frames as an animated GIF, an MP4 or numbered PNG files, whole or not at all. No Qt in here."""

import errno
import os
import shutil
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from functools import partial
from itertools import chain
from pathlib import Path
from queue import Empty, Queue
from tempfile import TemporaryDirectory
from threading import Event
from typing import TYPE_CHECKING, Any, BinaryIO, TypeVar

from p2sf.errors import ExportError
from p2sf.files.reasons import FileRefusedError, reason
from p2sf.files.writing import check_own, check_place, write_beside
from p2sf.messages import Alternatives, Message

if TYPE_CHECKING:
    from PIL.Image import Image
    from PIL.PngImagePlugin import PngInfo

ENDINGS = (".gif", ".mp4", ".png")
EVEN = "pad=ceil(iw/2)*2:ceil(ih/2)*2"  # H.264 halves the resolution of colour, so a film has even sides
OWN_FRAME = b"P2SF Explorer"  # in the text chunk of every frame
CRF = "18"  # the quality at which H.264 shows no loss
WAITING = 3  # frames between the window and the writer
PATIENCE_S = 0.1
NO_ROOM = Message("there is no room for it in the folder of temporary files")
PathLike = str | os.PathLike[str]
T = TypeVar("T")


@dataclass(frozen=True)
class FilmFrame:
    """One picture: width, height, and rows of RGB bytes."""

    width: int
    height: int
    rgb: bytes


class FrameQueue:
    """The frames between the window and the writer, a few at a time."""

    def __init__(self) -> None:
        self._frames: Queue[FilmFrame | None] = Queue(WAITING)

    @property
    def full(self) -> bool:
        """Return whether the writer is behind the window."""
        return self._frames.full()

    def put(self, frame: FilmFrame | None) -> None:
        """Add a frame, None after the last; call only while not `full`."""
        self._frames.put_nowait(frame)

    def frames(self, cancelled: Event) -> Iterator[FilmFrame]:
        """Yield the frames as they come, until the last; ExportError once ``cancelled``."""
        while True:
            if cancelled.is_set():
                raise ExportError("the export was cancelled; nothing was written")
            try:
                frame = self._frames.get(timeout=PATIENCE_S)
            except Empty:
                continue
            if frame is None:
                return
            yield frame


def check_film(path: PathLike) -> None:
    """Raise ExportError where a film cannot be written: an unknown ending, no such folder, an MP4 without ffmpeg."""
    if Path(path).suffix.lower() not in ENDINGS:
        raise ExportError(
            '{path}: a film has no ending "{ending}"; choose {endings}',
            path=str(path),
            ending=Path(path).suffix,
            endings=Alternatives(ENDINGS),
        )
    check_place(path)
    if Path(path).suffix.lower() == ".mp4":
        _ffmpeg()


def _ffmpeg() -> Any:
    """Return imageio-ffmpeg, which brings ffmpeg with it; ExportError where it is not installed."""
    try:
        import imageio_ffmpeg

        imageio_ffmpeg.get_ffmpeg_exe()
    except (ImportError, RuntimeError) as error:
        raise ExportError(
            "MP4 films need imageio-ffmpeg, which is not installed; pip install 'p2sf[mp4]', or choose a GIF"
        ) from error
    return imageio_ffmpeg


def write_film(frames: Iterator[FilmFrame], path: PathLike, frame_ms: int) -> tuple[Path, ...]:
    """Write frames as a .gif, an .mp4 or numbered .png files, whole or not at all; return the paths. ExportError."""
    check_film(path)
    if Path(path).suffix.lower() == ".mp4":
        return (write_beside(path, lambda handle: _write_mp4(frames, handle, frame_ms)),)
    if Path(path).suffix.lower() == ".gif":
        return (write_beside(path, lambda handle: _write_gif(frames, handle, frame_ms)),)
    return _write_pngs(frames, Path(path))


def _picture(frame: FilmFrame) -> "Image":
    from PIL.Image import frombytes

    return frombytes("RGB", (frame.width, frame.height), frame.rgb)


def _first(found: Iterator[T]) -> T:
    """Return the first frame; ExportError where there is none."""
    for frame in found:
        return frame
    raise ExportError("there is no frame to write; choose a longer sweep")


def _write_gif(frames: Iterator[FilmFrame], handle: BinaryIO, frame_ms: int) -> None:
    """Write a GIF that repeats for ever; each frame has its own 256 colours."""
    from PIL.Image import Dither, Quantize

    pictures = (_picture(frame).quantize(256, Quantize.FASTOCTREE, dither=Dither.NONE) for frame in frames)
    first = _first(pictures)
    first.save(handle, "GIF", save_all=True, append_images=pictures, duration=frame_ms, loop=0)


def _write_mp4(frames: Iterator[FilmFrame], handle: BinaryIO, frame_ms: int) -> None:
    """Write an H.264 film; ffmpeg needs a file of its own, which is copied once it is whole.

    ffmpeg's end is not told by imageio-ffmpeg: where its folder had no room, the film has fewer frames than were sent.
    """
    first, sent = _first(frames), 0
    with TemporaryDirectory() as folder:
        made = Path(folder) / "film.mp4"
        writer = _ffmpeg().write_frames(
            made,
            (first.width, first.height),
            fps=1000 / frame_ms,
            quality=None,
            macro_block_size=1,
            output_params=["-crf", CRF, "-vf", EVEN, "-movflags", "+faststart"],
        )
        writer.send(None)
        try:
            for frame in chain([first], frames):
                writer.send(frame.rgb)
                sent += 1
        finally:
            writer.close()
        if _frames_in(made) != sent:
            raise FileRefusedError(errno.ENOSPC, NO_ROOM, str(made))
        with made.open("rb") as film:
            shutil.copyfileobj(film, handle)


def _frames_in(film: Path) -> int:
    """Return how many frames a film has, 0 for one that cannot be read."""
    try:
        return int(_ffmpeg().count_frames_and_secs(str(film))[0])
    except (OSError, RuntimeError):
        return 0


def _frame_mark() -> "PngInfo":
    from PIL.PngImagePlugin import PngInfo

    found = PngInfo()
    found.add_text("Software", OWN_FRAME.decode())
    return found


def _copy(source: Path, handle: BinaryIO) -> None:
    handle.write(source.read_bytes())


def _write_pngs(frames: Iterator[FilmFrame], path: Path) -> tuple[Path, ...]:
    folder = path.resolve().with_name(f".{os.urandom(6).hex()}.part")
    made: list[Path] = []
    try:
        folder.mkdir()
        for number, frame in enumerate(frames, 1):
            made.append(path.with_name(f"{path.stem}_{number:04d}.png"))
            check_own(made[-1], OWN_FRAME)
            _picture(frame).save(folder / made[-1].name, pnginfo=_frame_mark())
        for target in made:
            write_beside(target, partial(_copy, folder / target.name))
    except OSError as error:
        raise ExportError(
            "{path} cannot be written, {why}; choose another place",
            path=str(path),
            why=reason(error),
        ) from error
    finally:
        with suppress(OSError):
            shutil.rmtree(folder)
    return tuple(made)
