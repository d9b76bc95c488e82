"""Calls -> checked calls: arguments to formals, standard functions to intrinsics."""

from scanbench.check import conversions, fold
from scanbench.check.context import did_you_mean
from scanbench.check.expressions import ExpressionChecker
from scanbench.check.program import (
    Base,
    Binary,
    CallBlock,
    CallFunction,
    Compare,
    Const,
    Convert,
    Expr,
    Intrinsic,
    Load,
    Place,
    Pou,
    Unary,
)
from scanbench.check.scopes import decode
from scanbench.check.standard.functions import FUNCTIONS, SPECIAL, Operator, Same, Shift, StringFunction
from scanbench.check.types import (
    BOOL,
    DINT,
    INT,
    LINT,
    MAX_STRING,
    TIME,
    ULINT,
    Elementary,
    Kind,
    Member,
    Record,
    Section,
    StringType,
    Type,
)
from scanbench.check.untyped import ANY_REAL, common, is_untyped, settle
from scanbench.problems import Span
from scanbench.syntax import tree


class CallChecker(ExpressionChecker):
    # ---- functions --------------------------------------------------------------------------------------

    def call(self, node: tree.Call, wanted: Type | None = None) -> Expr:
        if not isinstance(node.callee, tree.Name):
            raise self.report.reject(
                "T010", "Only functions and instances of function blocks can be called.", node.span
            )
        name = node.callee.name
        key = name.upper()
        found = self.scope.find(name)
        if found is not None and isinstance(found[0].type, Record):
            raise self.report.reject(
                "T010", f"`{name}` is an instance of {found[0].type}; call it as a statement, then use its outputs.",
                node.span,
            )  # fmt: skip
        if key in self.pous.functions:
            return self._function(node, self.pous.functions[key])
        if key in FUNCTIONS or key in SPECIAL:
            return self._standard(node, key, wanted)
        conversion = conversions.parse_name(key)
        if conversion is not None:
            return self._convert(node, key, *conversion)
        known = [*(pou.name for pou in self.pous.functions.values()), *FUNCTIONS, *SPECIAL]
        hint = did_you_mean(name, known)
        if key in self.declarations.block_trees:
            hint = f" `{name}` is a FUNCTION_BLOCK: declare an instance in VAR and call that."
        raise self.report.reject("T001", f"There is no function `{name}`.{hint}", node.span)

    def _function(self, node: tree.Call, callee: Pou) -> Expr:
        """A FUNCTION of the user or of the library: positional or formal arguments, never both."""
        given = self._given(node, [callee.frame.members[key] for key in callee.parameters], callee.name)
        args = tuple(self._argument(callee.frame.members[key], given.get(key), node) for key in callee.parameters)
        self.pous.use(self.pou, callee)
        return CallFunction(callee, callee.result, args)

    def _given(self, node: tree.Call, formals: list[Member], callee: str) -> dict[str, tree.Argument]:
        """Arguments by upper-case formal name; positional ones go to inputs and in-outs in order."""
        given: dict[str, tree.Argument] = {}
        named = False
        positions = [member for member in formals if member.section in (Section.INPUT, Section.IN_OUT)]
        for index, argument in enumerate(node.arguments):
            if argument.name is None:
                if named:
                    raise self.report.reject("T004", "Arguments by position come before those by name.", argument.span)
                if index >= len(positions):
                    raise self.report.reject(
                        "T004",
                        f"`{callee}` takes {len(positions)} arguments, not {len(node.arguments)}.",
                        argument.span,
                    )
                given[positions[index].name.upper()] = argument
                continue
            named = True
            key = argument.name.upper()
            member = next((each for each in formals if each.name.upper() == key), None)
            if member is None:
                hint = did_you_mean(argument.name, [each.name for each in formals])
                raise self.report.reject("T004", f"`{callee}` has no argument `{argument.name}`.{hint}", argument.span)
            if argument.output != (member.section is Section.OUTPUT):
                arrow = "=>" if member.section is Section.OUTPUT else ":="
                raise self.report.reject(
                    "T004",
                    f"`{member.name}` is {member.section.value}: write `{member.name} {arrow} ...`.",
                    argument.span,
                )
            if key in given:
                raise self.report.reject("T004", f"`{argument.name}` is given twice.", argument.span)
            given[key] = argument
        return given

    def _argument(self, member: Member, argument: tree.Argument | None, node: tree.Call) -> Expr | Place | None:
        value = argument.value if argument else None
        if member.section is Section.IN_OUT:
            return self.in_out(member, value, node.span)
        if member.section is Section.OUTPUT:
            if value is None:
                return None
            target = self.target(value)
            if target.type != member.type and not _both_strings(target.type, member.type):
                raise self.report.reject(
                    "T002", f"`{member.name}` is {member.type}, so its target cannot be {target.type}.", value.span
                )
            return target
        if value is not None:
            return self.as_type(value, member.type, f"`{member.name}`")
        default = decode(member.type, member.initial or bytes(member.type.size))
        if default is None:
            raise self.report.reject("T004", f"The argument `{member.name}` is missing.", node.span)
        return default

    def in_out(self, member: Member, value: tree.Expression | None, span: Span) -> Place:
        """The variable that an in-out is bound to."""
        if value is None:
            raise self.report.reject("T005", f"The in-out `{member.name}` must be connected at every call.", span)
        if not isinstance(value, tree.Name | tree.MemberOf | tree.IndexOf | tree.DirectAddress):
            raise self.report.reject("T005", f"`{member.name}` is an in-out and needs a variable.", value.span)
        place = self.target(value)
        if place.type != member.type:
            raise self.report.reject(
                "T005", f"The in-out `{member.name}` is {member.type}; {place.type} cannot be bound to it.", value.span
            )
        return place

    # ---- blocks -----------------------------------------------------------------------------------------

    def call_block(self, node: tree.Call) -> CallBlock:
        """`instance(...)` as a statement."""
        instance, member = self.place(node.callee)
        record = instance.type
        assert isinstance(record, Record)
        callee = self.pous.blocks.get(record.name.upper())
        if record.kind is not Kind.BLOCK or callee is None:
            raise self.report.reject("T010", f"{record.name} is a structure and cannot be called.", node.span)
        if member is not None and member.constant:
            raise self.report.reject("T003", f"`{member.name}` is CONSTANT, so it cannot run.", node.span)
        formals = list(record.members.values())
        given = self._given(node, [each for each in formals if each.section is not Section.VAR], record.name)
        in_outs = []
        for each in formals:
            if each.section is Section.IN_OUT:
                argument = given.get(each.name.upper())
                target = self.in_out(each, argument.value if argument else None, node.span)
                in_outs.append((_slot(record, each), target))
        inputs, outputs = [], []
        for key, argument in given.items():
            formal = record.members[key]
            if argument.value is None or formal.section is Section.IN_OUT:
                continue
            own = own_place(record, formal)
            if formal.section is Section.INPUT:
                inputs.append((own, self.as_type(argument.value, formal.type, f"`{formal.name}`")))
                continue
            target = self.target(argument.value)
            value = self.coerce(Load(own), target.type, argument.span, "The target")
            outputs.append((value, target))
        self.pous.use(self.pou, callee)
        return CallBlock(instance, callee, tuple(inputs), tuple(in_outs), tuple(outputs), node.span)

    # ---- standard functions -----------------------------------------------------------------------------

    def _values(self, node: tree.Call, formals: tuple[str, ...], name: str, variadic: bool = False) -> list[Expr]:
        """Arguments of a standard function in the order of its formals."""
        by_name = {argument.name.upper(): argument.value for argument in node.arguments if argument.name}
        if by_name:
            missing = [formal for formal in formals if by_name.get(formal) is None]
            extra = [key for key in by_name if key not in formals]
            if missing or extra or len(by_name) != len(node.arguments):
                raise self.report.reject("T004", f"`{name}` takes {', '.join(formals)}.", node.span)
            return [self.expr(value) for formal in formals if (value := by_name[formal]) is not None]
        values = [self.expr(argument.value) for argument in node.arguments if argument.value is not None]
        if len(values) != len(formals) and not (variadic and len(values) > len(formals)):
            raise self.report.reject(
                "T004", f"`{name}` takes {len(formals)} arguments ({', '.join(formals)}), not {len(values)}.", node.span
            )
        return values

    def _standard(self, node: tree.Call, name: str, wanted: Type | None) -> Expr:
        if name in SPECIAL:
            return self._special(node, name, wanted)
        match FUNCTIONS[name]:
            case Same() as same:
                return self._same_function(node, name, same, wanted)
            case Shift(intrinsic):
                bits, count = self._values(node, ("IN", "N"), name)
                bits = settle(bits)
                if not isinstance(bits.type, Elementary) or bits.type.kind is not Kind.BITS:
                    raise self.report.reject("T002", f"`{name}` needs a bit string, not {bits.type}.", node.span)
                return Intrinsic(intrinsic, bits.type, (bits, self._integer(count, node.span, name)))
            case StringFunction() as function:
                return self._string_function(node, name, function)
            case Operator(op, variadic):
                values = self._values(node, ("IN1", "IN2"), name, variadic)
                result = values[0]
                for value in values[1:]:
                    result = self.operate(op, result, value, node.span)
                return result

    def _same_function(self, node: tree.Call, name: str, same: Same, wanted: Type | None) -> Expr:
        values = self._unify(self._values(node, same.formals, name, same.variadic), node.span, name, wanted)
        type = values[0].type
        if not isinstance(type, Elementary) or type.kind not in same.kinds:
            raise self.report.reject(
                "T002", f"`{name}` cannot work on {type}.{_real_hint(type, same.kinds)}", node.span
            )
        if len(same.formals) == 1:
            return Intrinsic(same.intrinsic, type, (values[0],))
        result = values[0]
        for value in values[1:]:
            result = Intrinsic(same.intrinsic, type, (result, value))
        return result

    def _unify(self, values: list[Expr], span: Span, name: str, wanted: Type | None = None) -> list[Expr]:
        """All in one common type; literals alone take the one that is wanted."""
        if isinstance(wanted, Elementary) and all(is_untyped(value) for value in values):
            real = any(value.type == ANY_REAL for value in values)
            if wanted.kind is Kind.REAL or (not real and wanted.kind in (Kind.INT, Kind.UINT, Kind.BITS)):
                return [self.coerce(value, wanted, span, f"Each argument of `{name}`") for value in values]
        typed = [value for value in values if not is_untyped(value)] or [settle(value) for value in values]
        type = typed[0].type
        for value in typed[1:]:
            if isinstance(type, Elementary) and isinstance(value.type, Elementary):
                type = common(type, value.type)
            if type is None:
                raise self.report.reject("T002", f"The arguments of `{name}` have no common type.", span)
        assert type is not None
        return [self.coerce(value, type, span, f"Each argument of `{name}`") for value in values]

    def _integer(self, value: Expr, span: Span, name: str) -> Expr:
        value = settle(value)
        if not isinstance(value.type, Elementary) or value.type.kind not in (Kind.INT, Kind.UINT):
            raise self.report.reject("T002", f"`{name}` needs an integer here, not {value.type}.", span)
        return fold.convert(LINT, value)

    def _string_function(self, node: tree.Call, name: str, function: StringFunction) -> Expr:
        formals = tuple(formal for formal, _ in function.formals)
        values = self._values(node, formals, name, variadic=name == "CONCAT")
        args: list[Expr] = []
        kinds = [kind for _, kind in function.formals] + ["s"] * (len(values) - len(formals))
        for value, kind in zip(values, kinds, strict=True):
            if kind == "n":
                args.append(self._integer(value, node.span, name))
            elif isinstance(value.type, StringType):
                args.append(value)
            else:
                raise self.report.reject("T002", f"`{name}` needs a STRING, not {settle(value).type}.", node.span)
        if function.result == "INT":
            return Intrinsic(function.intrinsic, INT, tuple(args))
        if name == "CONCAT":
            result = args[0]
            for arg in args[1:]:
                result = Intrinsic("CONCAT", _capacity(result, arg), (result, arg))
            return result
        strings = [arg for arg in args if isinstance(arg.type, StringType)]
        return Intrinsic(function.intrinsic, _capacity(*strings), tuple(args))

    def _special(self, node: tree.Call, name: str, wanted: Type | None) -> Expr:
        match name:
            case "TIME":
                self._values(node, (), name)
                return Intrinsic("CLOCK", TIME, ())
            case "MOVE":
                return self._values(node, ("IN",), name)[0]
            case "SEL":
                gate, *rest = self._values(node, ("G", "IN0", "IN1"), name)
                first, second = self._unify(rest, node.span, name, wanted)
                if not isinstance(first.type, Elementary):
                    raise self.report.reject("T002", f"`SEL` cannot choose between values of {first.type}.", node.span)
                gate = self.coerce(gate, BOOL, node.span, "`G`")
                return Intrinsic("SEL", first.type, (gate, first, second))
            case "LIMIT":
                low, value, high = self._unify(self._values(node, ("MN", "IN", "MX"), name), node.span, name, wanted)
                if not isinstance(value.type, Elementary):
                    raise self.report.reject("T002", f"`LIMIT` cannot work on {value.type}.", node.span)
                lower = Intrinsic("MAX", value.type, (value, low))
                return Intrinsic("MIN", value.type, (lower, high))
            case "MUX":
                return self._mux(node, wanted)
        return self._trunc(node)

    def _mux(self, node: tree.Call, wanted: Type | None) -> Expr:
        values = self._values(node, ("K", "IN0"), "MUX", variadic=True)
        selector = self._integer(values[0], node.span, "MUX")
        if _runs_code(selector):
            # the selector is compared once for every choice; a function would run as often
            raise self.report.reject(
                "X001", "A function call as selector of MUX is not supported yet; assign it first.", node.span
            )
        choices = self._unify(values[1:], node.span, "MUX", wanted)
        type = choices[0].type
        if not isinstance(type, Elementary):
            raise self.report.reject("T002", f"`MUX` cannot choose between values of {type}.", node.span)
        result = choices[-1]
        for index in range(len(choices) - 2, -1, -1):
            chosen = fold.compare("le", BOOL, selector, Const(LINT, index))
            result = Intrinsic("SEL", type, (chosen, result, choices[index]))
        return result

    def _trunc(self, node: tree.Call) -> Expr:
        value = settle(self._values(node, ("IN",), "TRUNC")[0])
        if not isinstance(value.type, Elementary) or value.type.kind is not Kind.REAL:
            raise self.report.reject("T002", f"`TRUNC` needs a REAL, not {value.type}.", node.span)
        return Intrinsic("TRUNC", DINT, (value,))

    def _convert(self, node: tree.Call, name: str, source: Type | None, target: Type) -> Expr:
        values = self._values(node, ("IN",), name)
        value = settle(values[0]) if source is None else self.coerce(values[0], source, node.span, f"What {name} takes")
        result = conversions.convert(value, target)
        if result is None:
            raise self.report.reject("X001", f"The conversion {name} is not supported.", node.span)
        return result


