"""Run directories: which there are, what is in them, which of them live."""
