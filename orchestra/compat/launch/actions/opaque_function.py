"""`OpaqueFunction`: calls a function of the launch file."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

from orchestra.compat.explanation import told
from orchestra.compat.launch.action import Action
from orchestra.compat.wrong import WrongType

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.compat.launch.launch_context import LaunchContext
    from orchestra.compat.launch.launch_description_entity import LaunchDescriptionEntity


class OpaqueFunction(Action):
    """Call `function(context, *args, **kwargs)`; what it returns, None or a list of entities, is visited next.

    Raises `TypeError` for what cannot be called.
    """

    def __init__(
        self,
        *,
        function: Callable[..., list[LaunchDescriptionEntity] | None],
        args: Iterable[Any] | None = None,
        kwargs: Mapping[str, Any] | None = None,
        **left_over_kwargs: Any,
    ) -> None:
        super().__init__(**left_over_kwargs)
        if not callable(function):
            raise WrongType(
                f"the function of an OpaqueFunction cannot be called: {function!r}", path=("function",)
            )
        if args is not None and (not isinstance(args, Iterable) or (isinstance(args, str) and len(args) > 1)):
            raise WrongType(f"the args of an OpaqueFunction are a list, this is {told(args)}", path=("args",))
        if kwargs is not None and not isinstance(kwargs, Mapping):
            raise WrongType(
                f"the kwargs of an OpaqueFunction are a dict, this is {told(kwargs)}", path=("kwargs",)
            )
        self.__function = function
        self.__args = () if args is None else tuple(args)
        self.__kwargs = {} if kwargs is None else dict(kwargs)

    @property
    def function(self) -> Callable[..., list[LaunchDescriptionEntity] | None]:
        """The function."""
        return self.__function

    def execute(self, context: LaunchContext) -> list[LaunchDescriptionEntity] | None:
        """Call it."""
        return self.__function(context, *self.__args, **self.__kwargs)
