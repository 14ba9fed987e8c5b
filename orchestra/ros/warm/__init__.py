"""The fork server: a process that has imported rclpy, and becomes a node as often as it is asked to.

It is run by its file, as one of Orchestra's own processes; `supervise.warm.dialogue` says how it is spoken to.
It never initialises rclpy, so that what it has loaded is the same for every node, and runs no code of users itself.
"""
