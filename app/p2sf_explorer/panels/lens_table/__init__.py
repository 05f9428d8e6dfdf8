"""The lens table: its rows, the completion of glass names, and the sliders of a surface."""
