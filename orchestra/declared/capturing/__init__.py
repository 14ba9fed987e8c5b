"""What a running node has told of itself, written as declarations."""
