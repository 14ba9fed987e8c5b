"""The candidates for the word at the cursor of an `orchestra` command line."""

from __future__ import annotations

import argparse
from importlib import import_module
from typing import TYPE_CHECKING, Final, TypeAlias

from orchestra.cli.commands import ALIASES, COMMANDS
from orchestra.cli.completing.candidates import Candidate, beginning_with
from orchestra.cli.completing.paths import paths
from orchestra.cli.ros.verbs import VerbParser

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence

    from orchestra.cli.parser import CommandParser

    Words: TypeAlias = Callable[[Sequence[str], str], Iterable[Candidate]]

# The function of `launch_words` that knows the words of a command; those of the others are the choices of its parser.
_WORDS: Final = {"launch": "launch_words", "plan": "launch_words", "check": "check_words", "run": "run_words"}
_OF_RUNS: Final = {
    **dict.fromkeys(("start", "stop", "restart", "logs", "events", "attach"), "process_words"),
    "signal": "signal_words",
}
# Here `--name RUN` is a new name.
_NAMING: Final = frozenset({"launch", "run"})
_FILE, _RUN = "FILE", "RUN"


def candidates(before: Sequence[str], begun: str) -> list[Candidate]:
    """Return what the word at the cursor can become; `before` are the words between the program's name and it."""
    if not before:
        named = (Candidate(name, command.summary) for name, command in COMMANDS.items())
        return beginning_with(begun, (*named, *map(Candidate, ("--help", "--version") if begun else ())))
    command, *given = before
    command = ALIASES.get(command, command)
    if command not in COMMANDS:
        return []
    parser: CommandParser = import_module(COMMANDS[command].module).parser()
    if not isinstance(parser, VerbParser):
        return beginning_with(begun, _of_command(command, parser, given, begun, _words_of(command)))
    verb = next((word for word in given if not word.startswith("-")), None)
    if verb is None:
        return beginning_with(begun, (Candidate(name, known.summary) for name, known in parser.verbs.items()))
    if verb not in parser.verbs:
        return []
    given.remove(verb)
    words_of = import_module("orchestra.cli.completing.verb_words").words_of(command, parser.of(verb))
    return beginning_with(begun, _of_command(command, parser.of(verb), given, begun, words_of))


def _of_command(
    command: str, parser: CommandParser, given: Sequence[str], begun: str, function: Words | None
) -> Iterable[Candidate]:
    """Return what the word at the cursor can become; the function knows the words that are no options."""
    options = {name: option for option in parser.actions for name in option.option_strings}
    words, waiting, closed = _positional(given, options, intermixed=parser.intermixed)
    if waiting is not None:
        return _values(command, waiting, begun)
    if begun.startswith("-") and not closed:
        name, separator, value = begun.partition("=")
        if separator and name in options:
            found = _values(command, options[name], value)
            return (candidate._replace(word=f"{name}={candidate.word}") for candidate in found)
        return _options(options, given)
    return function(words, begun) if function else _choices(parser, words)


def _words_of(command: str) -> Words | None:
    """Return what knows the words of a command; only its module is imported."""
    for table, module in ((_WORDS, "launch_words"), (_OF_RUNS, "run_words")):
        if command in table:
            found: Words = getattr(import_module(f"orchestra.cli.completing.{module}"), table[command])
            return found
    return None


def _positional(
    given: Sequence[str], options: dict[str, argparse.Action], *, intermixed: bool
) -> tuple[list[str], argparse.Action | None, bool]:
    """Return the words that are no options, the option whose value is at the cursor, and whether none can follow."""
    words: list[str] = []
    waiting = None
    closed = False
    for word in given:
        if waiting is not None:
            waiting = None
        elif closed or not word.startswith("-"):
            words.append(word)
            closed |= not intermixed
        elif word == "--":
            closed = True
        elif (option := options.get(word)) is not None and _takes_a_value(option):
            waiting = option
    return words, waiting, closed


def _takes_a_value(option: argparse.Action) -> bool:
    return option.nargs != 0


def _options(options: dict[str, argparse.Action], given: Sequence[str]) -> Iterable[Candidate]:
    """Yield options that are not given yet; of several names of one that is, none."""
    for name, option in options.items():
        repeated = type(option).__name__ == "_AppendAction"
        if option.help != argparse.SUPPRESS and (repeated or not set(option.option_strings) & set(given)):
            yield Candidate(name, option.help or "")


def _values(command: str, option: argparse.Action, begun: str) -> Iterable[Candidate]:
    if option.choices is not None:
        return map(Candidate, map(str, option.choices))
    if option.metavar == _RUN and command not in _NAMING:
        names: Callable[[], Iterable[Candidate]] = import_module(
            "orchestra.cli.completing.run_words"
        ).run_names
        return names()
    return paths(begun) if option.metavar == _FILE else ()


def _choices(parser: CommandParser, words: Sequence[str]) -> Iterable[Candidate]:
    positional = [action for action in parser.actions if not action.option_strings]
    if len(words) >= len(positional):
        return ()
    return map(Candidate, map(str, positional[len(words)].choices or ()))
