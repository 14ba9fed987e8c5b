"""What a fleet monitor knows and decides: who is there, how each robot is, and who may drive where.

Nothing here knows ROS; `bringup.fleet_node` puts it on the graph.
"""
