"""What keeps a run together and leaves nothing behind: signals, descent, marks, sweeping, clearing up."""
