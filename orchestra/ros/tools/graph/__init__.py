"""Joining the graph, knowing when all of it has been seen, and what is in it."""
