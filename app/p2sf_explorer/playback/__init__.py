"""Playing a slider, and filming it."""
