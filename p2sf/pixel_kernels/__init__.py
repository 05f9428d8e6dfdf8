"""Pixel kernels: the light that a sensor's pixels receive from one point, anywhere on it and in any channel."""

from p2sf.pixel_kernels.channel import RAYS, Colour, Kernels, Recipe
from p2sf.pixel_kernels.sensor_points import SensorMap, sensor_map, sensor_maps

__all__ = ["RAYS", "Colour", "Kernels", "Recipe", "SensorMap", "sensor_map", "sensor_maps"]
