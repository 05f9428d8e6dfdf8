"""Pictures of points measured beside the lens on screen: requests, answers and what the panel shows of them. No Qt."""
