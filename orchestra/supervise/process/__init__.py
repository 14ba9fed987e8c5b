"""One process of a plan: its states, its start, its end, and the order among several."""
