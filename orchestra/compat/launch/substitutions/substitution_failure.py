"""`SubstitutionFailure`: a substitution that cannot be performed."""

from __future__ import annotations


class SubstitutionFailure(RuntimeError):
    """Raised by `perform`."""
