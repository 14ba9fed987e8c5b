"""What Orchestra costs, each figure beside what the machine needs without it: `python -m benchmarks`."""
