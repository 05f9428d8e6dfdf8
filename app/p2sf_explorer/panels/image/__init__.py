"""The image panel and its split view."""
