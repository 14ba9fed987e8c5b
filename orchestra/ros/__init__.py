"""The only room that imports rclpy, and only in processes that need it."""
