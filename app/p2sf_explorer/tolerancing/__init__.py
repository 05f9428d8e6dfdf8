"""Tolerances of the lens on screen: what is asked, the builds drawn at random, and what the panel shows. No Qt."""
