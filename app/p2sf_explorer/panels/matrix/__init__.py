"""The matrix panel and its charts of many small pictures."""
