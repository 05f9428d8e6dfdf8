"""Why a file cannot be read or written, as part of a sentence: data, so that a window says it in its language."""

import errno

from p2sf.messages import Message

SYSTEM = {  # what a system says of its refusals, as they stand within a sentence
    errno.ENOENT: Message("no such file or directory"),
    errno.EACCES: Message("permission denied"),
    errno.EPERM: Message("operation not permitted"),
    errno.EISDIR: Message("is a directory"),
    errno.ENOTDIR: Message("not a directory"),
    errno.ENAMETOOLONG: Message("file name too long"),
    errno.ELOOP: Message("too many levels of symbolic links"),
    errno.ENOSPC: Message("no space left on device"),
    errno.EDQUOT: Message("disk quota exceeded"),
    errno.EFBIG: Message("file too large"),
    errno.EROFS: Message("read-only file system"),
    errno.EIO: Message("input/output error"),
}


class FileRefusedError(OSError):
    """A file that this program does not touch: ``message`` says why."""

    def __init__(self, number: int, message: Message, path: str):
        super().__init__(number, str(message), path)
        self.message = message


class ContentRefusedError(ValueError):
    """Content that this program does not unpack: ``message`` says why."""

    def __init__(self, message: Message):
        super().__init__(str(message))
        self.message = message


class OversizedError(ContentRefusedError):
    """A file that declares more than can be unpacked; it may be valid."""


def reason(error: Exception) -> Message | str:
    """Return why something failed, for the middle of a sentence: a Message, or what another library says."""
    message = getattr(error, "message", None)
    if isinstance(message, Message):
        return message
    if isinstance(error, OSError) and error.errno in SYSTEM:
        return SYSTEM[error.errno]
    if isinstance(error, UnicodeDecodeError):
        return Message("it is no text in UTF-8")
    text = " ".join((getattr(error, "strerror", None) or str(error) or type(error).__name__).split()).rstrip(".")
    return text if text[:2].isupper() else text[:1].lower() + text[1:]
