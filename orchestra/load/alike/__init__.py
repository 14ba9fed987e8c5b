"""Actions that are written as others before them, with other values: they are read by what was learned of those."""
