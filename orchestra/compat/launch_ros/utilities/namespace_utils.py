"""How namespaces join."""

from __future__ import annotations


def is_root_namespace(ns: str) -> bool:
    """Return whether a namespace is `/`."""
    return ns == "/"


def is_namespace_absolute(ns: str) -> bool:
    """Return whether a namespace begins at the root."""
    return ns.startswith("/")


def make_namespace_absolute(ns: str | None) -> str | None:
    """Return a namespace with a slash in front; None stays None."""
    return ns if ns is None or is_namespace_absolute(ns) else f"/{ns}"


def prefix_namespace(base_ns: str | None, ns: str | None) -> str | None:
    """Return a namespace below another one, without slashes at its end; an absolute one stays as it is.

    None stands for a namespace that is not given: two of them give None.
    """
    if ns is None or not base_ns or is_namespace_absolute(ns):
        whole = base_ns if ns is None else ns
    else:
        whole = f"{'' if is_root_namespace(base_ns) else base_ns}/{ns}"
    return whole if whole is None or is_root_namespace(whole) else whole.rstrip("/")
