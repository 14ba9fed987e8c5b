"""PyYAML, imported when something of it is first used, and with expressions that are compiled when they are.

It is a tenth of what a first plan takes, and most have no use for it: those of launch files in other languages, and of
plain ones in YAML. Its parser in C needs no expressions, which are two thirds of it.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

__all__ = ["in_place", "yaml"]

if TYPE_CHECKING:
    import yaml

else:

    class _Later:
        """What the module is, as soon as somebody wants something of it."""

        def __getattr__(self, name: str) -> object:
            # Here, because it takes long, and what reads and writes nothing has no use for the observer.
            from orchestra.patterns import late  # noqa: PLC0415
            from orchestra.witness.observing import observer  # noqa: PLC0415

            with (
                observer().aside(),
                late(),
            ):  # it is there, whatever is read: nothing depends on where it is found
                import yaml  # noqa: PLC0415
            vars(self).update(vars(yaml))
            return getattr(yaml, name)

    yaml = _Later()


def in_place() -> None:
    """Import it now: what runs next may bring another module of that name."""
    _ = yaml.YAMLError
