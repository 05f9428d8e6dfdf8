"""The tolerances panel: tables of errors and builds, the histogram, and how they are arranged."""
