"""From what was written to what is meant: no substitution left, every value knows where it came from."""
