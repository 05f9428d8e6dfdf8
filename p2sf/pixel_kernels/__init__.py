"""Kernels of single pixels: what a sensor's pixels receive from one point, anywhere on it and in any channel."""

from p2sf.pixel_kernels.channel import Colour, Kernels, Recipe
from p2sf.pixel_kernels.sensor_points import View, distortion_at, view

__all__ = ["Colour", "Kernels", "Recipe", "View", "distortion_at", "view"]
