"""The ROS command line: what looks at the running graph and talks with it.

A process of its own: a command of `orchestra.cli.ros` reads the words and becomes it (`__main__.py`).
"""
