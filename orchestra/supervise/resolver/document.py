"""What the resolver hands to the supervisor: one JSON document with a plan and the options of the run."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, NamedTuple

from orchestra.plan import codec, model
from orchestra.plan.json_text import text_of
from orchestra.supervise import options

if TYPE_CHECKING:
    from orchestra.supervise.options import RunOptions


class Document(NamedTuple):
    """A plan and how to run it."""

    plan: model.Plan
    options: RunOptions


def dumps(plan: model.Plan, run_options: RunOptions) -> bytes:
    """Return the document for the stream that `prepare` is given."""
    chosen = json.dumps(options.encode(run_options), ensure_ascii=False)
    return f'{{"plan": {text_of(plan)}, "options": {chosen}}}'.encode("utf-8", "surrogatepass")


def loads(content: bytes) -> Document:
    """Read a document. Raises `ValueError` where it is none."""
    document = json.loads(content.decode("utf-8", "surrogatepass"))
    if not isinstance(document, dict) or document.keys() - {"plan", "options"} or "plan" not in document:
        raise ValueError("not an object with a plan")
    plan = document["plan"]
    if not isinstance(plan, dict) or plan.get("version") != model.VERSION:
        raise ValueError(f"not a plan of version {model.VERSION}")
    try:
        return Document(codec.decode(model.Plan, plan), options.decode(document.get("options", {})))
    except (KeyError, TypeError, AttributeError, IndexError) as error:
        raise ValueError(f"the plan is not complete: {error!r}") from error
