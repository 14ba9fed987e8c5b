"""`$(yaml-value path key [default])`: what stands in a YAML file, so that a file can carry a list of robots."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.description.source import Keyed, Written, kind_of
from orchestra.errors import Code
from orchestra.load.reader import Reader
from orchestra.nearest import nearest
from orchestra.resolve.context import POISON, Poison
from orchestra.resolve.refusals import refuse
from orchestra.resolve.substitutions.arguments import made
from orchestra.resolve.substitutions.file_content import content

if TYPE_CHECKING:
    from orchestra.description.text import Call
    from orchestra.resolve.context import Context, Evaluated
    from orchestra.resolve.substitutions.arguments import Evaluate


def perform(call: Call, context: Context, evaluate: Evaluate) -> Evaluated:
    """Return what stands under a key: `robots.robot1.x` is that of a mapping in a mapping.

    Of a list it is the items and of a mapping the keys, with commas between them. The default is evaluated only where
    there is nothing under the key. Paths are those of `file-content`.
    """
    found = content(call.arguments[0], context, evaluate)
    key = evaluate(call.arguments[1], context)
    if isinstance(found, Poison) or isinstance(key, Poison):
        return POISON
    at = context.at(call.arguments[0].span)
    name, text = found
    if all(line.partition("#")[0].strip() in ("", "---") for line in text.splitlines()):
        tree: Any = Written("", at.span, lambda _, __: at.span, null=True)
    else:
        from orchestra.load import yaml_file  # noqa: PLC0415 - it takes PyYAML

        tree = yaml_file.read(text, name, Reader(context.problems, (at.span, *at.included_from)))
    return POISON if tree is None else _under(key.text, tree, name, call, context, evaluate)


def _under(
    key: str,
    tree: Any,  # noqa: ANN401 - a tree
    file: str,
    call: Call,
    context: Context,
    evaluate: Evaluate,
) -> Evaluated:
    passed = ""
    for word in key.split("."):
        if not isinstance(tree, Keyed) or word not in tree:
            if len(call.arguments) > 2:  # noqa: PLR2004 - the third is the default
                default = evaluate(call.arguments[2], context)
                return default if isinstance(default, Poison) else made(call, context, default.text)
            near = nearest(word, tree) if isinstance(tree, Keyed) else None
            meant = f"{passed}{near}{key[len(passed) + len(word) :]}" if near else None
            told = f"there is no {passed + word!r} in {file}"
            return refuse(call.arguments[1], context, Code.UNDEFINED_VARIABLE, told, meant=meant)
        tree, passed = tree[word], f"{passed}{word}."
    text = _text(tree)
    if text is None:
        told = f"{key!r} in {file} is {kind_of(tree)} of lists or mappings: name something in it"
        return refuse(call.arguments[1], context, Code.BAD_VALUE, told)
    return made(call, context, text)


def _text(tree: Any) -> str | None:  # noqa: ANN401 - a tree
    if isinstance(tree, Written):
        return "" if tree.null else tree.text
    if isinstance(tree, Keyed):
        return ", ".join(tree)
    words = [item.text for item in tree if isinstance(item, Written)]
    return ", ".join(words) if len(words) == len(tree) else None
