"""What a process may use: checked against the machine before the start, in force before its program begins."""
