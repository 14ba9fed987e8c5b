"""Waiting for what processes do."""

from __future__ import annotations

from orchestra.compat.launch_testing.running import belongs_to_running

assert_output = belongs_to_running("assert_output")
assert_output_sync = belongs_to_running("assert_output_sync")
assert_stderr = belongs_to_running("assert_stderr")
assert_stderr_sync = belongs_to_running("assert_stderr_sync")
wait_for_exit = belongs_to_running("wait_for_exit")
wait_for_exit_sync = belongs_to_running("wait_for_exit_sync")
wait_for_output = belongs_to_running("wait_for_output")
wait_for_output_sync = belongs_to_running("wait_for_output_sync")
wait_for_start = belongs_to_running("wait_for_start")
wait_for_start_sync = belongs_to_running("wait_for_start_sync")
wait_for_stderr = belongs_to_running("wait_for_stderr")
wait_for_stderr_sync = belongs_to_running("wait_for_stderr_sync")
