"""Sessions that run at the same time get different domains."""

from __future__ import annotations

import socket
import subprocess
import sys
from contextlib import ExitStack

from orchestra.testing.domain import FIRST, LAST, free_domain

_HOLD = """
import sys
from orchestra.testing import free_domain
with free_domain({}) as domain:
    print(domain, flush=True)
    sys.stdin.read()
"""


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
