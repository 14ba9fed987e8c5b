"""The topics, services and actions that executables declare, and whether they fit together."""
