"""JSON Schemas of what Orchestra reads and writes, generated from the types themselves."""
