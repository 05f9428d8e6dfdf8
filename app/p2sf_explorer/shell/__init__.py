"""The window around the panels: bars, controls, tabs, actions, command palette, help, lens chooser."""
