"""What has to stay the same for a running process to be left alone."""

from __future__ import annotations

import json
import sys
from json.encoder import (  # type: ignore[attr-defined] # what the library's own encoder has
    c_make_encoder,
    encode_basestring,
)
from typing import TYPE_CHECKING, Final

from orchestra.plan.codec import encode

try:
    # What `hashlib` has, without the library of ciphers that it loads first.
    if sys.version_info >= (3, 12):
        from _sha2 import sha256
    else:
        from _sha256 import sha256  # type: ignore[import-not-found]
except ImportError:  # not every interpreter has it by this name
    from hashlib import sha256

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.plan.model import Process

# Tuples are lists to it.
_encoder: Final = json.JSONEncoder(sort_keys=True, ensure_ascii=False, default=encode)


def _texts() -> Callable[[object], str]:
    """Return what encodes; the encoder in C that the library makes anew for each text is made once."""
    if c_make_encoder is None:
        return _encoder.encode
    separators = (_encoder.key_separator, _encoder.item_separator)
    chunks = c_make_encoder(None, encode, encode_basestring, None, *separators, True, False, True)
    return lambda content: "".join(chunks(content, 0))


_text: Final = _texts()


def digest(process: Process) -> str:
    """Return the SHA-256 of command, environment, cwd, parameter content, stdin, shell and limits."""
    # As the encoder of plans has them, in a fifth of its time.
    files = [{"path": file.path, "content": file.content} for file in process.parameter_files]
    return digest_of(
        process.command,
        (process.environment, process.inherit_environment),
        process.cwd,
        process.parameters,
        files,
        process.stdin,
        process.shell,
        process.limits,
    )


def digest_of(*content: object) -> str:
    """Return the digest of a process that is not made yet, of the same in the same order."""
    found: str = sha256(_text(content).encode("utf-8", "surrogatepass")).hexdigest()
    return found
