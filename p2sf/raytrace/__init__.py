"""Exact rays: one surface, a whole lens, the pencil of one source, fits to it, vignetting, field curves."""
