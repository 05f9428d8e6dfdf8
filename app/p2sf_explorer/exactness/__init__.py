"""Fast or exact: what each method costs at the present point, and the slider of the top bar that chooses by it."""
