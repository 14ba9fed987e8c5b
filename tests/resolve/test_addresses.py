"""Ports, addresses and URLs as people write them."""

from __future__ import annotations

import pytest

from orchestra.resolve.addresses import http_address, tcp_address
from orchestra.resolve.amounts import UnfitError


@pytest.mark.parametrize(
    ("text", "address"),
    [
        ("8080", "localhost:8080"),
        (" 80 ", "localhost:80"),
        (":80", "localhost:80"),
        ("robot.local:11311", "robot.local:11311"),
        ("10.0.0.7:0080", "10.0.0.7:80"),
        ("[::1]:80", "[::1]:80"),
        ("[fe80::1%eth0]:65535", "[fe80::1%eth0]:65535"),
    ],
)
def test_an_address_has_a_host_and_a_port(text: str, address: str) -> None:
    assert tcp_address(text) == address


@pytest.mark.parametrize(
    ("text", "reason", "suggestion"),
    [
        ("", "'' is neither PORT nor HOST:PORT", None),
        ("robot", "'robot' lacks a port: HOST:PORT, or PORT alone", None),
        ("::1", "'::1' lacks a port: HOST:PORT, or PORT alone", None),
        ("[::1]", "'[::1]' lacks a port: HOST:PORT, or PORT alone", None),
        ("0", "a port is a number from 1 to 65535, not 0", None),
        ("host:65536", "a port is a number from 1 to 65535, not 65536", None),
        ("host:http", "'host:http' is neither PORT nor HOST:PORT", None),
        ("a b:80", "'a b:80' is neither PORT nor HOST:PORT", None),
        ("[1.2]:80", "'1.2' is no IPv6 address", None),
        ("fe80::1:80", "an IPv6 address with a port stands in brackets", "[fe80::1]:80"),
        ("http://h:80/x", "'http://h:80/x' is a URL: `tcp` is HOST:PORT, `http` waits for URLs", "h:80"),
        ("tcp://h", "'tcp://h' is a URL: `tcp` is HOST:PORT, `http` waits for URLs", None),
        ("\u0668\u0660", "'\u0668\u0660' is neither PORT nor HOST:PORT", None),
    ],
)
def test_what_is_no_address_is_told_with_what_was_meant(
    text: str, reason: str, suggestion: str | None
) -> None:
    with pytest.raises(UnfitError) as caught:
        tcp_address(text)
    assert (caught.value.reason, caught.value.suggestion) == (reason, suggestion)


@pytest.mark.parametrize(
    "url",
    [
        "http://localhost",
        "https://robot.local:8443/healthz?full=1",
        "HTTP://[::1]:80/",
        "http://user:word@host/x",
    ],
)
def test_a_url_is_taken_as_it_is(url: str) -> None:
    assert http_address(f" {url} ") == url


@pytest.mark.parametrize(
    ("text", "reason", "suggestion"),
    [
        (
            "localhost:80/x",
            "'localhost:80/x' is no URL: it lacks http:// or https://",
            "http://localhost:80/x",
        ),
        ("/health", "'/health' is no URL: it lacks http:// or https://", "http://localhost/health"),
        (":80/x", "':80/x' is no URL: it lacks http:// or https://", "http://localhost:80/x"),
        ("htp://a/b", "the scheme of a URL is http or https here, not htp", "http://a/b"),
        ("http:///x", "the URL 'http:///x' names no host", None),
        ("http://h:0/", "a port is a number from 1 to 65535, not '0'", None),
        ("http://h:x/", "a port is a number from 1 to 65535, not 'x'", None),
        ("http://[h]/", "'h' is no IPv6 address", None),
        ("http://a b", "'http://a b' is no URL: http://HOST:PORT/PATH", None),
    ],
)
def test_what_is_no_url_is_told_with_what_was_meant(text: str, reason: str, suggestion: str | None) -> None:
    with pytest.raises(UnfitError) as caught:
        http_address(text)
    assert (caught.value.reason, caught.value.suggestion) == (reason, suggestion)
