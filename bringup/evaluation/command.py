"""The command line of the evaluation: one function for each of its words."""

from __future__ import annotations

import argparse
import os
import sys
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

import yaml

from bringup.evaluation.bar import moments, summary, unmet
from bringup.evaluation.ground import facts
from bringup.evaluation.lockstep import laid_out, run
from bringup.evaluation.many import Runs, outcomes
from bringup.evaluation.recording import Writer, read
from bringup.evaluation.scenario import Choice, scenario
from bringup.evaluation.table import heading, lines, row
from bringup.evaluation.tracks import tracks, write
from bringup.world.layout import WORLDS

if TYPE_CHECKING:
    from collections.abc import Sequence

FAILED, WRONG = 1, 2


def main(words: Sequence[str] | None = None) -> int:
    """Do what the command line says; 0, 1 if a demand is not met, 2 if it cannot be done as asked."""
    arguments = parser().parse_args(words)
    try:
        status: int = arguments.run(arguments)
    except (OSError, ValueError) as error:
        sys.stderr.write(f"error: {error}\n")
        return WRONG
    return status


def parser() -> argparse.ArgumentParser:
    """All words and options."""
    made = argparse.ArgumentParser(prog="python -m bringup.evaluation", description=__doc__)
    words = made.add_subparsers(required=True, metavar="WORD")
    bar = words.add_parser(
        "consistency", help="run many seeds in lockstep and hold the errors against the demands"
    )
    bar.add_argument("--seeds", type=_whole, default=20, help="how many (default %(default)s)")
    bar.add_argument("--first-seed", type=int, default=1, help="default %(default)s")
    bar.add_argument(
        "--jobs", type=_whole, default=os.cpu_count() or 1, help="processes (default: one per core)"
    )
    bar.add_argument("--world", nargs="+", choices=list(WORLDS), default=["arena"], help="default: arena")
    _add_choice(bar)
    bar.set_defaults(run=consistency)
    lockstep = words.add_parser("run", help="run one seed in lockstep and write a recording")
    lockstep.add_argument("file", type=Path, help="the recording")
    _add_one(lockstep)
    lockstep.set_defaults(run=run_one)
    draw = words.add_parser("draw", help="draw a recording, or a new run in lockstep")
    draw.add_argument(
        "folder", type=Path, help="where trajectories, errors, consistency and report.html are written"
    )
    draw.add_argument("--recording", type=Path, help="what to draw (default: a run with the options below)")
    _add_one(draw)
    draw.set_defaults(run=draw_one)
    return made


def consistency(arguments: argparse.Namespace) -> int:
    """Print a row for each robot of each run, all of them together, and what is not as it should be."""
    choice = _choice(arguments)
    at = moments(choice.seconds)
    first = arguments.first_seed
    runs = Runs(tuple(arguments.world), tuple(range(first, first + arguments.seeds)), choice)
    _say(heading(at))
    found = []
    for outcome in outcomes(runs, arguments.jobs):
        found.append(outcome)
        _say(row(outcome))
    figures = summary(found, at)
    for line in lines(figures):
        _say(line)
    faults = list(unmet(figures))
    for fault in faults:
        _say(f"not met: {fault}")
    return FAILED if faults else 0


def run_one(arguments: argparse.Namespace) -> int:
    """Run a world and write what happened."""
    _simulate(arguments, arguments.file)
    return 0


def draw_one(arguments: argparse.Namespace) -> int:
    """Draw a recording; without one, of a run that is made for it."""
    # Here, because matplotlib takes longer to import than all the rest.
    from bringup.evaluation.pictures import draw  # noqa: PLC0415

    with TemporaryDirectory() as scratch:
        path = arguments.recording
        if path is None:
            path = Path(scratch) / "run"
            _simulate(arguments, path)
        recording = read(path)
    notes = () if recording.whole else ("The recording breaks off.",)
    for written in draw(tracks(recording), recording.facts, arguments.folder, notes):
        _say(str(written))
    return 0


def _simulate(arguments: argparse.Namespace, path: Path) -> None:
    chosen = scenario(_choice(arguments), world=arguments.world, seed=arguments.seed)
    world = chosen.world
    layout = laid_out(chosen)
    with Writer(path) as writer:
        writer.tell({"robots": list(world.robots), **facts(layout)})
        write(writer, run(chosen, innovations=True))


def _add_one(word: argparse.ArgumentParser) -> None:
    word.add_argument("--world", choices=list(WORLDS), default="arena", help="default: arena")
    word.add_argument("--seed", type=int, default=1, help="default %(default)s")
    _add_choice(word)


def _add_choice(word: argparse.ArgumentParser) -> None:
    word.add_argument("--seconds", type=_seconds, default=120.0, help="simulated (default %(default)s)")
    word.add_argument("--robots", type=_whole, default=2, help="default %(default)s")
    for node in ("simulation", "filter", "control"):
        word.add_argument(
            f"--{node}",
            nargs="+",
            default=[],
            metavar="NAME:=VALUE",
            help=f"parameters of the {node} that are to be different",
        )


def _choice(arguments: argparse.Namespace) -> Choice:
    robots = [f"robot{number}" for number in range(1, arguments.robots + 1)]
    return Choice(
        seconds=arguments.seconds,
        simulation={"robots": robots, **_changes(arguments.simulation)},
        filter=_changes(arguments.filter),
        control=_changes(arguments.control),
    )


def _changes(words: Sequence[str]) -> dict[str, Any]:
    changes = {}
    for word in words:
        name, found, value = word.partition(":=")
        if not found:
            raise ValueError(f"'{word}' is not NAME:=VALUE")
        changes[name] = yaml.safe_load(value)
    return changes


def _whole(text: str) -> int:
    number = int(text)
    if number < 1:
        raise ValueError(text)
    return number


def _seconds(text: str) -> float:
    number = float(text)
    if not number >= 1.0:
        raise ValueError(text)
    return number


def _say(line: str) -> None:
    sys.stdout.write(f"{line}\n")
    sys.stdout.flush()
