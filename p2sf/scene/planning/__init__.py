"""The plan of a scene: what is studied, what it costs, what is shared, and the check against exact sums."""
