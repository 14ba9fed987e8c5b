"""`InvalidConditionExpressionError`: a condition that comes to no boolean."""

from __future__ import annotations


class InvalidConditionExpressionError(ValueError):
    """Raised when a condition is evaluated whose text is no boolean."""
