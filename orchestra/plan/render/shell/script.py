"""A plan as a script that starts the same processes by hand.

For bash, 5 or later: it has what this needs and the standard shell lacks. What a standard shell starts in the
background ignores SIGINT, and there is no way back (POSIX, Shell Command Language, 2.12); with job control, each
process has a group and signals of its own, so that the script can end the whole of it. Bash also has arrays, opens
connections, and its clock counts microseconds.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.dataclass import dataclass
from orchestra.plan.model import Component, Process
from orchestra.plan.parameter_file import contents
from orchestra.plan.reactions import StartAction
from orchestra.plan.render.setting import Additions, Setting
from orchestra.plan.render.shell import process as one
from orchestra.plan.render.shell import waiting
from orchestra.plan.render.shell.order import in_order
from orchestra.plan.render.shell.words import comment, is_name, word, written, written_bytes
from orchestra.plan.render.triggers import trigger_lines
from orchestra.values import Stop

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from orchestra.plan.model import Plan

_HEAD = """\
# Whoever starts it with sh gets bash, which is what it is written for.
if [ -z "${BASH_VERSION:-}" ]; then
  [ -f "$0" ] || { echo "this is a script for bash" >&2; exit 2; }
  exec bash "$0" "$@"
fi
set -u

# The run directory; it stays, as that of a run does.
run=$(mktemp -d "${TMPDIR:-/tmp}/orchestra.XXXXXXXX") || exit
echo "run directory: $run" >&2
mkdir -p "$run/params" "$run/logs/ros" "$run/files" || exit
"""
_FUNCTIONS = """\
pids=() ended=() names=() wanted=() signals=() failed=0 began=${EPOCHREALTIME/[.,]/}

# A pause that a signal ends.
pause() {
  sleep "$1" &
  wait "$!"
}

started() {
  [[ -v pids[$1] || -v ended[$1] ]]
}

# Whether the group of a process is there, in which all are that it has started.
is_there() {
  kill -0 -- "-${pids[$1]}" 2>/dev/null
}

# Notes the end of a process where it has ended: its status is in `ended`.
look_after() {
  local status
  kill -0 "${pids[$1]}" 2>/dev/null && return
  wait "${pids[$1]}"
  status=$?
  ended[$1]=$status
  ((status == 0)) || failed=1
  echo "${names[$1]} has ended with status $status" >&2
}

# wait_for N SECONDS PROBE: until the probe succeeds; 0 seconds are without end.
wait_for() {
  local begin=$SECONDS
  started "$1" || return
  until "$3"; do
    [[ -v ended[$1] ]] || look_after "$1"
    [[ ! -v ended[$1] ]] || return
    (($2 == 0 || SECONDS - begin < $2)) || return
    pause 0.1
  done
}

# over N: until a process has ended.
over() {
  started "$1" || return
  until [[ -v ended[$1] ]]; do
    pause 0.1
    look_after "$1"
  done
}

# wait_until MILLISECONDS: since the start of the run.
wait_until() {
  until ((${EPOCHREALTIME/[.,]/} - began >= $1 * 1000)); do
    pause 0.05
  done
}

# send SIGNAL: to all groups that are there; the one that each wants where none is named. Fails where there is none.
send() {
  local n left=1
  for n in "${!pids[@]}"; do
    if is_there "$n"; then
      left=0
      [[ $1 == 0 ]] || kill -s "${1:-${signals[n]}}" -- "-${pids[n]}" 2>/dev/null
    fi
  done
  return "$left"
}

# finish STATUS: ends everything, as gently as it can be.
finish() {
  local signal patience
  trap '' HUP INT TERM
  for signal in '' TERM KILL; do
    send "$signal" || break
    for ((patience = 0; patience < grace; patience++)); do
      send 0 || break
      for n in "${!pids[@]}"; do
        [[ -v ended[$n] ]] || look_after "$n"
      done
      pause 0.1
    done
  done
  exit "$1"
}

trap 'finish 129' HUP
trap 'finish 130' INT
trap 'finish 143' TERM
"""
_END = """\
# Until all have ended, or one has without which the others are of no use.
while :; do
  left=0
  for n in "${!pids[@]}"; do
    [[ -v ended[$n] ]] && continue
    look_after "$n"
    if [[ ! -v ended[$n] ]]; then
      left=1
    elif [[ -v wanted[$n] ]]; then
      finish "${ended[$n]}"
    fi
  done
  ((left)) || finish "$failed"
  pause 0.2
