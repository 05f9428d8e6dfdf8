"""Rays traced otherwise than by the program, to compare with."""
