"""ROS nodes as the supervisor deals with them, through the observer: lifecycle, components, facts."""
