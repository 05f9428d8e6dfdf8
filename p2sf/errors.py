"""Errors that a user can cause; each message is one sentence: what is wrong, where, the value, what to do."""

from p2sf.messages import Message, ParameterName


class P2SFError(ValueError):
    """Any error caused by the user's input.

    ``P2SFError("{parameter} is {value:g} mm; give a positive number", parameter="depth_mm", value=-1)``: ``message`` is
    the sentence as data (`p2sf.messages`), and ``str`` of the error is the sentence in plain English. ``parameter`` is
    the Python name of the wrong parameter; the program that shows the sentence replaces it by its flag or control.
    """

    def __init__(self, template: str | Message, /, *, parameter: str = "", **values: object):
        named = {"parameter": ParameterName(parameter)} if parameter else {}
        self.message = template if isinstance(template, Message) else Message(template, **named, **values)
        super().__init__(self.message)

    def __str__(self) -> str:
        return str(self.message)


class P2SFWarning(UserWarning):
    """A result that is correct but possibly not what was intended, such as a PSF cut off by its window."""


class FileWarning(P2SFWarning):
    """A file was written, with an effect on another one; its argument is a `Message`."""


class GlassError(P2SFError):
    """A glass that is unknown or ambiguous, or a wavelength outside its data."""


class GeometryError(P2SFError):
    """A lens, stop, object or field for which the requested quantity does not exist."""


class SamplingError(P2SFError):
    """The sampling grid is too coarse or too large."""


class RequestError(P2SFError):
    """An invalid setting."""


class ExportError(P2SFError):
    """A file that cannot be written or read."""


class ClusterError(P2SFError):
    """A cluster that cannot be reached, or whose workers cannot do the work."""


class Cancelled(P2SFError):
    """A long computation was stopped by its caller."""


class LensFileError(P2SFError):
    """A lens file that cannot be read; ``path`` and ``line`` (from 1, None if unknown) say where."""

    def __init__(
        self,
        template: str | Message,
        /,
        path: object = "",
        line: int | None = None,
        *,
        parameter: str = "",
        **values: object,
    ):
        super().__init__(template, parameter=parameter, **values)
        self.path, self.line = str(path), line
        if line:
            self.message = Message("{path}, line {line}: {message}", path=self.path, line=line, message=self.message)
        elif path:
            self.message = Message("{path}: {message}", path=self.path, message=self.message)
        self.args = (self.message,)


class DatabaseError(P2SFError):
    """A database that cannot be built or read, or does not cover the request."""
