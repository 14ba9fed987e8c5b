"""A plan as a script for a shell: words and texts, what is waited for, one process, the whole script."""
