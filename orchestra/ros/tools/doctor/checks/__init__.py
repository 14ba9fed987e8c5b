"""The table of checks: each takes what was observed and yields what is wrong. A file each."""
