from __future__ import annotations

import contextlib
import http.server
import socket
import ssl
import threading
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

from orchestra.probes import visit
from orchestra.probes.address import Target
from orchestra.probes.http import Url, http_probe, judge, parse
from tests.probes.sites import place

if TYPE_CHECKING:
    from collections.abc import Iterator

_CERTIFICATE = Path(__file__).parents[1] / "data" / "tls" / "server.pem"


class _Handler(http.server.BaseHTTPRequestHandler):
    """Answers /STATUS with that status; /late with 503 the first time."""

    protocol_version = "HTTP/1.1"
    seen: list[tuple[str, str | None]] = []  # noqa: RUF012 - of all of them

    def do_GET(self) -> None:
        self.seen.append((self.path, self.headers["Host"]))
        late = self.path == "/late" and len(self.seen) == 1
        status = 503 if late else int(self.path[1:4]) if self.path[1:4].isdigit() else 200
        self.send_response(status)
        self.send_header("Content-Length", "0")
        self.send_header("Location", "http://robot.invalid/")
        self.end_headers()

    def log_message(self, *_words: Any) -> None:
        """Say nothing."""


@contextlib.contextmanager
def server(context: ssl.SSLContext | None = None) -> Iterator[int]:
    """A web server; gives its port."""
    _Handler.seen.clear()
    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), _Handler) as serving:
        if context:
            serving.socket = context.wrap_socket(serving.socket, server_side=True)
        thread = threading.Thread(target=serving.serve_forever, args=(0.02,))
        thread.start()
        try:
            yield serving.server_address[1]
        finally:
            serving.shutdown()
            thread.join()


@pytest.mark.parametrize("status", [200, 204, 301, 302, 399])
def test_a_good_status_is_ready_and_no_redirect_is_followed(status: int) -> None:
    with server() as port, place() as here:
        probe = http_probe(f"http://localhost:{port}/{status}?wait=no", 0.02)
        here.begin(probe)
        here.holds(probe)
        assert _Handler.seen == [(f"/{status}?wait=no", f"localhost:{port}")]


@pytest.mark.parametrize("status", [404, 500, 503])
def test_a_bad_status_is_told(status: int) -> None:
    with server() as port, place() as here:
        probe = http_probe(f"http://127.0.0.1:{port}/{status}", 0.02)
        here.begin(probe)
        here.fails(probe, f"http://127.0.0.1:{port}/{status} (status {status})")


def test_a_server_may_become_ready_later() -> None:
    with server() as port, place() as here:
        probe = http_probe(f"http://127.0.0.1:{port}/late", 0.02)
        here.begin(probe)
        here.holds(probe)
        assert len(_Handler.seen) == 2


def test_an_encrypted_server_needs_no_certificate_that_we_know() -> None:
    context = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
    context.load_cert_chain(_CERTIFICATE)
    with server(context) as port, place() as here:
        probe = http_probe(f"https://localhost:{port}/200", 0.02)
        here.begin(probe)
        here.holds(probe)


def test_a_plain_server_is_no_encrypted_one() -> None:
    with server() as port, place() as here:
        probe = http_probe(f"https://127.0.0.1:{port}/", 0.02)
        here.begin(probe)
        here.until(lambda: "(" in probe.words, "no fault")
        assert "SSL" in probe.words
        probe.end()


@contextlib.contextmanager
def mute(answer: bytes = b"", *, rude: bool = False) -> Iterator[int]:
    """A server that accepts, writes an answer to whoever comes and reads nothing; or hangs up at once."""
    with socket.create_server(("127.0.0.1", 0)) as opened, contextlib.ExitStack() as clients:
        opened.settimeout(20.0)

        def serve() -> None:
            with contextlib.suppress(OSError):
                while True:
                    client = opened.accept()[0]
                    if rude:
                        client.close()
                        continue
                    clients.callback(client.close)
                    client.setblocking(False)
                    client.send(answer) if answer else None

        thread = threading.Thread(target=serve)
        thread.start()
        try:
            yield opened.getsockname()[1]
        finally:
            opened.shutdown(socket.SHUT_RDWR)
            thread.join()


def test_a_server_that_never_answers_costs_one_attempt_its_time(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(visit, "WITHIN", 0.2)
    for scheme in ("http", "https"):
        with mute() as port, place() as here:
            probe = http_probe(f"{scheme}://127.0.0.1:{port}/", 0.02)
            here.begin(probe)
            here.fails(probe, f"{scheme}://127.0.0.1:{port}/ (no answer within 0.2 s)")


@pytest.mark.parametrize(
    "answer", [b"220 mail ready\r\n", b"x" * 20000, b"\0\xff\n", b"HTTP/1.1 2000 no\r\n"]
)
def test_what_is_no_web_server_is_told(answer: bytes) -> None:
    with mute(answer) as port, place() as here:
        probe = http_probe(f"http://127.0.0.1:{port}/", 0.02)
        here.begin(probe)
        here.fails(probe, f"http://127.0.0.1:{port}/ (no HTTP answer)")


def test_a_server_that_hangs_up_is_told() -> None:
    with mute(rude=True) as port, place() as here:
        probe = http_probe(f"http://127.0.0.1:{port}/", 0.02)
        here.begin(probe)
        here.until(lambda: "(" in probe.words, "no fault")
        assert probe.words.endswith(("(no HTTP answer)", "(connection reset by peer)", "(broken pipe)"))
        probe.end()


@pytest.mark.parametrize(
    ("text", "wanted"),
    [
        ("http://a", Url(Target("a", 80), secure=False, authority="a", path="/")),
        ("https://a/b?c=d", Url(Target("a", 443), secure=True, authority="a", path="/b?c=d")),
        ("http://[::1]:8080/", Url(Target("::1", 8080), secure=False, authority="[::1]:8080", path="/")),
        ("http://a/b c\r\nX: y", Url(Target("a", 80), secure=False, authority="a", path="/b%20cX:%20y")),
        (
            "http://a/%20?q=%C3%A4&r",
            Url(Target("a", 80), secure=False, authority="a", path="/%20?q=%C3%A4&r"),
        ),
        ("http://user:pw@a:80/", Url(Target("a", 80), secure=False, authority="a", path="/")),
        ("ftp://a/", None),
        ("a:80", None),
        ("http://", None),
        ("http://a:no/", None),
        ("http://[::1/", None),
    ],
)
def test_urls(text: str, wanted: Url | None) -> None:
    assert parse(text) == wanted


def test_what_is_no_url_is_told() -> None:
    with place() as here:
        probe = http_probe("robot/health", 0.02)
        here.begin(probe)
        here.fails(probe, "robot/health (not an http or https URL)")


@pytest.mark.parametrize(
    ("start", "fault"),
    [
        (b"HTTP/1.1 200 OK\r\n", None),
        (b"HTTP/1.0 204\r\n", None),
        (b"HTTP/1.1 399", None),
        (b"HTTP/1.1 400 Bad\r\n", "status 400"),
        (b"HTTP/1.1 199 Odd\r\n", "status 199"),
        (b"HTTP/2 200\r\n", "no HTTP answer"),
        (b"", "no HTTP answer"),
    ],
)
def test_status_lines(start: bytes, fault: str | None) -> None:
    assert judge(start) == fault
