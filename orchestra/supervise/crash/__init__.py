"""What is kept of every end that nobody wanted."""
