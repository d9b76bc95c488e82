"""What a dialect of Structured Text may allow beyond IEC 61131-3; `dialect_table` says which dialect allows what.

A construct that a dialect allows is taken with the warning W006, which names the rule of the standard and how a strict program
writes the same. What a vendor's tool computes there is known from its documentation (`docs/dialects.md` has the sources); where
it is not known, the dialect does not allow it.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import Enum, auto

from scanbench.syntax.language_file import DialectName, Policy


class Allowance(Enum):
    """Something that a dialect allows; `dialect_rules` says what the standard has instead."""

    BIT_NUMBERS = auto()
    BIT_CONVERSION = auto()
    NARROWING = auto()
    REAL_CONVERSION = auto()
    INTEGER_BITS = auto()
    ENUM_NUMBERS = auto()
    NUMBER_OF_BITS = auto()
    WIDE_RESULTS = auto()
    STRING_FROM_ZERO = auto()
    STRING_BYTES = auto()
    ARGUMENT_NAMES = auto()
    CHAINED_ASSIGNMENT = auto()
    ASSIGNED_VALUES = auto()
    RETURN_CONDITION = auto()
    BARE_CALLS = auto()
    BLOCK_VARIABLES = auto()
    LIFE = auto()
    KEPT_VARIABLES = auto()
    BLOCK_TEMPORARIES = auto()
    VENDOR_OPERATORS = auto()
    VENDOR_TYPES = auto()
    FINAL_INTERFACES = auto()
    LABELS = auto()
    ROUNDING = auto()
    DINT_RESULTS = auto()
    LOCAL_ADDRESSES = auto()
    DIRECT_REFERENCES = auto()
    POINTER_NUMBERS = auto()
    ANY_INPUTS = auto()
    INSTANCE_COPIES = auto()
    PROGRAM_CALLS = auto()
    HEAP = auto()
    UNLINKED_ADDRESSES = auto()
    TRY = auto()
    SIGNED_BITS = auto()
    BITS_AS_REALS = auto()
    WRAPPED_REALS = auto()
    TIME_NUMBERS = auto()
    CHAR_NUMBERS = auto()
    CHAINED_APART = auto()
    BIT_SUMS = auto()
    INSTRUCTION_CALLS = auto()
    INSTRUCTION_TYPES = auto()
    SIGNED_TEXTS = auto()
    TRUE_TEXTS = auto()
    HALVES_AWAY = auto()
    TEXT_NUMBERS = auto()
    BLOCK_MOVES = auto()
    VARIANTS = auto()
    INTEGER_SHIFTS = auto()
    GENERIC_CONSTANTS = auto()
    SHORTER_STRINGS = auto()
    OVERLOADS = auto()
    START_EXPRESSIONS = auto()
    COMBINED_ASSIGNMENT = auto()
    BLOCK_WRITES = auto()
    TEXT_STRUCTURES = auto()
    ACTION_ARGUMENTS = auto()
    OUTSIDE_PARTS = auto()
    TEXT_CASES = auto()
    RECURSION = auto()
    LITERAL_VALUES = auto()
    ADDRESS_OPERATOR = auto()
    MIXED_ARGUMENTS = auto()
    COUNTER_WRITES = auto()
    FOR_ENDS = auto()
    OPEN_REFERENCES = auto()
    OPEN_INPUTS = auto()
    SETTING_LISTS = auto()
    WORD_COUNTERS = auto()
    REAL_MOD = auto()
    LITERAL_SIZES = auto()
    SHORT_TIMES = auto()
    ALIKE_STRUCTURES = auto()
    REAL_FUNCTIONS = auto()


@dataclass(frozen=True, slots=True)
class Rule:
    """A rule of IEC 61131-3 that a dialect does not have."""

    allowed: str  # what the dialect allows
    strict: str  # what the standard says
    instead: str  # how a strict program writes it, by an example


@dataclass(frozen=True, slots=True)
class Dialect:
    """What the programs of a project may do."""

    name: DialectName
    title: str
    allows: frozenset[Allowance] = frozenset()
    prefixes: frozenset[str] = frozenset()
    """Names of libraries, in upper case, that mean nothing before a name: their texts are among the project's own."""
    defines: frozenset[str] = frozenset()
    """Names, in upper case, that the project defines for conditional pragmas."""
    subranges: Mapping[str, Policy] = field(default_factory=dict, hash=False)
    """What the project says of values outside of subranges; names are in upper case."""
    text_length: int = 80
    """Characters of a STRING or WSTRING that is declared without a length."""

    def policy(self, name: str) -> str:
        """What the project says under this name; '' where it says nothing."""
        said = self.subranges.get(name.upper())
        return "" if said is None else said.word
