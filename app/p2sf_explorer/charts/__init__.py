"""Charts and what paints them: axes, curves, heat maps, colours, text.

They paint themselves: with the same content a plot in pyqtgraph's graphics scene takes 1.9 to 8 times the CPU of a
frame; only many lines of one colour in one item take as little (``python -m tests.benchmarks.charts``). pyqtgraph gives
them the colour maps.
"""
