"""Random ST programs: every type, operator and statement, at the edges of their ranges."""

from random import Random

SIGNED = {"SINT": 8, "INT": 16, "DINT": 32, "LINT": 64}
UNSIGNED = {"USINT": 8, "UINT": 16, "UDINT": 32, "ULINT": 64}
BITS = {"BYTE": 8, "WORD": 16, "DWORD": 32, "LWORD": 64}
WHOLE = {**SIGNED, **UNSIGNED}
REALS = ("REAL", "LREAL")
SCALARS = (*WHOLE, *BITS, *REALS, "BOOL")
TEXTS = ("STRING[5]", "STRING[12]", "STRING[80]")

DECLARATIONS = """\
TYPE Pair : STRUCT x : INT; y : REAL; name : STRING[12]; flags : ARRAY[0..2] OF BOOL; END_STRUCT; END_TYPE
VAR_GLOBAL gi : DINT := 3; gr : REAL := 1.5; END_VAR
"""

CALLEES = """\
FUNCTION Mix : DINT
VAR_INPUT a : DINT; s : STRING[12]; END_VAR
VAR_IN_OUT b : INT; f : BOOL; END_VAR
VAR_OUTPUT c : INT; t : STRING[5]; END_VAR
VAR i : INT; sum : DINT; END_VAR
FOR i := 1 TO 5 DO sum := sum + a * i; END_FOR;
b := b + 1; f := NOT f; c := b * 3; t := CONCAT(s, 'ab');
Mix := sum + LEN(s) + gi;
IF a > 100 THEN RETURN; END_IF;
gi := gi + 1;
END_FUNCTION

FUNCTION Area : REAL
VAR_INPUT p : Pair; END_VAR
Area := p.y * INT_TO_REAL(p.x);
END_FUNCTION

FUNCTION_BLOCK Unit
VAR_INPUT run : BOOL; n : INT; text : STRING[12]; END_VAR
VAR_IN_OUT level : REAL; bit : BOOL; pair : Pair; END_VAR
VAR_OUTPUT total : DINT; last : STRING[5]; END_VAR
VAR i, k : INT; buf : ARRAY[-2..5] OF INT; tmr : TON; END_VAR
VAR_TEMP t : DINT; END_VAR
FOR i := 5 TO -1 BY -1 DO buf[i] := buf[i - 1]; END_FOR;
buf[-2] := n; t := 0;
FOR k := -2 TO 5 DO t := t + buf[k]; IF buf[k] > 1000 THEN EXIT; END_IF; END_FOR;
total := total + t;
tmr(IN := run, PT := T#3ms);
IF tmr.Q THEN bit := NOT bit; END_IF;
level := level * 0.5 + INT_TO_REAL(n);
pair.x := pair.x + n; last := LEFT(text, 3);
END_FUNCTION_BLOCK
"""

VARIABLES = """\
VAR
i0, i1, i2 : INT; j : ARRAY[0..7] OF INT; m : ARRAY[1..3, -1..2] OF DINT; p0, p1 : Pair; ps : ARRAY[0..2] OF Pair;
u : Unit; us : ARRAY[0..1] OF Unit; names : ARRAY[0..2] OF STRING[12]; rs : ARRAY[0..7] OF REAL;
lx AT %MX0.3 : BOOL; lw AT %MW0 : INT; ld AT %MD0 : REAL; lb AT %MB2 : BYTE; ls AT %MW4 : STRING[5];
"""


