"""The table of commands. A command's module has `parser()` and `run(options)` and is imported when it is called.

It may have `read(words)` too, which gives the same options as its parser, in less time.
"""

from __future__ import annotations

from typing import Final


class Command:
    """Where a command is and what it does, in a few words. To make fifty takes a dataclass a millisecond."""

    __slots__ = ("module", "summary")

    def __init__(self, module: str, summary: str) -> None:
        self.module: Final = module
        self.summary: Final = summary


COMMANDS: Final[dict[str, Command]] = {
    "launch": Command("orchestra.cli.launch", "start what a launch file describes, watch it, stop it"),
    "run": Command("orchestra.cli.run", "start one node"),
    "ps": Command("orchestra.cli.ps", "show which runs are alive, and how their processes stand"),
    "logs": Command("orchestra.cli.logs", "show what the processes of a run have written"),
    "events": Command("orchestra.cli.events", "show what has happened in a run"),
    "crash": Command("orchestra.cli.crash", "show why processes of a run have ended"),
    "start": Command("orchestra.cli.start", "start processes of a run"),
    "stop": Command("orchestra.cli.stop", "end processes of a run"),
    "restart": Command("orchestra.cli.restart", "end processes of a run and start them anew"),
    "signal": Command("orchestra.cli.signal", "send a signal to processes of a run"),
    "attach": Command("orchestra.cli.attach", "see what a process writes, and type what it reads"),
    "down": Command("orchestra.cli.down", "end a run"),
    "clean": Command("orchestra.cli.clean", "end what runs that died have left"),
    "plan": Command("orchestra.cli.plan", "show what a launch file would start"),
    "check": Command("orchestra.cli.check", "find what is wrong in launch files and parameter files"),
    "format": Command("orchestra.cli.format", "write launch files and parameter files in one form"),
    "convert": Command("orchestra.cli.convert", "write a launch file in another language"),
    "explain": Command(
        "orchestra.cli.explain", "explain a code of a problem, with a wrong and a right example"
    ),
    "schema": Command(
        "orchestra.cli.schema",
        "print the JSON Schema of files, or capture that of a running node",
    ),
    "node": Command("orchestra.cli.ros.node", "show the nodes that run, and what they have"),
    "topic": Command("orchestra.cli.ros.topic", "show topics and their messages, publish some"),
    "service": Command("orchestra.cli.ros.service", "show services and call them"),
    "param": Command("orchestra.cli.ros.param", "show and set parameters of running nodes"),
    "action": Command("orchestra.cli.ros.action", "show actions and send goals to them"),
    "lifecycle": Command("orchestra.cli.ros.lifecycle", "show and change the states of lifecycle nodes"),
    "component": Command("orchestra.cli.ros.component", "show, load and unload components of containers"),
    "interface": Command("orchestra.cli.ros.interface", "show types of messages, services and actions"),
    "pkg": Command("orchestra.cli.ros.pkg", "show the packages that are installed"),
    "tf": Command("orchestra.cli.ros.tf", "show the transforms between frames"),
    "graph": Command("orchestra.cli.ros.graph", "draw which nodes talk on which topics"),
    "doctor": Command("orchestra.cli.ros.doctor", "say what is wrong in the running graph"),
    "bag": Command("orchestra.cli.ros.bag", "record messages and play them again"),
    "teleop": Command("orchestra.cli.ros.teleop", "drive a robot with the keys"),
    "multicast": Command("orchestra.cli.ros.multicast", "try whether discovery can reach other machines"),
    "daemon": Command("orchestra.cli.ros.daemon", "nothing: there is no daemon"),
    "completion": Command(
        "orchestra.cli.completion", "print what makes a shell complete these command lines"
    ),
}
# Other names of commands, as the ROS 2 tools have them.
ALIASES: Final = {"wtf": "doctor"}


def overview() -> str:
    """Return the text of `orchestra --help`."""
    rows = "".join(f"  {name:<10} {command.summary}\n" for name, command in COMMANDS.items())
    return (
        "usage: orchestra [--help] [--version] COMMAND ...\n\n"
        "Launches, checks and supervises systems of ROS 2 nodes.\n\n"
        f"commands:\n{rows}\n"
        "'orchestra COMMAND --help' tells more about one of them.\n"
    )
