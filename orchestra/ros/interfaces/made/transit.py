"""Messages on their way: what is written and read by the types of the fields."""

from __future__ import annotations

from orchestra.ros.interfaces import cdr, conversion
from orchestra.ros.interfaces.wire import MalformedMessageError


def transit_of(kind: type) -> type[conversion.MessageInTransit]:
    """Return the class of the objects that stand for messages of a class on their way."""

    class InTransit(conversion.MessageInTransit):
        type_name = kind.__name__

        def encode(self, source: object) -> bytes:
            if not isinstance(source, kind):
                raise TypeError(f"{source!r} is no {kind.__name__}")
            return cdr.encode(source)

        def __call__(self) -> object:
            """Return what came in; an empty message, with a record in the log, if it is malformed.

            Raising here would leave rclpy's executor unable to serve the subscription again.
            """
            try:
                return conversion.uninterrupted(cdr.decode, self.serialized(), kind)
            except MalformedMessageError as error:
                conversion.log.error(
                    "a malformed %s came in, taken as an empty one: %s", kind.__name__, error
                )
                return kind()

    return InTransit
