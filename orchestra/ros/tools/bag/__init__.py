"""Recording of messages to MCAP, as rosbag2 lays it out, and playing them again."""
