"""The table of contents: a launch file is read, what it says is written in another language, and read again."""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

from orchestra.convert.comments.attached import attached
from orchestra.convert.equality import compared
from orchestra.convert.moved import moved
from orchestra.convert.named import named
from orchestra.convert.normal import difference, said
from orchestra.convert.original import language_of, opened
from orchestra.convert.recovered import recovered
from orchestra.convert.remarks import Remark, Remarks, UnsayableError
from orchestra.convert.unfolded import unfolded
from orchestra.convert.writers import WRITERS
from orchestra.dataclass import dataclass
from orchestra.description.launch import Description
from orchestra.errors import DescriptionError, UsageError
from orchestra.fields import replace

if TYPE_CHECKING:
    from collections.abc import Mapping

    from orchestra.convert.comments.kept import Comments
    from orchestra.convert.original import Original

ENDINGS = {"python": ".launch.py", "xml": ".launch.xml", "yaml": ".launch.yaml"}


@dataclass(frozen=True, slots=True)
class Converted:
    """A launch file in another language, None where nothing came of it, and what there is to tell about it.

    `mistake` is where the text says something else than the file, which is a fault of the conversion.
    """

    text: str | None
    remarks: tuple[Remark, ...]
    lossy: bool
    mistake: str | None = None


def convert(
    path: str,
    language: str,
    environment: Mapping[str, str],
    *,
    output: str | None = None,
    partial: bool = False,
) -> Converted:
    """Write a launch file in `yaml`, `xml` or `python`: arguments, conditions and substitutions stay what they are.

    `output` is the folder in which the result will stand, None: that of the file. Relative paths stay right there.
    What the language cannot say is among the remarks; with `partial` the rest is written with a comment in its place.
    Raises `DescriptionError` where the file has faults, `UsageError` where it is in that language.
    """
    if language_of(path) == language:
        raise UsageError(f"{path} is in {language} already: `orchestra format` brings it into one form")
    remarks = Remarks()
    with opened(path, environment) as original:
        description = _described(original, remarks)
        if output is not None:
            there = moved(description.actions, str(Path(original.path).parent), output)
            description = replace(description, actions=there)
        comments = attached(original, description.actions)
        text = _text(description, comments, remarks, language, partial=partial)
        wanted = said(description)
    mistake = None
    if text is not None and not remarks.lossy:
        mistake = _mistake(text, wanted, path, language, environment)
    return Converted(text if partial or not remarks.lossy else None, remarks.ordered, remarks.lossy, mistake)


def _described(original: Original, remarks: Remarks) -> Description:
    """Return what a file says, with what its code has made known as far as possible."""
    actions = original.actions
    if original.language == "python":
        actions = named(unfolded(actions, remarks), remarks)
        actions = compared(recovered(actions, original, remarks))
    return Description(original.path, original.file, actions, original.deprecated)


def _text(
    description: Description, comments: Comments, remarks: Remarks, language: str, *, partial: bool
) -> str | None:
    try:
        return WRITERS[language](description, comments, remarks, partial=partial)
    except UnsayableError as error:
        remarks.lose(error.message, error.span)
        return None


def _mistake(
    text: str, wanted: object, path: str, language: str, environment: Mapping[str, str]
) -> str | None:
    """Read what was written, and return where it says something else; it is read from a folder of its own."""
    with tempfile.TemporaryDirectory(prefix="orchestra-") as folder:
        file = Path(folder, Path(path).name.split(".")[0] + ENDINGS[language])
        file.write_text(text, "utf-8")
        try:
            with opened(str(file), environment) as again:
                return difference(wanted, said(_described(again, Remarks())))
        except DescriptionError as error:
            return "; ".join(f"{problem.span}: {problem.message}" for problem in error.problems)
