"""Triggers: what happens, what is done then, and what is asked of the resolver."""
