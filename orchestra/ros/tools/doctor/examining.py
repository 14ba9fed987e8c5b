"""`doctor`: observes the graph, makes the checks, and tells what is wrong."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.ros.tools.doctor.checks.table import CHECKS
from orchestra.ros.tools.doctor.observing import observed
from orchestra.ros.tools.doctor.report import report, report_text
from orchestra.ros.tools.graph.joining import joined
from orchestra.ros.tools.telling import lines, tell

if TYPE_CHECKING:
    from argparse import Namespace
    from collections.abc import Sequence

    from orchestra.ros.tools.doctor.observed import Finding

_WRONG = 1


def examine(options: Namespace) -> int:
    """Write what is wrong; return 1 where something is, else 0."""
    with joined(options) as graph:
        seen = observed(graph, options)
        domain = graph.node.context.get_domain_id()
    findings = [finding for name in options.checks for finding in CHECKS[name](seen)]
    reports = options.report or (options.report_failed and findings)
    told = report(seen, domain) if reports else None
    data: dict[str, Any] = {"domain": domain, "nodes": sorted(seen.system.nodes), "checks": options.checks}
    data["findings"] = [
        {"check": one.check, "message": one.message, "about": list(one.about), "details": one.details}
        for one in findings
    ]
    if told is not None:
        data["report"] = told
    text = "" if told is None else report_text(told) + "\n"
    text += lines(f"{one.check}: {one.message}" for one in findings)
    tell(options, text + _summary(findings, len(seen.system.nodes), domain), data)
    return _WRONG if findings else 0


def _summary(findings: Sequence[Finding], nodes: int, domain: int) -> str:
    where = f"{_counted(nodes, 'node')} in domain {domain}"
    if not findings:
        return f"nothing is wrong: {where}\n"
    count = len(findings)
    return f"{'1 thing is' if count == 1 else f'{count} things are'} wrong: {where}\n"


def _counted(count: int, word: str) -> str:
    return f"{count} {word}" if count == 1 else f"{count or 'no'} {word}s"
