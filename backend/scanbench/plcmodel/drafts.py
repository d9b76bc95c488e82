"""Errors as somebody writes them: every attribute as its text, right or wrong. What a form edits, and `errors.xml` holds.

`read_drafts` takes any document that follows the schema, so a file whose addresses are wrong can be corrected in the form.
"""

from dataclasses import dataclass, field

from lxml import etree

from scanbench.plcmodel.document import Document
from scanbench.plcmodel.reading import LANGUAGE, text_of


@dataclass(frozen=True, slots=True)
class DraftText:
    """Name and description in one language; of an address only the description counts."""

    language: str
    name: str = ""
    description: str = ""


Texts = tuple[DraftText, ...]


@dataclass(frozen=True, slots=True)
class DraftAddress:
    """An `ErrorAddress`; an attribute that is not given is empty."""

    id: str = ""
    address: str = ""
    type: str = "Bit"
    shift: str = ""
    width: str = ""
    value: str = ""
    min: str = ""
    max: str = ""
    default: str = ""
    base: str = ""
    adds: str = ""
    """AddToErrorCode: `true`, `false` or, as the error says, empty."""
    texts: Texts = ()


@dataclass(frozen=True, slots=True)
class DraftDetail:
    """An `ErrorControl`."""

    name: str = ""
    control: str = "List"
    default: str = ""
    addresses: tuple[DraftAddress, ...] = ()
    texts: Texts = ()
    identifies: str = ""
    hardware: str = ""
    absent: str = ""


@dataclass(frozen=True, slots=True)
class DraftAlso:
    """An `Also`."""

    address: str = ""
    type: str = "Bit"
    shift: str = ""
    width: str = ""
    value: str = ""
    detail: str = ""


@dataclass(frozen=True, slots=True)
class DraftError:
    """An `Error`, with the English names of the groups that it is in, the outermost first."""

    id: str = ""
    group: tuple[str, ...] = ()
    code: str = ""
    flag: str = ""
    severity: str = "nonfatal"
    priority: str = ""
    cause: str = ""
    memory: str = ""
    source: str = ""
    verified: str = ""
    adds: str = ""
    texts: Texts = ()
    details: tuple[DraftDetail, ...] = ()
    also: tuple[DraftAlso, ...] = ()
    hardware: str = ""


@dataclass(frozen=True, slots=True)
class DraftGroup:
    """What a group is called in other languages than English."""

    path: tuple[str, ...]
    texts: Texts = ()


@dataclass(frozen=True, slots=True)
class Drafts:
    """A whole file."""

    errors: tuple[DraftError, ...] = ()
    groups: tuple[DraftGroup, ...] = field(default=())
    """Those that are called something in other languages."""


ADDRESS = {
    "id": "Id", "address": "Address", "type": "Type", "shift": "Shift", "width": "Width", "value": "Value", "min": "Min",
    "max": "Max", "default": "Default", "base": "Base", "adds": "AddToErrorCode",
}  # fmt: skip
"""Field -> attribute."""
DETAIL = {
    "name": "Name", "control": "Type", "default": "Default", "identifies": "Identifies", "hardware": "Hardware",
    "absent": "Absent",
}  # fmt: skip
ALSO = {"address": "Address", "type": "Type", "shift": "Shift", "width": "Width", "value": "Value", "detail": "Detail"}
ERROR = {
    "id": "Id", "code": "ErrorCode", "flag": "ErrorFlag", "severity": "Severity", "priority": "Priority",
    "cause": "Cause", "memory": "Memory", "source": "Source", "verified": "Verified", "adds": "AddToErrorCode",
    "hardware": "Hardware",
}  # fmt: skip


def read_drafts(document: Document) -> Drafts:
    """Every error of the document, in its order, and how groups are called."""
    errors: list[DraftError] = []
    groups: dict[tuple[str, ...], Texts] = {}
    for node in document.root.iterchildren("ErrorGroup"):
        _read_group(node, (), errors, groups)
    return Drafts(tuple(errors), tuple(DraftGroup(path, texts) for path, texts in groups.items() if texts))


def _read_group(
    node: etree._Element, above: tuple[str, ...], errors: list[DraftError], groups: dict[tuple[str, ...], Texts]
) -> None:
    path = (*above, text_of(node, "Name"))
    if not groups.get(path):
        groups[path] = tuple(text for text in _texts(node) if text.language != "en")
    errors += [_error(child, path) for child in node.iterchildren("Error")]
    for child in node.iterchildren("ErrorSubGroup"):
        _read_group(child, path, errors, groups)


def _error(node: etree._Element, group: tuple[str, ...]) -> DraftError:
    return DraftError(
        **_attributes(node, ERROR),
        group=group,
        texts=_texts(node),
        details=tuple(map(_detail, node.iterfind("ErrorDetailPattern/ErrorControl"))),
        also=tuple(DraftAlso(**_attributes(child, ALSO)) for child in node.iterchildren("Also")),
    )


def _detail(node: etree._Element) -> DraftDetail:
    return DraftDetail(
        **_attributes(node, DETAIL),
        texts=_texts(node),
        addresses=tuple(
            DraftAddress(**_attributes(child, ADDRESS), texts=_texts(child))
            for child in node.iterchildren("ErrorAddress")
        ),
    )


def _attributes(node: etree._Element, names: dict[str, str]) -> dict[str, str]:
    return {field: node.get(attribute, "") for field, attribute in names.items()}


def _texts(node: etree._Element) -> Texts:
    """In every language in which something is said, English first."""
    children = [*node.iterchildren("Name"), *node.iterchildren("Description")]
    languages = sorted({child.get(LANGUAGE, "en") for child in children}, key=lambda each: (each != "en", each))
    texts = (DraftText(each, text_of(node, "Name", each), text_of(node, "Description", each)) for each in languages)
    return tuple(text for text in texts if text.name or text.description)
