"""Pixel kernels: the light that a sensor's pixels receive from one point, anywhere on it and in any channel."""
