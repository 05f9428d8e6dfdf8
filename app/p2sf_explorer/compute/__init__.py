"""From a state to answers: setup, method, pupil, layout and what every panel reads. No Qt."""
