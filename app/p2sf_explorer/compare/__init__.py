"""Two setups A and B: what differs, A − B, and the bar that chooses what is shown."""
