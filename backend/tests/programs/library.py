"""Functions and blocks of the standard library, with any arguments."""

import re

from tests.programs.expressions import expression
from tests.programs.scope import Draw, ExpressionMaker, Parts, Scope, StatementMaker

FUNCTIONS = (
    "INT: DINT_TO_INT(<DINT>)", "INT: REAL_TRUNC_INT(<REAL>)", "INT: LREAL_TO_INT(<LREAL>)", "INT: ABS(<INT>)",
    "INT: ADD(<INT>, <INT>, <INT>)", "INT: LEN(<STRING[12]>)", "INT: STRING_TO_INT(<STRING[12]>)", "INT: MOVE(<INT>)",
    "INT: DAY_OF_WEEK(DT_TO_DATE(<DATE_AND_TIME>))", "UINT: WORD_BCD_TO_UINT(<WORD>)", "WORD: UINT_TO_BCD_WORD(<UINT>)",
    "BOOL: IS_VALID_BCD(<WORD>)", "BOOL: IS_VALID(<REAL>)", "DWORD: TO_BIG_ENDIAN(<DWORD>)", "WORD: FROM_BIG_ENDIAN(<WORD>)",
    "DINT: TO_LITTLE_ENDIAN(<DINT>)", "DWORD: REAL_TO_DWORD(<REAL>)", "LWORD: LREAL_TO_LWORD(<LREAL>)", "REAL: INT_TO_REAL(<INT>)",
    "REAL: STRING_TO_REAL(<STRING[12]>)", "STRING[12]: BOOL_TO_STRING(<BOOL>)", "STRING[12]: INT_TO_STRING(<INT>)",
    "LREAL: REAL_TO_LREAL(<REAL>)", "LREAL: SQRT(<LREAL>)", "TIME: MUL_TIME(<TIME>, <INT>)", "TIME: DIV_TIME(<TIME>, <REAL>)",
    "TIME: ADD_TIME(<TIME>, <TIME>)", "TIME: MAX(<TIME>, <TIME>)", "DINT: TIME_TO_DINT(<TIME>)", "LINT: MUL(<LINT>, <LINT>)",
    "USINT: BOOL_TO_USINT(<BOOL>)", "BYTE: SHL(<BYTE>, <INT>)", "LWORD: ROR(<LWORD>, <DINT>)",
)  # fmt: skip
BLOCKS = {
    "ton": "TON(IN := <BOOL>, PT := T#<MS>ms)", "tof": "TOF(IN := <BOOL>, PT := T#<MS>ms)", "tp": "TP(IN := <BOOL>, PT := T#<MS>ms)",
    "ctu": "CTU(CU := <BOOL>, R := <BOOL>, PV := <INT>)", "ctd": "CTD(CD := <BOOL>, LD := <BOOL>, PV := <INT>)",
    "ctud": "CTUD(CU := <BOOL>, CD := <BOOL>, R := <BOOL>, LD := <BOOL>, PV := <INT>)", "up": "R_TRIG(CLK := <BOOL>)",
    "down": "F_TRIG(CLK := <BOOL>)", "sr": "SR(S1 := <BOOL>, R := <BOOL>)", "rs": "RS(S := <BOOL>, R1 := <BOOL>)",
}  # fmt: skip
HOLE = re.compile(r"<([^<>]+)>")


def library(parts: Parts) -> None:
    """The ingredient."""
    scope = parts.main
    parts.variables.append("std_dt0 : DATE_AND_TIME := DT#2024-02-29-23:59:58;")
    scope.add("DATE_AND_TIME", "std_dt0")
    for each in FUNCTIONS:
        type, call = each.split(": ")
        scope.add_expression(type, _call(call))
    for name, call in BLOCKS.items():
        parts.variables.append(f"{name}_ : {call.split('(')[0]};")
        scope.statements.append(_block(name, call))
    scope.add(
        "BOOL",
        "ton_.Q",
        "tof_.Q",
        "tp_.Q",
        "ctu_.Q",
        "ctd_.Q",
        "ctud_.QU",
        "up_.Q",
        "down_.Q",
        "sr_.Q1",
        "rs_.Q1",
        writable=False,
    )
    scope.add("INT", "ctu_.CV", "ctd_.CV", "ctud_.CV", writable=False)
    scope.add("TIME", "ton_.ET", "tof_.ET", "tp_.ET", writable=False)


def _filled(draw: Draw, scope: Scope, call: str, depth: int) -> str:
    def fill(hole: re.Match[str]) -> str:
        if hole[1] == "MS":
            return str(draw.one(0, 5, 10, 15, 20))
        return expression(draw, scope, hole[1], depth - 1)

    return HOLE.sub(fill, call)


def _call(call: str) -> ExpressionMaker:
    return lambda draw, scope, depth: _filled(draw, scope, call, depth)


def _block(name: str, call: str) -> StatementMaker:
    arguments = call[call.index("(") :]
    return lambda draw, scope, depth: f"{name}_{_filled(draw, scope, arguments, 2)};"