done
"""


def render(plan: Plan, setting: Setting = Setting(), /) -> str:  # noqa: B008 - it is frozen
    """Return the script. Bytes that are no Unicode are surrogates in it, as the system's own calls have them."""
    additions = setting.additions or Additions()
    order = in_order(plan)
    whole = _Whole(
        {process.id: number for number, process in enumerate(order, 1)},
        {process.id: process for process in order},
        _loaded(plan.components),
        additions,
    )
    late, held = dict(_late(plan)), _held(plan)
    first = [process for process in order if process.id not in held]
    then = [process for process in order if process.id in late]
    sections = [
        ["#!/usr/bin/env bash", *_introduction(plan)],
        _HEAD.splitlines(),
        *_environment(additions),
        *_files(plan),
        [*_FUNCTIONS.splitlines(), f"grace={_grace(plan)}"],
        *(_section(process, whole, None) for process in first),
        *(
            _section(process, whole, late[process.id])
            for process in sorted(then, key=lambda item: late[item.id])
        ),
        _END.splitlines(),
    ]
    return "\n".join("".join(f"{line}\n" for line in section) for section in sections)


def _introduction(plan: Plan) -> Iterator[str]:
    yield comment(f"What {plan.file} starts, by hand. Start it in the folder in which the plan was made.")
    yield comment(
        "Restarts, signs of life, states of lifecycle nodes, components and triggers need Orchestra."
    )
    for line in trigger_lines(plan.triggers):
        yield comment(f"trigger: {line}")
    held = _held(plan) - dict(_late(plan)).keys()
    for process in plan.processes:
        if process.id in held:
            yield comment(f"not started here: {process.id}, which a trigger starts")


def _environment(additions: Additions) -> Iterator[list[str]]:
    """Yield what a run adds to the environment of its processes."""
    lines = [
        comment("What a run adds to the environment of all its processes."),
        'printf -v ORCHESTRA_RUN \'%x-%d\' "$(date +%s%N)" "$$"',
        "export ORCHESTRA_RUN",
    ]
    lines += [f"export {name}={word(value)}" for name, value in additions.variables.items() if is_name(name)]
    lines += [f"export {name}={word(value)}${{{name}:+:${name}}}" for name, value in additions.before.items()]
    lines += [f"export {name}=${{{name}:+${name}:}}{word(value)}" for name, value in additions.after.items()]
    yield lines
    for path, content in additions.files.items():
        text = content.decode(errors="surrogateescape")
        yield written_bytes(path, content) if "${run}" in text else written(path, text)


def _files(plan: Plan) -> Iterator[list[str]]:
    for process in plan.processes:
        for path, text in contents(process).items():
            yield written(path, text)


def _held(plan: Plan) -> set[str]:
    """Return the processes that do not start with the run."""
    return {
        action.process
        for trigger in plan.triggers
        for action in trigger.do
        if isinstance(action, StartAction)
    }


def _late(plan: Plan) -> Iterator[tuple[str, float]]:
    """Yield the processes that start a while after the start of the run, with that time in seconds."""
    for trigger in plan.triggers:
        if trigger.on.event == "run_started" and trigger.armed:
            for action in trigger.do:
                if isinstance(action, StartAction):
                    yield action.process, trigger.delay or 0.0


def _grace(plan: Plan) -> int:
    """Return how long a signal may take to act, in tenths of a second."""
    stops = [process.stop or Stop() for process in plan.processes] or [Stop()]
    return max(1, round(10 * max(max(stop.timeout, stop.kill_timeout) for stop in stops)))


@dataclass(frozen=True, slots=True)
class _Whole:
    """What of the whole plan counts for each process: numbers and processes by name, components by their process."""

    numbers: dict[str, int]
    others: dict[str, Process]
    loaded: dict[str, list[Component]]
    additions: Additions


def _section(process: Process, whole: _Whole, delay: float | None) -> list[str]:
    number = whole.numbers[process.id]
    starting = [f"names[{number}]={word(process.id)}"]
    starting += [f"signals[{number}]={(process.stop or Stop()).signal.removeprefix('SIG')}"]
    starting += [f"wanted[{number}]=1"] if process.required else []
    starting += one.start(process, number, whole.additions)
    return [
        *one.introduction(process, whole.loaded),
        *one.around(process, number, whole.additions),
        *waiting.probe(process, number),
        *([] if delay is None else [f"wait_until {round(1000 * delay)}"]),
        *_conditional(process.id, waiting.waits(process, whole.numbers, whole.others), starting),
    ]


def _conditional(identity: str, conditions: list[str], starting: list[str]) -> list[str]:
    if not conditions:
        return starting
    skipped = f"echo {word(f'{identity} is skipped: what it waits for has not come about')} >&2"
    together = " && ".join(conditions)
    return [f"if {together}; then", *(f"  {line}" for line in starting), "else", f"  {skipped}", "fi"]


def _loaded(components: Sequence[Component]) -> dict[str, list[Component]]:
    found: dict[str, list[Component]] = {}
    for component in components:
        if component.process is not None:
            found.setdefault(component.process, []).append(component)
    return found
