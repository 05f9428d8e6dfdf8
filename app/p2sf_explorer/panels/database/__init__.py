"""The database panel and its chart over depth and field."""
