"""Messages as text and back: YAML, CSV, plain data; their classes by name."""
