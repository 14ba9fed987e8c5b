"""Makes a case that fails smaller, as long as it still fails."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from tests.chaos.cases import Case, Member

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from tests.chaos.cases import Root


def smallest(case: Case, fails: Callable[[Case], bool]) -> Case:
    """Take away whatever can be taken away while `fails` says yes."""
    while True:
        smaller = next((each for each in _smaller(case) if fails(each)), None)
        if smaller is None:
            return case
        case = smaller


def _smaller(case: Case) -> Iterator[Case]:
    """Yield the case with one thing less, big things first."""
    for root in case.roots:
        rest = tuple(_without_need(each, root.member.name) for each in case.roots if each is not root)
        if rest:
            yield replace(case, roots=rest)
    for number in range(len(case.acts)):
        if len(case.acts) > 1:
            yield replace(case, acts=case.acts[:number] + case.acts[number + 1 :])
    usual = Case(case.seed, (), ())
    for name in ("door", "screen", "disk", "leaps"):
        if getattr(case, name) != getattr(usual, name):
            yield replace(case, **{name: getattr(usual, name)})
    for number, root in enumerate(case.roots):
        for plainer in _plainer_root(root):
            yield replace(case, roots=(*case.roots[:number], plainer, *case.roots[number + 1 :]))


def _without_need(root: Root, name: str) -> Root:
    needs = tuple(need for need in root.needs if need != name)
    return replace(root, needs=needs, needs_ready=bool(needs) and root.needs_ready)


def _plainer_root(root: Root) -> Iterator[Root]:
    for member in _plainer(root.member):
        yield replace(root, member=member)
    usual = type(root)(root.member)
    for name in ("respawn", "required", "ready", "never_ready", "tty", "capped", "stdin", "stop"):
        if getattr(root, name) != getattr(usual, name):
            yield replace(root, **{name: getattr(usual, name)})
    if root.needs:
        yield replace(root, needs=(), needs_ready=False)


def _plainer(member: Member) -> Iterator[Member]:
    below = member.members
    for number, child in enumerate(below):
        yield replace(member, members=below[:number] + below[number + 1 :])
        for plainer in _plainer(child):
            yield replace(member, members=(*below[:number], plainer, *below[number + 1 :]))
    usual = Member(member.name)
    for name in ("manner", "ignores", "closes", "stops", "storm", "lines", "floods", "after", "slow"):
        if getattr(member, name) != getattr(usual, name):
            yield replace(member, **{name: getattr(usual, name)})
