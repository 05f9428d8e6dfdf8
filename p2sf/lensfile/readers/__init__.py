"""Readers of other programs' lens files, one a format; `lensfile.importing` chooses by content."""
