"""The command line: one file per command, behind the table in `commands`."""
