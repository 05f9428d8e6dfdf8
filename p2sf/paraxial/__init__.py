"""Paraxial optics: first order, stop and pupils, Seidel sums, and the wavefront of the six coefficients."""
