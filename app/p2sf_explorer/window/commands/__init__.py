"""What menus, keys and the command palette do: actions, choices, help, reports, sharing, export of PSF sets."""
