"""What lies between two plans: which processes start, stop or restart, what else changes, and why."""
