"""From photographs of points back to wavefronts: model, fit, reading, finding, whole frames (handbook 11)."""
