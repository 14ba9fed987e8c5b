"""What a project has decided about problems: how much each weighs, which files and lines are left alone."""
