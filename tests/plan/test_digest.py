"""The digest of a process is that of the JSON text that the standard library writes."""

from __future__ import annotations

import json
from hashlib import sha256
from typing import Any

import pytest

from orchestra.plan import digest
from orchestra.plan.codec import encode
from orchestra.values import Limits


@pytest.mark.parametrize(
    "content",
    [
        (("a", 'b"\\\n', "ü\udc80"), {"z": None, "a": "1"}, True),
        ({"rate": 1.0, "small": 1e-7, "many": (1, -2), "off": False, "nan": float("inf")}, Limits(nice=3)),
        ([{"path": "p", "content": "a: 1\n"}], None, {}),
    ],
)
def test_what_is_hashed_is_what_the_library_writes(content: tuple[Any, ...]) -> None:
    text = json.dumps(content, sort_keys=True, ensure_ascii=False, default=encode)
    assert digest.digest_of(*content) == sha256(text.encode("utf-8", "surrogatepass")).hexdigest()


def test_where_the_library_has_no_code_in_c_it_is_the_same(monkeypatch: pytest.MonkeyPatch) -> None:
    quick = digest.digest_of("a", {"b": (1.5, None)})
    monkeypatch.setattr(digest, "c_make_encoder", None)
    monkeypatch.setattr(digest, "_text", digest._texts())
    assert digest.digest_of("a", {"b": (1.5, None)}) == quick
