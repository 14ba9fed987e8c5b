"""Launch files and parameter files in one form: indentation, spaces and line breaks change, nothing else does."""
