"""`orchestra multicast`: whether datagrams to many reach other machines, as discovery needs it."""

from __future__ import annotations

import json
import socket
import struct
import sys
from typing import TYPE_CHECKING, Final

from orchestra.cli.boundary import OK
from orchestra.cli.ros.options import counting, timeout
from orchestra.cli.ros.verbs import Verb, VerbParser
from orchestra.errors import RunError

if TYPE_CHECKING:
    from argparse import Namespace

    from orchestra.cli.parser import CommandParser

# Those of the ROS 2 tools, so that each hears the other.
_GROUP: Final = "225.0.0.1"
_PORT: Final = 49150
_GREETING: Final = b"Hello World!"
_MOST: Final = 4096


def _ttl(parser: CommandParser) -> None:
    parser.add_argument("--ttl", type=counting, metavar="N", help="across so many routers (default: 1, none)")


_VERBS: Final = {
    "receive": Verb("wait for a datagram and show it", "", (timeout(None, "wait no longer"),)),
    "send": Verb("send a datagram to all who wait for it", "", (_ttl,)),
}


def parser() -> VerbParser:
    """Return what the command understands."""
    return VerbParser("multicast", f"Send and receive UDP multicast ({_GROUP}:{_PORT}).", _VERBS)


def run(options: Namespace) -> int:
    """Send or receive one datagram."""
    return _send(options) if options.verb == "send" else _receive(options)


def _send(options: Namespace) -> int:
    _say(options, "Sending one UDP multicast datagram...\n")
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM, socket.IPPROTO_UDP) as sender:
        if options.ttl is not None:
            sender.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_TTL, struct.pack("b", options.ttl))
        sender.sendto(_GREETING, (_GROUP, _PORT))
    if options.format == "json":
        sys.stdout.write(json.dumps({"sent": _GREETING.decode(), "to": f"{_GROUP}:{_PORT}"}) + "\n")
    return OK


def _receive(options: Namespace) -> int:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM, socket.IPPROTO_UDP) as receiver:
        receiver.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        receiver.bind(("", _PORT))
        member = struct.pack("4sL", socket.inet_aton(_GROUP), socket.INADDR_ANY)
        receiver.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, member)
        receiver.settimeout(options.timeout)
        _say(options, "Waiting for UDP multicast datagram...\n")
        try:
            data, (host, port) = receiver.recvfrom(_MOST)
        except (TimeoutError, BlockingIOError):  # the latter where no time is given at all
            raise RunError(f"no datagram came within {options.timeout:g} s") from None
    text = data.decode(errors="replace")
    if options.format == "json":
        sys.stdout.write(json.dumps({"received": text, "from": f"{host}:{port}"}) + "\n")
    _say(options, f"Received from {host}:{port}: '{text}'\n")
    return OK


def _say(options: Namespace, text: str) -> None:
    if options.format == "text":
        sys.stdout.write(text)
        sys.stdout.flush()
