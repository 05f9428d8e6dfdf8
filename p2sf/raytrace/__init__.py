"""Exact rays: through a surface and a lens, aimed at the stop, the pencil of one source, the geometry of a field."""
