"""Runs a plan: the only stage that starts, signals or waits. Standard library only."""
