"""The explorer: one window on one lens, following its sliders."""
