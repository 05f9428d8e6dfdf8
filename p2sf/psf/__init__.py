"""The point spread function: one module per method, the choice between them, and figures of the result."""
