"""Why a file is left as it is although nothing is wrong with it."""

from __future__ import annotations


class NotFormatted(Exception):  # noqa: N818 - it is no error: the file stays as it is
    """The file has something in it that has no form here, or would not have been the same afterwards."""
