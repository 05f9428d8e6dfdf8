"""The program: start and end, crash reports and recovery, and its entry among the programs of a desktop."""
