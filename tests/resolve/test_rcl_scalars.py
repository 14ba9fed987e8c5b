from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from orchestra.resolve.rcl.scalars import typed

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.values import Scalar


@pytest.mark.conforms("4.6.4 bool", "4.6.4 int", "4.6.4 double", "4.6.4 string", "4.6.4 null")
@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("y", True),
        ("Off", False),
        ("tRue", "tRue"),
        ("+1", 1),
        ("0452", 298),
        ("0489", 489.0),
        ("-0x10", -16),
        ("0x", "0x"),
        (" 12", 12),
        (" y", " y"),
        ("12 ", "12 "),
        ("9223372036854775807", 2**63 - 1),
        ("9223372036854775808", 2.0**63),
        ("-9223372036854775808", -(2**63)),
        ("0" * 100 + "7", 7),
        ("1" * 5000, "1" * 5000),
        ("1.", 1.0),
        ("0x1.8", 1.5),
        ("0x1p3", 8.0),
        ("0x1p99999999999", "0x1p99999999999"),
        ("1e400", "1e400"),
        ("1e-400", "1e-400"),
        ("0e-400", 0.0),
        ("1e-999999999999", "1e-999999999999"),
        ("5e-324", "5e-324"),
        ("0x0.0000000000001p-1022", 5e-324),
        ("2.2250738585072014e-308", 2.2250738585072014e-308),
        ("-iNfInItY", -math.inf),
        ("-.INF", -math.inf),
        (".iNf", ".iNf"),
        ("nan(a_1)", math.nan),
        ("-.nan", "-.nan"),
        ("0b1", "0b1"),
        ("1_0", "1_0"),
    ],
)
def test_scalars_get_the_types_of_c(text: str, value: Scalar) -> None:
    assert repr(typed(text)) == repr(value)


def _written(sign: str, mantissa: int, exponent: int) -> str:
    return repr(math.ldexp(float(sign + str(mantissa)), exponent))


_TEXTS = st.one_of(
    st.text(alphabet="0123456789abcdefxXpPeE.+-_infINFnan()yYtru", min_size=1, max_size=9),
    st.from_regex(r"[-+]?0?[xX]?[0-7]{1,25}", fullmatch=True),
    st.from_regex(r"[-+]?[0-9]{1,20}\.?[0-9]{0,5}[eE]-?[0-9]{1,3}", fullmatch=True),
    st.from_regex(r"-?0x[0-9a-f]{1,16}\.?[0-9a-f]{0,4}p-?[0-9]{1,4}", fullmatch=True),
    st.builds(_written, st.sampled_from(["", "-"]), st.integers(0, 2**53), st.integers(-1127, 900)),
    st.floats(allow_nan=False, allow_infinity=False).map(float.hex),
)


def _agree(ask_rcl: Callable[..., Any], texts: list[str]) -> None:
    lines = [f"    k{index}: |-\n      {text}\n" for index, text in enumerate(texts)]
    ((_, parameters),) = ask_rcl("parse", texts=["/n:\n  ros__parameters:\n" + "".join(lines)])
    assert [repr(value) for _, value in parameters] == [repr(typed(text)) for text in texts]


@pytest.mark.conforms("4.6.4 bool", "4.6.4 int", "4.6.4 double", "4.6.4 string")
@settings(
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
    deadline=None,
    max_examples=50,
)
@given(texts=st.lists(_TEXTS, min_size=20, max_size=20))
def test_scalars_are_typed_as_by_the_real_parser(ask_rcl: Callable[..., Any], texts: list[str]) -> None:
    _agree(ask_rcl, texts)


@pytest.mark.long
@settings(
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
    deadline=None,
    max_examples=500,
)
@given(texts=st.lists(_TEXTS, min_size=100, max_size=100))
def test_many_scalars_are_typed_as_by_the_real_parser(ask_rcl: Callable[..., Any], texts: list[str]) -> None:
    _agree(ask_rcl, texts)
