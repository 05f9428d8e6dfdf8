"""The accuracy ladder in one place: render a PSF by any rung, choose one, and measure what each costs."""

from p2sf.psf.methods import METHODS, Choice, choose, render
from p2sf.studies.tradeoff import Row, draw, table, to_json, tradeoff

__all__ = ["METHODS", "Choice", "Row", "choose", "draw", "render", "table", "to_json", "tradeoff"]
