"""What only tests that run can use."""

from __future__ import annotations

from orchestra.compat.launch_testing.running import belongs_to_running

DataRepublisher = belongs_to_running("DataRepublisher")
LaunchTestRunner = belongs_to_running("LaunchTestRunner")
MessagePump = belongs_to_running("MessagePump")
WaitForTopics = belongs_to_running("WaitForTopics")
