"""How good the bringup's filters are: runs in lockstep or recorded ones, their errors, and pictures of them.

Only `listening` knows ROS, and only `drawing` matplotlib.
"""
