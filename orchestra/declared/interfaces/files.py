"""What an executable declares of its interfaces, in whatever way its package has it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.declared.documents import read_document
from orchestra.declared.interfaces.finding import names_of, nodl_files, own_file
from orchestra.declared.interfaces.own_form import read_interface

if TYPE_CHECKING:
    from orchestra.declared.interfaces.model import Interface
    from orchestra.errors import Problems
    from orchestra.location import Location


def interface_of(share: str, called: str, named_at: Location, problems: Problems) -> Interface | None:
    """Return what an executable, or the class `pkg::Class`, declares; None where its package says nothing of it.

    `named_at` is where the description starts it.
    """
    path = own_file(share, called)
    if path is not None:
        document = read_document(path, named_at, problems)
        return None if document is None else read_interface(document, problems)
    for file in nodl_files(share):
        # Here, because few packages have such files, and for the parser of XML.
        from orchestra.declared.interfaces.nodl_xml import read_nodl  # noqa: PLC0415

        found = read_nodl(file, named_at, problems)
        chosen = next((found[name] for name in names_of(called) if name in found), None)
        if chosen is not None:
            return chosen
    return None
