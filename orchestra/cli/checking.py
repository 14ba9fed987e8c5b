"""What is wrong in a set of files, each problem once."""

from __future__ import annotations

import gc
import os
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from orchestra.cli.look.finding import Finding
from orchestra.cli.look.garbage import Garbage
from orchestra.cli.look.kept import Kept
from orchestra.cli.look.pool import Lost, Pool
from orchestra.cli.look.scratch import scratch
from orchestra.cli.look.sources import NOWHERE, is_source, shared
from orchestra.cli.look.worker import Done
from orchestra.cli.targets import Target
from orchestra.dataclass import dataclass
from orchestra.errors import Code, Problem, Problems
from orchestra.location import displayed, point
from orchestra.pyyaml import in_place
from orchestra.settings.settle import comments_in, unused
from orchestra.witness.observing import observer

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from orchestra.cli.look.looker import Looker
    from orchestra.resolve.inputs import Inputs

_LACKS = (Code.MISSING_ARGUMENT, Code.UNDEFINED_VARIABLE)


@dataclass(frozen=True, slots=True)
class Manner:
    """How files are looked at: by how many processes, how long one file may take in seconds, whether by what is kept.

    Without `jobs` this process looks by itself, at every file, for as long as it takes. With `strict` comments that
    silence nothing are told. `identity` is that of Orchestra in this environment, where it is known already.
    """

    jobs: int = 0
    patience: float = 120.0
    cache: bool = False
    strict: bool = False
    identity: str | None = None


@dataclass(frozen=True, slots=True)
class Checked:
    """The problems of a set of files; of so many `files` it was known that nothing has changed."""

    problems: tuple[Problem, ...]
    files: int
    unchanged: int


def problems_in(targets: Sequence[Target], inputs: Inputs) -> tuple[Problem, ...]:
    """Return the problems of all targets, looked at by this process."""
    return check(targets, inputs, Manner()).problems


def check(targets: Sequence[Target], inputs: Inputs, manner: Manner) -> Checked:
    """Return the problems of all targets.

    A launch file that another of them includes is judged by how that one uses it: alone it would lack the arguments
    and variables that it is given there. Where a condition keeps it from being included, it is looked at all the same,
    but what it lacks is not told; nor is that of one which is included as part of its package, from where that is
    installed or would be.
    """
    kept = Kept(inputs, wanted=manner.cache, identity=manner.identity)
    findings, unchanged = _findings(targets, inputs, manner, kept)
    every = list(findings)
    while behind := _behind(every):
        every += _findings(behind, inputs, manner, kept)[0]
    if unchanged < len(findings):
        kept.tidy()
    found = Problems()
    named = {path for finding in every for path in finding.named}
    sources = shared(path for finding in every for path in (*finding.named, *finding.included))
    for finding in _outermost(every):
        lacks = _LACKS if finding.path in named or is_source(finding.path, sources) else ()
        found.extend(problem for problem in finding.problems if problem.code not in lacks)
    _judge_comments(targets, every, found, strict=manner.strict)
    return Checked(found.ordered, len(targets), unchanged)


def _findings(
    targets: Sequence[Target], inputs: Inputs, manner: Manner, kept: Kept
) -> tuple[list[Finding], int]:
    """Return what is found in each file, and how much of that was known."""
    findings: dict[int, Finding] = {}
    if not kept.is_empty:
        findings = {number: known for number, target in enumerate(targets) if (known := kept.finding(target))}
    unchanged = len(findings)
    missing = [number for number in range(len(targets)) if number not in findings]
    if missing:
        looks = _looks([targets[number] for number in missing], inputs, manner, kept)
        findings.update(zip(missing, looks, strict=True))
    return [findings[number] for number in range(len(targets))], unchanged


