"""What a running node declares: its parameters by their descriptors, and the interfaces that it has in the graph.

A process of its own: `orchestra.cli.capturing` starts it.
"""
