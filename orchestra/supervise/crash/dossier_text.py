"""A dossier for people: from the document of `report.json` to the text of `report.txt`."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Iterator

_MEGABYTE = 1 << 20
_SHOWN_RUNS = 10


def text_of(document: dict[str, Any]) -> str:
    """Return the text of a dossier."""
    parts = (_head, _lines, _threads, _core, _repeat, _history, _resources, _environment)
    return "\n\n".join("\n".join(part) for maker in parts if (part := list(maker(document)))) + "\n"


def summary(document: dict[str, Any]) -> str:
    """Return one line about a dossier."""
    return f"{_moment(document['ended'])}  {document['process']}  {document['cause']['ending']}"


def _head(document: dict[str, Any]) -> Iterator[str]:
    cause = document["cause"]
    yield f"{document['process']}: {cause['ending']}" + (" (core dumped)" if cause["core_dumped"] else "")
    if cause["out_of_memory"]:
        yield f"    {cause['out_of_memory']}"
    elif cause["meaning"]:
        yield f"    {cause['meaning']}"
    for line in cause["evidence"]:
        yield f"    > {line}"
    yield ""
    yield f"when      {_moment(document['ended'])}, {document['uptime']:.3f} s after start {document['start']}"
    if document["pid"] is not None:
        yield f"pid       {document['pid']}"
    yield f"run       {document['run']}"
    yield f"written   {document['location']}"


def _lines(document: dict[str, Any]) -> Iterator[str]:
    if not document["lines"]:
        yield f"it wrote nothing; log: {document['log']}"
        return
    yield f"last lines (all of them: {document['log']})"
    yield from (f"    {line}" for line in document["lines"])


def _threads(document: dict[str, Any]) -> Iterator[str]:
    if document["threads"]:
        yield "where its threads were when it hung"
        yield from (f"    {line}" for line in document["threads"])


def _core(document: dict[str, Any]) -> Iterator[str]:
    if document["core_advice"]:
        yield "core file"
        if document["core"]:
            yield f"    {document['core']}"
        yield f"    {document['core_advice']}"


def _repeat(document: dict[str, Any]) -> Iterator[str]:
    yield "to run it again by hand"
    yield from (f"    {line}" for line in document["repeat"].split("\n"))
    for file in document["parameter_files"]:
        yield f"    parameters: {file}"


def _history(document: dict[str, Any]) -> Iterator[str]:
    runs = document["history"][-_SHOWN_RUNS:]
    earlier = document["runs_before"] + len(document["history"]) - len(runs)
    yield "its runs so far"
    if earlier:
        yield f"    {earlier} before these"
    for run in runs:
        yield f"    {run['start']:>3}  {_moment(run['began'])}  {run['uptime']:>9.3f} s  {run['ending']}"


def _resources(document: dict[str, Any]) -> Iterator[str]:
    used = document["resources"]
    yield "resources"
    if used["peak_memory"] is not None:
        bound = "at most " if used["at_most"] else ""
        yield f"    largest process: {bound}{used['peak_memory'] / _MEGABYTE:.1f} MiB"
    if used["capped_peak"] is not None:
        yield f"    all together: {used['capped_peak'] / _MEGABYTE:.1f} MiB"
    if used["user_time"] is not None:
        yield f"    processor: {used['user_time']:.2f} s, in the kernel {used['system_time']:.2f} s"
    written = {
        name: value for name, value in (document["limits"] or {}).items() if value not in (None, {}, False)
    }
    if written:
        yield "    limits: " + ", ".join(f"{name} {value}" for name, value in written.items())
    bounds = {name: values[0] for name, values in document["rlimits"].items() if values[0] != -1}
    yield "    in force: " + ", ".join(f"{name} {value}" for name, value in bounds.items())


def _environment(document: dict[str, Any]) -> Iterator[str]:
    changes = document["environment"]
    yield "environment, compared with the launcher's"
    for name, value in changes["added"].items():
        yield f"    + {name}={value}"
    for name, (before, now) in changes["changed"].items():
        yield f"    ~ {name}={now}"
        yield f"      {' ' * len(name)} was {before}"
    for name in changes["removed"]:
        yield f"    - {name}"
    if not any(changes.values()):
        yield "    the same"


def _moment(seconds: float) -> str:
    whole = time.strftime("%Y-%m-%d %H:%M:%S", time.localtime(seconds))
    return f"{whole}.{int(seconds * 1000) % 1000:03}"
