"""What launch files import as `ros2pkg`."""