class ProgramText:
    """Writes one program, steered by a source of choices."""

    def __init__(self, choices: Random) -> None:
        self.choices = choices
        self.loops: list[str] = []
        self.depth = 0

    # ---- places -----------------------------------------------------------------------------------------

    def place(self, type: str) -> str:
        """A variable of the type, or a part of one."""
        pick = self.choices.choice
        plain = [f"v_{type.split('[')[0].lower()}{n}" for n in range(2)] if type in SCALARS else []
        match type:
            case "INT":
                plain += ["i0", "i1", "i2", "p0.x", "lw", f"j[{self.index(0, 7)}]", f"ps[{self.index(0, 2)}].x"]
            case "DINT":
                plain += ["gi", f"m[{self.index(1, 3)}, {self.index(-1, 2)}]"]
            case "REAL":
                plain += ["gr", "p0.y", "p1.y", "ld", f"rs[{self.index(0, 7)}]"]
            case "BOOL":
                plain += ["lx", f"p0.flags[{self.index(0, 2)}]", "%MX1.6"]
            case "BYTE":
                plain += ["lb", "%MB1"]
            case "STRING[5]":
                plain = ["s5", "ls"]
            case "STRING[12]":
                plain = ["s12", "p1.name", f"names[{self.index(0, 2)}]"]
            case "STRING[80]":
                plain = ["s80", "t80"]
        return str(pick(plain))

    def index(self, low: int, high: int) -> str:
        """An index that is mostly inside."""
        kind = self.choices.randrange(8)
        if kind < 4:
            return str(self.choices.randint(low, high))
        if kind == 4 and self.loops:
            return self.choices.choice(self.loops)
        if kind == 5:
            return f"i0 + {self.choices.randint(-1, 1)}"
        return f"ABS(i{self.choices.randrange(3)} MOD {high - low + 1}) + {low}"

    # ---- expressions --------------------------------------------------------------------------------------

    def literal(self, type: str) -> str:
        choose = self.choices.choice
        if type == "BOOL":
            return str(choose(("TRUE", "FALSE")))
        if type in REALS:
            number = choose(("0.0", "1.0", "-1.0", "0.1", "3.4e38", "1.0e-40", "100.0", "2.5", "-0.5", "1.0e300"))
            return number if type == "LREAL" or number != "1.0e300" else "1.0e38"
        if type.startswith("STRING"):
            return str(choose(("''", "'a'", "'abc'", "'bca'", "'hello world, this is long'", "'-12.5e1x'", "' 42'")))
        bits = {**WHOLE, **BITS}[type]
        low, high = (-(1 << bits - 1), (1 << bits - 1) - 1) if type in SIGNED else (0, (1 << bits) - 1)
        value = choose((0, 1, 2, 7, 10, 100, high, high - 1, low, low + 1, -1 if low else 3))
        value = min(max(value, low), high)
        if value == low and low:
            return f"({type}#{-high + 0 if high else 0} - {type}#1)".replace("#-", "#-")
        return f"{type}#{value}" if value >= 0 else f"({type}#0 - {type}#{-value})"

    def expr(self, type: str) -> str:
        """An expression of the type."""
        self.depth += 1
        try:
            if self.depth > 4 or self.choices.randrange(4) == 0:
                return self.literal(type) if self.choices.randrange(3) == 0 else self.place(type)
            if type == "BOOL":
                return self.bool_expr()
            if type.startswith("STRING"):
                return self.text_expr()
            if type in REALS:
                return self.real_expr(type)
            return self.bits_expr(type) if type in BITS else self.whole_expr(type)
        finally:
            self.depth -= 1

    def whole_expr(self, type: str) -> str:
        e, kind = self.expr, self.choices.randrange(11)
        if kind < 5:
            return f"({e(type)} {self.choices.choice(('+', '-', '*', '/', 'MOD'))} {e(type)})"
        if kind == 5:
            other = self.choices.choice([each for each in (*SCALARS,) if each not in (type, "BOOL")])
            return f"{other}_TO_{type}({e(other)})"
        if kind == 6:
            return f"{self.choices.choice(('MIN', 'MAX'))}({e(type)}, {e(type)})"
        if kind == 7:
            return f"SEL({e('BOOL')}, {e(type)}, {e(type)})"
        if kind == 8 and type == "DINT":
            return (
                f"Mix(a := {e('DINT')}, s := {self.text_expr()}, b := i1, f := {self.place('BOOL')}, c => i2, t => s5)"
            )
        if kind == 9 and type == "INT":
            return self.choices.choice((f"LEN({self.text_expr()})", f"FIND({self.text_expr()}, {self.text_expr()})"))
        return f"(-{e(type)})" if type in SIGNED else e(type)

    def real_expr(self, type: str) -> str:
        e, kind = self.expr, self.choices.randrange(10)
        if kind < 5:
            return f"({e(type)} {self.choices.choice('+-*/')} {e(type)})"
        if kind == 5:
            return f"{self.choices.choice(('SQRT', 'ABS', 'SIN', 'EXP', 'LN', 'ATAN', 'TAN', 'LOG'))}({e(type)})"
        if kind == 6:
            other = self.choices.choice(("INT", "LINT", "UDINT", "ULINT", "LREAL" if type == "REAL" else "REAL"))
            return f"{other}_TO_{type}({e(other)})"
        if kind == 7:
            return f"{self.choices.choice(('MIN', 'MAX'))}({e(type)}, {e(type)})"
        if kind == 8:
            return f"EXPT({e(type)}, {e(type)})"
        return f"Area(ps[{self.index(0, 2)}])" if type == "REAL" else f"(-{e(type)})"

    def bits_expr(self, type: str) -> str:
        e, kind = self.expr, self.choices.randrange(6)
        if kind < 2:
            return f"({e(type)} {self.choices.choice(('AND', 'OR', 'XOR'))} {e(type)})"
        if kind == 2:
            return f"(NOT {e(type)})"
        if kind == 3:
            shift = self.choices.choice(("SHL", "SHR", "ROL", "ROR"))
            return f"{shift}({e(type)}, {self.choices.choice((e('INT'), '3', '0', '64', '8'))})"
        other = self.choices.choice([each for each in (*WHOLE, *BITS) if each != type])
        return f"{other}_TO_{type}({e(other)})"

    def bool_expr(self) -> str:
        e, kind = self.expr, self.choices.randrange(5)
        if kind < 2:
            return f"({e('BOOL')} {self.choices.choice(('AND', 'OR', 'XOR'))} {e('BOOL')})"
        if kind == 2:
            return f"(NOT {e('BOOL')})"
        order = self.choices.choice(("=", "<>", "<", "<=", ">", ">="))
        if kind == 3 and self.choices.randrange(2):
            return f"({self.text_expr()} {order} {self.text_expr()})"
        type = self.choices.choice((*WHOLE, *REALS))
        return f"({e(type)} {order} {e(type)})"

    def text_expr(self) -> str:
        self.depth += 1
        try:
            kind = self.choices.randrange(12 if self.depth < 5 else 3)
            t, n = self.text_expr, self.choices.choice(("i0", "0", "1", "3", "-1", "200", "i1"))
            m = self.choices.choice(("i2", "1", "2", "5", "0", "-3"))
            if kind < 2:
                return self.place(self.choices.choice(TEXTS))
            if kind == 2:
                return self.literal("STRING")
            if kind < 5:
                return f"CONCAT({t()}, {t()})"
            if kind == 5:
                return f"{self.choices.choice(('LEFT', 'RIGHT'))}({t()}, {n})"
            if kind == 6:
                return f"MID({t()}, {n}, {m})"
            if kind == 7:
                return f"INSERT({t()}, {t()}, {n})"
            if kind == 8:
                return f"DELETE({t()}, {n}, {m})"
            if kind == 9:
                return f"REPLACE({t()}, {t()}, {n}, {m})"
            type = self.choices.choice(("INT", "LINT", "ULINT", "REAL", "LREAL"))
            return f"{type}_TO_STRING({self.expr(type)})"
        finally:
            self.depth -= 1

    # ---- statements -----------------------------------------------------------------------------------------

    def statements(self, count: int) -> str:
        return "\n".join(self.statement() for _ in range(count))

    def block(self) -> str:
        return self.statements(self.choices.randint(1, 3))

    def statement(self) -> str:
        self.depth += 1
        try:
            kind = self.choices.randrange(16 if self.depth < 4 else 7)
            return self.simple() if kind < 7 else self.compound(kind)
        finally:
            self.depth -= 1

    def simple(self) -> str:
        kind, e = self.choices.randrange(12), self.expr
        if kind < 6:
            type = self.choices.choice(SCALARS)
            return f"{self.place(type)} := {e(type)};"
        if kind < 9:
            return f"{self.place(self.choices.choice(TEXTS))} := {self.text_expr()};"
        if kind == 9:
            return self.choices.choice(
                ("p0 := p1;", "p1 := ps[0];", f"ps[{self.index(0, 2)}] := p0;", "ps[1] := ps[2];")
            )
        if kind == 10:
            unit = self.choices.choice(("u", f"us[{self.index(0, 1)}]"))
            level = self.choices.choice(("gr", "rs[2]", f"rs[{self.index(0, 7)}]", "ps[1].y"))
            bit = self.choices.choice(("lx", "p0.flags[1]", "v_bool0"))
            pair = self.choices.choice(("p0", f"ps[{self.index(0, 2)}]"))
            return (f"{unit}(run := {e('BOOL')}, n := {e('INT')}, text := {self.text_expr()}, level := {level}, "
                    f"bit := {bit}, pair := {pair}, total => gi, last => s5);")  # fmt: skip
        return "v_lint0 := STRING_TO_LINT(s12); v_lreal0 := STRING_TO_LREAL(s80);"

    def compound(self, kind: int) -> str:
        e = self.expr
        if kind < 10:
            tail = f"\nELSIF {e('BOOL')} THEN\n{self.block()}" if self.choices.randrange(2) else ""
            tail += f"\nELSE\n{self.block()}" if self.choices.randrange(2) else ""
            return f"IF {e('BOOL')} THEN\n{self.block()}{tail}\nEND_IF;"
        if kind == 10:
            return f"IF j[{self.index(0, 7)}] > j[i0] THEN i1 := j[i0]; j[i0] := j[i0] + 1; j[i1] := 3; END_IF;"
        if kind == 11:
            return (f"CASE {e('INT')} OF\n0: {self.simple()}\n1, 2, 5..9: {self.simple()}\n100..32000: {self.simple()}"
                    f"\nELSE\n{self.simple()}\nEND_CASE;")  # fmt: skip
        if kind < 15:
            return self.for_loop()
        loop = self.choices.randrange(2)
        step = "i2 := i2 + 1;"
        if loop:
            return f"i2 := 0;\nWHILE i2 < {self.choices.randint(0, 9)} AND {e('BOOL')} DO\n{step}\n{self.block()}\nEND_WHILE;"
        return f"i2 := 0;\nREPEAT\n{step}\n{self.block()}\nUNTIL i2 > 5 OR {e('BOOL')} END_REPEAT;"

    def for_loop(self) -> str:
        variable, type = self.choices.choice((("i0", "INT"), ("i1", "INT"), ("v_sint0", "SINT"), ("v_udint1", "UDINT"),
                                              ("v_ulint0", "ULINT"), ("v_lint1", "LINT"), ("v_usint0", "USINT")))  # fmt: skip
        low, high = self.choices.choice(((0, 7), (1, 3), (0, 2), (120, 127), (5, 5), (7, 0)))
        start = self.choices.choice(
            (str(low), f"{low}", self.expr(type) if self.choices.randrange(3) == 0 else str(low))
        )
        by = self.choices.choice(("", "", "", " BY 2", " BY 3"))
        if type in SIGNED and self.choices.randrange(3) == 0:
            start, high, by = str(high), low, self.choices.choice((" BY -1", " BY -2", f" BY {self.literal(type)}"))
        end = self.choices.choice(
            (str(high), str(high), self.expr(type) if self.choices.randrange(4) == 0 else str(high))
        )
        if type == "INT":
            self.loops.append(variable)
        inside = self.block()
        if self.choices.randrange(4) == 0:
            inside += f"\nIF {self.expr('BOOL')} THEN EXIT; END_IF;"
        if type == "INT":
            self.loops.pop()
        return f"FOR {variable} := {start} TO {end}{by} DO\n{inside}\nEND_FOR;"


def program_text(choices: Random) -> str:
    """A whole project in one file."""
    body = ProgramText(choices).statements(choices.randint(1, 7))
    scalars = "".join(f"v_{type.lower()}{n} : {type};\n" for type in SCALARS for n in range(2))
    variables = (
        f"{VARIABLES}{scalars}s5 : STRING[5] := 'xyz'; s12 : STRING[12] := 'abcabc'; s80, t80 : STRING[80];\nEND_VAR\n"
    )
    return f"{DECLARATIONS}{CALLEES}PROGRAM Main\n{variables}{body}\nEND_PROGRAM\n"
