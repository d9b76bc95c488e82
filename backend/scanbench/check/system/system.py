"""What the model adds to every program: common processing (phase 1), the vendor's instructions, named system words.

Common processing and instructions are ST, made from the model and checked like any other; their text may use names that no
other text can: `__SCAN` and other fields of the header, and the model's addresses, whatever a program may do there.
"""

from dataclasses import dataclass
from functools import lru_cache

from scanbench.check.body.references import reference_type
from scanbench.check.system import instruction_text, network_text, system_text
from scanbench.plcmodel.model import Instruction, Location, MessageInstruction, Model, Special, TextPlace
from scanbench.plcmodel.network import ports
from scanbench.problems import Span
from scanbench.program.layout import Layout
from scanbench.program.origin import SYSTEM_FILE
from scanbench.program.own_variables import SYSTEM
from scanbench.program.types import (
    ELEMENTARY,
    LINT,
    LWORD,
    UDINT,
    ULINT,
    ArrayType,
    Kind,
    Member,
    Record,
    Section,
    Type,
)
from scanbench.syntax import tree
from scanbench.syntax.parse_st import parse_st
from scanbench.syntax.source import Source

_HEADER: tuple[tuple[str, Type, int], ...] = (
    ("__SCAN", ULINT, Layout.SCAN),
    ("__STARTED", ULINT, Layout.STARTED),
    ("__CLOCK", ULINT, Layout.CLOCK),
    ("__TIME", LINT, Layout.CLOCK),
    ("__EPOCH", LINT, Layout.EPOCH),
    ("__INTERVAL", ULINT, Layout.INTERVAL),
    ("__ASKED_COUNT", UDINT, Layout.ASKED_COUNT),
    ("__ASKED", ArrayType(((0, Layout.ASKED_LIMIT - 1),), LWORD), Layout.ASKED),
)
_NOWHERE = Span(SYSTEM_FILE, 1, 1, 1, 1)
_BITS = {1: "BOOL", 8: "BYTE", 16: "WORD", 32: "DWORD", 64: "LWORD"}
_NUMBERS = {8: "USINT", 16: "UINT", 32: "UDINT", 64: "ULINT"}


@dataclass(frozen=True, slots=True)
class System:
    """Everything of one model; the trees are the same objects for every program."""

    words: Record
    """What only text of the system sees."""
    symbols: Record
    """Variables that every program knows, unless it declares the name itself."""
    file: tree.File


@dataclass(frozen=True, slots=True)
class _Same:
    """A model by identity: comparing two catalogues takes longer than making this again."""

    model: Model

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Same) and other.model is self.model

    def __hash__(self) -> int:
        return id(self.model)


def system_of(model: Model, areas: dict[str, int]) -> System:
    """What this model adds; `areas` are the offsets of its areas, the same for every program."""
    return _system_of(_Same(model), tuple(areas.items()))


@lru_cache(maxsize=64)
def _system_of(same: _Same, areas: tuple[tuple[str, int], ...]) -> System:
    model, offsets = same.model, dict(areas)
    words = Record(SYSTEM.name, Kind.STRUCT)
    for name, type, offset in _HEADER:
        words.place_at(Member(name, type, Section.GLOBAL, _NOWHERE), offset)
    if ports(model):
        places = ArrayType(((0, Layout.ASKED_LIMIT - 1),), reference_type(ELEMENTARY["WORD"]))
        words.place_at(Member(network_text.PLACES, places, Section.GLOBAL, _NOWHERE), Layout.ASKED)
    for number, special in enumerate(model.specials):
        _add(words, system_text.word(number), _type_of(special), special.location, offsets, special.text)
    _add_instructions(words, model, offsets)
    if model.code_word is not None:
        numbers = ELEMENTARY[_NUMBERS[model.code_word.bits]]
        _add(words, system_text.CODE, numbers, model.code_word, offsets, "")
    if model.error_reset is not None:
        bit = model.error_reset.bit
        _add(words, system_text.RESET_BIT, ELEMENTARY["BOOL"], bit, offsets, model.format(*bit))
        _add(words, system_text.RESET_CODE, ELEMENTARY["UINT"], model.error_reset.code, offsets, "")
    if model.log is not None:
        _add(words, system_text.LOG_COUNT, ELEMENTARY["UINT"], model.log.counter, offsets, "")
    symbols = Record("", Kind.STRUCT)
    for special in model.specials:
        if special.symbol:
            type = ELEMENTARY[_BITS[special.location.bits]]
            _add(symbols, special.symbol, type, special.location, offsets, special.text)
    file, problems = parse_st(Source(SYSTEM_FILE, _text(model)))
    assert not problems, (model.name, problems)
    return System(words, symbols, file)


def _add_instructions(words: Record, model: Model, offsets: dict[str, int]) -> None:
    """What the vendor's instructions read and write."""
    for instruction in model.instructions:
        entry = model.error(instruction.error)
        if entry is not None:
            _add(words, system_text.flag(instruction), ELEMENTARY["BOOL"], entry.flag, offsets, entry.flag_text)
        place = instruction_text.number_place(model, instruction)
        if place is not None and place.location is not None:
            numbers = (
                ELEMENTARY["UINT"]
                if place.kind == "Word"
                else ArrayType(((0, instruction.maximum // 16),), ELEMENTARY["UINT"])
            )
            _add(words, system_text.number_name(instruction), numbers, place.location, offsets, place.text)
        if instruction.texts is not None:
            _add_texts(words, instruction, instruction.texts, offsets)
        if instruction.system_errors is not None:
            _add(words, system_text.stand_in(instruction), ELEMENTARY["UINT"], instruction.system_errors, offsets, "")
    for reset in model.resets:
        _add(words, system_text.reset_flags(reset), ELEMENTARY["UINT"], reset.flags, offsets, "")
    for query in model.queries:
        _add(words, system_text.query_flags(query), ELEMENTARY["UINT"], query.flags, offsets, "")
        _add(words, system_text.query_code(query), ELEMENTARY["UDINT"], query.code, offsets, "")
    for message in model.messages:
        _add_texts(words, message, message.texts, offsets)


def _text(model: Model) -> str:
    return "\n".join(
        filter(
            None,
            (
                system_text.common(model),
                *instruction_text.instructions(model),
                *network_text.network_instructions(model),
            ),
        )
    )


def _type_of(special: Special) -> Type:
    """How common processing sees the address."""
    if special.role == "clock":
        return ArrayType(((0, len(special.fields) - 1),), ELEMENTARY["BYTE"])
    return ELEMENTARY["BOOL"] if special.location.bits == 1 else ELEMENTARY[_NUMBERS[special.location.bits]]


def _add_texts(
    words: Record, made: Instruction | MessageInstruction, texts: TextPlace, offsets: dict[str, int]
) -> None:
    last = 2 * texts.words * (made.maximum + 1) - 1
    _add(words, system_text.texts(made), ArrayType(((0, last),), ELEMENTARY["BYTE"]), texts.first, offsets, "")


def _add(record: Record, name: str, type: Type, location: Location, areas: dict[str, int], address: str) -> None:
    member = Member(name, type, Section.GLOBAL, _NOWHERE, address=address, bit=location.bit)
    member.offset = areas[location.area.name] + location.byte
    member.home = record.name
    record.members[name.upper()] = member
