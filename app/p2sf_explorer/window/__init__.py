"""The window around the panels: bars, controls, stage and tabs, workspaces, lens chooser."""
