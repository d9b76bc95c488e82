"""Reads a hardware configuration, and checks it against the model: everything that is wrong with it, at its line."""

import json
import posixpath
import re
from collections.abc import Iterator, Mapping
from typing import get_args

from scanbench.plcmodel.catalogue import ErrorDetail, Hardware
from scanbench.plcmodel.hardware import HARDWARE_FILE, Fitted
from scanbench.plcmodel.model import Model
from scanbench.plcmodel.reading import nearest
from scanbench.problems import Problem, Span

FORMAT = 1
_FIELDS = ("kind", "number", "rack", "slot", "words", "name")
_PLACED = ("basic-io-unit", "special-io-unit", "cpu-bus-unit")
"""Units that are in a slot; of a special or bus unit it may be left out."""
_LONGEST = 100
Range = tuple[int, int]


def is_hardware(path: str) -> bool:
    """Whether a file of this path has the hardware of its project."""
    return posixpath.basename(path.replace("\\", "/")) == HARDWARE_FILE


def ranges(model: Model) -> dict[str, Range]:
    """The kinds of hardware that a model has, and their lowest and highest numbers; `slot` and `rack` among them."""
    found: dict[str, Range] = {}
    for error in model.errors():
        if error.hardware:
            number = error.hardware_number or 0
            low, high = found.get(error.hardware, (number, number))
            found[error.hardware] = min(low, number), max(high, number)
        for detail in error.details:
            for kind, low, high in _counted(detail):
                known = found.get(kind, (low, high))
                found[kind] = min(low, known[0]), max(high, known[1])
    return found


def _counted(detail: ErrorDetail) -> Iterator[tuple[str, int, int]]:
    address = detail.addresses[0]
    low, high = address.minimum or 0, address.maximum or 0
    match detail.hardware:
        case "" | "unit":
            return
        case "basic-io-unit":
            yield "basic-io-unit", 0, 0
            yield detail.name, low, high
        case kind:
            yield kind, low, high


def read_hardware(
    model: Model, text: str, file: str = HARDWARE_FILE
) -> tuple[tuple[Fitted, ...] | None, list[Problem]]:
    """What is fitted, or everything that is wrong with the text."""
    reader = _Reader(model, text, file)
    fitted = reader.read()
    return (None if reader.problems else fitted), reader.problems


