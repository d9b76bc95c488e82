"""The dialects with what each allows, and which one a project is written in."""

from collections.abc import Mapping
from dataclasses import replace

from scanbench.check.dialect import Allowance, Dialect
from scanbench.check.libraries.catalogue import library_of_file
from scanbench.syntax.language_file import BYTES_SINCE, DialectName, defined_in, language_of

_LOGIX = frozenset(
    {Allowance.ROUNDING, Allowance.WRAPPED_REALS, Allowance.DINT_RESULTS, Allowance.TEXT_STRUCTURES, Allowance.REAL_MOD}
)
_SIEMENS = frozenset(
    {
        *(Allowance.ROUNDING, Allowance.WRAPPED_REALS, Allowance.TIME_NUMBERS, Allowance.CHAR_NUMBERS),
        *(Allowance.CHAINED_APART, Allowance.BIT_SUMS, Allowance.INSTRUCTION_CALLS),
        *(
            Allowance.INSTRUCTION_TYPES,
            Allowance.SIGNED_TEXTS,
            Allowance.BLOCK_MOVES,
            Allowance.VARIANTS,
            Allowance.OVERLOADS,
            Allowance.COMBINED_ASSIGNMENT,
            Allowance.BLOCK_WRITES,
            Allowance.TEXT_CASES,
            Allowance.OPEN_REFERENCES,
            Allowance.ALIKE_STRUCTURES,
            Allowance.SHORTER_STRINGS,
        ),
    }
)
_TWINCAT = frozenset({Allowance.SHORTER_STRINGS})
_CODESYS = frozenset(Allowance) - _LOGIX - _SIEMENS - _TWINCAT
"""All but what only the others have."""
DIALECTS: dict[DialectName, Dialect] = {
    each.name: each
    for each in (
        Dialect("iec", "IEC 61131-3"),
        Dialect("codesys", "CODESYS", _CODESYS, frozenset({"STANDARD"})),
        Dialect("twincat", "TwinCAT", _CODESYS | _TWINCAT, frozenset({"TC2_STANDARD", "STANDARD"})),
        Dialect(
            "siemens",
            "Siemens SCL",
            _SIEMENS
            | {Allowance.INTEGER_SHIFTS}
            | {Allowance.CHAINED_ASSIGNMENT, Allowance.LABELS, Allowance.BLOCK_VARIABLES}
            | {Allowance.BIT_CONVERSION, Allowance.NARROWING, Allowance.REAL_CONVERSION}
            | {Allowance.BLOCK_TEMPORARIES, Allowance.INSTANCE_COPIES},
            frozenset({"SYSTEM.MATH", "IEC"}),
            text_length=254,
        ),
        Dialect(
            "rockwell",
            "Rockwell Logix",
            _LOGIX
            | {Allowance.PROGRAM_CALLS, Allowance.BLOCK_VARIABLES, Allowance.OUTSIDE_PARTS}
            | {Allowance.INTEGER_BITS, Allowance.NARROWING, Allowance.REAL_CONVERSION, Allowance.BITS_AS_REALS},
        ),
        Dialect("omron", "Omron Sysmac"),
    )
}
IEC = DIALECTS["iec"]


def dialect_in(sources: Mapping[str, str]) -> Dialect:
    """What these files are written in, with the names of the libraries that they have or name."""
    language = language_of(sources)[0]
    dialect = DIALECTS[language.dialect]
    if language.version < BYTES_SINCE:
        dialect = replace(dialect, allows=dialect.allows - {Allowance.STRING_BYTES})
    if defined := defined_in(sources):
        dialect = replace(dialect, defines=defined)
    if language.subranges:
        dialect = replace(dialect, subranges={name.upper(): said for name, said in language.subranges.items()})
    named = {*language.namespaces, *(library for file in sources if (library := library_of_file(file)))}
    return replace(dialect, prefixes=dialect.prefixes | {each.upper() for each in named}) if named else dialect
