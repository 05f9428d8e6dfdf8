"""What a screen reader is told of the window's own widgets."""
