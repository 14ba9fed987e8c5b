"""What should stand in place of a piece of code that is of the wrong kind, where no more than its form is wrong."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any, Final

from orchestra.compat.forms_meant import form_meant
from orchestra.compat.source_text import text_at
from orchestra.compat.syntax_trees import called_by, node_span, tree_of
from orchestra.fields import replace

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.compat.place import Place
    from orchestra.location import Span

_MOST: Final = 100  # characters: what is longer is read better in the message alone
_TWO_TEXTS: Final = re.compile(r"""((["'])(?:(?!\2).)+\2)\s*((["'])(?:(?!\4).)+\4)""")
# Arguments whose values are names, hardly ever variables of the name that they have.
_NAMES: Final = frozenset({"executable", "exec", "name", "namespace", "output", "package", "pkg", "plugin"})
_TAKE_A_NAME: Final = frozenset(
    {
        *(
            "DeclareLaunchArgument",
            "EnvironmentVariable",
            "FindExecutable",
            "FindPackage",
            "FindPackagePrefix",
        ),
        *("FindPackageShare", "LaunchConfiguration", "get_package_prefix", "get_package_share_directory"),
    }
)


class Rewritten(str):
    """A suggestion that is code, quotes and brackets with it: it stands in place of the whole expression."""

    __slots__ = ()


def rewritten(file: str, span: Span, value: Any, message: str) -> Rewritten | None:
    """Return what was meant by the expression at a place that has come to a value, which was refused."""
    source = _short(file, span)
    if source is None:
        return None
    is_pair = isinstance(value, dict | list | set) or (isinstance(value, str) and ":=" in value)
    if "a remapping is a tuple" in message and not is_pair:
        return _apart(file, span, source)
    meant = (
        form_meant(source, value, message)
        or _loaded(file, source, message)
        or _called(file, source, value, message)
    )
    is_given = source in _arguments_around(file, span)  # then the mistake may be where the function is called
    return None if meant is None or is_given else Rewritten(meant)


def _called(file: str, source: str, value: Any, message: str) -> str | None:
    """Return the call of a function that stands in place of what it returns."""
    # Here, because only mistakes need it.
    from orchestra.compat.named_calls import call_of  # noqa: PLC0415

    is_value = any(
        part in message for part in ("expected a", "is no value of a parameter", "is a text, this is")
    )
    return call_of(source, value, tree_of(file)) if callable(value) and is_value else None


def in_brackets(file: str, span: Span) -> Span | None:
    """Return the place of what alone stands in round brackets with them, which are no tuple for want of a comma."""
    wide = replace(span, column=max(span.column - 2, 1), end_column=span.end_column + 1)
    source = text_at(file, wide)
    is_alone = source[1:2] == "(" and source[-1:] == ")" and source[:1] in " =,("
    return replace(wide, column=span.column - 1) if is_alone else None


def _loaded(file: str, source: str, message: str) -> str | None:
    """Return the action that loads a component which stands by itself, where the file has one container for it."""
    tree = tree_of(file) if "composable_node_descriptions" in message else None
    # Here, because only mistakes need it.
    import ast  # noqa: PLC0415

    containers = [
        node.targets[0].id
        for node in (() if tree is None else tree.nodes)
        if isinstance(node, ast.Assign)
        and isinstance(node.targets[0], ast.Name)
        and called_by(node.value) == "ComposableNodeContainer"
    ]
    if len(containers) != 1:
        return None
    return f"LoadComposableNodes(target_container={containers[0]}, composable_node_descriptions=[{source}])"


def _apart(file: str, span: Span, source: str) -> Rewritten | None:
    """Return two texts side by side in brackets with the comma between them that makes a pair."""
    before = text_at(file, replace(span, column=max(span.column - 1, 1)))[:1]
    found = _TWO_TEXTS.fullmatch(source)
    return Rewritten(f"{found[1]}, {found[3]}") if found is not None and before == "(" else None


def named(file: str, span: Span, name: str) -> Rewritten | None:
    """Return an argument with the name that it lacks."""
    source = _short(file, span)
    return None if source is None else Rewritten(f"{name}={source}")


def in_two(file: str, span: Span, value: Any) -> Rewritten | None:
    """Return a name and its value as two arguments that are given in one: a dictionary, a pair or a text."""
    source = _short(file, span) or ""
    match value:
        case dict() if len(value) == 1:
            pair = next(iter(value.items()))
            return Rewritten(f"{pair[0]!r}, {pair[1]!r}") if source[:1] == "{" else None
        case (str() as first, second):
            return Rewritten(f"{first!r}, {second!r}") if source[:1] in ("(", "[") else None
        case str() if "=" in value and source[1:-1] == value:
            first, _, second = value.partition("=")
            return Rewritten(f"{first.rstrip(' :')!r}, {second.lstrip()!r}")
    return None


def all_named(place: Place, first: int, names: Sequence[str]) -> tuple[Span, Rewritten | None]:
    """Return where the arguments without a name stand from one on, and these with the names that they lack."""
    # Here, because only mistakes need it.
    import ast  # noqa: PLC0415

    tree = tree_of(place.file)
    call = None if tree is None else tree.expression(place.file, place.span)
    given = call.args[first:] if isinstance(call, ast.Call) else []
    if not given or len(given) > len(names) or any(isinstance(item, ast.Starred) for item in given):
        return place.span, None
    begin, end = (node_span(place.file, given[index], quotes=True) for index in (0, -1))
    code = ", ".join(f"{name}={ast.unparse(item)}" for name, item in zip(names, given, strict=False))
    span = replace(begin, end_line=end.end_line, end_column=end.end_column)
    return span, Rewritten(code) if len(code) <= _MOST else None


def all_listed(place: Place) -> tuple[Span, Rewritten | None]:
    """Return where the arguments without a name of a call stand, and the list of them; else the whole call."""
    # Here, because only mistakes need it.
    import ast  # noqa: PLC0415

    tree = tree_of(place.file)
    call = None if tree is None else tree.expression(place.file, place.span)
    if not isinstance(call, ast.Call) or not call.args:
        return place.span, None
    first, last = (node_span(place.file, call.args[index], quotes=True) for index in (0, -1))
    code = f"[{', '.join(map(ast.unparse, call.args))}]"
    span = replace(first, end_line=last.end_line, end_column=last.end_column)
    return span, Rewritten(code) if len(code) <= _MOST else None


def last_comma(file: str, span: Span) -> Span | None:
    """Return where the comma stands that alone makes a tuple of what is assigned to the name at a place."""
    # Here, because only mistakes need it.
    import ast  # noqa: PLC0415

    tree = tree_of(file)
    node = None if tree is None else tree.expression(file, span)
    known = None if tree is None or node is None else tree.meaning(node)
    if not isinstance(known, ast.Tuple) or len(known.elts) != 1:
        return None
    whole, inner = node_span(file, known), node_span(file, known.elts[0], quotes=True)
    comma = replace(whole, line=inner.end_line, column=inner.end_column)
    is_bare = (whole.line, whole.column) == (inner.line, inner.column)
    return comma if is_bare and text_at(file, comma).strip() == "," else None


def in_quotes(place: Place, name: str) -> Rewritten | None:
    """Return a name that nobody has defined with quotes, where a text is what would stand there."""
    # Here, because only mistakes need it.
    import ast  # noqa: PLC0415

    tree = tree_of(place.file)
    known = None if tree is None else tree.expression(place.file, place.span)
    for node in () if known is None or tree is None else tree.nodes:
        match node:
            case ast.Dict(keys=texts):
                pass
            case ast.Call(func=ast.Name(id=called), args=[first, *_], keywords=words) if (
                called in _TAKE_A_NAME
            ):
                texts = [first, *(word.value for word in words if word.arg in _NAMES)]
            case ast.Call(keywords=words):
                texts = [word.value for word in words if word.arg in _NAMES]
            case _:
                continue
        if any(text is known for text in texts):
            return Rewritten(f"'{name}'")
    return None


def arguments_around(place: Place) -> tuple[str, ...]:
    """Return the arguments of the functions around a place: a frame has only those that its code names."""
    return _arguments_around(place.file, place.span)


def _arguments_around(file: str, span: Span) -> tuple[str, ...]:
    tree = tree_of(file)
    node = None if tree is None else tree.expression(file, span)
    if node is None or tree is None:
        return ()
    functions = tree.functions_around(node)
    return tuple(item.arg for each in functions for item in (*each.args.args, *each.args.kwonlyargs))


def _short(file: str, span: Span) -> str | None:
    """Return the code of a range, in one line; None where it is long, or says more in comments."""
    source = text_at(file, span)
    if "\n" in source:
        # Here, because only mistakes need it.
        import ast  # noqa: PLC0415

        tree = tree_of(file)
        node = None if tree is None or "#" in source else tree.expression(file, span)
        source = "" if node is None else ast.unparse(node)
    return source if 0 < len(source) <= _MOST else None
