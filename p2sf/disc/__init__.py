"""The unit disc: functions on it, quadrature, Zernike polynomials, masks, and sums from it to the focal plane."""
