"""The state of one resolution, as the visitors of the actions see it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, TypeAlias

from orchestra.dataclass import dataclass
from orchestra.description.entity import Action, Entity
from orchestra.description.fields import FLAG_WORDS, meant_seconds, meant_whole
from orchestra.description.launch import Description
from orchestra.description.text import MatchedTemplate, Words
from orchestra.errors import Code, Problems
from orchestra.fields import field, replace
from orchestra.location import Location, Span, location_of
from orchestra.nearest import nearest
from orchestra.resolve.booleans import boolean
from orchestra.resolve.context import POISON, Context, Evaluated, Packaged, Poison, Value
from orchestra.resolve.evaluate import evaluate, performed
from orchestra.resolve.found import Found
from orchestra.resolve.impossible.held import Held
from orchestra.resolve.inputs import Inputs
from orchestra.resolve.late_values import matched_value
from orchestra.resolve.ledger import Ledger
from orchestra.resolve.model import FileParameters, ResolvedDependency
from orchestra.resolve.occasions import Action as CollectedAction
from orchestra.resolve.occasions import Occasion
from orchestra.resolve.packages.extensions import extends
from orchestra.resolve.refusals import refuse_value
from orchestra.resolve.scope import Scope

if TYPE_CHECKING:
    from orchestra.description.text import Template

LoadFile: TypeAlias = Callable[..., Description | None]
Visit: TypeAlias = Callable[[Iterable[Action], "Resolution"], None]

MOST_STEPS = 200_000
# Each level of actions takes some ten calls of the thousand that the interpreter allows.
_DEEP = 25


@dataclass(frozen=True, slots=True)
class Frame:
    """One file on the way to where the visit is.

    `given` are the arguments of its include, which stands at `included_at` and names it at `named_at` (not known in
    Python); `scope` and `mark` tell what was set when its visit began, `choices` how many conditions and repetitions
    are around it. `fixed`: its include can name no other file.
    `private`: what it sets is not seen outside, so that arguments which are given to it are nobody else's.
    """

    path: str
    scope: Scope
    mark: int = 0
    choices: int = 0
    fixed: bool = True
    included_at: Location | None = None
    given: frozenset[str] = frozenset()
    labels: tuple[str, ...] = ()
    depends_on: tuple[ResolvedDependency, ...] = ()
    private: bool = False
    named_at: Location | None = None


@dataclass(slots=True)
class Resolution:
    """Where the visit is, and what it may use. `around` are the objects of Python launch files that it is inside of.

    `startable` has the programs that have been found to be there and sound, each with the search path, `packaged` the
    words of those of packages. `inherited` is a pushed namespace with what a node has that says none. `components` are
    what distributions declare, by where code is imported from.
    """

    inputs: Inputs
    problems: Problems
    load: LoadFile
    visit: Visit
    context: Context
    scope: Scope
    found: Found = field(default_factory=Found)
    frames: tuple[Frame, ...] = ()
    occasion: Occasion | None = None
    around: tuple[Any, ...] = ()
    depth: int = 0
    steps: int = 0
    conditions: int = 0
    repetitions: int = 0
    held: tuple[Held, ...] = ()
    startable: set[tuple[str, str]] = field(default_factory=set)
    packaged: dict[tuple[str | None, str | None, str], Packaged] = field(default_factory=dict)
    components: dict[tuple[str, ...], tuple[Any, ...]] = field(default_factory=dict)
    inherited: tuple[Value, Value] | None = None
    descriptions: dict[str, Description | None] = field(default_factory=dict)
    parameter_files: dict[tuple[object, ...], FileParameters | None] = field(default_factory=dict)
    make_engine: Callable[[Resolution], Any] | None = None
    _engine: Any = None
    _extended: bool | None = None

    @property
    def engine(self) -> Any:  # noqa: ANN401 - a ResolvingEngine, whose module needs this one
        """What Python launch files see of the resolution, made when the first of them needs it."""
        if self._engine is None and self.make_engine is not None:
            self._engine = self.make_engine(self)
        return self._engine

    @property
    def conditional(self) -> bool:
        """Whether what is visited need not come about: a condition or an event is around it."""
        return self.conditions > 0 or self.occasion is not None

    @property
    def later(self) -> bool:
        """Whether what is visited is carried out when something happens, not now."""
        return self.occasion is not None and not self.occasion.now

    def nodes_are_extended(self) -> bool:
        """Return whether an installed package has its say about every node."""
        if self._extended is None:
            self._extended = extends("launch_ros.node_action")
        return self._extended

    def handle_events(self) -> None:
        """Hand events of the users' own, if any have happened, to the handlers that want them."""
        if self._engine is not None:
            self._engine.handle_events()

    @property
    def delayed(self) -> list[CollectedAction] | None:
        """Where actions go that are not carried out now but when something happens; None where they are now."""
        return None if self.occasion is None else self.occasion.do

    @property
    def frame(self) -> Frame:
        """The file that is being visited; user code may visit actions by hand, in none."""
        return self.frames[-1] if self.frames else Frame("", self.scope)

    def goes_on(self, place: Action | Span) -> bool:
        """Count a step of the visit; false where there have been more than any description needs."""
        self.steps += 1
        if self.steps == MOST_STEPS:
            message = f"the description comes to more than {MOST_STEPS} actions"
            span = place.span if isinstance(place, Action) else place
            self.problems.error(Code.INCLUDE_CYCLE, message, self.at(span))
        return self.steps < MOST_STEPS

    @property
    def is_deep(self) -> bool:
        """Whether so many actions stand around this one that it is they who exhaust the stack, if it is exhausted."""
        return self.depth > _DEEP

    def report_endless(self, error: RecursionError) -> None:
        """Report actions in each other without end, or too deep, at the innermost; the visit is out of all of them."""
        spans = []
        traceback = error.__traceback__
        while traceback is not None:
            action = traceback.tb_frame.f_locals.get("action")
            spans += [action.span] if isinstance(action, Action) else []
            traceback = traceback.tb_next
        message = "actions stand inside each other without end, or too deep"
        self.problems.error(Code.INCLUDE_CYCLE, message, spans[-1] if spans else None)
        self.depth = self.conditions = self.repetitions = 0
        self.around, self.occasion, self.held = (), None, ()

    def at(self, span: Span) -> Location:
        """Return the location of a span of the file that is being visited."""
        return self.context.at(span)

    def place(self, written: Template | Entity) -> Location:
        """Return the location of something in the file that is being visited; quicker than `at` its span."""
        if type(written) is MatchedTemplate:
            return location_of(written.matched, written.group, self.context.included_from)
        return written.location(self.context.included_from)

    def evaluate(self, template: Template | None) -> Evaluated | None:
        """Evaluate a text in the current scope; None stays None."""
        if type(template) is not MatchedTemplate:
            return None if template is None else evaluate(template, self.context)
        if template.constant is not None:
            return matched_value(template.constant, template, self.context.included_from)
        known = None if template.pieces is None else self.scope.filled(template.pieces, template.raw)
        if known is None:
            return performed(template, self.context)
        return matched_value(known[0], template, self.context.included_from, known[1])

    def text(self, template: Template | None) -> str | Poison | None:
        """Return what a text comes to."""
        if type(template) is MatchedTemplate:
            if template.constant is not None:
                return template.constant
        elif template is not None and not template.faulty:
            parts = template.parts
            if len(parts) == 1 and type(parts[0]) is Words:
                return parts[0].text
        value = self.evaluate(template)
        return value.text if isinstance(value, Value) else value

    def flag(self, template: Template | None, default: bool | None = None) -> bool | Poison | None:
        """Return what a text comes to as true or false; anything else is reported."""
        if template is None:
            return default
        value = self.evaluate(template)
        if not isinstance(value, Value):
            return default if value is None else POISON
        if (flag := boolean(value.text)) is not None:
            return flag
        message = f"expected true or false, found '{value.text}'"
        meant = nearest(value.text, FLAG_WORDS)
        return refuse_value(value, self.problems, Code.BAD_VALUE, message, meant=meant)

    def number(self, template: Template | None) -> float | Poison | None:
        """Return what a text comes to as a number of seconds; anything else is reported."""
        if template is None:
            return None
        value = self.evaluate(template)
        if value is None or isinstance(value, Poison):
            return value
        try:
            number = float(value.text)
        except ValueError:
            number = -1.0
        if 0 <= number < float("inf"):
            return number
        message = f"expected a number of seconds, found '{value.text}'"
        return refuse_value(value, self.problems, Code.BAD_VALUE, message, meant=meant_seconds(value.text))

    def integer(self, template: Template | None) -> int | Poison | None:
        """Return what a text comes to as a whole number; anything else is reported."""
        value = self.evaluate(template)
        if value is None or isinstance(value, Poison):
            return value
        try:
            return int(value.text)
        except ValueError:
            message = f"expected a whole number, found '{value.text}'"
            return refuse_value(value, self.problems, Code.BAD_VALUE, message, meant=meant_whole(value.text))

    def word(self, template: Template | None, words: Sequence[str]) -> str | Poison | None:
        """Return what a text comes to, which is one of a few words; anything else is reported."""
        if template is None:
            return None
        value = self.evaluate(template)
        if value is None or isinstance(value, Poison):
            return value
        if value.text in words:
            return value.text
        message = f"expected one of {', '.join(words)}, found '{value.text}'"
        meant = nearest(value.text, words)
        return refuse_value(value, self.problems, Code.BAD_VALUE, message, meant=meant)

    def collect(self, occasion: Occasion, children: Sequence[Action]) -> None:
        """Visit actions that are carried out on an occasion: they see the scope as it is, and set nothing outside."""
        self.found.occasions.append(occasion)  # before those inside it: as they are written
        outer, self.occasion = self.occasion, occasion
        with self.scope.nested():
            self.visit(children, self)
        self.occasion = outer

    @contextmanager
    def reporting_to(self, problems: Problems) -> Iterator[Problems]:
        """Let what comes up for a while be reported elsewhere."""
        outer = self.problems
        self._report_to(problems)
        try:
            yield problems
        finally:
            self._report_to(outer)

    def _report_to(self, problems: Problems) -> None:
        self.problems = self.scope.problems = problems
        self.context = replace(self.context, problems=problems)

    @contextmanager
    def scoped(self, scope: Scope) -> Iterator[None]:
        """Carry on in another scope for a while."""
        outer, outer_context = self.scope, self.context
        self.scope = scope
        self.context = replace(
            outer_context, variables=scope, environment=scope.environment, parameters=scope.parameter_texts
        )
        try:
            yield
        finally:
            self.scope, self.context = outer, outer_context

    @contextmanager
    def inside(self, frame: Frame) -> Iterator[Ledger]:
        """Carry on in another file, in the same scope, for a while. Its ledger flows into the outer one."""
        at = frame.included_at
        chain = () if at is None else (at.span, *at.included_from)
        outer_frames, outer_context, outer_ledger = self.frames, self.context, self.scope.ledger
        self.frames = (*outer_frames, frame)
        self.context = replace(outer_context, file=frame.path, included_from=chain)
        self.scope.ledger = Ledger()
        try:
            yield self.scope.ledger
        finally:
            outer_ledger.absorb(self.scope.ledger)
            self.frames, self.context, self.scope.ledger = outer_frames, outer_context, outer_ledger
