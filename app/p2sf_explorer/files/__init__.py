"""Opening and saving: states, snapshots, lenses, recent files and the session."""
