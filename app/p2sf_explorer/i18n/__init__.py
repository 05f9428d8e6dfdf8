"""The language of the window: translation, messages, and the language files."""
