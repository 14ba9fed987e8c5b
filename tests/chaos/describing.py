"""From a case to what a run is given: a plan as a document, or a launch file with the same processes."""

from __future__ import annotations

import json
import sys
from typing import TYPE_CHECKING, Any

from orchestra.supervise.options import RunOptions
from orchestra.supervise.resolver import document
from orchestra.values import Limits, Restart, Stop
from tests.chaos.cases import member_words
from tests.supervise.plans import PROCESSES, after, plan, process, ready_when

if TYPE_CHECKING:
    from pathlib import Path

    from orchestra.plan.model import Process
    from tests.chaos.cases import Case, Member, Root

NEVER = "/never"
# More than any member needs: 50 of them at once, too.
_CAP = 1 << 30


def prepared(case: Case, folder: Path, cookie: str) -> tuple[str, ...]:
    """Write what the run needs into a folder, and return the command that starts it."""
    if case.door == "document":
        path = folder / "document.json"
        path.write_bytes(
            document.dumps(plan(*(_process(root, cookie) for root in case.roots)), RunOptions(name="chaos"))
        )
        launcher = "leaping.py" if case.leaps else "launcher.py"
        return (sys.executable, str(PROCESSES / launcher), str(path))
    path = folder / "chaos.launch.yaml"
    path.write_text(json.dumps({"launch": [{"executable": _action(root, cookie)} for root in case.roots]}))
    return (sys.executable, "-m", "orchestra", "launch", str(path))


def command_of(member: Member, cookie: str) -> tuple[str, ...]:
    """Return the command of a member; the cookie is only there to be seen."""
    return (sys.executable, "-S", "-E", str(PROCESSES / "tree.py"), cookie, member_words(member))


def _announcement(root: Root) -> str:
    return f"up {root.member.name} "


def _process(root: Root, cookie: str) -> Process:
    ready = None
    if root.never_ready:
        ready = ready_when(message=NEVER)
    elif root.ready:
        ready = ready_when(log=_announcement(root))
    changes: dict[str, Any] = {
        "restart": Restart("always") if root.respawn else None,
        "depends_on": after(root.needs[0], "ready" if root.needs_ready else "started") if root.needs else (),
        "limits": Limits(memory=_CAP) if root.capped else None,
        "stdin": True if root.stdin else None,
        "stop": Stop(timeout=root.stop[0], kill_timeout=root.stop[1]) if root.stop else None,
    }
    return process(
        root.member.name,
        command=command_of(root.member, cookie),
        required=root.required,
        emulate_tty=root.tty,
        ready=ready,
        **changes,
    )


def _action(root: Root, cookie: str) -> dict[str, Any]:
    action: dict[str, Any] = {
        "name": root.member.name,
        "cmd": list(command_of(root.member, cookie)),
        "required": root.required,
        "emulate_tty": root.tty,
        "respawn": root.respawn,
        "output": "both",
    }
    if root.never_ready:
        action["ready"] = {"message": NEVER}
    elif root.ready:
        action["ready"] = {"log": _announcement(root)}
    if root.needs:
        condition = "ready" if root.needs_ready else "started"
        action["depends_on"] = [{"process": name, "condition": condition} for name in root.needs]
    if root.capped:
        action["limits"] = {"memory": _CAP}
    if root.stdin:
        action["stdin"] = True
    if root.stop:
        action["stop"] = {"timeout": root.stop[0], "kill_timeout": root.stop[1]}
    return action
