"""The course: six lectures with tasks that grade themselves, a concept check, and tables of results."""
