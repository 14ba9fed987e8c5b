"""The behaviour of each action, one module per word: `visit(action, run)`."""
