"""What both readers of a model file need: attributes, texts in several languages, addresses, and a list of problems."""

from collections.abc import Sequence

from lxml import etree

from scanbench.plcmodel import address
from scanbench.plcmodel.areas import Area, IecMap, Location
from scanbench.plcmodel.catalogue import Wording
from scanbench.plcmodel.document import Document
from scanbench.problems import Problem

LANGUAGE = "{http://www.w3.org/XML/1998/namespace}lang"


class Reader:
    """Reads elements of one document; what is wrong goes to `problems`, and reading goes on."""

    def __init__(self, document: Document) -> None:
        self.document = document
        self.areas: Sequence[Area] = ()
        self.iec_maps: Sequence[IecMap] = ()
        self.problems: list[Problem] = []

    def problem(self, code: str, message: str, node: etree._Element, attribute: str = "") -> None:
        """Note a problem at the element or its attribute."""
        self.problems.append(Problem(code, message, self.document.span(node, attribute)))

    def area(self, node: etree._Element, attribute: str, name: str) -> Area | None:
        """The area of this name."""
        for area in self.areas:
            if area.name == name:
                return area
        known = ", ".join(area.name for area in self.areas)
        self.problem("M003", f"area {name!r} does not exist, the model has {known}", node, attribute)
        return None

    def find(self, text: str) -> Location | None:
        """The place that an address names; that there is none is no problem here."""
        try:
            return address.parse(self.areas, self.iec_maps, text)
        except address.NoSuchPlace:
            return None

    def place(self, node: etree._Element, attribute: str, bits: int | None = None) -> Location | None:
        """The place that an attribute names; `bits` says what it must be (1: a bit, 16: a word)."""
        text = node.get(attribute)
        if text is None:
            return None
        try:
            location = address.parse(self.areas, self.iec_maps, text)
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
                name = f"{location.area.name}{word}"
                self.problem("M003", f"{name} is outside of the area or closed to the simulator", node, attribute)
                return False
        return True


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
