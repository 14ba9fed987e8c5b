"""What the command arbiter decides, without ROS: whose velocity the robot obeys.

`settings` are the inputs and the locks, `choice` who is in force at a moment.
"""