class _Reader:
    def __init__(self, model: Model, text: str, file: str) -> None:
        self._model, self._text, self._file = model, text, file
        self._ranges = ranges(model)
        self._lines = _lines(text)
        self.problems: list[Problem] = []

    def read(self) -> tuple[Fitted, ...]:
        try:
            told = json.loads(self._text)
        except json.JSONDecodeError as error:
            self._say(error.lineno, f"this is no JSON text: {error.msg}")
            return ()
        except ValueError:  # Python reads no numbers of more digits than sys.get_int_max_str_digits
            long = re.search(r"\d{1000,}", self._text)
            line = 1 if long is None else self._text.count("\n", 0, long.start()) + 1
            self._say(line, "a number is too long: write a whole number of a few digits")
            return ()
        except RecursionError:
            self._say(1, "this is no hardware configuration: it is nested too deep")
            return ()
        if not isinstance(told, dict) or not isinstance(told.get("fitted"), list):
            self._say(1, 'a hardware configuration is an object with "version" and a list "fitted"')
            return ()
        if told.get("version") != FORMAT:
            self._say(1, f'"version" is {told.get("version")!r}, and this Scanbench reads {FORMAT}')
            return ()
        found: dict[tuple[str, int | None, int | None, int | None], int] = {}
        places: dict[tuple[int, int], int] = {}
        words: dict[str, int] = {}
        fitted = []
        for index, each in enumerate(told["fitted"]):
            line = self._lines[index] if index < len(self._lines) else 1
            one = self._one(each, line)
            if one is None:
                continue
            by_place = one.kind == "basic-io-unit"
            key = (one.kind, one.number, one.rack if by_place else None, one.slot if by_place else None)
            if key in found:
                self._say(line, f"{_text(one)} is fitted in line {found[key]} already: give one of them another number")
            found.setdefault(key, line)
            if one.rack is not None and one.slot is not None:
                place = one.rack, one.slot
                if place in places:
                    self._say(
                        line,
                        f"rack {one.rack}, slot {one.slot} is taken by line {places[place]}: one unit goes into a slot",
                    )
                places.setdefault(place, line)
            for word in one.words:
                if word in words:
                    self._say(line, f"word {word} belongs to line {words[word]} already: a word leads to one unit")
                words.setdefault(word, line)
            fitted.append(one)
        return tuple(fitted)

    def _one(self, told: object, line: int) -> Fitted | None:
        if not isinstance(told, Mapping):
            self._say(line, "what is fitted is an object with a kind, and with a number, a rack and slot, and a name")
            return None
        unknown = next((each for each in told if each not in _FIELDS), None)
        if unknown is not None:
            self._say(line, f"{unknown} is unknown; there are {', '.join(_FIELDS)}")
            return None
        kind = told.get("kind")
        if not isinstance(kind, str) or kind not in self._ranges or kind in ("slot", ""):
            self._say(line, self._no_kind(kind))
            return None
        name = told.get("name", "")
        if not isinstance(name, str) or len(name) > _LONGEST:
            self._say(line, f"a name is a text of at most {_LONGEST} characters")
            return None
        numbers: dict[str, int | None] = {}
        for field in ("number", "rack", "slot"):
            value = told.get(field)
            if value is not None and (not isinstance(value, int) or isinstance(value, bool)):
                self._say(line, f"{field} is {value!r}, and has to be a whole number")
                return None
            numbers[field] = value
        words = self._words(kind, told.get("words", ""), line)
        if words is None:
            return None
        one = Fitted(kind, numbers["number"], numbers["rack"], numbers["slot"], name, words)
        return one if self._fits(one, line) else None

    def _words(self, kind: str, told: object, line: int) -> tuple[str, ...] | None:
        """The words of a unit, as the model writes them; None where the text is wrong."""
        if not isinstance(told, str):
            self._say(line, "words is a text with the addresses of the unit's words, and commas between them")
            return None
        texts = [each.strip() for each in told.split(",") if each.strip()]
        if texts and kind not in _PLACED:
            self._say(line, f"a {kind} has no words of inputs and outputs")
            return None
        found = [self._word(text, line) for text in texts]
        return None if None in found else tuple(each for each in found if each is not None)

    def _word(self, text: str, line: int) -> str | None:
        place = self._model.locate(text)
        if place is None:
            self._say(line, self._model.why_not(text))
            return None
        for each in self._model.iec_maps:
            if (
                each.letter in "IQ"
                and each.area == place.area
                and each.first <= place.byte // 2 < each.first + each.words
            ):
                return self._model.word_text(place.area, place.byte // 2 * 2)
        self._say(line, f"{text} is no word of inputs or outputs of the {self._model.name}")
        return None

    def _no_kind(self, kind: object) -> str:
        known = [each for each in self._ranges if each != "slot"]
        if kind in get_args(Hardware):
            return f"{self._model.name} has no {kind}; it has {', '.join(known)}"
        return f"there is no kind {kind!r}{nearest(str(kind), known)}; {self._model.name} has {', '.join(known)}"

    def _fits(self, one: Fitted, line: int) -> bool:
        """Whether the model has such a number and such a place."""
        count = len(self.problems)
        numbered = one.kind not in ("inner-board", "basic-io-unit")
        if numbered and one.number is None:
            self._say(line, f"a {one.kind} needs a number: {self._between(one.kind)}")
        elif numbered and not self._within(one.kind, one.number):
            self._say(
                line, f"{_text(one)} is outside of the {self._model.name}: its numbers are {self._between(one.kind)}"
            )
        elif not numbered and one.number is not None:
            self._say(line, f"a {one.kind} has no number")
        placed = one.rack is not None or one.slot is not None
        if placed and one.kind not in _PLACED:
            self._say(line, f"a {one.kind} is in no slot")
        elif (placed or one.kind == "basic-io-unit") and (one.rack is None or one.slot is None):
            self._say(line, f"a {one.kind} in a slot needs both rack and slot")
        elif placed:
            for what, number in (("rack", one.rack), ("slot", one.slot)):
                if not self._within(what, number):
                    message = (
                        f"{what} {number} is outside of the {self._model.name}: it has {what}s {self._between(what)}"
                    )
                    self._say(line, message)
        return len(self.problems) == count

    def _within(self, kind: str, number: int | None) -> bool:
        low, high = self._ranges.get(kind, (0, -1))
        return number is not None and low <= number <= high

    def _between(self, kind: str) -> str:
        low, high = self._ranges.get(kind, (0, -1))
        return f"{low} to {high}" if high >= low else "none"

    def _say(self, line: int, message: str) -> None:
        self.problems.append(Problem("M011", message, Span(self._file, line, 1, line, 2)))


def _text(one: Fitted) -> str:
    if one.kind == "basic-io-unit":
        return f"a basic-io-unit in rack {one.rack}, slot {one.slot}"
    return one.kind if one.number is None else f"{one.kind} {one.number}"


def _lines(text: str) -> list[int]:
    """The line in which each item of the list begins: where its `kind` is written."""
    return [text.count("\n", 0, match.start()) + 1 for match in re.finditer(r'"kind"\s*:', text)]


def write_hardware(fitted: tuple[Fitted, ...]) -> str:
    """The text of a configuration: an item a line, in the order of kinds, racks and numbers, so that it can be compared."""
    lines = []
    for each in sorted(fitted, key=lambda one: (one.kind, one.rack or 0, one.slot or 0, one.number or 0)):
        told = {field: value for field in _FIELDS if (value := _told(each, field)) not in (None, "")}
        lines.append(f"    {json.dumps(told, ensure_ascii=False)}")
    items = ",\n".join(lines)
    return (
        f'{{\n  "version": {FORMAT},\n  "fitted": [\n{items}\n  ]\n}}\n'
        if lines
        else f'{{\n  "version": {FORMAT},\n  "fitted": []\n}}\n'
    )


def _told(one: Fitted, field: str) -> object:
    return ", ".join(one.words) if field == "words" else getattr(one, field)
