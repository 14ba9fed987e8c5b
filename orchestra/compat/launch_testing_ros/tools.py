"""Tools for tests that run."""

from __future__ import annotations

from orchestra.compat.launch_testing.running import belongs_to_running

basic_output_filter = belongs_to_running("basic_output_filter")
