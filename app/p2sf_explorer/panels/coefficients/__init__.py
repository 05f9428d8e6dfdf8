"""The coefficients panel and its mixer."""
