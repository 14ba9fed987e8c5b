"""XML Schema (XSD 1.0) of launch files in XML, from the same models as the JSON Schema and the loader itself.

It says which elements and attributes there are, what they are for, and which must stand there; the values of attributes
are texts, as substitutions may stand anywhere. Elements stand in any order, as the loader takes them.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, get_args, get_origin
from xml.sax.saxutils import escape

from orchestra.description.actions import ACTIONS, model_of
from orchestra.description.launch import Launch
from orchestra.load.forms import Kind, forms_of

if TYPE_CHECKING:
    from collections.abc import Iterator

    from orchestra.description.entity import Entity

_ATTRIBUTES = (Kind.TEXT, Kind.VALUE, Kind.LIST)
_LISTS = (Kind.VALUE, Kind.LIST)
_SEPARATOR = "What separates the items of a list."
_ELEMENTS = (Kind.PART, Kind.PARTS, Kind.VARIABLES)
_HEAD = """\
<?xml version="1.0" encoding="UTF-8"?>
<xs:schema xmlns:xs="http://www.w3.org/2001/XMLSchema">
"""
_VARIABLES = """\
  <xs:complexType name="variables">
    <xs:anyAttribute processContents="skip"/>
  </xs:complexType>
"""


def xml_schema_text() -> str:
    """Return the text of the schema, line break at its end included."""
    models: dict[str, type[Entity]] = {}
    actions = "".join(_element(name, _model(name), _summary(_model(name)), models) for name in ACTIONS)
    types = [_type(Launch, models)]
    told: set[str] = {Launch.__name__}
    while waiting := [model for name, model in models.items() if name not in told]:
        for model in waiting:
            told.add(model.__name__)
            types.append(_type(model, models))
    root = (
        f'  <xs:element name="launch" type="Launch">\n{_documentation(_summary(Launch), 4)}  </xs:element>\n'
    )
    group = f'  <xs:group name="actions">\n    <xs:choice>\n{actions}    </xs:choice>\n  </xs:group>\n'
    return f"{_HEAD}{root}{group}{_VARIABLES}{''.join(types)}</xs:schema>\n"


def _model(name: str) -> type[Entity]:
    model = model_of(name)
    assert model is not None  # noqa: S101 - the name is from the table
    return model


def _summary(model: type[Entity]) -> str:
    return " ".join((model.__doc__ or "").split("\n\n")[0].split())


def _spellings(name: str) -> tuple[str, ...]:
    """Return how a key may be written: hyphens and underlines are alike."""
    return (name, name.replace("_", "-")) if "_" in name else (name,)


def _element(name: str, model: type[Entity] | None, text: str, models: dict[str, type[Entity]]) -> str:
    """Return the declarations of an element inside of a choice; a model of its content is noted."""
    if model is not None:
        models[model.__name__] = model
    kind = model.__name__ if model is not None else "variables"
    return "".join(
        f'      <xs:element name="{spelling}" type="{kind}">\n{_documentation(text, 8)}      </xs:element>\n'
        for spelling in _spellings(name)
    )


def _type(model: type[Entity], models: dict[str, type[Entity]]) -> str:
    """Return the type of an element with the content that a model reads."""
    forms = forms_of(model)
    texts = {entry.alias or name: entry.description or "" for name, entry in model.model_fields.items()}
    elements = "".join(
        _element(key, form.model, texts[key], models)
        for key, form in forms.by_key.items()
        if (form.kind in _ELEMENTS or form.or_variables) and not _is_action_too(key, model)
    )
    if forms.holds_actions:
        elements += '      <xs:group ref="actions"/>\n'
    choice = (
        f'    <xs:choice minOccurs="0" maxOccurs="unbounded">\n{elements}    </xs:choice>\n'
        if elements
        else ""
    )
    attributes = "".join(_attributes(model, texts))
    return f'  <xs:complexType name="{model.__name__}">\n{choice}{attributes}  </xs:complexType>\n'


def _is_action_too(key: str, around: type[Entity]) -> bool:
    """Tell whether a key of an action is an action in it too, as `for_each` of `group`: XSD has one type for both."""
    return key in ACTIONS and forms_of(around).holds_actions


def _is_key_too(model: type[Entity]) -> bool:
    """Tell whether an action is the key with variables of one around it as well."""
    names = [name for name in ACTIONS if _model(name) is model]
    return any(
        name in forms_of(around).by_key and _is_action_too(name, around)
        for around in map(_model, ACTIONS)
        for name in names
    )


def _attributes(model: type[Entity], texts: dict[str, str]) -> Iterator[str]:
    any_variable = _is_key_too(model)
    needed = () if any_variable else model.required_beside(model.known_keys())
    for key, form in forms_of(model).by_key.items():
        if form.kind not in _ATTRIBUTES and not form.or_text:
            continue
        required = key in needed and len(_spellings(key)) == 1
        for spelling in _spellings(key):
            yield _attribute(spelling, texts[key], required=required)
        if form.kind in _LISTS or _may_be_list(model.model_fields[_field(model, key)].annotation):
            yield from (_attribute(f"{name}-sep", _SEPARATOR) for name in _spellings(key))
    if any_variable:
        yield '    <xs:anyAttribute processContents="skip"/>\n'
    if model is Launch:
        yield _attribute("version", "Says nothing; files of ROS 1 have it.")
        yield '    <xs:anyAttribute namespace="##other" processContents="skip"/>\n'


def _field(model: type[Entity], key: str) -> str:
    return next(name for name, entry in model.model_fields.items() if key in (name, entry.alias))


def _may_be_list(annotation: Any) -> bool:  # noqa: ANN401 - a type
    """Tell whether a value may be several: then an attribute beside it may say what separates these."""
    return get_origin(annotation) is tuple or any(map(_may_be_list, get_args(annotation)))


def _attribute(name: str, text: str, *, required: bool = False) -> str:
    use = ' use="required"' if required else ""
    declared = f'<xs:attribute name="{name}" type="xs:string"{use}>'
    return f"    {declared}\n{_documentation(text, 6)}    </xs:attribute>\n"


def _documentation(text: str, indent: int) -> str:
    margin = " " * indent
    return f"{margin}<xs:annotation><xs:documentation>{escape(text)}</xs:documentation></xs:annotation>\n"
