"""Packages of message, service and action definitions that are here as sources: where they are, and what is built."""
