"""Looks into the ROS graph for the supervisor, as long as something is awaited: run `python -m orchestra.ros.observer`.

It speaks JSON lines on standard input and output (see `orchestra.supervise.graph.observation`) and ends when its input
does.
"""