def _runs_code(expr: Expr) -> bool:
    """Whether evaluating it calls a function."""
    match expr:
        case CallFunction():
            return True
        case Unary(operand=operand) | Convert(operand=operand):
            return _runs_code(operand)
        case Binary(left=left, right=right) | Compare(left=left, right=right):
            return _runs_code(left) or _runs_code(right)
        case Intrinsic(args=args):
            return any(map(_runs_code, args))
        case Load(place=place):
            return any(_runs_code(index.value) for index in place.indices)
    return False


def own_place(record: Record, member: Member) -> Place:
    """A member of a block, seen from its own body."""
    if member.located:
        return Place(member.type, Base.IMAGE, member.offset, bit=member.bit, variable="@")
    return Place(member.type, Base.SELF, member.offset, variable=f"{record.name}.{member.name}".upper())


def _slot(record: Record, member: Member) -> Place:
    return Place(ULINT, Base.SELF, member.offset, variable=f"{record.name}.{member.name}".upper())


def _both_strings(first: Type, second: Type) -> bool:
    return isinstance(first, StringType) and isinstance(second, StringType)


def _capacity(*args: Expr) -> StringType:
    total = sum(arg.type.capacity for arg in args if isinstance(arg.type, StringType))
    return StringType(min(total, MAX_STRING))


def _real_hint(type: Type | None, kinds: tuple[Kind, ...]) -> str:
    integer = isinstance(type, Elementary) and type.kind in (Kind.INT, Kind.UINT)
    return f" Convert it with {type}_TO_REAL." if integer and kinds == (Kind.REAL,) else ""
