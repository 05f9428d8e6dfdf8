"""Exact rays: through a surface and a lens, the pencil of one source, fits to it, vignetting, field curves."""
