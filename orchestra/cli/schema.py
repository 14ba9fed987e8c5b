"""`orchestra schema`: print a JSON Schema of our own files, or capture what a running node declares."""

from __future__ import annotations

import json
import sys
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Any

from orchestra.cli.boundary import OK
from orchestra.cli.parser import CommandParser
from orchestra.cli.schemas.table import FILES, schema_text
from orchestra.errors import RunError, UsageError

if TYPE_CHECKING:
    from argparse import Namespace

    from orchestra.declared.capturing.model import Captured

_CAPTURE = "capture"
_FORMATS = ("json", "yaml", "gpl")
_EPILOG = """\
'orchestra schema capture NODE' asks a running node, by its full name, for the descriptors of its parameters and writes
a schema: JSON Schema as json or yaml, gpl for a definition of generate_parameter_library. With --interfaces the topics,
services and actions that it has are written to another file, with types and QoS. Where a launch file then names the
schema (params_schema), or the package has it beside its parameters, values are checked before anything starts.
"""


def parser() -> CommandParser:
    """Return what the command understands."""
    made = CommandParser(
        "schema", "Print the JSON Schema of one kind of file, or write one for a running node.", _EPILOG
    )
    made.add_argument(
        "name",
        nargs="?",
        choices=[*sorted(FILES), _CAPTURE],
        default="launch",
        help="which one (default: launch)",
    )
    made.add_argument("node", nargs="?", metavar="NODE", help="with capture: the full name of the node")
    made.add_argument(
        "-o", "--output", metavar="FILE", help="with capture: where to write it (default: print it)"
    )
    made.add_argument("--format", choices=_FORMATS, help="with capture: how (default: json, or as FILE ends)")
    made.add_argument(
        "--interfaces", metavar="FILE", help="with capture: write the interfaces of the node there"
    )
    made.add_argument(
        "--timeout",
        type=float,
        default=10.0,
        metavar="SECONDS",
        help="with capture: wait so long (default: 10)",
    )
    made.add_argument(
        "--run", metavar="RUN", help="with capture: the node is reached as those of this run are"
    )
    return made


def run(options: Namespace) -> int:
    """Print the schema."""
    if options.name == _CAPTURE:
        return _capture(options)
    given = [name for name in ("node", "output", "format", "interfaces", "run") if getattr(options, name)]
    if given:
        raise UsageError(f"'{given[0]}' goes with capture: orchestra schema capture NODE")
    sys.stdout.write(schema_text(options.name))
    return OK


def _capture(options: Namespace) -> int:
    if options.node is None:
        raise UsageError("the full name of a node is missing: orchestra schema capture NODE")
    if not 0 < options.timeout < float("inf"):
        raise UsageError(f"a time to wait is a number of seconds, not {options.timeout:g}")
    # Here, because the other schemas need none of it.
    from orchestra.cli.capturing import capture, environment_of  # noqa: PLC0415
    from orchestra.cli.runs import living  # noqa: PLC0415

    run = None if options.run is None else living(options.run)
    with tempfile.TemporaryDirectory(prefix="orchestra-") as logs:
        found = capture(
            options.node,
            environment_of(run, logs),
            timeout=options.timeout,
            interfaces=options.interfaces is not None,
        )
    text = _schema(found, options.format or _format_of(options.output))
    if options.interfaces is not None:
        from orchestra.declared.capturing.interface import as_interface  # noqa: PLC0415 - as above

        _write(options.interfaces, _text(as_interface(found), json_=options.interfaces.endswith(".json")))
    if options.output is None:
        sys.stdout.write(text)
    else:
        _write(options.output, text)
    return OK


def _format_of(output: str | None) -> str:
    return "yaml" if output is not None and output.endswith((".yaml", ".yml")) else "json"


def _schema(found: Captured, wanted: str) -> str:
    from orchestra.declared.capturing.definition import as_definition  # noqa: PLC0415 - as above
    from orchestra.declared.capturing.json_schema import as_json_schema  # noqa: PLC0415

    if wanted != "gpl":
        return _text(as_json_schema(found), json_=wanted == "json")
    try:
        return _text(as_definition(found), json_=False)
    except ValueError as error:
        raise RunError(str(error)) from None


def _text(document: Any, *, json_: bool) -> str:  # noqa: ANN401 - JSON data
    if json_:
        return json.dumps(document, indent=2, ensure_ascii=False) + "\n"
    import yaml  # noqa: PLC0415 - as above

    return yaml.safe_dump(document, sort_keys=False, allow_unicode=True, width=100)


def _write(path: str, text: str) -> None:
    Path(path).write_text(text, "utf-8")
