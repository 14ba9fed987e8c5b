"""What is wrong in a running graph: it is observed once, then each check judges what was seen, by itself and purely."""
