"""Launch files in another language: what they say is kept, not what it comes to."""
