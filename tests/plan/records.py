"""Plans made by hand, for tests of what is done with plans."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from hypothesis import strategies as st

from orchestra.location import Location, Span
from orchestra.plan.digest import digest
from orchestra.plan.model import VERSION, Plan, Process, Provenance


def at(line: int, file: str = "two.yaml") -> Location:
    """Return a place in a launch file."""
    return Location(Span(file, line, 5, line, 9))


def process(identity: str, *command: str, **changes: Any) -> Process:
    """Return a process of the plan that is nothing but its command, unless changes say more."""
    bare = Process(
        id=identity,
        kind="process",
        package=None,
        executable=command[0] if command else "true",
        name=None,
        namespace=None,
        command=command or ("true",),
        shell=False,
        prefix=(),
        environment={},
        inherit_environment=True,
        cwd=None,
        parameters={},
        parameter_files=(),
        remappings=(),
        arguments=(),
        output=None,
        emulate_tty=None,
        stdin=None,
        restart=None,
        required=False,
        success_exit_codes=None,
        ready=None,
        alive=None,
        lifecycle=None,
        depends_on=(),
        stop=None,
        limits=None,
        warm=None,
        machine=None,
        digest="",
        location=at(3),
        provenance=Provenance(),
    )
    made = replace(bare, **changes)
    return replace(made, digest=digest(made))


def node(identity: str, *command: str, **changes: Any) -> Process:
    """Return a node that is called by its id."""
    namespace, _, name = identity.rpartition("/")
    return process(
        identity, *command, **{"kind": "node", "name": name, "namespace": namespace or "/", **changes}
    )


def plan(*processes: Process, **changes: Any) -> Plan:
    """Return the plan of these processes."""
    return replace(Plan(VERSION, "two.yaml", (), processes, (), (), (), ()), **changes)


# Anything that a word of a command line can be: whatever the system passes on, NUL apart, as Python has it.
words = st.one_of(
    st.text(st.characters(exclude_characters="\0", exclude_categories=["Cs"]), max_size=12),
    st.binary(max_size=8).map(lambda data: data.replace(b"\0", b"").decode(errors="surrogateescape")),
    st.sampled_from(
        [
            "",
            "'",
            '"',
            "$HOME",
            "`id`",
            "$(id)",
            "a\nb",
            "\\",
            "\\\n",
            "!!",
            "*",
            "~",
            "-n",
            "#",
            "${run}",
            "a${run}/b",
            "\r\n",
            "\x1b[0m",
            "ä€\U0001f600",
            "END",
            "a=b",
            "{a,b}",
            "$'x'",
        ]
    ),
)
