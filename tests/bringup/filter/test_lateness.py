"""What is said of updates that take longer than their period."""

from bringup.filter_node.lateness import QUIET, Lateness


def test_long_updates_are_told_when_they_begin_and_counted_when_they_are_over() -> None:
    lateness = Lateness(0.02)
    assert lateness.begins(0.02, 1.0) is None
    assert lateness.begins(0.03, 2.0) == "failed to meet update rate: an update took 0.0300 s of 0.0200 s"
    for second in range(3, 60):
        assert lateness.begins(0.05 if second == 20 else 0.025, float(second)) is None
        assert lateness.ends(float(second)) is None
    assert lateness.ends(59.0 + QUIET - 0.1) is None
    assert lateness.ends(59.0 + QUIET) == (
        "the update rate is met again: 58 updates took too long, 0.0500 s at most"
    )
    assert lateness.ends(1000.0) is None
    assert lateness.begins(0.03, 1001.0) is not None
