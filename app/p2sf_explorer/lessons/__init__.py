"""Lessons: the file format, the claims a lesson makes, its page in the window; the lessons themselves as Markdown."""
