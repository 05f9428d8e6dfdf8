"""The handbook: pages in Markdown with formulas, and how the window shows them."""
