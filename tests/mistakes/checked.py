"""Checks a broken file where packages are installed, and says how what is told differs from what is expected."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from orchestra.cli.look.looker import Looker
from orchestra.cli.targets import targets
from orchestra.pipeline import inputs_from
from orchestra.witness.observing import observer

if TYPE_CHECKING:
    from pathlib import Path

    from orchestra.errors import Problem, Severity
    from orchestra.location import Span
    from tests.mistakes.corpus import Case

_PROGRAMS = {"demo": ("listener", "talker"), "robot_bringup": ("controller", "ekf_node")}
_LAUNCHES_PARAMETERS = """\
launch:
- arg: {name: frame, default: base}
- node:
    pkg: demo
    exec: talker
    name: talker
    param: [{from: params.yaml, allow_substs: %s}]
"""


class Checker:
    """A folder with packages, in which one case after another is checked."""

    def __init__(self, root: Path) -> None:
        self.folder = root / "work"
        self.folder.mkdir()
        prefix = root / "prefix"
        for package, programs in _PROGRAMS.items():
            _install(prefix, package, programs)
        environment = {name: os.environ[name] for name in ("HOME", "PATH")}
        self.environment = {**environment, "AMENT_PREFIX_PATH": str(prefix)}

    def problems(self, case: Case, main: str) -> tuple[Problem, ...]:
        """Return what is told of a case when a file of it is checked."""
        inputs = inputs_from(case.words, environment=self.environment)
        (target,) = targets([str(self.folder / main)])
        # Another test may have had this process watched, which keeps what files hold; here they change.
        observer().kept.clear()
        finding, _ = Looker(inputs).look(target)
        return finding.problems

    def differences(self, case: Case) -> str:
        """Return how what is told differs from what is expected, nothing where it does not."""
        for file in self.folder.rglob("*"):
            if file.is_file():
                file.unlink()
        for name, text in case.files.items():
            path = self.folder / name
            path.parent.mkdir(exist_ok=True)
            path.write_text(text, "utf-8", newline="")
        found = []
        if case.main == "params.yaml":
            text = _LAUNCHES_PARAMETERS % ("true" if "substs" in case.told else "false")
            (self.folder / "main.launch.yaml").write_text(text)
            found.append(("launched", self.problems(case, "main.launch.yaml")))
            if not case.told:
                found.append(("alone", self.problems(case, "params.yaml")))
        else:
            found.append(("", self.problems(case, case.main)))
        return "\n".join(filter(None, (_difference(how, case, problems) for how, problems in found)))


def _difference(how: str, case: Case, problems: tuple[Problem, ...]) -> str:
    expected = [_shown(item.span, item.severity, item.suggestion) for item in case.mistakes]
    told = [_shown(item.span, item.severity, item.suggestion) for item in problems]
    lines = [f"{how} expected {line}" for line in expected if line not in told]
    for problem, line in zip(problems, told, strict=True):
        if line not in expected or told.count(line) > 1:
            lines.append(f"{how} told {line}: {problem.message} [{problem.code}] {problem.notes}")
        if (span := problem.span) is not None and case.chains.get(
            span.file, chain := _chain(problem)
        ) != chain:
            lines.append(f"{how} {line} is included from {', '.join(chain)}")
    return "\n".join(lines)


def _shown(span: Span | None, severity: Severity, suggestion: str | None) -> str:
    place = f"{span}-{span.end_line}:{span.end_column}" if span is not None else "nowhere"
    return f"{place} {severity} -> {suggestion!r}"


def _chain(problem: Problem) -> tuple[str, ...]:
    return tuple(f"{span.file}:{span.line}" for span in problem.included_from)


def _install(prefix: Path, package: str, programs: tuple[str, ...]) -> None:
    index = prefix / "share/ament_index/resource_index/packages"
    share, library = prefix / "share" / package, prefix / "lib" / package
    for made in (index, library, share / "launch", share / "config"):
        made.mkdir(parents=True, exist_ok=True)
    (index / package).touch()
    (share / "launch/included.launch.yaml").write_text("launch: []\n")
    (share / "config/params.yaml").write_text("/**: {ros__parameters: {a: 1}}\n")
    for program in programs:
        (library / program).write_text("#!/bin/sh\n")
        (library / program).chmod(0o755)
