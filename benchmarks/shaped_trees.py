"""Trees of launch files of one form each: what a plan takes depends on what its files say, and in which language."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final, NamedTuple

from benchmarks import levels, node_tree, python_shapes

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from pathlib import Path


class Shape(NamedTuple):
    """How a file with some nodes is written, how many have room in one, and how many files another one includes.

    `python` writes the same nodes in Python.
    """

    yaml: Callable[[Sequence[int]], str]
    nodes: int = 20
    files: int = 10
    python: Callable[[Sequence[int]], str] | None = None


_INCLUDE: Final = """\
  - include:
      file: $(dirname)/{file}
      arg: [{{name: robot, value: {robot}}}, {{name: mode, value: $(var mode)}}]
"""
_ARGUMENTS: Final = """\
launch:
  - arg: {name: robot, default: nobody}
  - arg: {name: mode, default: sim, description: "sim, or the real one"}
  - arg: {name: debug, default: "false"}
"""
_NODE: Final = "pkg: benchmark_widget\n      exec: widget\n      name: widget{n}\n"
_WITH_FILES: Final = f"""\
  - node:
      {_NODE}\
      param:
        - {{{{from: $(dirname)/shared.yaml}}}}
        - {{{{from: $(dirname)/$(var mode).yaml}}}}
"""
_GROUP: Final = """\
  - group:
      - push_ros_namespace: {{namespace: $(var robot)/group{n}}}
      - let: {{name: side, value: left{n}}}
      - set_remap: {{from: scan, to: /$(var robot)/scan}}
"""
_GROUPED: Final = """\
      - node:
          pkg: benchmark_widget
          exec: widget
          name: widget{n}
          args: --side $(var side)
          param:
            - {{name: side, value: $(var side)}}
"""
_CONDITIONS: Final = (
    "if: $(eval \"'$(var mode)' == 'sim' and {n} >= 0\")",
    "unless: $(var debug)",
    "if: $(not $(var debug))",
    "if: $(eval \"'$(var robot)' in ('nobody', '$(var robot)')\")",
    "if: $(and $(not $(var debug)) $(eval \"len('$(var mode)') == 3\"))",
    "unless: $(eval \"'$(var mode)' != 'sim' or {n} < 0\")",
)
_KINDS: Final = (
    """\
  - executable:
      cmd: /bin/echo $(var robot) --id {n}
      name: widget{n}
      output: screen
      env:
        - {{name: ROBOT, value: $(var robot)}}
""",
    f"""\
  - lifecycle_node:
      {_NODE}\
      namespace: $(var robot)
      autostart: true
""",
    f"""\
  - node:
      {_NODE}\
      respawn: true
      respawn_delay: 2.0
      ros_args: --log-level debug
      param:
        - {{{{from: $(dirname)/shared.yaml}}}}
""",
    f"""\
  - group:
      - set_parameter: {{{{name: use_sim_time, value: true}}}}
      - node:
          {_NODE.replace("      ", "          ")}\
          namespace: part{{n}}
          remap:
            - {{{{from: odom, to: /$(var robot)/odom}}}}
""",
    f"""\
  - node:
      {_NODE}\
      if: $(eval "'$(var mode)' == 'sim'")
      param:
        - name: limits
          param:
            - {{{{name: lower, value: -{{n}}.0}}}}
            - {{{{name: upper, value: {{n}}.0}}}}
        - {{{{name: names, value: [left, right]}}}}
""",
)

_SAME_GROUP: Final = """\
  - group:
      - push_ros_namespace: {namespace: $(var robot)}
      - set_parameter: {name: use_sim_time, value: true}
"""
_SAME_GROUPED: Final = """\
      - node:
          pkg: benchmark_widget
          exec: widget
          name: widget{n}
          output: screen
          respawn: true
          respawn_delay: 2.0
          if: $(var used true)
          param:
            - {{name: frame, value: $(var robot)/base{n}}}
          ros_args: --log-level info
          remap:
            - {{from: /tf, to: tf}}
            - {{from: /tf_static, to: tf_static}}
"""


def _yaml(node: str) -> Callable[[Sequence[int]], str]:
    return lambda numbers: _ARGUMENTS + "".join(node.format(n=n) for n in numbers)


def _groups(numbers: Sequence[int]) -> str:
    return _ARGUMENTS + "".join(
        (_GROUP if place % 3 == 0 else "").format(n=n) + _GROUPED.format(n=n)
        for place, n in enumerate(numbers)
    )


def _conditions(numbers: Sequence[int]) -> str:
    return _ARGUMENTS + "".join(
        f"  - node:\n      {_NODE}      {_CONDITIONS[n % len(_CONDITIONS)]}\n".format(n=n) for n in numbers
    )


def _kinds(numbers: Sequence[int]) -> str:
    return _ARGUMENTS + "".join(_KINDS[n % len(_KINDS)].format(n=n) for n in numbers)


def _same(numbers: Sequence[int]) -> str:
    return _ARGUMENTS + "".join(node_tree.YAML_NODE.format(n=n) for n in numbers)


def _same_grouped(numbers: Sequence[int]) -> str:
    return _ARGUMENTS + _SAME_GROUP + "".join(_SAME_GROUPED.format(n=n) for n in numbers)


SHAPES: Final = {
    "files of parameters": Shape(_yaml(_WITH_FILES)),
    "groups": Shape(_groups),
    "conditions": Shape(_conditions),
    "kinds in turn": Shape(_kinds),
    "four deep": Shape(_kinds, nodes=10, files=5),
    "written out": Shape(_same, python=python_shapes.written_out),
    "loops": Shape(_same, python=python_shapes.ranged(python_shapes.LOOP)),
    "helper": Shape(_same, python=python_shapes.helped),
    "opaque": Shape(_same, python=python_shapes.ranged(python_shapes.OPAQUE)),
    "grouped": Shape(_same_grouped, python=python_shapes.grouped),
    "short files": Shape(_same, nodes=10, python=python_shapes.written_out),
    "one file": Shape(_same, nodes=1000, python=python_shapes.written_out),
}


def write(folder: Path, name: str, nodes: int, *, python: bool = False) -> Path:
    """Write a tree of this shape with so many nodes; return the file at its top."""
    node_tree.write_package(folder)
    shape = SHAPES[name]
    language, text = ("py", shape.python) if python and shape.python else ("yaml", shape.yaml)
    folder = folder / f"{name.replace(' ', '_')}-{language}{nodes}"
    folder.mkdir()
    for file, number in (("shared", 1), ("sim", 2)):
        node_tree.write_parameters(folder / f"{file}.yaml", number)
    level = []
    for number in range(0, nodes, shape.nodes):
        path = folder / f"robot{number}.launch.{language}"
        path.write_text(text(range(number, min(nodes, number + shape.nodes))))
        level.append((path.name, f"robot{number}"))

    def including(name: str, files: Sequence[levels.File]) -> levels.File:
        path = folder / f"{name}.launch.{language}"
        if language == "py":
            path.write_text(python_shapes.including(files))
        else:
            path.write_text(
                _ARGUMENTS + "".join(_INCLUDE.format(file=file, robot=robot) for file, robot in files)
            )
        return path.name, name

    return folder / levels.top(level, including, shape.files)
