"""What happens when the program is wrong: one dialog, a report without anything personal, and the window back."""
