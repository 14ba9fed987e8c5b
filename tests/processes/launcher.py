"""Runs a document that stands in a file, as `orchestra launch` runs the one that its resolver makes.

launcher.py DOCUMENT            hand over the document
launcher.py - exit=N            the resolver refuses with this status
launcher.py - garbage           the resolver writes something else
launcher.py - raise             the resolver has a bug
launcher.py - wait              the resolver never comes to an end; says "resolving" first
launcher.py - litter            the resolver leaves a process behind and refuses with 2
"""

import os
import signal
import subprocess
import sys
from pathlib import Path
from typing import BinaryIO

from orchestra.control.entrance import afterwards, attend
from orchestra.supervise.run import run


def prepare(stream: BinaryIO) -> int:
    document, *words = sys.argv[1:]
    if document != "-":
        stream.write(Path(document).read_bytes())
        return 0
    name, _, value = words[0].partition("=")
    if name == "garbage":
        stream.write(b"\x80 no plan")
    if name == "raise":
        raise RuntimeError("a bug of the resolver")
    if name == "wait":
        sys.stderr.write("resolving\n")
        sys.stderr.flush()
        while True:  # a dump of the stacks on SIGQUIT ends a pause too
            signal.pause()
    if name == "litter":
        os.setsid() if os.getpid() != os.getsid(0) else None
        subprocess.Popen(["sleep", "1000"], start_new_session=True)
        return 2
    return int(value or 0)


sys.exit(run(prepare, attend, afterwards))
