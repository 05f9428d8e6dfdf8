"""Pupils: of a source through a lens, what light leaves it and how it is described."""
