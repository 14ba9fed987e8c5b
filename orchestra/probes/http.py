"""Ready when a URL answers with a status from 200 to 399.

One GET over a connection of its own; no redirect is followed, for a server that redirects answers. Certificates are not
checked, as with the probes of Kubernetes: nothing secret is sent, nothing of the answer is used, and servers beside a
robot have certificates of their own making.
"""

from __future__ import annotations

import re
from functools import partial
from typing import TYPE_CHECKING, NamedTuple, TypeVar
from urllib.parse import quote, urlsplit

from orchestra.probes.address import Addresses, Target
from orchestra.probes.repeated import Repeated
from orchestra.probes.visit import Visit

if TYPE_CHECKING:
    import socket
    from collections.abc import Callable, Generator

    from orchestra.probes.conversation import Steps, Want
    from orchestra.probes.protocol import Cancel, Site

_T = TypeVar("_T")

_PORTS = {"http": 80, "https": 443}
_GOOD = range(200, 400)
# The status line of an answer is shorter than this, in bytes (RFC 9112, section 4).
_LONGEST_START = 8192
_STATUS = re.compile(rb"HTTP/1\.[01] (\d{3})(?:[ \r\n]|$)")
# Which error says what to wait for.
_PLAIN_READ: dict[type[OSError], Want] = {BlockingIOError: "read"}
_PLAIN_WRITE: dict[type[OSError], Want] = {BlockingIOError: "write"}


class Url(NamedTuple):
    """What a request needs of a URL; `path` has the query in it."""

    goal: Target
    secure: bool
    authority: str
    path: str

    @property
    def request(self) -> bytes:
        """The request (RFC 9112, section 3)."""
        return (
            f"GET {self.path} HTTP/1.1\r\nHost: {self.authority}\r\nUser-Agent: orchestra\r\n"
            "Accept: */*\r\nConnection: close\r\n\r\n"
        ).encode("ascii", "ignore")


def http_probe(text: str, interval: float) -> Repeated:
    """Return the condition that a URL answers well."""
    url = parse(text)
    addresses = Addresses(url.goal) if url else None

    def attempt(site: Site, told: Callable[[str | None], None]) -> Cancel | None:
        if url is None or addresses is None:
            told("not an http or https URL")
            return None
        return Visit(site, addresses, lambda peer: _ask(peer, url), told)

    return Repeated(text, attempt, interval)


def parse(text: str) -> Url | None:
    """Read a URL; None where it is not one of http or https."""
    try:
        parts = urlsplit(text)
        port = parts.port
    except ValueError:
        return None
    if parts.scheme not in _PORTS or not parts.hostname:
        return None
    host = f"[{parts.hostname}]" if ":" in parts.hostname else parts.hostname
    path = quote(parts.path or "/", safe="/%:@!$&'()*+,;=~-._")
    query = f"?{quote(parts.query, safe='/%:@!$&()*+,;=~-._?')}" if parts.query else ""
    usual = _PORTS[parts.scheme]
    authority = host if port in (None, usual) else f"{host}:{port}"
    return Url(Target(parts.hostname, port or usual), parts.scheme == "https", authority, path + query)


def judge(start: bytes) -> str | None:
    """Return what is wrong with an answer, by its first bytes."""
    found = _STATUS.match(start)
    if found is None:
        return "no HTTP answer"
    status = int(found.group(1))
    return None if status in _GOOD else f"status {status}"


def _ask(peer: socket.socket, url: Url) -> Steps:
    if not url.secure:
        return (yield from _exchange(peer, url.request, _PLAIN_WRITE, _PLAIN_READ))
    from orchestra.probes import tls  # noqa: PLC0415 - the library is big, and few need it

    with tls.wrapped(peer, url.goal.host) as secured:
        yield from _persist(secured, secured.do_handshake, tls.WAITS)
        return (yield from _exchange(secured, url.request, tls.WAITS, tls.WAITS))


def _exchange(
    peer: socket.socket,
    request: bytes,
    writing: dict[type[OSError], Want],
    reading: dict[type[OSError], Want],
) -> Steps:
    while request:
        request = request[(yield from _persist(peer, partial(peer.send, request), writing)) :]
    start = b""
    while b"\n" not in start and len(start) < _LONGEST_START:
        more = yield from _persist(peer, partial(peer.recv, _LONGEST_START), reading)
        if not more:
            break
        start += more
    return judge(start)


def _persist(
    peer: socket.socket, call: Callable[[], _T], waits: dict[type[OSError], Want]
) -> Generator[tuple[int, Want], None, _T]:
    """Call until it need not wait."""
    while True:
        try:
            return call()
        except tuple(waits) as error:
            yield peer.fileno(), waits[type(error)]
