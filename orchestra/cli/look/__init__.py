"""How `orchestra check` looks at many files: beside each other, and only at those that are not known already."""
