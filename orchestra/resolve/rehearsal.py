"""What a condition leaves out, carried out aside: what is wrong with it whatever the condition says.

Nothing is run for it, and what it would have set is seen by nobody. Of what it comes upon only what no variable, file
or program elsewhere could make right is told: names that are none, values that no parameter or key can have.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from orchestra.description.actions.executable import Executable
from orchestra.description.actions.node import Node
from orchestra.description.actions.set_remap import SetRemap
from orchestra.errors import Code, Problems
from orchestra.fields import replace
from orchestra.resolve.actions import executable, node, set_remap
from orchestra.resolve.context import CommandResult
from orchestra.resolve.found import Found
from orchestra.resolve.ledger import Ledger
from orchestra.resolve.resolution import Resolution
from orchestra.resolve.scope import Scope
from orchestra.witness.variables import copied

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping

    from orchestra.description.entity import Action, Entity
    from orchestra.errors import Problem
    from orchestra.resolve.context import Variable

_TOLD: Final = frozenset(
    {
        Code.BAD_NAME,
        Code.BAD_VALUE,
        Code.DUPLICATE_PARAMETER,
        Code.PARAMETER_SYNTAX,
        Code.PARAMETER_TYPE,
        Code.SUBSTITUTION_SYNTAX,
        Code.SURPRISING_SCALAR,
    }
)


def rehearsed(
    entities: Iterable[Entity], run: Resolution, variables: Mapping[str, Variable]
) -> Iterator[Problem]:
    """Yield what is wrong with actions; `variables` are what they are whatever the condition says."""
    found = Problems()
    aside = _aside(run, variables, found)
    for entity in entities:
        if type(entity) is Node:
            node.visit(entity, aside)
        elif type(entity) is Executable:
            executable.visit(entity, aside)
        elif type(entity) is SetRemap:
            set_remap.visit(entity, aside)
    yield from (problem for problem in found if problem.code in _TOLD)


def _aside(run: Resolution, variables: Mapping[str, Variable], found: Problems) -> Resolution:
    """Return a resolution at the same place of which nothing is left."""
    scope = Scope(found, Ledger(), copied(run.scope.environment), dict(variables))
    context = replace(
        run.context,
        problems=found,
        variables=scope,
        environment=scope.environment,
        run_command=_run_nothing,
        anonymous=dict(run.context.anonymous),
        elsewhere=set(),
        parameters={},
        lost=run.context.lost | run.scope.variables.keys(),
    )
    return Resolution(run.inputs, found, run.load, _visit_nothing, context, scope, Found(), run.frames)


def _run_nothing(command: tuple[str, ...], environment: Mapping[str, str]) -> CommandResult:
    del command, environment
    return CommandResult(0, "", "", "nothing is run here")


def _visit_nothing(actions: Iterable[Action], run: Resolution) -> None:
    del actions, run
