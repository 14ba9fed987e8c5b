"""What is said between the supervisor and the fork server: one JSON object per message of a SOCK_SEQPACKET socket.

To the server:

    {"prepare": [[KIND, TARGET], ...]}
        nodes will be asked for whose programs are these: `script` with its path, `module` with its name
    {"id": N, "kind": KIND, "target": TARGET, "words": [...], "executable": PATH, "comm": NAME, "cwd": PATH or null,
     "set": {...}, "unset": [...], "mark": N or null, "limits": LIMITS or null, "place": TEXT}
        start a node. `words` is what its command line shows, `executable` the path by which its interpreter would have
        been found, `comm` the name of the process; `set` and `unset` is in what its environment differs from the
        server's. With it come descriptors: the node's own end of a stream socket, its output, its errors, and its
        input where that is not /dev/null.

From the server:

    {"id": N, "pid": PID}        it is there, waits, and is the supervisor's child
    {"id": N, "cold": REASON}    it is not; the server goes on
    {"unusable": REASON}         nothing can be started warm, and the server ends

On its stream socket a node waits for one byte before it begins. What it sends back says why it does not begin:
`[ERRNO, TEXT, FILE or null]` for what a cold start would fail with too, `{"cold": REASON}` where only a cold start will
do. Where the socket closes without a word the program runs. The server ends when its socket is closed.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.plan.codec import encode
from orchestra.plan.startup import is_read_at_startup

if TYPE_CHECKING:
    from collections.abc import Mapping

    from orchestra.plan.model import Process
    from orchestra.supervise.process.spec import Spec


def request(number: int, process: Process, spec: Spec, served: Mapping[str, str]) -> dict[str, Any]:
    """Return the request for a process that can be started warm; `served` is the environment of the server."""
    warm = process.warm
    if warm is None:
        raise ValueError(f"the plan does not say how {process.id} is started warm")
    words = [*warm.interpreter, *spec.command[warm.skip :]]
    return {
        "id": number,
        "kind": warm.kind,
        "target": warm.target,
        "executed": warm.skip == 0,
        "words": words,
        "executable": warm.executable,
        "comm": warm.comm,
        "cwd": spec.cwd,
        "set": {name: value for name, value in spec.environment.items() if served.get(name) != value},
        "unset": [name for name in served if name not in spec.environment],
        "mark": spec.mark,
        "limits": None if process.limits is None else encode(process.limits),
        "place": str(process.location),
    }


def obstacle(environment: Mapping[str, str], served: Mapping[str, str]) -> str | None:
    """Return the variable that an interpreter reads when it starts, and that differs from the server's, if any."""
    names = (name for name in {**environment, **served} if environment.get(name) != served.get(name))
    return next(filter(is_read_at_startup, names), None)
