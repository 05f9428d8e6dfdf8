"""Sampling the pupil: quadrature nodes, Zernike polynomials, and the sums that lead to the focal plane."""
