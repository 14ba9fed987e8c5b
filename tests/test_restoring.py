from __future__ import annotations

import os
import subprocess
from typing import TYPE_CHECKING

from tests.restoring import environment_restored

if TYPE_CHECKING:
    import pytest


def test_variables_are_as_before_here_and_for_programs(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("CHANGED", "before")
    monkeypatch.setenv("REMOVED", "there")
    monkeypatch.delenv("ADDED", raising=False)
    environment = dict(os.environ)
    with environment_restored():
        os.environ["CHANGED"] = "after"
        os.environ["ADDED"] = "too much"
        del os.environ["REMOVED"]
    assert os.environ == environment
    told = subprocess.run(["printenv", "CHANGED", "REMOVED", "ADDED"], stdout=subprocess.PIPE, check=False)
    assert told.stdout == b"before\nthere\n"


def test_what_pytest_is_at_is_its_own() -> None:
    with environment_restored():
        os.environ["PYTEST_CURRENT_TEST"] = at = os.environ["PYTEST_CURRENT_TEST"] + " and more"
    assert os.environ["PYTEST_CURRENT_TEST"] == at
