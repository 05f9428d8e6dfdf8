"""Results as files: written beside and renamed, so that a file is there whole or not at all."""

from p2sf.export.beside import check_place, plain, write_beside, write_json
from p2sf.export.psf_files import ENDINGS, read_psf, write_psf
from p2sf.export.record import CONVENTIONS, describe, versions

__all__ = [
    "CONVENTIONS",
    "ENDINGS",
    "check_place",
    "describe",
    "plain",
    "read_psf",
    "versions",
    "write_beside",
    "write_json",
    "write_psf",
]
