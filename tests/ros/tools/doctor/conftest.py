"""A domain of the tests' own."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from orchestra.testing.domain import free_domain

if TYPE_CHECKING:
    from collections.abc import Iterator


@pytest.fixture(scope="session")
def free_domain_number() -> Iterator[int]:
    """A domain in which nobody else is."""
    with free_domain({}) as number:
        yield number