def _looks(targets: Sequence[Target], inputs: Inputs, manner: Manner, kept: Kept) -> list[Finding]:
    get_ready()
    from orchestra.cli.look.looker import Looker  # noqa: PLC0415 - as there

    if not manner.jobs:
        looker = Looker(inputs)
        return [looker.look(target)[0] for target in targets]
    # What is written alike stands together: whoever looks at it has read its like before.
    order = sorted(range(len(targets)), key=lambda number: _kind(targets[number]))
    with scratch() as folder, _frozen():
        ordered = [targets[number] for number in order]
        pool = Pool(
            lambda: _Looking(ordered, Looker(inputs), kept, folder),
            max(1, min(manner.jobs, len(targets))),
            manner.patience,
        )
        found = {
            order[place]: _finding(ordered[place], result) for place, result in pool.results(len(targets))
        }
    return [found[number] for number in range(len(targets))]


def get_ready() -> None:
    """Import what it takes to look at files. It is heavy, and not needed where everything is known."""
    in_place()
    import orchestra.cli.look.looker  # noqa: F401, PLC0415


class _Looking:
    """Looks at files in a process of its own, and keeps what is found."""

    def __init__(self, targets: Sequence[Target], looker: Looker, kept: Kept, folder: str) -> None:
        self._targets, self._looker, self._kept = targets, looker, kept
        self._garbage = Garbage()
        looker.watch(folder)

    def foresee(self, piece: int) -> None:
        """Read one of the files, which is looked at soon."""
        self._looker.read(self._targets[piece])

    def turn(self, piece: int) -> Done:
        """Return what is found in one of the files."""
        target = self._targets[piece]
        finding, record = self._looker.look(target)
        self._garbage.left_by(code=observer().ran_code)
        data = finding.as_data()
        self._kept.keep(target, data, record)
        return Done(data, last=self._looker.is_spent)

    def end(self) -> None:
        """Write what is to be kept."""
        self._kept.written()


@contextmanager
def _frozen() -> Iterator[None]:
    """Keep the garbage collector from walking through what is there by now, here and in processes that are forked."""
    gc.freeze()
    try:
        yield
    finally:
        gc.unfreeze()


def _kind(target: Target) -> tuple[str, str]:
    return target.kind, target.path.rpartition(".")[2]


def _finding(target: Target, result: Any) -> Finding:  # noqa: ANN401 - JSON data
    return _lost(target, result) if isinstance(result, Lost) else Finding.from_data(result)


def _lost(target: Target, result: Lost) -> Finding:
    """Return what is to be said of a file whose code has ended the process it was run in, or has not ended itself."""
    problems, file = Problems(), displayed(target.path)
    problems.error(Code.USER_CODE, f"code of {file} {result.reason}", point(file))
    return Finding(os.path.realpath(target.path), problems.ordered)


def _behind(findings: Sequence[Finding]) -> list[Target]:
    """Return the files that only stand behind conditions, and are nobody's target."""
    known = {path for finding in findings for path in (finding.path, *finding.included)}
    named = {path for finding in findings for path in finding.named}
    return [Target(path, "launch") for path in sorted(named - known) if not path.startswith(NOWHERE)]


def _outermost(findings: Sequence[Finding]) -> list[Finding]:
    """Return those of files that no other includes, and of files that include each other in a circle the first."""
    inner = {path for finding in findings for path in finding.included - {finding.path}}
    chosen = [finding for finding in findings if finding.path not in inner]
    reached = {path for finding in chosen for path in (finding.path, *finding.included)}
    for finding in findings:
        if finding.path not in reached:
            chosen.append(finding)
            reached |= {finding.path, *finding.included}
    return chosen


def _judge_comments(
    targets: Sequence[Target], findings: Sequence[Finding], problems: Problems, *, strict: bool
) -> None:
    used = {place for finding in findings for place in finding.silencing}
    for target, finding in zip(targets, findings, strict=False):
        if finding.comments:
            path = os.path.abspath(target.path)  # noqa: PTH100 - pathlib is slow
            unused(comments_in(path, displayed(target.path)), used, problems, strict=strict)
