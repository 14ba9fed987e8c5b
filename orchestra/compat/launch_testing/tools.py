"""Tools for tests that run."""

from __future__ import annotations

from orchestra.compat.launch_testing.running import belongs_to_running

ProcessProxy = belongs_to_running("ProcessProxy")
launch_process = belongs_to_running("launch_process")
expect_output = belongs_to_running("expect_output")
basic_output_filter = belongs_to_running("basic_output_filter")
expected_output_from_file = belongs_to_running("expected_output_from_file")
