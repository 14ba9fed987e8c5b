"""One module for each set of figures that are measured together."""
