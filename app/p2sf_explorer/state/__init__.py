"""The frozen State of the window, its limits, and how its quantities are scaled and written. No Qt."""
