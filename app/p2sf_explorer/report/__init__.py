"""A report on a lens as it is set: what is in it, its drawings, and files of it as PDF, HTML and JSON."""
