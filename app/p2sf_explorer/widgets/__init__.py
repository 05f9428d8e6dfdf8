"""Widgets that several panels share: cards, sliders, editors, readouts, split views."""
