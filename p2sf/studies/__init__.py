"""What the program measures about itself: every method's time against its error, and the paper's figures redone."""
