"""What can be seen of a launch file without executing it: the arguments it declares, the files it includes."""
