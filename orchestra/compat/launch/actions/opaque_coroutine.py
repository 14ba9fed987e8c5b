"""`OpaqueCoroutine`: runs a coroutine of the launch file while the system runs."""

from __future__ import annotations

import asyncio
from inspect import iscoroutinefunction
from typing import TYPE_CHECKING, Any

from orchestra.compat.building import model_of
from orchestra.compat.launch.action import ModelledAction
from orchestra.compat.launch.actions.opaque_function import OpaqueFunction
from orchestra.compat.values import scalar
from orchestra.compat.wrong import WrongType
from orchestra.description.actions.timer import Timer

if TYPE_CHECKING:
    from collections.abc import Callable, Coroutine, Iterable, Mapping

    from orchestra.compat.launch.launch_context import LaunchContext
    from orchestra.description.entity import Action as Model


class OpaqueCoroutine(ModelledAction):
    """Run `coroutine(context, *args, **kwargs)` when the system starts, without the context if it is to be ignored.

    It runs to its end before any other code of the launch file is called; what it emits follows then. Raises
    `TypeError` for anything but a coroutine function, for `args` that are no iterable and `kwargs` that are no dict.
    """

    def __init__(
        self,
        *,
        coroutine: Callable[..., Coroutine[Any, Any, Any]],
        args: Iterable[Any] | None = None,
        kwargs: dict[str, Any] | None = None,
        ignore_context: bool = False,
        **left_over_kwargs: Any,
    ) -> None:
        super().__init__(**left_over_kwargs)
        if not iscoroutinefunction(coroutine):
            raise WrongType(
                f"OpaqueCoroutine takes a coroutine function, not {coroutine!r}", path=("coroutine",)
            )
        if kwargs is not None and not isinstance(kwargs, dict):
            raise WrongType(f"the kwargs of an OpaqueCoroutine are a dict, not {kwargs!r}", path=("kwargs",))
        self.__coroutine = coroutine
        self.__args = () if args is None else tuple(args)
        self.__kwargs = kwargs or {}
        self.__ignore_context = ignore_context

    def _to_model(self, common: Mapping[str, Any]) -> Model:
        span = self._place.span
        during_the_run = OpaqueFunction(function=self.__run)
        during_the_run._place = self._place
        return Timer.at(span, period=scalar(0, span), children=(model_of(during_the_run),), **common)

    def __run(self, context: LaunchContext) -> None:
        """Run the coroutine to its end."""
        first = () if self.__ignore_context else (context,)
        asyncio.run(self.__coroutine(*first, *self.__args, **self.__kwargs))
