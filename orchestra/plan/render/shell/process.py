"""One process as lines of bash: what is around it, its command line, its start."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from orchestra.plan.render.details import process_kind
from orchestra.plan.render.shell import waiting
from orchestra.plan.render.shell.words import comment, is_name, word, words
from orchestra.resolve.quantities import UNLIMITED

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from orchestra.plan.model import Component, Process
    from orchestra.plan.render.setting import Additions
    from orchestra.values import Limits

# Variables that tell whom a process belongs to; `orchestra clean` finds what a dead run has left by them.
_PROCESS = "ORCHESTRA_PROCESS"
_RUN = "ORCHESTRA_RUN"
_LEAVES_OUT: Final = (
    ("restart", "it is not started again when it ends"),
    ("alive", "its signs of life are not watched"),
    ("lifecycle", "nobody brings it to a state: `ros2 lifecycle set` does"),
)


def introduction(process: Process, components: Mapping[str, list[Component]]) -> Iterator[str]:
    """Yield comments: what it is, what it waits for, and what of the plan a script does not do."""
    yield comment(f"{process.id}: {process_kind(process)}, {process.location}")
    yield from waiting.notes(process)
    for key, told in _LEAVES_OUT:
        if getattr(process, key) is not None and getattr(process, key) is not False:
            yield comment(f"{key}: {told}")
    if process.limits is not None and process.limits.memory is not None:
        yield comment(f"limits: no more than {process.limits.memory} bytes of memory are not seen to")
    for component in components.get(process.id, ()):
        plugin = f"{component.package} {component.plugin}"
        yield comment(f"component {component.id}: ros2 component load {component.container} {plugin}")


def around(process: Process, number: int, additions: Additions) -> list[str]:
    """Return the function that makes folder and environment those of a process."""
    lines = [f"cd -- {word(process.cwd)} || exit"] if process.cwd else []
    if process.inherit_environment:
        lines += _changes(process.environment)
        if "LD_LIBRARY_PATH" in process.environment and additions.before.get("LD_LIBRARY_PATH"):
            lines += [f"unset -v {name}" for name in additions.variables if name.startswith("_ROS_WHEELS")]
        lines.append(f"export {_PROCESS}={word(process.id)}")
    return [f"around_{number}() {{", *(f"  {line}" for line in lines or [":"]), "}"]


def _changes(environment: Mapping[str, str | None]) -> Iterator[str]:
    for name, value in environment.items():
        if is_name(name):
            yield f"unset -v {name}" if value is None else f"export {name}={word(value)}"


def start(process: Process, number: int, additions: Additions) -> list[str]:
    """Return the lines that start it in the background, in a group of its own, and note its number."""
    stdin = "" if process.stdin else " </dev/null"
    # Only where somebody waits for a line of it does its output go through a file.
    heard = process.ready is not None and process.ready.log is not None
    output = f' > >(tee -- "$run/logs/{number}.log") 2>&1' if heard else ""
    before = [f': >"$run/logs/{number}.log"'] if heard else []
    return [
        *before,
        "set -m",
        f"(around_{number}; exec -- {' '.join(_command(process, additions))}){stdin}{output} &",
        f"set +m; pids[{number}]=$!",
    ]


def _command(process: Process, additions: Additions) -> Iterator[str]:
    argv = ("/bin/sh", "-c", " ".join(process.command)) if process.shell else process.command
    if process.limits is not None:
        yield from _limited(process.limits)
    odd = {name: value for name, value in process.environment.items() if not is_name(name)}
    if not process.inherit_environment:
        bare = {**additions.bare, **process.environment, _PROCESS: process.id}
        yield f'env -i {_RUN}="${_RUN}" {_assigned(bare)}'
    elif odd:
        yield f"env {_assigned(odd)}"
    yield words(argv)


def _assigned(environment: Mapping[str, str | None]) -> str:
    unset = [f"-u {word(name)}" for name, value in environment.items() if value is None]
    return " ".join(
        [*unset, *(word(f"{name}={value}") for name, value in environment.items() if value is not None)]
    )


def _limited(limits: Limits) -> Iterator[str]:
    """Yield the programs of util-linux and coreutils that set limits and then become the command."""
    if limits.rlimits:
        pairs = (
            f"--{name}={':'.join('unlimited' if item == UNLIMITED else str(item) for item in pair)}"
            for name, pair in limits.rlimits.items()
        )
        yield f"prlimit {' '.join(pairs)} --"
    if limits.cores is not None:
        yield f"taskset -c {','.join(map(str, limits.cores))}"
    if limits.scheduler is not None:
        yield f"chrt --{limits.scheduler} {limits.priority or 0}"
    if limits.nice is not None:
        yield f"nice -n {limits.nice}"
