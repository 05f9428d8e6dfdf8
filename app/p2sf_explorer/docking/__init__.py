"""Where panels stand: the stage and its rail, the tabs, windows of their own, and workspaces, which arrange them."""
