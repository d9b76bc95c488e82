"""Instruction List (edition 3, tables 67 to 70): one instruction a line, to the same tree."""

from scanbench.syntax import half_words, parse_chart, parse_expression, parse_networks, parse_statement, tree
from scanbench.syntax.chart import Chart
from scanbench.syntax.cursor import NAME, Cursor, Unexpected
from scanbench.syntax.lexer import Lex
from scanbench.syntax.networks import NetworkBody
from scanbench.syntax.parse_expression import LITERALS
from scanbench.syntax.parse_statement import STOPS

PLAIN = frozenset(("LD", "ST", "S", "R", "NOT"))
NEGATABLE = frozenset(("LD", "ST", "AND", "OR", "XOR"))
DEFERRED = frozenset("AND OR XOR ADD SUB MUL DIV MOD GT GE EQ NE LE LT".split())
CONDITIONAL = frozenset(("JMP", "CAL", "RET"))
INPUTS = frozenset(("S1", "R1", "CLK", "CU", "CD", "PV", "IN", "PT"))
"""Inputs of the standard blocks, which are operators with the instance as operand (table 70)."""

Mnemonic = tuple[str, bool, bool]
"""Operator without modifiers, negated, conditional."""


def _mnemonics() -> dict[str, Mnemonic]:
    made: dict[str, Mnemonic] = {name: (name, False, False) for name in PLAIN | DEFERRED | CONDITIONAL | INPUTS}
    made |= {name + "N": (name, True, False) for name in NEGATABLE}
    made |= {name + "C": (name, False, True) for name in CONDITIONAL}
    made |= {name + "CN": (name, True, True) for name in CONDITIONAL}
    return made


MNEMONICS = _mnemonics()
BEGINNINGS = frozenset(name for name, (plain, _, _) in MNEMONICS.items() if plain not in INPUTS)
OPERANDS = LITERALS | {NAME, Lex.ADDRESS}
ENDINGS = STOPS - {""}


Body = tuple[tree.Statement, ...] | tree.IlBody | NetworkBody | Chart


def body(c: Cursor, first: Body = ()) -> Body:
    """The statements of a POU, in whichever language its first line is written; `first` is what stood before a METHOD or ACTION."""
    if c.at == c.wall or c.texts[c.at] in STOPS:
        return ()
    if first and c.kinds[c.at + 1] is NAME and parse_statement.declaration_follows(c):
        return ()
    if isinstance(first, NetworkBody) or (not first and (parse_networks.follows(c) or half_words.network(c))):
        return parse_networks.body(c)
    if isinstance(first, Chart) or (not first and (parse_chart.follows(c) or half_words.chart(c))):
        return parse_chart.body(c)
    return _il_body(c) if _il_follows(c, c.at) else parse_statement.statements(c)


# ---- which language ---------------------------------------------------------------------------------------------


def _il_follows(c: Cursor, at: int) -> bool:
    if c.kinds[at] is NAME and c.texts[at + 1] == ":":
        at += 2
    text = c.texts[at].upper()
    if c.kinds[at] is not NAME:
        return False
    after = at + 1
    while c.texts[after] == "." and c.kinds[after + 1] is NAME:
        after += 2  # a method: `axis.move( ... )`
    if text not in BEGINNINGS:
        return c.texts[after] == "(" and _mnemonic_after_call(c, after)
    if text.startswith("RET"):
        return c.texts[after] != ";" and (not _same_line(c, at, after) or c.kinds[after] is Lex.END)
    if not _same_line(c, at, after):  # half typed; a variable would go on with an operator
        return c.kinds[after] in (NAME, Lex.KEYWORD, Lex.END)
    operand = c.kinds[after] in OPERANDS or c.texts[after] in ("TRUE", "FALSE", "-", "+")
    # `r REF= x;` and `s S= x;` begin with a variable
    return operand and c.texts[after + 1] not in (";", "=")


def _mnemonic_after_call(c: Cursor, opening: int) -> bool:
    """`LIMIT( ... )` with an instruction on the next line: the result of the call is the current result."""
    depth, at = 0, opening
    while c.texts[at] not in STOPS and c.texts[at] != ";":
        depth += {"(": 1, ")": -1}.get(c.texts[at], 0)
        at += 1
        if depth == 0:
            return not _same_line(c, at - 1, at) and _il_follows(c, at)
    return False


def _same_line(c: Cursor, first: int, second: int) -> bool:
    return c.source.text.find("\n", c.starts[first], c.starts[second]) < 0


# ---- instructions -------------------------------------------------------------------------------------------


def _il_body(c: Cursor) -> tree.IlBody:
    start = c.at
    found: list[tree.IlInstruction] = []
    opened = c.depth
    while not _il_ended(c):
        if c.accept(";"):
            continue
        depth, line = c.depth, c.at
        try:
            instruction = _instruction(c)
            found.append(instruction)
            if instruction.deferred:
                c.enter()
                depth = c.depth
            elif instruction.operator == ")":
                depth = c.depth = max(opened, c.depth - 1)
            if not c.ended() and _same_line(c, c.at - 1, c.at) and not c.is_(")", ";"):
                raise c.fail("the end of the line expected after the instruction")
        except Unexpected:
            c.depth = depth
            _skip_line(c, line)
    c.depth = opened
    return tree.IlBody(tuple(found), c.span_from(start))


