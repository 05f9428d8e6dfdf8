"""Files written atomically, and files of unknown origin read within limits."""
