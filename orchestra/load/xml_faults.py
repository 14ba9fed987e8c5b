"""Why a text is no XML, in the words of who wrote it: the parser's own are few and point behind the cause."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Final
from xml.parsers.expat import ErrorString, errors

from orchestra.dataclass import dataclass
from orchestra.description.actions import ACTIONS, model_of
from orchestra.description.launch import Launch
from orchestra.description.source import shortened
from orchestra.errors import Code
from orchestra.load.faults import Fault
from orchestra.load.forms import forms_of
from orchestra.location import Span
from orchestra.nearest import is_slip

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from orchestra.load.offsets import Source

_NAME = r"[^\s=<>/\"'&]+"
_WORD = re.compile(_NAME)
_ENTITY = re.compile(r"&(?!(?:amp|lt|gt|quot|apos);|#)([^;\s&<]*;?)")
_CHARACTER = re.compile(r"&#[^;\s&<]*;?")
_ATTRIBUTE = re.compile(rf"""(\s*)({_NAME})(?:\s*=\s*(?:("[^"<]*"?|'[^'<]*'?)|({_NAME}))?)?""")
_DOUBLED = re.compile(r"\s*=\s*=")
_CURLY = "\u201c\u201d\u201e\u2018\u2019"
_KNOWN_ENTITIES = "XML knows &amp; &lt; &gt; &quot; &apos; and numbers such as &#10;"


@dataclass(frozen=True, slots=True)
class Opened:
    """The innermost element that is open where a fault is found, and the names of those around it.

    `ended` has the places of the `/>` by which elements in it end, the last one of each name.
    """

    name: str
    span: Span
    around: tuple[str, ...]
    ended: dict[str, Span]


def explained(code: int, at: int, whole: Source, opened: Opened | None) -> Fault:
    """Return the fault behind an error code of expat at an offset."""
    if "<<<<<<<" in whole.text:
        from orchestra.load.conflicts import TOLD, conflict_in  # noqa: PLC0415 - hardly any file has one

        if (conflict := conflict_in(whole.text)) is not None:
            return _fault(TOLD, whole, *conflict)
    reason = ErrorString(code)
    if reason in _EXPLANATIONS:
        return _EXPLANATIONS[reason](at, whole, opened)
    return _fault(f"this is not XML: {reason}", whole, at, at)


def _fault(message: str, whole: Source, begin: int, end: int, suggestion: str | None = None) -> Fault:
    return Fault(message, whole.span(begin, end), suggestion=suggestion)


def _mismatch(at: int, whole: Source, opened: Opened | None) -> Fault:
    name = _word(whole.text, at)
    assert opened is not None  # noqa: S101 - a tag is closed that does not match one
    if name in opened.around and not is_slip(name, opened.name):
        return Fault(
            f"<{opened.name}> is not closed: </{opened.name}> is missing before </{name}>", opened.span
        )
    if is_slip(opened.name, name) and _is_known(name) and not _is_known(opened.name):
        message = f"<{opened.name}> is closed by </{name}>, which is what it is called"
        return Fault(message, opened.span, suggestion=name)
    note = f"<{opened.name}> is opened at {opened.span}"
    if name in opened.ended:
        note = f"<{name}> is closed already: the '/>' at {opened.ended[name]} does so"
    return Fault(
        f"</{name}> stands where </{opened.name}> is expected",
        whole.span(at, at + len(name)),
        suggestion=opened.name if is_slip(name, opened.name) else None,
        notes=(note,),
    )


def _is_known(name: str) -> bool:
    """Return whether an element has this name somewhere in a launch file."""
    models = [Launch, *(model for action in ACTIONS if (model := model_of(action)) is not None)]
    known = {"launch", *ACTIONS, *(key for model in models for key in forms_of(model).elements)}
    return name.replace("-", "_") in known


def _ended(at: int, whole: Source, opened: Opened | None) -> Fault:
    if opened is not None:
        return Fault(f"<{opened.name}> is not closed: </{opened.name}> is missing", opened.span)
    del at
    return _fault("the file is empty: a launch file has a <launch> element", whole, 0, 0)


def _unclosed(at: int, whole: Source, opened: Opened | None) -> Fault:
    del opened
    for begin, what, end in (("<!--", "comment", "-->"), ("<?", "processing instruction", "?>")):
        if whole.text.startswith(begin, at):
            return _fault(f"this {what} is not closed: '{end}' is missing", whole, at, at + len(begin))
    return _in_tag(at, len(whole.text), whole) or _fault(
        "this tag is not closed: '>' is missing", whole, at, at + 1
    )


def _unclosed_cdata(at: int, whole: Source, opened: Opened | None) -> Fault:
    del opened
    begin = whole.text.rfind("<![CDATA[", 0, at)
    return _fault("this CDATA section is not closed: ']]>' is missing", whole, begin, begin + 9)


def _second_root(at: int, whole: Source, opened: Opened | None) -> Fault:
    del opened
    if whole.text.startswith("<", at) and (name := _word(whole.text, at + 1)):
        message = f"a launch file has one root element: <{name}> stands behind it"
        return _fault(message, whole, at + 1, at + 1 + len(name))
    line = whole.text[at:].partition("\n")[0].rstrip()
    return _fault(f"'{shortened(line)}' stands behind the root element", whole, at, at + len(line))


def _unknown_entity(at: int, whole: Source, opened: Opened | None) -> Fault:
    del opened
    found = _ENTITY.search(whole.text, at)
    begin, end = found.span() if found else (at, at)
    name = whole.text[begin:end]
    span = whole.span(begin, end)
    from html.entities import name2codepoint  # noqa: PLC0415 - large, and only mistakes need it

    number = name2codepoint.get(name.strip("&;"))
    instead = f"&amp;{name[1:]}" if number is None else f"&#{number};"
    return Fault(f"there is no entity {name}", span, suggestion=instead, notes=(_KNOWN_ENTITIES,))


def _no_character(at: int, whole: Source, opened: Opened | None) -> Fault:
    del opened
    found = _CHARACTER.match(whole.text, at)
    end = found.end() if found else at
    return _fault(f"{whole.text[at:end]} is no character that XML can hold", whole, at, end)


def _twice(at: int, whole: Source, opened: Opened | None) -> Fault:
    del opened
    name = _word(whole.text, at)
    tag = whole.text.rfind("<", 0, at)
    first = re.compile(rf"\s({re.escape(name)})\s*=").search(whole.text, tag)
    notes = (f"first at {whole.span(first.start(1), first.end(1))}",) if first else ()
    message = f"the attribute '{name}' stands twice in one element"
    return Fault(message, whole.span(at, at + len(name)), Code.DUPLICATE_KEY, notes=notes)


def _late_declaration(at: int, whole: Source, opened: Opened | None) -> Fault:
    del opened
    return _fault("the XML declaration must be the very first in the file", whole, at, at + 5)


def _invalid(at: int, whole: Source, opened: Opened | None) -> Fault:
    """Return the cause of what the parser calls an invalid token, or a syntax error outside the root."""
    text = whole.text
    begin = text.rfind("<", 0, at)
    comment = _comment(at, whole)
    if comment is not None:
        return comment
    ampersand = text.rfind("&", 0, at)
    if ampersand >= 0 and re.fullmatch(r"&[\w.#-]*", text[ampersand:at]):
        end = ampersand + 1 + (text[ampersand + 1 : ampersand + 2] == "&")  # `&&` is one mistake
        meant = "&amp;" * (end - ampersand)
        return _fault(f"'&' begins an entity: write {meant}", whole, ampersand, end, meant)
    here = text[at : at + 1]
    if here.isspace() and text.endswith("/", 0, at) and begin >= 0 and text[at:].lstrip().startswith("<"):
        return _fault("this '/' needs a '>' behind it", whole, at - 1, at, "/>")
    if here and (here < " " or here in "\ufffe\uffff"):
        return _fault(f"the character U+{ord(here):04X} cannot stand in XML", whole, at, at + 1)
    if begin >= 0 and (fault := _in_tag(begin, at, whole) or _unfinished(begin, at, whole)):
        return fault
    if text.endswith("]]", 0, at) and here == ">":
        return _fault("']]>' cannot stand in a text", whole, at - 2, at + 1)
    if opened is None and begin < 0:
        line = text[at:].partition("\n")[0].rstrip()
        return _fault(f"this is not XML: it begins with '{shortened(line)}'", whole, at, at + len(line))
    return _fault("this is not XML", whole, at, at + len(here))


def _comment(at: int, whole: Source) -> Fault | None:
    """Return what is wrong with the comment that an offset is inside of, None where it is in none."""
    text = whole.text
    begin = text.rfind("<!--", 0, at)
    outer = text.rfind("<!--", 0, begin) if text.startswith("<!--", at - 4) else begin
    if outer < 0 or text.find("-->", outer, at) >= 0:
        return None
    if outer < begin and "\n" in text[outer:begin]:  # the next comment begins, and this one has not ended
        return _fault("this comment is not closed: '-->' is missing", whole, outer, outer + 4)
    return _fault("'--' cannot stand inside a comment", whole, at - 2, at)


def _in_tag(begin: int, at: int, whole: Source) -> Fault | None:
    """Return what is wrong with the attributes of a tag that begins at one offset and fails at another."""
    text = whole.text
    place = begin + 1 + len(_word(text, begin + 1))
    if text.startswith("/", begin + 1):
        place = begin + 2 + len(_word(text, begin + 2))
        return None if at > place else _fault(f"'{text[begin:place]}>' closes nothing", whole, begin, place)
    if place == begin + 1 or begin < at < place:
        message = "'<' begins a tag, and a name follows at once: a '<' of a text is written &lt;"
        return _fault(message, whole, begin, begin + 1, "&lt;")
    while (found := _ATTRIBUTE.match(text, place)) and found.start() <= at:
        if not found[1] and text[place - 2] == "=":
            return _unquoted(begin, place, whole)
        if (fault := _in_attribute(found, whole)) is not None:
            return fault
        place = found.end()
    return None


def _in_attribute(found: re.Match[str], whole: Source) -> Fault | None:
    """Return what is wrong with one attribute: a blank before it, a name, a value in quotes or without."""
    blank, name, quoted, bare = found.groups()
    if not blank:
        if name[:1] in ",;":
            return _fault(f"blanks stand between attributes, not '{name}'", whole, *found.span(2), " ")
        return _fault(f"a space is missing before '{name}'", whole, *found.span(2), f" {name}")
    if bare:
        behind = whole.text[found.end(4) :][:1]
        meant = f"{behind}{bare}" if behind in ("'", '"') else f'"{bare.strip(_CURLY)}"'
        return _fault(f"the value of '{name}' needs quotes", whole, *found.span(4), meant)
    if not quoted and (doubled := _DOUBLED.match(whole.text, found.end(2))):
        return _fault("one '=' stands between name and value", whole, doubled.end() - 1, doubled.end())
    if not quoted:
        message = f"the attribute '{name}' has no value: write {name}=\"...\""
        is_apart = whole.text[found.end(2) :].lstrip()[:1] in (
            '"',
            "'",
        )  # the value stands there, without its '='
        return _fault(message, whole, *found.span(2), f"{name.rstrip(':')}=" if is_apart else None)
    if len(quoted) == 1 or quoted[-1] != quoted[0]:
        return _in_value(name, found.start(3), found.end(3), whole)
    return None


def _unfinished(begin: int, at: int, whole: Source) -> Fault | None:
    """Return what is wrong with the end of a tag that begins at one offset and fails at another."""
    text = whole.text
    if text.startswith("<", at) and ">" not in text[begin:at]:
        return _fault("this tag is not closed: '>' is missing", whole, begin, begin + 1)
    if text.endswith("/", 0, at) and text[at:].lstrip().startswith(">"):
        return _fault("'/>' ends an element: nothing stands between the two", whole, at - 1, at)
    return None


def _unquoted(begin: int, end: int, whole: Source) -> Fault:
    """Return the fault of a value that holds the beginning of the next attribute: its own quote is not closed."""
    place = begin + 1 + len(_word(whole.text, begin + 1))
    while (found := _ATTRIBUTE.match(whole.text, place)) and found.end() < end:
        place = found.end()
    assert found is not None  # noqa: S101 - it ends there
    return _fault(
        f"the value of '{found[2]}' is not closed: a quote is missing",
        whole,
        found.start(3),
        found.start(3) + 1,
    )


def _in_value(name: str, begin: int, end: int, whole: Source) -> Fault:
    """Return why a value is not closed: a '<' in it, or a quote that is missing before that."""
    text = whole.text
    rest_of_line = text[end:].partition("\n")[0]
    if not re.search("[\n>]", text[begin:end]) and text[begin] in rest_of_line:
        message = f"the value of '{name}' cannot hold '<': write &lt;"
        return _fault(message, whole, end, end + 1, "&lt;")
    return _fault(f"the value of '{name}' is not closed: a quote is missing", whole, begin, begin + 1)


def _word(text: str, at: int) -> str:
    found = _WORD.match(text, at)
    return found[0] if found else ""


_EXPLANATIONS: Final[Mapping[str, Callable[[int, Source, Opened | None], Fault]]] = {
    errors.XML_ERROR_SYNTAX: _invalid,
    errors.XML_ERROR_INVALID_TOKEN: _invalid,
    errors.XML_ERROR_NO_ELEMENTS: _ended,
    errors.XML_ERROR_UNCLOSED_TOKEN: _unclosed,
    errors.XML_ERROR_UNCLOSED_CDATA_SECTION: _unclosed_cdata,
    errors.XML_ERROR_TAG_MISMATCH: _mismatch,
    errors.XML_ERROR_DUPLICATE_ATTRIBUTE: _twice,
    errors.XML_ERROR_JUNK_AFTER_DOC_ELEMENT: _second_root,
    errors.XML_ERROR_UNDEFINED_ENTITY: _unknown_entity,
    errors.XML_ERROR_BAD_CHAR_REF: _no_character,
    errors.XML_ERROR_MISPLACED_XML_PI: _late_declaration,
}
