"""Texts that stand for contents."""

from __future__ import annotations

try:
    from _blake2 import blake2b  # what `hashlib` has, without the library of ciphers that it loads first
except ImportError:  # not every interpreter has it by this name
    from hashlib import blake2b


def digest_of(content: bytes) -> str:
    """Return a text that stands for a content."""
    return blake2b(content, digest_size=16).hexdigest()
