"""Two robots in a MuJoCo world: launch files, parameters, worlds and nodes to copy."""
