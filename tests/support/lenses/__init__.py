"""Lenses for tests: simple, random, shaped, misaligned, zooms, and lens files."""
