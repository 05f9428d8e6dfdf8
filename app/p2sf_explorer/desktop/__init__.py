"""The explorer among the programs of a desktop: its icon, what it opens, links that open it."""
