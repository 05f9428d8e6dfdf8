"""Tolerance analysis: sensitivities, compensators, and the yield of random builds.

The wavefront of a build is a quadratic form in its errors (`differentials`), so that thousands of builds take a second.
"""
