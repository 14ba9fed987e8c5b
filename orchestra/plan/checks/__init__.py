"""What can be wrong with a description that resolves: a module per check, one table."""
