"""Instruction List (edition 3, tables 67 to 70): one instruction a line, to the same tree."""

from scanbench.syntax import tree
from scanbench.syntax.cursor import NAME, Unexpected
from scanbench.syntax.lexer import Lex
from scanbench.syntax.parse_expression import LITERALS
from scanbench.syntax.parse_statement import STOPS, StatementParser

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


class IlParser(StatementParser):
    def body(self) -> "tuple[tree.Statement, ...] | tree.IlBody":
        """The statements of a POU, in whichever language its first line is written."""
        return self._il_body() if self._il_follows(self.at) else self.statements()

    # ---- which language ---------------------------------------------------------------------------------------------

    def _il_follows(self, at: int) -> bool:
        if self.kinds[at] is NAME and self.texts[at + 1] == ":":
            at += 2
        text = self.texts[at].upper()
        if self.kinds[at] is not NAME:
            return False
        behind = at + 1
        while self.texts[behind] == "." and self.kinds[behind + 1] is NAME:
            behind += 2  # a method: `axis.move( ... )`
        if text not in BEGINNINGS:
            return self.texts[behind] == "(" and self._mnemonic_after_call(behind)
        if text.startswith("RET"):
            return self.texts[behind] != ";" and (not self._same_line(at, behind) or self.kinds[behind] is Lex.END)
        operand = self.kinds[behind] in OPERANDS or self.texts[behind] in ("TRUE", "FALSE", "-", "+")
        # `r REF= x;` and `s S= x;` begin with a variable
        return operand and self._same_line(at, behind) and self.texts[behind + 1] not in (";", "=")

    def _mnemonic_after_call(self, opening: int) -> bool:
        """`LIMIT( ... )` with an instruction on the next line: the result of the call is the current result."""
        depth, at = 0, opening
        while self.texts[at] not in STOPS and self.texts[at] != ";":
            depth += {"(": 1, ")": -1}.get(self.texts[at], 0)
            at += 1
            if depth == 0:
                return not self._same_line(at - 1, at) and self._il_follows(at)
        return False

    def _same_line(self, first: int, second: int) -> bool:
        return self.source.text.find("\n", self.starts[first], self.starts[second]) < 0

    # ---- instructions -------------------------------------------------------------------------------------------

    def _il_body(self) -> tree.IlBody:
        start = self.at
        found: list[tree.IlInstruction] = []
        opened = self.depth
        while not self._il_ended():
            if self.accept(";"):
                continue
            depth, line = self.depth, self.at
            try:
                instruction = self._instruction()
                found.append(instruction)
                if instruction.deferred:
                    self.enter()
                    depth = self.depth
                elif instruction.operator == ")":
                    depth = self.depth = max(opened, self.depth - 1)
                if not self.ended() and self._same_line(self.at - 1, self.at) and not self.is_(")", ";"):
                    raise self.fail("the end of the line expected behind the instruction")
            except Unexpected:
                self.depth = depth
                self._skip_line(line)
        self.depth = opened
        return tree.IlBody(tuple(found), self.span_from(start))

    def _il_ended(self) -> bool:
        if self.ended() or self.texts[self.at] in ENDINGS:
            return True
        return self.kinds[self.at + 1] is NAME and self.declaration_follows()

    def _skip_line(self, before: int) -> None:
        if self.at == before:
            self.take()
        while not self._il_ended() and self._same_line(self.at - 1, self.at):
            self.take()

    def _instruction(self) -> tree.IlInstruction:
        start, label = self.at, None
        if self.kinds[start] is NAME and self.texts[start + 1] == ":":
            label = self.texts[start]
            self.at += 2
            if self._il_ended() or (self.kinds[self.at] is NAME and self.texts[self.at + 1] == ":"):
                return self._made(start, label, ("", False, False), False, None, ())
        if self.is_(")"):
            self.take()
            return self._made(start, label, (")", False, False), False, None, ())
        at = self.at
        text = self.texts[at].upper()
        if text == "&":
            text = "AND"
        elif self.kinds[at] is not NAME and text not in MNEMONICS:
            raise self.fail("an instruction (an operator, and what it works on) expected")
        self.take()
        if text == "AND" and self.texts[at] == "&" and self.word() == "N" and self._same_line(at, self.at):
            self.take()
            text = "ANDN"
        if text not in MNEMONICS:
            return self._function(start, label, at)
        mnemonic = MNEMONICS[text]
        if mnemonic[0] in DEFERRED and self.is_("(") and not self._formal_follows():
            self.take()
            operand = self._operands() if self._on_line(self.at - 1) and not self.is_(")") else ()
            return self._made(start, label, mnemonic, True, operand[0] if operand else None, self._rest(operand))
        if mnemonic[0] in DEFERRED and self.is_("("):
            return self._made(start, label, mnemonic, False, None, self.arguments("call"))
        if mnemonic[0] == "CAL":
            return self._call_block(start, label, mnemonic)
        operands = self._operands() if self._on_line(at) else ()
        if not operands and mnemonic[0] not in ("RET", "NOT"):
            raise self.fail(f"an operand expected behind {text}")
        return self._made(start, label, mnemonic, False, operands[0] if operands else None, self._rest(operands))

    def _formal_follows(self) -> bool:
        return self.kinds[self.at + 1] is NAME and self.texts[self.at + 2] in (":=", "=>")

    def _on_line(self, token: int) -> bool:
        """Something more stands on the line of this token."""
        return not self.ended() and self.texts[self.at] not in ENDINGS and self._same_line(token, self.at)

    def _call_block(self, start: int, label: str | None, mnemonic: Mnemonic) -> tree.IlInstruction:
        at = self.name("the instance of a block")
        callee = self._postfix(tree.Name(self.texts[at], self.span_of(at)), calls=False)
        arguments = self.arguments("call") if self.is_("(") else ()
        return self._made(start, label, mnemonic, False, callee, arguments)

    def _function(self, start: int, label: str | None, at: int) -> tree.IlInstruction:
        """`LIMIT 1, x, 3`, or `LIMIT(MN := 1, IN := x, MX := 3)`."""
        self.at = at
        name = self.qualified("the name of a function").upper()
        operands: tuple[tree.Expression, ...] = ()
        arguments: tuple[tree.Argument, ...] = ()
        if self.is_("("):
            arguments = self.arguments("call")
        elif self._on_line(self.at - 1):
            operands = self._operands()
        operand = operands[0] if operands else None
        return self._made(start, label, (name, False, False), False, operand, arguments or self._rest(operands))

    def _operands(self) -> tuple[tree.Expression, ...]:
        """Variables and literals with commas between them."""
        found = [self._il_operand()]
        while self.accept(","):
            found.append(self._il_operand())
        return tuple(found)

    def _il_operand(self) -> tree.Expression:
        if self.kinds[self.at] is NAME:
            at = self.take()
            return self._postfix(tree.Name(self.texts[at], self.span_of(at)), calls=False)
        if self.is_("-", "+") or self.kinds[self.at] in OPERANDS or self.is_("TRUE", "FALSE"):
            return self._operand()
        raise self.fail("a variable or literal expected")

    def _rest(self, operands: tuple[tree.Expression, ...]) -> tuple[tree.Argument, ...]:
        return tuple(tree.Argument(None, False, each, each.span) for each in operands[1:])

    def _made(
        self,
        start: int,
        label: str | None,
        mnemonic: Mnemonic,
        deferred: bool,
        operand: tree.Expression | None,
        arguments: tuple[tree.Argument, ...],
    ) -> tree.IlInstruction:
        operator, negated, conditional = mnemonic
        return tree.IlInstruction(
            label, operator, negated, conditional, deferred, operand, arguments, self.span_from(start)
        )
