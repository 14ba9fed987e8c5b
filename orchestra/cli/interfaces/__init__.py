"""Definitions of messages, services and actions: which are installed, and their text. No graph, no rclpy."""
