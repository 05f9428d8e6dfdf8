"""The failures a user can cause, each one sentence: what is wrong, where, the value, what to do."""


class P2SFError(ValueError):
    """Any failure that a user's input can cause."""


class GlassError(P2SFError):
    """A glass that nobody sells, that several makers sell, or a wavelength outside its data."""


class GeometryError(P2SFError):
    """A lens, stop, object or field for which the asked quantity does not exist."""


class SamplingError(P2SFError):
    """A grid that cannot carry the asked PSF."""


class RequestError(P2SFError):
    """A setup, as a user states it, that cannot be."""


class ExportError(P2SFError):
    """A result that cannot be written to, or read back from, the file asked for."""


class Cancelled(P2SFError):
    """A long computation that its caller stopped."""


class LensFileError(P2SFError):
    """A lens file that cannot be read; ``path`` and ``line`` (from 1, None if unknown) say where."""

    def __init__(self, message: str, path: str = "", line: int | None = None):
        place = f"{path}, line {line}: " if line else f"{path}: " if path else ""
        super().__init__(place + message)
        self.path, self.line = str(path), line


class DatabaseError(P2SFError):
    """A database or stack that cannot be built, read, or asked what it was asked."""
