"""Sizes, cores and limits as people write them."""

from __future__ import annotations

import resource

import pytest
from hypothesis import given
from hypothesis import strategies as st

from orchestra.description.limits import Rlimits
from orchestra.resolve.amounts import UnfitError
from orchestra.resolve.quantities import SIZES, UNLIMITED, cap, cores, distinct, lock, rlimit, size


@pytest.mark.parametrize(
    ("text", "number"),
    [
        ("0", 0),
        ("4096", 4096),
        ("1K", 1024),
        ("512M", 512 << 20),
        ("512 mb", 512 << 20),
        ("2G", 2 << 30),
        ("2GiB", 2 << 30),
        ("1.5g", 3 << 29),
        ("1T", 1 << 40),
        ("9223372036854775807", 2**63 - 1),
    ],
)
def test_units_are_powers_of_1024(text: str, number: int) -> None:
    assert size(text) == number


@pytest.mark.parametrize(
    "text", ["", "M", "-1", "4X", "1e3", "0.3K", "1.5", "9223372036854775808", "9" * 400 + "T"]
)
def test_what_is_no_size_is_refused(text: str) -> None:
    with pytest.raises(UnfitError, match="expected a size as 512M or 2G"):
        size(text)


def test_a_cap_of_nothing_is_refused_and_a_lock_of_nothing_is_not() -> None:
    with pytest.raises(UnfitError, match="cannot be 0"):
        cap("0")
    assert (lock("0"), lock("Unlimited"), lock("64M")) == (0, UNLIMITED, 64 << 20)


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("3", (3,)),
        ("0-3,6", (0, 1, 2, 3, 6)),
        (" 7 , 0 - 1 ", (7, 0, 1)),
        ("[0, 2-3]", (0, 2, 3)),
        ("2-2", (2,)),
        ("8191", (8191,)),
    ],
)
def test_cores_are_numbers_and_ranges(text: str, found: tuple[int, ...]) -> None:
    assert cores(text) == found


@given(st.sets(st.integers(0, 500), min_size=1))
def test_any_set_of_cores_can_be_written_in_any_order(numbers: set[int]) -> None:
    assert distinct(cores(",".join(map(str, numbers)))) == tuple(sorted(numbers))


@pytest.mark.parametrize(
    ("text", "reason", "suggestion"),
    [
        ("", "expected numbers of cores as 0-3,6, found ''", None),
        ("0,,1", "expected numbers of cores as 0-3,6, found '0,,1'", None),
        ("-1", "expected numbers of cores as 0-3,6, found '-1'", None),
        ("all", "expected numbers of cores as 0-3,6, found 'all'", None),
        ("3-1", "the range 3-1 is empty", "1-3"),
        ("0-99999999999", "there is no core 99999999999: Linux counts from 0 to 8191 at most", None),
    ],
)
def test_what_are_no_cores_is_told(text: str, reason: str, suggestion: str | None) -> None:
    with pytest.raises(UnfitError) as caught:
        cores(text)
    assert (caught.value.reason, caught.value.suggestion) == (reason, suggestion)


def test_a_core_stands_once_and_there_is_one() -> None:
    with pytest.raises(UnfitError, match="core 2 stands twice"):
        distinct((1, 2, 3, 2))
    with pytest.raises(UnfitError, match="the list is empty"):
        distinct(())


@pytest.mark.parametrize(
    ("text", "is_size", "pair"),
    [
        ("4096", False, (4096, 4096)),
        ("1024:4096", False, (1024, 4096)),
        ("0:unlimited", False, (0, UNLIMITED)),
        ("unlimited", True, (UNLIMITED, UNLIMITED)),
        (" 8M : 1G ", True, (8 << 20, 1 << 30)),
    ],
)
def test_a_limit_is_soft_and_hard(text: str, is_size: bool, pair: tuple[int, int]) -> None:
    assert rlimit(text, is_size=is_size) == pair


@pytest.mark.parametrize(
    ("text", "is_size", "suggestion"),
    [
        ("5:4", False, "4:5"),
        ("unlimited:4", False, "4:unlimited"),
        ("infinity", True, "unlimited"),
        ("-1", False, "unlimited"),
        ("unlimted", False, "unlimited"),
        ("8M", False, None),
        ("1:2:3", False, None),
        ("", True, None),
    ],
)
def test_what_is_no_limit_is_refused(text: str, is_size: bool, suggestion: str | None) -> None:
    with pytest.raises(UnfitError) as caught:
        rlimit(text, is_size=is_size)
    assert caught.value.suggestion == suggestion


def test_the_names_are_those_that_the_system_has() -> None:
    known = {name.removeprefix("RLIMIT_").lower() for name in dir(resource) if name.startswith("RLIMIT_")}
    assert known - {"ofile"} == Rlimits.known_keys()  # which is another name of nofile
    assert Rlimits.known_keys() > SIZES
    assert resource.RLIM_INFINITY == UNLIMITED
