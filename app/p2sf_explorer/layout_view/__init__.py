"""What the layout panel paints over the lens: marks, the source point, the highlighted surface."""
