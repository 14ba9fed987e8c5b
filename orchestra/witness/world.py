"""Whether what has been recorded is still so. Each thing is looked at once, however many records name it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.witness import looking

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from orchestra.witness.record import Record, Signature


class World:
    """How things are now; `ask` answers the questions that records have answers to."""

    def __init__(self, environment: Mapping[str, str], ask: Callable[[str], Any]) -> None:
        self._environment = environment
        self._names = ""
        self._ask = ask
        self._signatures: dict[str, Signature | None] = {}
        self._digests: dict[str, str | None] = {}
        self._looks: dict[str, dict[str, Any]] = {kind: {} for kind in looking.LOOKS}
        self._answers: dict[str, Any] = {}
        self._parts: dict[int, tuple[Record, bool]] = {}  # kept, so that no other one gets its number

    def holds(self, record: Record) -> bool:
        """Tell whether everything is as it was."""
        return self._holds(record) and all(self._part_holds(part) for part in record.every()[1:])

    def _part_holds(self, part: Record) -> bool:
        known = self._parts.get(id(part))
        if known is None:
            known = self._parts[id(part)] = part, self._holds(part)
        return known[1]

    def _holds(self, record: Record) -> bool:
        return (
            not record.unknown
            and all(self._environment.get(name) == value for name, value in record.variables.items())
            and (not record.names or record.names == self._all_names())
            and all(self._is(path, *state) for path, state in record.files.items())
            and all(
                self._look(kind, path) == told
                for kind, all_ in record.looks.items()
                for path, told in all_.items()
            )
            and all(self._answer(words) == answer for words, answer in record.answers.items())
        )

    def _is(self, path: str, digest: str, before: Signature | None) -> bool:
        if before is not None and self._signature(path) == before:
            return True
        if path not in self._digests:
            self._digests[path] = looking.content(path)
        return self._digests[path] == digest

    def _signature(self, path: str) -> Signature | None:
        if path not in self._signatures:
            self._signatures[path] = looking.signature(path)
        return self._signatures[path]

    def _look(self, kind: str, path: str) -> Any:
        known = self._looks[kind]
        if path not in known:
            known[path] = looking.LOOKS[kind](path)
        return known[path]

    def _all_names(self) -> str:
        self._names = self._names or looking.names_of(self._environment)
        return self._names

    def _answer(self, words: str) -> Any:
        if words not in self._answers:
            self._answers[words] = self._ask(words)
        return self._answers[words]
