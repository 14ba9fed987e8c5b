"""Encrypted connections that prove nothing about the other side: who asks only wants to know whether it answers."""

from __future__ import annotations

import ssl
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import socket

    from orchestra.probes.conversation import Want

# Which error says what to wait for: a write may have to wait for something to read.
WAITS: dict[type[OSError], Want] = {ssl.SSLWantReadError: "read", ssl.SSLWantWriteError: "write"}


def wrapped(peer: socket.socket, host: str) -> ssl.SSLSocket:
    """Return the connected socket with encryption; no handshake has been made."""
    context = ssl.SSLContext(ssl.PROTOCOL_TLS_CLIENT)
    context.check_hostname = False
    context.verify_mode = ssl.CERT_NONE
    return context.wrap_socket(peer, server_hostname=host, do_handshake_on_connect=False)
