"""Output of processes: bytes to lines, lines to the screen and to files."""
