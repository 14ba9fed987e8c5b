"""Labels of transitions that follow from their states."""

from __future__ import annotations

import pytest

from orchestra.ros.observer.transitions import consequence, label_of


@pytest.mark.parametrize(
    ("start", "goal", "label"),
    [
        ("unconfigured", "configuring", "configure"),
        ("configuring", "inactive", "transition_success"),
        ("configuring", "unconfigured", "transition_failure"),
        ("configuring", "errorprocessing", "transition_error"),
        ("errorprocessing", "unconfigured", "transition_success"),
        ("errorprocessing", "finalized", "transition_failure"),
        ("inactive", "activating", "activate"),
        ("activating", "active", "transition_success"),
        ("active", "deactivating", "deactivate"),
        ("inactive", "cleaningup", "cleanup"),
        ("active", "shuttingdown", "shutdown"),
        ("shuttingdown", "finalized", "transition_success"),
        ("inactive", "active", ""),
    ],
)
def test_labels(start: str, goal: str, label: str) -> None:
    assert label_of(start, goal) == label


@pytest.mark.parametrize(
    ("before", "after", "told"),
    [
        ("unconfigured", "unconfigured", ""),
        ("active", "active", ""),
        ("active", "inactive", ""),
        ("inactive", "unconfigured", ": it has handled an error"),
        ("active", "unconfigured", ": it has handled an error"),
        ("unconfigured", "finalized", ": it could not handle an error"),
        ("active", "finalized", ": it could not handle an error"),
    ],
)
def test_where_a_transition_that_fails_leads_is_explained(before: str, after: str, told: str) -> None:
    assert consequence(before, after).startswith(told)
    assert bool(consequence(before, after)) == bool(told)
