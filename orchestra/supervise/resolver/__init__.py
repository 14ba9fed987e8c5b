"""The process in which launch files are read, and the supervisor's side of its connection."""
