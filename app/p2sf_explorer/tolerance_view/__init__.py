"""What the Tolerances panel is made of: tables of errors and builds, the histogram, and how they are arranged."""
