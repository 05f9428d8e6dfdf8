"""Lens files of other programs: one module a format, and one more where it is written too."""
