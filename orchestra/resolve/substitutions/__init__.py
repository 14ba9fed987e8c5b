"""The substitutions: one file each, and one table."""
