"""Lenses as TOML, read and written: surfaces, placements, masks, and tables in columns."""
