"""From a state to everything the main panels show. No Qt."""
