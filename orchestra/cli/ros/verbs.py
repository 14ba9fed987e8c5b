"""Commands that have verbs, as `topic list`: each verb has options of its own and a tool that answers."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.cli.parser import CommandParser
from orchestra.dataclass import dataclass
from orchestra.errors import UsageError
from orchestra.nearest import nearest

if TYPE_CHECKING:
    from argparse import Namespace
    from collections.abc import Callable, Mapping, Sequence

    Options = Callable[[CommandParser], None]


@dataclass(frozen=True, slots=True)
class Verb:
    """What a verb does in a few words, the options that it adds, and the `module:function` of the tool."""

    summary: str
    tool: str
    options: tuple[Options, ...] = ()


class VerbParser(CommandParser):
    """Reads a verb and then its options; `verbs` is the table of them."""

    def __init__(self, command: str, description: str, verbs: Mapping[str, Verb]) -> None:
        width = max(map(len, verbs))
        rows = "".join(f"  {name:<{width}}  {verb.summary}\n" for name, verb in verbs.items())
        epilog = f"verbs:\n{rows}\n'orchestra {command} VERB --help' tells more about one of them.\n"
        super().__init__(command, description, epilog)
        self.verbs = verbs
        self._command = command
        self.add_argument("verb", choices=list(verbs), metavar="VERB", help="one of those below")

    def read(self, words: Sequence[str]) -> Namespace:
        """Return the options of the verb, `verb` among them. Without any word, print the help."""
        before = [word for word in words[: _first_word(words)] if word not in ("-h", "--help")]
        rest = words[_first_word(words) :]
        if not rest:
            if before:
                raise UsageError(f"a verb is missing: one of {', '.join(self.verbs)}")
            self.print_help()
            raise SystemExit(0)
        verb, *given = rest
        if verb not in self.verbs:
            near = nearest(verb, self.verbs)
            hint = f"; did you mean '{near}'?" if near else f": there are {', '.join(self.verbs)}"
            raise UsageError(f"there is no verb '{verb}' of {self._command}{hint}")
        options = self.of(verb).read([*given, *before])
        options.verb = verb
        return options

    def of(self, verb: str) -> CommandParser:
        """Return the parser of a verb."""
        made = CommandParser(f"{self._command} {verb}", f"{self.verbs[verb].summary.capitalize()}.")
        for add in self.verbs[verb].options:
            add(made)
        made.add_argument(
            "--format", choices=["text", "json"], default="text", help="how to write it (default: text)"
        )
        return made


def _first_word(words: Sequence[str]) -> int:
    """Return the place of the first word that is no option: options may stand before the verb."""
    return next((place for place, word in enumerate(words) if not word.startswith("-")), len(words))
