"""What has to stay the same for a running process to be left alone."""

from __future__ import annotations

import json
import sys
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
    from orchestra.plan.model import Process

# Tuples are lists to it.
_text: Final = json.JSONEncoder(sort_keys=True, ensure_ascii=False, default=encode).encode


def digest(process: Process) -> str:
    """Return the SHA-256 of command, environment, cwd, parameter content, stdin, shell and limits."""
    return digest_of(
        process.command,
        (process.environment, process.inherit_environment),
        process.cwd,
        process.parameters,
        process.parameter_files,
        process.stdin,
        process.shell,
        process.limits,
    )


def digest_of(*content: object) -> str:
    """Return the digest of a process that is not made yet, of the same in the same order."""
    found: str = sha256(_text(content).encode("utf-8", "surrogatepass")).hexdigest()
    return found
