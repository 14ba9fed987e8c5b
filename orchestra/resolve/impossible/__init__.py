"""Conditions that are the same whatever is given: comparisons that cannot hold, conditions that contradict others."""
