"""Work too slow for a frame: the latest-wins worker and the jobs that use it."""
