"""Python launch files while they are resolved: what user code sees of the resolution, and what it does to it.

isolation.py       one resolution leaves the process as it was
connection.py      what compat objects reach without a context
engine.py          what they reach through a `LaunchContext`
configurations.py  launch configurations and environment as mappings
calling.py         the boundary of user code: environment in and out, exceptions to problems
visiting.py        entities that only their own code can carry out
"""
