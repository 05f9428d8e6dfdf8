"""The layout panel, and what it paints over the lens: marks, the source point, the highlighted surface."""
