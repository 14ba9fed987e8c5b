"""When a process counts as ready: one condition per file, behind one Protocol and one table."""
