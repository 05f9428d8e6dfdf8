"""Small pictures of one kind at several fields, and at several colours, depths, sensor shifts or for A and B. No Qt."""
