"""What both readers of a model file need: attributes, texts in several languages, addresses, and a list of problems."""

from collections.abc import Iterable, Mapping, MutableMapping, Sequence
from decimal import Decimal
from difflib import get_close_matches
from typing import TypeVar

from lxml import etree

from scanbench.plcmodel import address
from scanbench.plcmodel.areas import Area, IecMap, Location
from scanbench.plcmodel.catalogue import CodeForm, Wording
from scanbench.plcmodel.document import Document
from scanbench.problems import Problem, perhaps

T = TypeVar("T")
LANGUAGE = "{http://www.w3.org/XML/1998/namespace}lang"


class Reader:
    """Reads elements of one document; what is wrong goes to `problems`, and reading goes on.

    A document may be read as the base of a second one, its `heir`: what does not fit is then reported at the heir's Base.
    """

    def __init__(self, document: Document, heir: Document | None = None) -> None:
        self.document = document
        self.heir = heir
        self.areas: Sequence[Area] = ()
        self.iec_maps: Sequence[IecMap] = ()
        self.symbols: Mapping[str, Location] = {}
        self.code_form: CodeForm = "hex4"
        self.problems: list[Problem] = []

    @property
    def root(self) -> etree._Element:
        """The element `Model`."""
        return self.document.root

    def problem(self, code: str, message: str, node: etree._Element, attribute: str = "") -> None:
        """Note a problem at the element or its attribute."""
        span = self.document.span(node, attribute)
        if self.heir is not None:
            message = f"what it takes from {span.file}:{span.line} does not fit any more: {message}"
            span = self.heir.span(self.heir.root, "Base")
        self.problems.append(Problem(code, message, span))

    def area(self, node: etree._Element, attribute: str, name: str) -> Area | None:
        """The area of this name."""
        for area in self.areas:
            if area.name == name:
                return area
        known = ", ".join(area.name for area in self.areas)
        hint = nearest(name, [area.name for area in self.areas])
        self.problem("M003", f"area {name!r} does not exist, the model has {known}{hint}", node, attribute)
        return None

    def find(self, text: str) -> Location | None:
        """The place that an address names; that there is none is no problem here."""
        try:
            return address.parse(self.areas, self.iec_maps, text, self.symbols)
        except address.NoSuchPlace:
            return None

    def place(self, node: etree._Element, attribute: str, bits: int | None = None) -> Location | None:
        """The place that an attribute names; `bits` says what it must be (1: a bit, 16: a word)."""
        text = node.get(attribute)
        if text is None:
            return None
        try:
            location = address.parse(self.areas, self.iec_maps, text, self.symbols)
        except address.NoSuchPlace as reason:
            self.problem("M003", str(reason), node, attribute)
            return None
        if bits is not None and location.bits != bits:
            kinds = {1: "a bit, such as A402.12", 16: "a word, such as A400"}
            self.problem("M003", f"{text!r} must be {kinds[bits]}", node, attribute)
            return None
        return location

    def engine_writes(self, node: etree._Element, attribute: str, location: Location, words: int = 1) -> bool:
        """Whether the error simulator may write there; if not, that is a problem."""
        for word in range(location.word, location.word + words):
            if location.area.access(word, "engine") != "write":
                name = address.write(location.area, self.iec_maps, 2 * word, None, 16)
                self.problem("M003", f"{name} is outside of the area or closed to the simulator", node, attribute)
                return False
        return True


def nearest(name: str, known: Iterable[str]) -> str:
    """A hint at what was perhaps meant, to end a message with."""
    hint = perhaps(get_close_matches(name, known, n=1))
    return f".{hint}" if hint else ""


Element = tuple[Reader, etree._Element]


def merged(layers: Sequence[Reader], path: str, key: str, kind: str) -> dict[str, Element]:
    """The elements that the layers leave, by the attribute `key`: a later one takes the place of an earlier one.

    What `kind` of Without names is left out. Only what is left is read: what an heir replaces need not fit it.
    """
    found: dict[str, Element] = {}
    for reader in layers:
        removals(reader, kind, found)
        own: set[str] = set()
        for node in reader.root.iterfind(path):
            name = node.get(key, "")
            if name in own:
                reader.problem("M004", f"{node.tag} {name!r} is there twice", node, key)
            own.add(name)
            found[name] = reader, node
    return found


def removals(reader: Reader, kind: str, known: MutableMapping[str, T]) -> None:
    """Takes out of `known` what the file's Without says that the model has not."""
    node = reader.root.find("Without")
    if node is None:
        return
    for name in node.get(kind, "").split():
        if known.pop(name, None) is None:
            message = f"{name!r} cannot be left out: the base has no such thing{nearest(name, known)}"
            reader.problem("M009", message, node, kind)


def text_of(node: etree._Element, tag: str, language: str = "en") -> str:
    """The text of the child `tag` in this language; without xml:lang it is English."""
    for child in node.iterchildren(tag):
        if child.get(LANGUAGE, "en") == language:
            return " ".join((child.text or "").split())
    return ""


def wordings_of(node: etree._Element) -> tuple[Wording, ...]:
    """Name and description in every other language than English."""
    children = [*node.iterchildren("Name"), *node.iterchildren("Description")]
    languages = sorted({child.get(LANGUAGE, "en") for child in children} - {"en"})
    return tuple(
        Wording(language, text_of(node, "Name", language), text_of(node, "Description", language))
        for language in languages
    )


def number_of(text: str) -> int:
    """`12` or `16#0C`; the schema has seen to the form."""
    return int(text[3:], 16) if text.startswith("16#") else int(text)


def duration_ns(text: str) -> int:
    """`20ms`, `0.1s`, `1min` in nanoseconds; the schema has seen to the form."""
    unit = text.lstrip("0123456789.")
    return round(Decimal(text.removesuffix(unit)) * {"us": 1_000, "ms": 10**6, "s": 10**9, "min": 60 * 10**9}[unit])
