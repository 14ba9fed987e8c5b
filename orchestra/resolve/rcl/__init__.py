"""Parameters as rcl reads them: files, `-p` overrides, node patterns, and which value wins in a node."""
