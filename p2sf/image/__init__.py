"""Space-variant image formation: a picture through a lens."""
