"""What has been looked at, and how it was."""

from __future__ import annotations

import json
from functools import lru_cache
from typing import TYPE_CHECKING, Any, TypeAlias

from orchestra.dataclass import dataclass
from orchestra.fields import field

if TYPE_CHECKING:
    from collections.abc import Mapping

# Modification and change time in ns, size, inode and device: while they are the same, so is the content.
Signature: TypeAlias = tuple[int, ...]


@dataclass(slots=True, eq=False)
class Record:
    """What a result depends on.

    `files` are those that were opened: a digest of the content (of the reason where they cannot be read), and the
    signature where that may be trusted. `looks` are other looks at paths, by the kind of look: what `stat` told, where
    links lead to, what is in folders. `variables` are those of the environment, None where unset; `names` is a digest
    of the names of all of them, where these were listed. `answers` are those to questions, by their words. `unknown`
    tells why nobody can say what the result depends on; empty where that is not so. `parts` are records of what others
    may depend on as well.
    """

    files: dict[str, tuple[str, Signature | None]] = field(default_factory=dict)
    looks: dict[str, dict[str, Any]] = field(default_factory=dict)
    variables: dict[str, str | None] = field(default_factory=dict)
    names: str = ""
    answers: dict[str, Any] = field(default_factory=dict)
    unknown: str = ""
    parts: list[Record] = field(default_factory=list)

    def depend(self, part: Record) -> None:
        """Depend on what another one depends on, too."""
        self.parts.append(part)
        self.unknown = self.unknown or part.unknown

    def every(self) -> list[Record]:
        """Return it with its parts and theirs, each once."""
        if not self.parts:
            return [self]
        found = {self: None}
        waiting = [self]
        while waiting:
            for part in waiting.pop().parts:
                if part not in found:
                    found[part] = None
                    if part.parts:
                        waiting.append(part)
        return list(found)

    def whole(self) -> Record:
        """Return a record without parts that depends on the same; what is here counts before what is there."""
        whole = Record()
        for record in self.every():
            whole.absorb(record)
        return whole

    def absorb(self, other: Record) -> None:
        """Depend on what another one without parts depends on, too; what has been seen first counts."""
        _add(self.files, other.files)
        for kind, looks in other.looks.items():
            _add(self.looks.setdefault(kind, {}), looks)
        _add(self.variables, other.variables)
        self.names = self.names or other.names
        _add(self.answers, other.answers)
        self.unknown = self.unknown or other.unknown

    def as_data(self) -> dict[str, Any]:
        """Return it as JSON data, without its parts."""
        return {
            "files": self.files,
            "looks": self.looks,
            "variables": self.variables,
            "names": self.names,
            "answers": self.answers,
        }

    @classmethod
    def from_data(cls, data: Mapping[str, Any]) -> Record:
        """Return what was written as JSON data; raises `KeyError`, `TypeError` and `ValueError` for anything else."""
        files = {
            path: (digest, None if signature is None else tuple(signature))
            for path, (digest, signature) in data["files"].items()
        }
        return cls(files, data["looks"], data["variables"], data["names"], data["answers"])


def _add(known: dict[str, Any], more: Mapping[str, Any]) -> None:
    for key, value in more.items():
        if key not in known:
            known[key] = value


@lru_cache(maxsize=1024)
def question(*words: str) -> str:
    """Return the words of a question as one text."""
    return json.dumps(words)
