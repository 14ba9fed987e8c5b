"""What is said over the control socket: JSON objects, one per line, in UTF-8.

    server  {"protocol": 1, "run": MARK, "name": NAME, "directory": PATH, "keeper": PID, "supervisor": PID}
                                                                    first of all
    client  {"id": ANY, "request": NAME, ...}                       `requests.REQUESTS` has the names
    server  {"id": ANY, "result": {...}}                            or
            {"id": ANY, "error": {"code": CODE, "message": TEXT}}   `id` null where the line was none
    server  {"event": {...}, "number": N}                           after `subscribe`: the N-th event of the run
    server  {"output": BASE64}, {"detached": TEXT}                  after `attach`, as `attaching` says

Answers may come in another order than requests, since some wait for what they ask for. After an error with the code
`oversized`, `busy` or `foreign` the server closes the connection.
"""

from __future__ import annotations

import json
from typing import Any, Final, Literal, NamedTuple, TypeAlias

VERSION: Final = 1
# The longest line that a server reads, in bytes; what it writes has no limit.
LONGEST_REQUEST: Final = 65536

Code: TypeAlias = Literal[
    "malformed",  # the line is not a request
    "oversized",  # the line is too long
    "unknown_request",
    "unknown_process",  # no process has this name, or fits this pattern
    "unknown_signal",
    "refused",  # the run is in no state to do that
    "busy",  # too many clients, or too many who are attached
    "foreign",  # another user
    "over",  # the run ended before the answer
    "bug",
]


class Refusal(Exception):  # noqa: N818 - it is the answer to a request, not a fault of ours
    """A request cannot be met; `code` says which way, the message is for people."""

    def __init__(self, code: Code, message: str) -> None:
        super().__init__(message)
        self.code: Code = code


class Request(NamedTuple):
    """What a client wants. `id` comes back with the answer."""

    id: object
    name: str
    given: dict[str, Any]


def encode(message: dict[str, Any]) -> bytes:
    """Return a message as a line. Lone surrogates, which stand for bytes that are not UTF-8, come through as such."""
    return json.dumps(message).encode() + b"\n"


def encode_event(line: str, number: int) -> bytes:
    """Return the message for an event from its line in the event stream."""
    # What cannot be encoded is a lone surrogate inside a string, where `\udc80` is JSON.
    return b'{"event": %b, "number": %d}\n' % (line.encode("utf-8", "backslashreplace"), number)


def decode(line: bytes) -> Request:
    """Read a request. Raises `Refusal` where the line is none."""
    try:
        document = json.loads(line)
    except (ValueError, RecursionError) as error:
        raise Refusal("malformed", f"not a line of JSON: {error}") from None
    if not isinstance(document, dict) or not isinstance(document.get("request"), str):
        raise Refusal("malformed", "not an object with a 'request'")
    return Request(document.pop("id", None), document.pop("request"), document)


def answer(request: object, result: dict[str, Any]) -> bytes:
    """Return the answer to the request with this id."""
    return encode({"id": request, "result": result})


def refusal(request: object, why: Refusal) -> bytes:
    """Return the answer to a request with this id that cannot be met."""
    return encode({"id": request, "error": {"code": why.code, "message": str(why)}})
