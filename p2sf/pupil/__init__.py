"""Sampling the pupil: quadrature nodes, Zernike polynomials, and the sums from the pupil to the focal plane."""
