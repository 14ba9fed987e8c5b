"""The control socket of a run: what is said over it, who answers in the supervisor, and who asks."""
