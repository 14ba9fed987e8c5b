"""What is done in a child before its program begins, and how its failure reaches the parent.

`subprocess` itself says no more than that something has failed, so the reason goes through a pipe that closes when the
program begins (O_CLOEXEC).
"""

from __future__ import annotations

import errno
import json
import os
import subprocess
from contextlib import contextmanager
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

# A pipe takes this at once and never blocks (pipe(7), PIPE_BUF). The texts are cut so that they fit, escaped as JSON.
_LONGEST = 4096
_LONGEST_TEXT = 300


@contextmanager
def reported(action: Callable[[], None]) -> Iterator[Callable[[], None]]:
    """Give what `subprocess.Popen` is to call in the child: `action`, whose `OSError` is raised here, in the parent."""
    read, told = os.pipe2(os.O_CLOEXEC | os.O_NONBLOCK)

    def act() -> None:
        try:
            action()
        except OSError as error:
            _tell(told, error)
            raise

    try:
        yield act
    except subprocess.SubprocessError as error:
        raise _reason(read) from error
    finally:
        os.close(read)
        os.close(told)


def _tell(descriptor: int, error: OSError) -> None:
    text, file = (error.strerror or str(error))[:_LONGEST_TEXT], str(error.filename or "")[-_LONGEST_TEXT:]
    os.write(descriptor, json.dumps([error.errno, text, file]).encode())


def _reason(descriptor: int) -> OSError:
    try:
        number, text, file = json.loads(os.read(descriptor, _LONGEST))
    except BlockingIOError:  # it could not even tell: no memory within its limits
        return OSError(errno.ENOMEM, "its process could not be prepared: too little memory within its limits")
    return OSError(number, text, file or None)
