"""What the velocity controller decides, without ROS: modes, wandering, stopping before obstacles.

`settings` are the parameters and what makes them acceptable, `sight` turns a scan into points,
`clearance` measures how far the robot may go among them, `guard` limits a wanted velocity by that,
`ramp` limits its change, `wander` chooses where to go, `journey` goes to a goal by a `way` that `route` finds
through the `costs` of a `grid` of what was seen, and `controller` puts one tick together.
Lengths are metres, angles radians, times seconds of ROS time; x points ahead, y to the left, and the origin
of the robot's frame is the middle of its axle.
"""
