"""Why a text is no YAML, in the words of who wrote it: the parser's own point behind the cause, often lines behind.

What the parser has told apart before it gave up (its tokens) is looked at again: a quote that ends on another line
than it begins, a key without its colon, a bracket that is open still.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any, Final

from orchestra.description.source import shortened
from orchestra.load.faults import Fault
from orchestra.load.yaml_colons import comment_meant, in_quotes, of_brackets, of_second_colon
from orchestra.load.yaml_escapes import of_escape
from orchestra.load.yaml_failure import Failure
from orchestra.load.yaml_indentation import of_lines
from orchestra.nearest import nearest
from orchestra.patterns import pattern
from orchestra.pyyaml import yaml

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.load.offsets import Source


_PLAIN = pattern(r"[^\s,\]}#](?:[^\n,\]}#]*[^\s,\]}#])?")
_WORD_ALONE = pattern(r"[ ]*(?:- )?([A-Za-z_][\w-]*)[ ]*$", re.MULTILINE)
_COLON = pattern(r":(?:\s|$)|\s#", re.MULTILINE)
_ANCHOR = pattern(r"&([^\s,\[\]{}]+)")
_ALIAS = pattern(r"\*([^\s,\[\]{}]*)")
_CONTROL = pattern("[^\t\n\r -~\x85\xa0-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
_OF_A_SHELL = pattern(r"\$[{\[]\s*(?:(var|env|find-pkg-share)\s+)?([A-Za-z_]\w*)\s*[}\]]")
_CLOSERS: Final = {"[": "]", "{": "}"}


def explained(error: yaml.YAMLError, whole: Source) -> Fault:
    """Return the fault behind an error of PyYAML."""
    if not isinstance(error, yaml.MarkedYAMLError):
        return _no_character(error, whole)
    at = failed_at(error, whole)
    context = _offset(error.context_mark, whole) if error.context_mark is not None else at
    failure = Failure(whole, at, context, error.problem or "", error.context or "")
    if failure.is_doubled:
        return failure.fault("this '-' is one too many", context, context + 1)
    by_lines = of_lines(failure) if any(map(failure.problem.count, _OF_LINES)) else None
    plain = failure.of_conflict() or failure.of_quotes()
    return plain or by_lines or _explanation(failure)(failure) or failure.plainly()


def failed_at(error: yaml.YAMLError, whole: Source) -> int:
    """Return the offset where PyYAML gave up."""
    mark = (error.problem_mark or error.context_mark) if isinstance(error, yaml.MarkedYAMLError) else None
    return _offset(mark, whole) if mark is not None else 0


def _explanation(failure: Failure) -> Callable[[Failure], Fault | None]:
    return next(
        (explain for said, explain in _EXPLANATIONS.items() if said in failure.problem),
        lambda _failure: None,
    )


def _stray(failure: Failure) -> Fault | None:
    """Explain a character that begins nothing."""
    if failure.here == "\t":
        return _tab(failure)
    found = _PLAIN.match(failure.text, failure.at)
    if found is None:
        return None
    message = f"a text cannot begin with {failure.here} unless it is in quotes"
    end = _without_its_colon(failure, failure.at, found.end())
    return failure.fault(message, failure.at, end, in_quotes(failure.text[failure.at : end]))


def _without_its_colon(failure: Failure, begin: int, end: int) -> int:
    """Return where a plain text ends that may be a key: before its colon."""
    found = _COLON.search(failure.text, begin, end)
    return found.start() if found is not None and found.start() > begin else end


def _tab(failure: Failure) -> Fault:
    begin = failure.whole.lines[failure.line_of(failure.at) - 1]
    first = failure.text.find("\t", begin, failure.at + 1)
    at = first if first >= 0 else failure.at
    return failure.fault("a tab cannot indent: YAML takes spaces", at, at + 1)


def _ended(failure: Failure) -> Fault | None:
    return failure.unclosed(failure.context) if "quoted scalar" in failure.doing else None


def _open(failure: Failure) -> Fault:
    """Explain a list or mapping in brackets in which something else stands than a comma or the end."""
    shell = _OF_A_SHELL.match(failure.text, failure.at - 1) if failure.here in ("{", "[") else None
    if shell is not None:
        message = f"{shell[0]} is no substitution, and cannot stand in brackets without quotes"
        is_named = failure.text.endswith(("$(env ", "$(var "), 0, shell.start())
        instead = shell[2] if is_named else f"$({shell[1] or 'var'} {shell[2]})"
        return failure.fault(message, *shell.span(), instead)
    opening = failure.text[failure.context]
    closer = _CLOSERS.get(opening, "]")
    last = next((piece for piece in reversed(failure.pieces()) if piece.begin > failure.context), None)
    around = last.end if last is not None and last.end <= failure.at else failure.at
    begun = last.begin if last is not None else failure.context
    alone = failure.text[failure.context + 1 :].partition("\n")[0].strip() == ""
    unclosed = f"this {opening} is not closed: a {closer} is missing"
    if alone and failure.here == ":" and last is not None and "\n" in failure.text[last.begin : last.end]:
        if failure.indentation(failure.at) <= failure.indentation(failure.context):
            return failure.fault(unclosed, failure.context, failure.context + 1)
        return _without_comma(failure, last.begin, last.end, closer)
    if failure.here in ("]", "}") and failure.here != closer and not failure.is_open(failure.here, closer):
        message = f"'{opening}' and '{failure.here}' do not belong together"
        if failure.holds_pairs != (opening == "{"):
            return failure.fault(
                message, failure.context, failure.context + 1, "{" if opening == "[" else "["
            )
        return failure.fault(message, failure.at, failure.at + 1, closer)
    begun_earlier = failure.line_of(begun) < failure.line_of(failure.at) and not failure.here.isalnum()
    if failure.here in ("", *"]}") or begun_earlier or "\n" in failure.text[around : failure.at]:
        return failure.fault(unclosed, failure.context, failure.context + 1)
    if failure.here == ":" and last is not None and last.end == failure.at and not last.quoted:
        return _without_comma(failure, last.begin, last.end, closer)
    return _without_comma(failure, failure.at, failure.end_of_word(failure.at), closer)


def _no_value(failure: Failure) -> Fault | None:
    """Explain brackets in which something else stands than a value or the end."""
    opening = failure.opening()
    if opening is None:
        return None
    bracket = failure.text[opening]
    below = "\n" in failure.text[opening : failure.at]
    if failure.here == "" or (failure.here == "-" and below) or failure.here in _CLOSERS.values():
        message = f"this {bracket} is not closed: a {_CLOSERS[bracket]} is missing"
        return failure.fault(message, opening, opening + 1)
    if failure.here == ",":
        return failure.fault("there is nothing before this ','", failure.at, failure.at + 1)
    if failure.here == "-":
        return failure.fault("an item in [ ] has no '-'", failure.at, failure.at + 1)
    if failure.here == ":" and (found := _PLAIN.match(failure.text, failure.at)):
        message = f"a text in {bracket} {_CLOSERS[bracket]} cannot begin with : unless it is in quotes"
        alone = ":" not in found[0][1:]
        end = found.end() if alone else failure.at + 1
        return failure.fault(message, failure.at, end, in_quotes(found[0]) if alone else None)
    return None


def _without_comma(failure: Failure, begin: int, end: int, closer: str) -> Fault:
    """Explain the last word of a stretch, before which a comma is missing."""
    begin += len(re.split(r"\S+$", failure.text[begin:end])[0])
    message = f"a ',' or '{closer}' is missing before '{shortened(failure.text[begin:end])}'"
    return failure.fault(message, begin, end)


def _second_value(failure: Failure) -> Fault | None:
    """Explain a colon behind what can be no key: a value, or a key over several lines."""
    last = next((piece for piece in reversed(failure.pieces()) if piece.end <= failure.at), None)
    colon = of_second_colon(failure)
    if last is None or last.quoted or failure.line_of(last.begin) == failure.line_of(failure.at):
        return colon
    line = failure.whole.lines[failure.line_of(last.begin) - 1]
    if re.search(r":\s+$", failure.text[line : last.begin]):
        begin = last.begin + failure.text[last.begin : last.end].rfind("\n") + 1
        begin += len(failure.text[begin : last.end]) - len(failure.text[begin : last.end].lstrip())
        word = shortened(failure.text[begin : last.end])
        return failure.fault(f"'{word}' is indented too far: the line above has a value", begin, last.end)
    return _without_colon(failure, last.begin)


def _without_colon(failure: Failure, begin: int) -> Fault:
    """Explain a key whose colon, or the blank behind it, is missing."""
    end = failure.line_end(begin)
    written = failure.text[begin:end]
    if (comment := comment_meant(written)) is not None:
        return failure.fault("a comment begins with '#'", begin, end, comment)
    if written.startswith("- "):
        return _above_items(failure, begin) or failure.fault(
            "this is indented as nothing above it is", begin, begin + 1
        )
    if _is_item(failure, begin):
        instead = f"- {written.removeprefix('-')}"
        return failure.fault("an item of the list begins with '- '", begin, end, instead)
    if ":" in written:
        name, _, value = written.partition(":")
        return failure.fault(f"a blank is missing behind '{name}:'", begin, end, f"{name}: {value.strip()}")
    name, blank, value = re.match(r"([^\s=]*)(\s*=?\s*)(.*)", written).groups()  # type: ignore[union-attr] # matches
    name = name.rstrip(",;")
    meant = f"{name}: {value}" if blank and " " not in value else f"{name}:" if not blank else None
    return failure.fault(f"a ':' is missing behind '{shortened(name)}'", begin, end, meant)


def _above_items(failure: Failure, begin: int) -> Fault | None:
    """Explain a word above the items of a list that is their key, and has no colon."""
    line = failure.line_of(begin)
    found = _WORD_ALONE.match(failure.text, failure.whole.lines[line - 2]) if line > 1 else None
    if found is None:
        return None
    return failure.fault(f"a ':' is missing behind '{found[1]}'", *found.span(1), f"{found[1]}:")


def _is_item(failure: Failure, begin: int) -> bool:
    """Return whether the line above is an item of a list that stands where this line does; behind a '-' that below."""
    line, column = failure.place(begin)
    starts, item = failure.whole.lines, re.compile(f" {{{column - 1}}}- ")
    beside = (line - 2, line) if failure.text.startswith("-", begin) else (line - 2,)
    return any(0 <= at < len(starts) and item.match(failure.text, starts[at]) for at in beside)


def _no_key(failure: Failure) -> Fault | None:
    """Explain what stands where a key of a mapping is expected."""
    if failure.here in ("]", "}"):
        return failure.fault(f"'{failure.here}' closes nothing", failure.at, failure.at + 1)
    begin = failure.whole.lines[failure.line_of(failure.at) - 1]
    if failure.text[begin : failure.at].strip():
        plain = failure.fault("the value has ended before this", failure.at, failure.end_of_word(failure.at))
        return of_brackets(failure, begin) or plain
    message = "this is indented as nothing above it is"
    return failure.fault(message, failure.at, failure.end_of_word(failure.at))


def _no_item(failure: Failure) -> Fault | None:
    begin, end = failure.at, failure.end_of_word(failure.at)
    word = failure.text[begin:end]
    column = failure.place(begin)[1]
    if column != failure.place(failure.context)[1]:
        return failure.fault("this is indented as nothing above it is", begin, end)
    return failure.fault("an item of the list begins with '- '", begin, end, f"- {word.removeprefix('-')}")


def _key_without_colon(failure: Failure) -> Fault:
    return _without_colon(failure, failure.context)


def _item_in_line(failure: Failure) -> Fault:
    return failure.fault(
        "a list begins on a line of its own, or is written [a, b]", failure.at, failure.at + 1
    )


def _undefined_alias(failure: Failure) -> Fault:
    found = _ALIAS.match(failure.text, failure.at)
    name = found[1] if found else ""
    near = nearest(name, _ANCHOR.findall(failure.text))
    message = f"no anchor &{name} stands before this alias"
    end = found.end() if found else failure.at + 1
    return failure.fault(message, failure.at, end, f"*{near}" if near else None)


def _no_anchor(failure: Failure) -> Fault:
    """Explain a text that begins like an alias, an anchor or a block."""
    found = _PLAIN.match(failure.text, failure.context)
    end = _without_its_colon(failure, failure.context, found.end()) if found else failure.context + 1
    first = failure.text[failure.context]
    written = failure.text[failure.context : end]
    message = f"a text cannot begin with {first} unless it is in quotes"
    return failure.fault(message, failure.context, end, in_quotes(written))


def _no_character(error: yaml.YAMLError, whole: Source) -> Fault:
    found = _CONTROL.search(whole.text)
    if found is None:
        return Fault(f"this is not YAML: {shortened(str(error), 200)}", whole.span(0, 0))
    message = f"this is not YAML: a file cannot hold the character U+{ord(found[0]):04X}"
    return Fault(message, whole.span(*found.span()))


def _offset(mark: Any, whole: Source) -> int:  # noqa: ANN401 - a mark of either parser
    index: int = mark.index
    return min(index, len(whole.text))


# What the parser says where lines do not fit together.
_OF_LINES: Final = (
    "did not find expected key",
    "did not find expected '-' indicator",
    "did not find expected <document start>",
    "mapping values are not allowed",
    "could not find expected ':'",
)
_EXPLANATIONS: Final[dict[str, Callable[[Failure], Fault | None]]] = {
    "found character that cannot start any token": _stray,
    "found a tab character": _tab,
    "found unexpected end of stream": _ended,
    "did not find expected ',' or": _open,
    "mapping values are not allowed": _second_value,
    "could not find expected ':'": _key_without_colon,
    "did not find expected key": _no_key,
    "did not find expected node content": _no_value,
    "did not find expected '-' indicator": _no_item,
    "block sequence entries are not allowed": _item_in_line,
    "found undefined alias": _undefined_alias,
    "did not find expected alphabetic or numeric character": _no_anchor,
    "did not find expected comment or line break": _no_anchor,
    "found unknown escape character": of_escape,
}
