"""Problems: what is wrong in a program or a model file, where, and what to do about it.

Every problem has a code from `TABLE`; one row is one problem, with a page in the documentation and a test.
This module imports nothing of ours: every room may use it.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from enum import StrEnum


class Severity(StrEnum):
    ERROR = "error"
    WARNING = "warning"


@dataclass(frozen=True, slots=True)
class Span:
    """A stretch of a file. Lines and columns count from 1; the end is exclusive."""

    file: str
    line: int
    column: int
    end_line: int
    end_column: int

    def to(self, last: "Span") -> "Span":
        """The stretch from the start of this one to the end of `last`."""
        return Span(self.file, self.line, self.column, last.end_line, last.end_column)

    def last(self, length: int) -> "Span":
        """Its last characters, which are on one line."""
        return Span(self.file, self.end_line, self.end_column - length, self.end_line, self.end_column)

    def plain(self) -> "Span":
        """The same, as plain data: no source text is kept alive by it."""
        return self

    def __str__(self) -> str:
        return f"{self.file}:{self.line}:{self.column}"


@dataclass(frozen=True, slots=True)
class Problem:
    """One finding; `message` says what is wrong and what to do."""

    code: str
    message: str
    span: Span
    severity: Severity = Severity.ERROR

    def __post_init__(self) -> None:
        if not self.message.isprintable():
            object.__setattr__(self, "message", "".join(map(_shown, self.message)))
        object.__setattr__(self, "severity", Severity(self.severity))  # over a link it comes as its value

    def __str__(self) -> str:
        return f"{self.span}: {self.code} {self.message}"


def perhaps(near: Iterable[str]) -> str:
    """A sentence that follows a message: ` Did you mean `x` or `y`?`; nothing where no name is near."""
    names = " or ".join(f"`{each}`" for each in near)
    return f" Did you mean {names}?" if names else ""


def _shown(char: str) -> str:
    r"""A character of the program as it can be seen, such as \x07: a terminal obeys some of those that cannot."""
    return char if char.isprintable() or char == "\n" else char.encode("unicode_escape").decode()


TABLE: dict[str, str] = {
    # S: the text cannot be read
    "S001": "unexpected character",
    "S002": "text, comment or pragma that never ends",
    "S003": "something else was expected here",
    "S004": "literal that cannot be read or is out of its type's range",
    # D: declarations
    "D001": "name declared twice",
    "D002": "unknown type",
    "D003": "type that contains itself",
    "D004": "initial value that is not constant or does not fit",
    "D005": "address that the model does not have, or that does not fit the type",
    "D006": "array bounds or string length that make no sense",
    "D007": "VAR_EXTERNAL without its VAR_GLOBAL, or of a different type",
    "D008": "section that is not allowed here",
    "D009": "recursion",
    "D010": "configuration that names something unknown",
    "D011": "nothing to run: no program",
    "D012": "memory larger than the limit",
    "D013": "calls that multiply beyond what a scan may take",
    "D014": "class, interface or method that breaks a rule of inheritance",
    # T: types and names in statements
    "T001": "unknown name",
    "T002": "types that do not fit",
    "T003": "value that cannot be assigned to",
    "T004": "call with wrong arguments",
    "T005": "in-out that is not connected, or cannot be",
    "T006": "condition that is not BOOL",
    "T007": "CASE label that is not constant or occurs twice",
    "T008": "FOR loop that cannot be counted",
    "T009": "EXIT or CONTINUE outside of a loop",
    "T010": "name used in a way that its kind does not allow",
    "T011": "write to read-only memory of the model",
    "T012": "constant index outside of the array",
    "T013": "reference to something that cannot be referred to",
    "T014": "member that is not accessible from here",
    # W: works, but is probably not meant
    "W001": "statement without effect",
    "W002": "input or output without an address",
    "W003": "bits copied, where other tools convert the number",
    "W004": "bytes that other tools have otherwise",
    "W005": "character number 0",
    "W006": "construct that only the dialect of the project allows",
    "W007": "statement that is never reached",
    "W008": "use of a stub, whose results the user sets",
    # R: required reactions
    "R001": "requirement that cannot be checked",
    # X: constructs that are known, and not supported
    "X001": "construct that is not supported",
    # M: model files
    "M001": "file that cannot be read as a model",
    "M002": "model file that does not follow the schema",
    "M003": "address or area that the model does not have, or that does not fit",
    "M004": "name used twice in a model file",
    "M005": "error code and flag that two errors share",
    "M006": "access ranges with a gap or an overlap",
    "M007": "number that does not fit its field",
    "M008": "error detail that is incomplete",
    "M009": "base model that cannot be used",
    "M010": "special address or instruction that does not fit its role or error",
    "M011": "hardware configuration that the model does not allow",
}
