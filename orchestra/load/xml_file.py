"""XML launch files as trees of scalars, mappings and lists that know their place: the same trees as YAML gives.

What an element means is told by the model that it belongs to (`forms`): scalars are attributes, parts are elements, and
what is no key of a group is one of its actions. So every key that a model has can be written in XML.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.dataclass import dataclass
from orchestra.description.actions import ACTIONS, model_of
from orchestra.description.launch import Launch
from orchestra.description.source import Keyed, Listed
from orchestra.errors import Code
from orchestra.load.elements import Attribute, Element, Tagged
from orchestra.load.exposed import exposes_action
from orchestra.load.forms import VARIABLES, Form, Forms, Kind, forms_of
from orchestra.load.keys import action_meant, key_meant, spelled
from orchestra.load.offsets import Source, source
from orchestra.load.reader import Reader
from orchestra.load.xml_attributes import listed, separated
from orchestra.load.xml_parser import NotXmlError, parse
from orchestra.nearest import is_slip, nearest

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from orchestra.description.entity import Entity
    from orchestra.location import Span

_ROOT = "launch"
_SEPARATOR = "_sep"
_ATTRIBUTES = (Kind.TEXT, Kind.VALUE, Kind.LIST)
# Attributes of a root that say nothing to us: files of ROS 1 carry a version.
_IGNORED = frozenset({"version"})
# Keys of which a text between tags is probably meant to be the value.
_VALUES = ("value", "default")
_PAIR = frozenset({"name", "value"})


def read(text: str, file: str, reader: Reader) -> Keyed | None:
    """Return the tree of an XML text, None where it is no XML or no launch file (which has been reported)."""
    whole = source(file, text)
    reader.text = text
    try:
        root = parse(whole)
    except NotXmlError as error:
        fault = error.fault
        reader.error(fault.code, fault.message, fault.span, suggestion=fault.suggestion, notes=fault.notes)
        return None
    return tree_of(root, whole, reader)


def tree_of(root: Element, whole: Source, reader: Reader) -> Keyed | None:
    """Return the tree of a root element, None where it is not that of a launch file (which has been reported)."""
    at = root.span(whole)
    if root.name != _ROOT:
        near = _ROOT if is_slip(root.name, _ROOT) else None
        message = f"the root element of a launch file is <{_ROOT}>, not <{root.name}>"
        reader.error(Code.UNKNOWN_KEY, message, at, suggestion=near)
        if near is None:
            return None
    tree = Keyed(at, at)
    tree.put(_ROOT, _Shaper(whole, reader).launch(root), at)
    return tree


def tree_of_action(element: Element, whole: Source, reader: Reader) -> Keyed:
    """Return the tree of one action."""
    return _Shaper(whole, reader).action(element)


@dataclass(slots=True)
class _Shaper:
    """Makes trees of elements."""

    whole: Source
    reader: Reader

    def launch(self, root: Element) -> Tagged:
        """Return the content of the root; unlike any other element it may have attributes that mean nothing."""
        known = forms_of(Launch).by_key
        for attribute in root.attributes:
            name = attribute.name
            if spelled(name) not in known and name not in _IGNORED and ":" not in name:
                near = nearest(name, {key for key, form in known.items() if form.kind is Kind.TEXT})
                self.reader.warning(
                    Code.UNKNOWN_KEY,
                    f"the attribute '{name}' of <{root.name}> is ignored",
                    attribute.span(self.whole),
                    suggestion=near,
                )
        root.attributes = tuple(item for item in root.attributes if spelled(item.name) in known)
        return self.content(root, Launch)

    def action(self, element: Element) -> Keyed:
        """Return an action: a mapping with its name as the only key."""
        at = element.span(self.whole)
        action = Keyed(at, at)
        model = model_of(spelled(element.name))
        if model is None and exposes_action(element.name):
            # Here, because only code of users has words of its own, and it imports the library's elements.
            from orchestra.load.placed import placed  # noqa: PLC0415

            action.put(element.name, placed(element, self.whole), at)
            return action
        if model is None:
            near, slip = action_meant(element.name)
            model = model_of(near) if near is not None and slip else None
        action.put(element.name, self.content(element, model), at)
        return action

    def content(self, element: Element, model: type[Entity] | None, forms: Forms | None = None) -> Tagged:
        """Return what an element says; without a model scalars are taken for texts, elements for lists."""
        forms = forms or forms_of(model)
        at = element.span(self.whole)
        tagged = Tagged(at, at, element, forms.elements)
        self._attributes(element, forms, tagged)
        if not (element.children or forms.holds_actions or element.text is not None):
            return tagged
        actions = Listed(at)
        for child in self._unwrapped(element.children, forms):
            form = self._form(child.name, forms, actions=forms.holds_actions, element=True)
            if forms.holds_actions and child.children and spelled(child.name) in ACTIONS:
                form = None  # `for_each` is an action where it has others in it, else a key of a group
            slip = form is not None and spelled(child.name) not in forms.by_key
            if form is not None and not (slip and child.attributes and form.kind in _ATTRIBUTES):
                self._child(child, form, tagged)
            elif forms.holds_actions:
                actions.append(self.action(child))
            else:
                self._part(child, None, tagged)
        if forms.holds_actions:
            tagged.put("children", actions, at)
        if element.text is not None and (model is not None or forms is VARIABLES):
            self._text(element, model, tagged)
        return tagged

    def _unwrapped(self, children: Sequence[Element], forms: Forms) -> Iterator[Element]:
        """Yield elements; of one that is nothing but a wrapping of others with one name, which is reported, those."""
        for child in children:
            if child.attributes or not child.children or not self._is_wrapping(child, forms):
                yield child
                continue
            message = f"unknown element <{child.name}>: each <{child.children[0].name}> stands without it"
            self.reader.error(Code.UNKNOWN_KEY, message, child.span(self.whole))
            yield from child.children

    def _is_wrapping(self, child: Element, forms: Forms) -> bool:
        name, inner = spelled(child.name), {spelled(part.name) for part in child.children}
        action = forms.holds_actions and (name in ACTIONS or exposes_action(child.name))
        return len(inner) == 1 and inner <= forms.elements and name not in forms.by_key and not action

    def _attributes(self, element: Element, forms: Forms, tagged: Tagged) -> None:
        if all(map(forms.texts.__contains__, (item.name for item in element.attributes))):  # as nearly always
            for attribute in element.attributes:
                tagged[attribute.name] = attribute.written(self.whole)
            tagged.place_later(lambda: {item.name: item.span(self.whole) for item in element.attributes})
            return
        separators = _separators(element)
        lost = self._misspelt_separators(element, forms, tagged)
        for attribute in element.attributes:
            if attribute in separators.values() or attribute.name.split(":")[0] in ("xmlns", *lost):
                continue
            form = self._form(attribute.name, forms) or forms.others
            at = attribute.span(self.whole)
            if form.or_text:
                tagged.put(attribute.name, attribute.written(self.whole), at)
            elif form.kind not in _ATTRIBUTES:
                self._not_an_attribute(attribute.name, form, at, tagged, forms)
            elif (separator := separators.get(spelled(attribute.name))) is not None:
                tagged.put(attribute.name, separated(attribute, separator, self.whole, self.reader), at)
            elif form.kind is not Kind.TEXT:
                one = form.kind is Kind.LIST
                tagged.put(attribute.name, listed(attribute, self.whole, self.reader, alone=one), at)
            else:
                tagged.put(attribute.name, attribute.written(self.whole), at)

    def _misspelt_separators(self, element: Element, forms: Forms, tagged: Tagged) -> tuple[str, ...]:
        """Report attributes that are slips for those that separate the items of others; return the names of both."""
        beside = {spelled(item.name): item.name for item in element.attributes}
        lost = list[str]()
        for name, written in beside.items():
            if not forms.by_key or name in forms.by_key or not ("_" in name or name.endswith(_SEPARATOR[1:])):
                continue
            near = nearest(
                name, {f"{key}{_SEPARATOR}" for key in beside.keys() & forms.by_key} | {*forms.by_key}
            )
            if near is None or not near.endswith(_SEPARATOR) or not is_slip(name, near):
                continue
            at = next(item for item in element.attributes if item.name == written).span(self.whole)
            instead = near if "_" in written else near.replace("_", "-")
            self.reader.error(Code.UNKNOWN_KEY, f"unknown attribute '{written}'", at, suggestion=instead)
            _lose(tagged, near.removesuffix(_SEPARATOR))
            lost += [written, beside[near.removesuffix(_SEPARATOR)]]
        return tuple(lost)

    def _form(self, name: str, forms: Forms, *, actions: bool = False, element: bool = False) -> Form | None:
        """Return the form of a key, or of the one that it is a slip of unless it may as well be an action.

        An `element` is rather a slip of an element, as an attribute of an attribute.
        """
        known = forms.by_key
        form = known.get(spelled(name))
        if form is not None or not known or (actions and (spelled(name) in ACTIONS or exposes_action(name))):
            return form
        others = ACTIONS if actions else ()
        near, slip = key_meant(
            name, {*(forms.elements if element else known.keys() - forms.elements), *others}
        )
        if not slip:
            near, slip = key_meant(name, {*known, *others})
        return known.get(near) if near is not None and slip else None

    def _child(self, child: Element, form: Form, tagged: Tagged) -> None:
        at = child.span(self.whole)
        match Kind.VARIABLES if form.or_variables else form.kind:
            case Kind.PART:
                self._once(child, self.content(child, form.model), tagged)
            case Kind.PARTS:
                self._part(child, form.model, tagged)
            case Kind.VARIABLES:
                self._once(child, self.content(child, None, VARIABLES), tagged)
            case _:
                from orchestra.load.xml_texts import text_in  # noqa: PLC0415 - only a mistake needs it

                written = text_in(child, self.whole)
                message = f"'{child.name}' is written as an attribute: {child.name}=\"{written}\""
                near = next((key for key in tagged.elements if is_slip(child.name, key)), None)
                self.reader.error(Code.WRONG_TYPE, message, at, suggestion=near)
                _lose(tagged, child.name)

    def _once(self, child: Element, content: Keyed, tagged: Tagged) -> None:
        if child.name not in tagged:
            tagged.put(child.name, content, content.head)
            return
        message = f"<{child.name}> stands twice in <{tagged.element.name}>"
        first = f"first at {tagged.keys_at[child.name]}"
        self.reader.error(Code.DUPLICATE_KEY, message, content.head, notes=(first,))

    def _part(self, child: Element, model: type[Entity] | None, tagged: Tagged) -> None:
        """Add an element to the list of those with its name."""
        name = spelled(child.name) if spelled(child.name) in tagged.elements else child.name
        content = self.content(child, model)
        if name not in tagged:
            tagged.elements |= {name}
            tagged.put(name, Listed(content.head), content.head)
        if isinstance(tagged[name], Listed):
            tagged[name].append(content)

    def _text(self, element: Element, model: type[Entity] | None, tagged: Tagged) -> None:
        """Tell that text between tags says nothing; an error where something is missing that it probably is."""
        from orchestra.load.xml_texts import tell_text  # noqa: PLC0415 - only a mistake needs it

        lacking = _lacking(model, tagged)
        tell_text(element, lacking, self.whole, self.reader)
        for name in lacking:
            _lose(tagged, name)

    def _not_an_attribute(self, name: str, form: Form, at: Span, tagged: Tagged, forms: Forms) -> None:
        key = spelled(name)
        attributes = {spelled(item.name) for item in tagged.element.attributes}
        if forms.texts >= _PAIR and "name" not in attributes:
            self.reader.error(Code.UNKNOWN_KEY, f"unknown attribute '{name}'", at, suggestion="name")
            _lose(tagged, "name")
            return
        if form.kind is Kind.ACTIONS:
            message = f"'{name}' is no attribute: actions stand inside <{tagged.element.name}>"
        else:
            message = f"'{name}' is written as an element: <{key} .../>"
        self.reader.error(Code.WRONG_TYPE, message, at)
        _lose(tagged, key)


def _separators(element: Element) -> dict[str, Attribute]:
    """Return the attributes that separate the items of others, by the names of those."""
    ending = [item for item in element.attributes if spelled(item.name).endswith(_SEPARATOR)]
    if not ending:
        return {}
    names = {spelled(item.name) for item in element.attributes}
    found = {spelled(item.name).removesuffix(_SEPARATOR): item for item in ending}
    return {name: item for name, item in found.items() if name in names}


def _lacking(model: type[Entity] | None, tagged: Tagged) -> frozenset[str]:
    """Return the keys that an element lacks and that a text in it may stand for."""
    if model is None or tagged.element.children:
        return frozenset()
    present = {spelled(key) for key in tagged}
    required = model.required_beside(present) - present
    return required or (frozenset(_VALUES) & model.known_keys() if present <= {"name"} else frozenset())


def _lose(tagged: Tagged, key: str) -> None:
    """Mark a key as reported and left out."""
    tagged.lossy = True
    tagged.meant |= {spelled(key)}
