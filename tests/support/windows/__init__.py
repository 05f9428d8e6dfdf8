"""Windows in tests: events, waiting, random hands, screen readers."""
