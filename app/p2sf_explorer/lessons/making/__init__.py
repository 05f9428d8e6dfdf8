"""Lessons of a person's own: recorded from the window, with questions by a form, and tested."""
