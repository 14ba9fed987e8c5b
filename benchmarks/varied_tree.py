"""A tree of launch files in YAML as people write them: nodes of many kinds, hardly two with the same keys in order."""

from __future__ import annotations

from random import Random
from typing import TYPE_CHECKING, Final

from benchmarks import levels, node_tree

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence
    from pathlib import Path

# So many nodes in a file, and of a group.
_NODES: Final = 20
_TOGETHER: Final = 3

_ARGUMENTS: Final = """\
launch:
  - arg: {name: robot}
  - arg: {name: mode, default: sim, description: "sim, or the real one"}
  - arg:
      name: debug
      default: "false"
  - let: {name: base, value: $(var robot)/base}
"""
# Each is there or not; {n} is the number of the node, and of the file that it is in.
_PARTS: Final = (
    ("namespace: $(var robot)", "namespace: part{n}", "namespace: '/$(var robot)/sub'"),
    ("output: screen", 'output: "log"'),
    ("args: --id {n} --verbose", 'args: "--frame $(var base) -n {n}"'),
    ("respawn: true\nrespawn_delay: 1.5", "on_exit: shutdown"),
    ("env:\n  - {{name: ROBOT, value: $(var robot)}}", "env:\n  - name: LEVEL\n    value: '{n}'"),
    ("if: $(eval \"'$(var mode)' == 'sim'\")", "unless: $(var debug)", "if: \"$(eval '{n} >= 0')\""),
    ("remap:\n  - {{from: scan, to: scan{n}}}\n  - from: odom\n    to: /$(var robot)/odom",),
)
_VALUES: Final = (
    "- {{name: rate{m}, value: {n}.5}}",
    "- name: frame{m}\n  value: $(var base)",
    '- {{name: label{m}, value: "robot {n}"}}',
    "- {{name: gains{m}, value: [1.0, 2.0, {n}.5]}}",
    "- {{name: on{m}, value: true}}",
    "- name: names{m}\n  value: [left, right]",
)
_INCLUDES: Final = (
    "  - include: {{file: $(dirname)/{file}, arg: [{{name: robot, value: {robot}}}]}}\n",
    """\
  - include:
      file: "$(dirname)/{file}"
      arg:
        - name: robot
          value: {robot}
        - name: mode
          value: sim
""",
)


def write(folder: Path, nodes: int) -> Path:
    """Write a tree with so many nodes; return the file at its top."""
    node_tree.write_package(folder)
    rnd = Random(nodes)  # noqa: S311 - the same every time
    folder = folder / f"varied{nodes}"
    folder.mkdir()
    node_tree.write_parameters(folder / "shared.yaml", 1)
    level = []
    for first in range(0, nodes, _NODES):
        numbers = range(first, min(nodes, first + _NODES))
        node_tree.write_parameters(folder / f"robot{first}.yaml", first + 1)
        file = f"robot{first}.launch.yaml"
        (folder / file).write_text(_ARGUMENTS + "".join(_actions(numbers, rnd)))
        level.append((file, f"robot{first}"))

    def including(name: str, files: Sequence[levels.File]) -> levels.File:
        path = folder / f"{name}.launch.yaml"
        includes = [
            _INCLUDES[number % 2].format(file=file, robot=robot) for number, (file, robot) in enumerate(files)
        ]
        path.write_text("".join(["launch:\n", *includes]))
        return path.name, name

    return folder / levels.top(level, including)


def _actions(numbers: range, rnd: Random) -> Iterable[str]:
    waiting = list(numbers)
    while waiting:
        if rnd.random() < 1 / _TOGETHER:
            together, waiting = waiting[:_TOGETHER], waiting[_TOGETHER:]
            yield f"  - group:\n      - push_ros_namespace: {{namespace: group{together[0]}}}\n"
            yield from (_indented(_node(number, numbers[0], rnd), 6) for number in together)
        else:
            yield _indented(_node(waiting.pop(0), numbers[0], rnd), 2)


def _node(number: int, file: int, rnd: Random) -> str:
    """Return a node: where it is, some of all that can be said of it, and parameters, in any order."""
    parts = [rnd.choice(part).format(n=number) for part in _PARTS if rnd.random() < 1 / _TOGETHER]
    values = [text.format(n=number, m=m) for m, text in enumerate(rnd.choices(_VALUES, k=rnd.randrange(7)))]
    if rnd.random() < 1 / _TOGETHER:
        values.insert(0, f"- from: $(dirname)/{rnd.choice(('shared', f'robot{file}'))}.yaml")
    parts.append(f"name: node{number}")
    if values:
        parts.append("param:\n" + _indented("\n".join(values), 2).rstrip("\n"))
    rnd.shuffle(parts)
    words = _indented("\n".join(["pkg: benchmark_widget", "exec: widget", *parts]), 4)
    return f"- node:\n{words}"


def _indented(text: str, blanks: int) -> str:
    return "".join(f"{' ' * blanks}{line}\n" for line in text.splitlines())
