"""Lens files: the shipped lenses, TOML, and other programs' formats, read and written.

`importing.import_lens` gives the report on the reading of a file as well, `writing.write_lens` writes a lens in the
format of its ending, `agf.read_agf` reads a glass catalogue; these modules load on first use.
"""