def _il_ended(c: Cursor) -> bool:
    if c.ended() or c.at == c.wall or c.texts[c.at] in ENDINGS:
        return True
    return c.kinds[c.at + 1] is NAME and parse_statement.declaration_follows(c)


def _skip_line(c: Cursor, before: int) -> None:
    if c.at == before:
        c.take()
    while not _il_ended(c) and _same_line(c, c.at - 1, c.at):
        c.take()


def _instruction(c: Cursor) -> tree.IlInstruction:
    start, label = c.at, None
    if c.kinds[start] is NAME and c.texts[start + 1] == ":":
        label = c.texts[start]
        c.at += 2
        if _il_ended(c) or (c.kinds[c.at] is NAME and c.texts[c.at + 1] == ":"):
            return _made(c, start, label, ("", False, False), False, None, ())
    if c.is_(")"):
        c.take()
        return _made(c, start, label, (")", False, False), False, None, ())
    at = c.at
    text = c.texts[at].upper()
    if text == "&":
        text = "AND"
    elif c.kinds[at] is not NAME and text not in MNEMONICS:
        raise c.fail("an instruction (an operator, and what it works on) expected")
    c.take()
    if text == "AND" and c.texts[at] == "&" and c.word() == "N" and _same_line(c, at, c.at):
        c.take()
        text = "ANDN"
    if text not in MNEMONICS:
        return _function(c, start, label, at)
    mnemonic = MNEMONICS[text]
    if mnemonic[0] in DEFERRED and c.is_("(") and not _formal_follows(c):
        c.take()
        operand = _operands(c) if _on_line(c, c.at - 1) and not c.is_(")") else ()
        return _made(c, start, label, mnemonic, True, operand[0] if operand else None, _rest(c, operand))
    if mnemonic[0] in DEFERRED and c.is_("("):
        return _made(c, start, label, mnemonic, False, None, parse_expression.arguments(c, "call"))
    if mnemonic[0] == "CAL":
        return _call_block(c, start, label, mnemonic)
    operands = _operands(c) if _on_line(c, at) else ()
    if not operands and mnemonic[0] not in ("RET", "NOT"):
        raise c.fail(f"an operand expected after {text}")
    return _made(c, start, label, mnemonic, False, operands[0] if operands else None, _rest(c, operands))


def _formal_follows(c: Cursor) -> bool:
    return c.kinds[c.at + 1] is NAME and c.texts[c.at + 2] in (":=", "=>")


def _on_line(c: Cursor, token: int) -> bool:
    """Whether more tokens follow on the line of this token."""
    return not c.ended() and c.texts[c.at] not in ENDINGS and _same_line(c, token, c.at)


def _call_block(c: Cursor, start: int, label: str | None, mnemonic: Mnemonic) -> tree.IlInstruction:
    at = c.name("the instance of a block")
    callee = parse_expression.postfix(c, tree.Name(c.texts[at], c.span_of(at)), calls=False)
    arguments = parse_expression.arguments(c, "call") if c.is_("(") else ()
    return _made(c, start, label, mnemonic, False, callee, arguments)


def _function(c: Cursor, start: int, label: str | None, at: int) -> tree.IlInstruction:
    """`LIMIT 1, x, 3`, or `LIMIT(MN := 1, IN := x, MX := 3)`."""
    c.at = at
    name = c.qualified("the name of a function").upper()
    operands: tuple[tree.Expression, ...] = ()
    arguments: tuple[tree.Argument, ...] = ()
    if c.is_("("):
        arguments = parse_expression.arguments(c, "call")
    elif _on_line(c, c.at - 1):
        operands = _operands(c)
    operand = operands[0] if operands else None
    return _made(c, start, label, (name, False, False), False, operand, arguments or _rest(c, operands))


def _operands(c: Cursor) -> tuple[tree.Expression, ...]:
    """Variables and literals with commas between them."""
    found = [_il_operand(c)]
    while c.accept(","):
        found.append(_il_operand(c))
    return tuple(found)


def _il_operand(c: Cursor) -> tree.Expression:
    if c.kinds[c.at] is NAME:
        at = c.take()
        return parse_expression.postfix(c, tree.Name(c.texts[at], c.span_of(at)), calls=False)
    if c.is_("-", "+") or c.kinds[c.at] in OPERANDS or c.is_("TRUE", "FALSE"):
        return parse_expression.operand(c)
    raise c.fail("a variable or literal expected")


def _rest(c: Cursor, operands: tuple[tree.Expression, ...]) -> tuple[tree.Argument, ...]:
    return tuple(tree.Argument(None, False, each, each.span) for each in operands[1:])


def _made(
    c: Cursor,
    start: int,
    label: str | None,
    mnemonic: Mnemonic,
    deferred: bool,
    operand: tree.Expression | None,
    arguments: tuple[tree.Argument, ...],
) -> tree.IlInstruction:
    operator, negated, conditional = mnemonic
    return tree.IlInstruction(label, operator, negated, conditional, deferred, operand, arguments, c.span_from(start))
