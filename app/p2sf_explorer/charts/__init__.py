"""Charts and what paints them: axes, curves, heat maps, colours, text."""
