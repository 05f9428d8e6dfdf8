"""The plan of a scene: measured errors, cost, shared pupils, and verification against exact sums."""
