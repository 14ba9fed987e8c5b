"""Sessions, and modules of tests, that run at the same time get different domains."""

from __future__ import annotations

import re
import socket
import subprocess
import sys
from contextlib import ExitStack
from pathlib import Path

from orchestra.testing.domain import FIRST, LAST, free_domain

_HOLD = """
import sys
from orchestra.testing import free_domain
with free_domain({}) as domain:
    print(domain, flush=True)
    sys.stdin.read()
"""
_TESTS = Path(__file__).parents[1]
# A number that is called a domain, or the first argument of what begins something in one.
_NUMBER = re.compile(
    r"""(?:DOMAIN(?:_ID)?"?\s*[:=]|domain_id=|\{"ROS_DOMAIN_ID":|(?:Domain|controller|on_bench|start)\()\s*"?(\d+)"""
)


def test_a_given_domain_is_respected() -> None:
    with free_domain({"ROS_DOMAIN_ID": "42"}) as one, free_domain({"ROS_DOMAIN_ID": "42"}) as other:
        assert one == other == 42


def test_domains_held_together_differ() -> None:
    with ExitStack() as stack:
        held = [stack.enter_context(free_domain({})) for _ in range(5)]
        assert len(set(held)) == 5
        assert all(FIRST <= domain <= LAST for domain in held)


def test_another_session_gets_another_domain_until_this_one_ends() -> None:
    with subprocess.Popen(
        [sys.executable, "-c", _HOLD], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    ) as other:
        assert other.stdin
        assert other.stdout
        theirs = int(other.stdout.readline())
        with ExitStack() as stack:
            ours = [stack.enter_context(free_domain({})) for _ in range(10)]
            assert theirs not in ours
        other.stdin.close()
        assert other.wait(30) == 0


def test_a_domain_in_which_somebody_talks_is_left_alone() -> None:
    with free_domain({}) as domain:
        pass
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as participant:
        participant.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        participant.bind(("", 7400 + 250 * domain))
        with free_domain({}) as other:
            assert other != domain


def test_no_two_modules_of_the_tests_talk_in_the_same_domain() -> None:
    """They run at the same time, in as many processes as pytest has."""
    found: dict[int, set[str]] = {}
    for path in _TESTS.rglob("*.py"):
        for number in _NUMBER.findall(path.read_text("utf-8")):
            found.setdefault(int(number), set()).add(str(path.relative_to(_TESTS)))
    for domain in (0, 1, 3, 5, 7, 42, 233):  # that are only spoken of
        found.pop(domain, None)
    assert len(found) >= 40, "the numbers are written in another way now"
    assert {domain: modules for domain, modules in found.items() if len(modules) > 1} == {}
