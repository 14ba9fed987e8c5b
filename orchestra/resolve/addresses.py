"""Addresses that a process is ready at, as people write them."""

from __future__ import annotations

import _socket  # without its enumerations, which take longer to import than all of this
import re
from typing import Final

from orchestra.patterns import pattern
from orchestra.resolve.amounts import UnfitError

_HERE: Final = "localhost"
_PORTS: Final = range(1, 65536)
_ADDRESS: Final = pattern(r"(?:(?P<host>\[[^][\s]*\]|[^][\s:/@]*):)?(?P<port>[0-9]{1,9})")
_URL: Final = pattern(
    r"(?:(?P<scheme>[A-Za-z][A-Za-z0-9+.-]*)://)?(?:[^\s/?#@]*@)?"
    r"(?P<host>\[[^][\s]*\]|[^][\s:/?#@]*)(?P<port>:[^\s/?#]*)?(?P<rest>(?:[/?#]\S*)?)"
)


def tcp_address(text: str) -> str:
    """Return `HOST:PORT` for a port or for host and port; an IPv6 address stands in brackets.

    Raises `UnfitError` with what was probably meant.
    """
    text = text.strip()
    found = _ADDRESS.fullmatch(text)
    if found is None:
        raise _no_address(text)
    if int(found["port"]) not in _PORTS:
        raise UnfitError(f"a port is a number from 1 to 65535, not {found['port']}")
    host = found["host"] or _HERE
    if host.startswith("[") and not _is_ipv6(host[1:-1]):
        raise UnfitError(f"'{host[1:-1]}' is no IPv6 address")
    return f"{host}:{int(found['port'])}"


def http_address(text: str) -> str:
    """Return a URL that can be asked for. Raises `UnfitError` with what was probably meant."""
    text = text.strip()
    found = _URL.fullmatch(text)
    if found is None:
        raise UnfitError(f"'{text}' is no URL: http://HOST:PORT/PATH")
    scheme, host, port = found["scheme"], found["host"], found["port"]
    if scheme is None:
        near = f"http://{_HERE}{text}" if not host else f"http://{text}"
        raise UnfitError(f"'{text}' is no URL: it lacks http:// or https://", near)
    if scheme.lower() not in ("http", "https"):
        near = re.sub(r"^[^:]*", "http", text)
        raise UnfitError(f"the scheme of a URL is http or https here, not {scheme}", near)
    if not host:
        raise UnfitError(f"the URL '{text}' names no host")
    if host.startswith("[") and not _is_ipv6(host[1:-1]):
        raise UnfitError(f"'{host[1:-1]}' is no IPv6 address")
    if port is not None and not (re.fullmatch("[0-9]{1,5}", port[1:]) and int(port[1:]) in _PORTS):
        raise UnfitError(f"a port is a number from 1 to 65535, not '{port[1:]}'")
    return text


def _no_address(text: str) -> UnfitError:
    url = _URL.fullmatch(text)
    if url is not None and url["scheme"] is not None:
        near = f"{url['host']}{url['port']}" if url["host"] and url["port"] else None
        return UnfitError(f"'{text}' is a URL: `tcp` is HOST:PORT, `http` waits for URLs", near)
    host, _, port = text.rpartition(":")
    if port.isdecimal() and _is_ipv6(host):
        return UnfitError("an IPv6 address with a port stands in brackets", f"[{host}]:{port}")
    if _is_ipv6(text.strip("[]")) or re.fullmatch(r"[A-Za-z0-9.-]+", text):
        return UnfitError(f"'{text}' lacks a port: HOST:PORT, or PORT alone")
    return UnfitError(f"'{text}' is neither PORT nor HOST:PORT")


def _is_ipv6(text: str) -> bool:
    try:
        _socket.inet_pton(_socket.AF_INET6, text.partition("%")[0])
    except (OSError, UnicodeError):
        return False
    return True
