"""End codes of FINS, and the refusal that carries one. (W342, section 5; libfins `fins.h`.)"""

from enum import IntEnum


class End(IntEnum):
    """Main and sub code of an answer."""

    OK = 0x0000
    NO_NODE = 0x0201
    NO_UNIT = 0x0202
    UNDEFINED = 0x0401
    TOO_LONG = 0x1001
    TOO_SHORT = 0x1002
    NOT_AS_MANY = 0x1003
    NO_AREA = 0x1101
    BEGINS_OUTSIDE = 0x1103
    ENDS_OUTSIDE = 0x1104
    ANSWER_TOO_LONG = 0x110B
    PARAMETER = 0x110C
    READ_ONLY = 0x2101
    PROTECTED = 0x2102
    CANNOT_CHANGE = 0x2108
    NOT_NOW = 0x2201
    NOT_IN_PROGRAM = 0x2203
    NOT_IN_RUN = 0x2206
    SERVICE_BUSY = 0x2605
    NOT_CLEARED = 0x260B


NONFATAL, FATAL = 0x0040, 0x0080
"""Bits that every answer carries while the CPU Unit has an error."""


class Refused(Exception):
    """The request is answered with this end code and nothing else."""

    def __init__(self, code: End) -> None:
        super().__init__(code.name)
        self.code = code
