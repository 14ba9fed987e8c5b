"""`SetRemap`: adds a remapping rule to every node."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.compat.building import made_of
from orchestra.compat.launch.plain_action import PlainAction, text_at
from orchestra.compat.text import normalized, template
from orchestra.description.actions.set_remap import SetRemap as SetRemapModel

if TYPE_CHECKING:
    from collections.abc import Mapping

    from orchestra.compat.launch.substitution import Substitution
    from orchestra.compat.place import Arguments
    from orchestra.compat.text import Sub
    from orchestra.description.entity import Action as Model


class SetRemap(PlainAction):
    """Let every node that follows in this scope use the name `dst` instead of `src`."""

    _plain = (2, ("src", "dst"))

    def __init__(self, src: Sub, dst: Sub, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__src = normalized(src)
        self.__dst = normalized(dst)

    @property
    def src(self) -> list[Substitution]:
        """The name that nodes use."""
        return self.__src

    @property
    def dst(self) -> list[Substitution]:
        """The name that they shall use instead."""
        return self.__dst

    def _read(self, given: dict[str, Any], call: Arguments) -> tuple[type[Model], dict[str, Any]]:
        source, target = text_at(given["src"], call, "src"), text_at(given["dst"], call, "dst")
        return SetRemapModel, {"from_": source, "to": target}

    def _made(self, common: Mapping[str, Any]) -> Model:
        source, target = self._place.at("src"), self._place.at("dst")
        names = template(self.src, source), template(self.dst, target)
        return made_of(SetRemapModel, self._place, {"from_": names[0], "to": names[1]}, common)
