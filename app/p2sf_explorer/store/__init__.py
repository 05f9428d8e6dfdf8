"""The one place the state lives while the window is open, with undo; and the workers for what is slow."""
