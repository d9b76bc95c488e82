"""Goes over the bodies of a project, and notes what each use says of names without a declaration."""

from collections.abc import Iterable

from scanbench.check.placeholders.shapes import Member, Shape, Signature, Unknown, join, named, of_type, variables
from scanbench.check.placeholders.world import CONVERSION, ENUMERATION, INSTRUCTIONS, LABELS, World, declared_in
from scanbench.program.types import ELEMENTARY
from scanbench.syntax import tree
from scanbench.syntax.lexer import GLOBAL_MARK

_FIRST = frozenset("MAX MIN ABS LIMIT SEL MUX MOVE SHL SHR ROL ROR SQRT EXPT".split())
_TEXTS = frozenset("CONCAT LEFT RIGHT MID INSERT DELETE REPLACE".split())
_COMPARED = frozenset({"eq", "ne", "lt", "gt", "le", "ge"})
_LOGIC = frozenset({"and", "or", "xor", "and_then", "or_else"})


class Body:
    """The statements of one POU or method."""

    def __init__(self, world: World, pou: tree.PouDeclaration, method: tree.PouDeclaration | None = None) -> None:
        self.world, self.pou, self.method = world, pou, method
        around = [method] if method is not None else []
        self.local: dict[str, tree.TypeSpec] = {}
        bases = [each for each in world.bases(pou) if isinstance(each, tree.PouDeclaration)]
        for each in (*reversed(bases), pou, *around):
            self.local |= declared_in(each)
            for inner in each.methods:
                if inner.kind != "method" and inner.result is not None:
                    self.local.setdefault(inner.name.upper(), inner.result)
        owner = method or pou
        if owner.result is not None:
            self.local[owner.name.upper()] = owner.result
        self.base = world.unknown_base(pou)

    # ---- statements -------------------------------------------------------------------------------------

    def statements(self, body: Iterable[tree.Statement]) -> None:
        """Each of them."""
        for each in body:
            self._statement(each)

    def _statement(self, each: tree.Statement) -> None:
        match each:
            case tree.Assignment(target=target, value=value, operator=operator, also=also):
                self._assignment([target, *also], value, operator)
            case tree.ExpressionStatement(expression=expression):
                self.of(expression, used=False)
            case tree.IfStatement(branches=branches, orelse=orelse):
                for condition, inner in branches:
                    self._condition(condition)
                    self.statements(inner)
                self.statements(orelse)
            case tree.CaseStatement(selector=selector, branches=cases, orelse=orelse):
                subject = self.of(selector)
                for labels, inner in cases:
                    for label in (one for pair in labels for one in pair if one is not None):
                        self._label(label)
                        join(subject, self.of(label))
                    self.statements(inner)
                self.statements(orelse)
            case tree.ForStatement(variable=variable, start=start, end=end, step=step, body=inner):
                counter = self.of(variable)
                self._written(variable)
                for bound in (start, end, *([] if step is None else [step])):
                    join(counter, self.of(bound))
                self.statements(inner)
            case tree.WhileStatement(condition=condition, body=inner):
                self._condition(condition)
                self.statements(inner)
            case tree.RepeatStatement(body=inner, until=condition):
                self.statements(inner)
                self._condition(condition)
            case tree.ReturnStatement(condition=condition) if condition is not None:
                self._condition(condition)
            case tree.TryStatement(body=inner, handler=handler, final=final):
                self.statements((*inner, *handler, *final))
            case _:
                pass

    def _assignment(self, targets: list[tree.Expression], value: tree.Expression, operator: str) -> None:
        given = self.of(value)
        for target in targets:
            taken = self.of(target)
            self._written(target)
            if operator == "REF=":
                self._opened(value)
            if operator == "REF=" and isinstance(spec := self.world.resolved(taken.known), tree.ReferenceSpec):
                taken = of_type(spec.target)
            self.gives(given, taken)
            join(taken, given)

    def gives(self, given: Shape, taken: Shape) -> None:
        source, goal = self.world.resolved(given.known), taken.known
        if isinstance(source, Unknown) and isinstance(goal, tree.NamedType):
            source.gives.add(self.world.bare(goal.name).upper())
            if goal.name.upper() in ELEMENTARY:
                join(source.shape, of_type(goal))
        target = self.world.resolved(goal)
        if isinstance(target, Unknown) and not isinstance(source, Unknown):
            join(target.shape, given)

    def _written(self, target: tree.Expression) -> None:
        if isinstance(target, tree.MemberOf) and not self._before(target.owner):
            found = self.world.resolved(self.of(target.owner).known)
            if isinstance(found, Unknown) and target.name.upper() in found.members:
                found.members[target.name.upper()].written = True
        self._opened(target)

    def _opened(self, target: tree.Expression) -> None:
        """It may be written, and what it is a part of with it."""
        match target:
            case tree.MemberOf(owner=owner, name=name):
                member = None if self._before(owner) else self.world.member(self.of(owner), name)
                if member is not None:
                    member.open = True
                self._opened(owner)
            case tree.IndexOf(array=owner) | tree.PartialAccess(owner=owner):
                self._opened(owner)
            case _:
                pass

    def _before(self, owner: tree.Expression) -> bool:
        """Whether it is the name of a library or a list, written before one of its own."""
        if not isinstance(owner, tree.Name) or owner.name.upper() in self.local:
            return False
        key = owner.name.upper()
        return key in self.world.prefixes or key in self.world.lists or self.world.is_list(owner.name)

    def _label(self, label: tree.Expression) -> None:
        """A label `E.Value` is a value of an enumeration, whatever that is called: a part of a variable is none.
        A name alone is a constant."""
        if self.world.only is not None and isinstance(label, tree.Name) and label.name.upper() not in self.local:
            key = label.name.removeprefix(GLOBAL_MARK).upper()
            self.world.fixed.add(key)
            self.world.counted.setdefault(key, LABELS + len(self.world.counted))
        owner = self._plain(label.owner) if isinstance(label, tree.MemberOf) else None
        if not isinstance(owner, tree.Name) or owner.name.upper() in self.local or self._before(owner):
            return
        key, world = owner.name.upper(), self.world
        if key not in world.globals and key not in world.types and not world.has_function(key):
            world.unknown.setdefault(key, Unknown(owner.name))

    def _plain(self, owner: tree.Expression) -> tree.Expression:
        """A name without that of its library, but that of a list."""
        if isinstance(owner, tree.MemberOf) and isinstance(owner.owner, tree.Name):
            key = owner.owner.name.upper()
            is_list = owner.name.upper() in self.world.lists or self.world.is_list(owner.name)
            if key in self.world.prefixes and key not in self.local and not is_list:
                return tree.Name(owner.name, owner.span)
        return owner

    def _condition(self, condition: tree.Expression) -> None:
        self.of(condition).root.literals.add("bool")

    # ---- expressions ------------------------------------------------------------------------------------

    def of(self, each: tree.Expression, used: bool = True) -> Shape:
        """What the value is; `used`: somebody takes it."""
        match each:
            case tree.Literal(kind=kind):
                return Shape(literals={kind}) if kind in ("int", "real", "string", "bool", "time") else Shape()
            case tree.Name(name=name):
                return self._name(name, each)
            case tree.TypedName(type_name=type_name, name=name):
                found = self.world.resolved(named(type_name, each))
                if isinstance(found, Unknown):
                    found.values.setdefault(name.upper(), name)
                return of_type(named(type_name, each))
            case tree.MemberOf():
                return self._member(each)
            case tree.IndexOf(array=array, indices=indices):
                owner = self.of(array)
                written = [one.value for one in indices if isinstance(one, tree.Literal) and isinstance(one.value, int)]
                owner.root.top = max(owner.root.top, *written, 0)
                return self.index(owner, [self.of(one) for one in indices])
            case tree.Dereference(reference=reference):
                if isinstance(reference, tree.Name) and reference.name.upper() in ("THIS", "SUPER"):
                    return self.of(reference)
                spec = self.world.resolved(self.of(reference).known)
                return of_type(spec.target) if isinstance(spec, tree.ReferenceSpec) else Shape()
            case tree.PartialAccess(owner=owner, size=size):
                self.of(owner).root.literals.add("int")
                return of_type(named("BOOL", each)) if size == "X" else Shape()
            case tree.UnaryOp(op=op, operand=operand):
                value = self.of(operand)
                value.root.literals |= {"bool"} if op == "not" else set()
                return value
            case tree.BinaryOp(op=op, left=left, right=right):
                if op == "assign":
                    self._written(left)
                return self._binary(op, self.of(left), self.of(right), each)
            case tree.Call():
                return self._call(each, used)
            case _:
                return Shape()

    def _binary(self, op: str, left: Shape, right: Shape, each: tree.BinaryOp) -> Shape:
        join(left, right)
        for one, other in ((left, right), (right, left)):
            found = self.world.resolved(one.known)
            if op in _COMPARED and isinstance(found, Unknown) and other.known is None and "int" in other.root.literals:
                found.interface = found.interface or not (found.values or found.members)
            if one.known is None and other.known is None:
                one.root.literals |= other.root.literals
        if op in _COMPARED:
            return of_type(named("BOOL", each))
        if op in _LOGIC and left.known is None and right.known is None:
            left.root.literals.add("bool")
            right.root.literals.add("bool")
        return left if left.known is not None else right

    def _name(self, name: str, at: tree.Expression) -> Shape:
        key = name.removeprefix(GLOBAL_MARK).upper()
        if key in self.local and not name.startswith(GLOBAL_MARK):
            return of_type(self.local[key])
        name = name.removeprefix(GLOBAL_MARK)
        if key in ("THIS", "SUPER"):
            base = self.pou.extends[0] if self.pou.extends and key == "SUPER" else named(self.pou.name, at)
            return of_type(base)
        world = self.world
        if key in world.globals:
            return of_type(world.globals[key])
        if key in world.types:  # a PROGRAM, or the name before a value
            return of_type(named(name, at))
        if key in world.values:
            return of_type(world.values[key])
        quoted = world.only is not None and key in world.only  # a tag may be called like a function
        if key in world.lists or (world.has_function(key) and not quoted) or key in world.prefixes:
            return Shape()
        if self.base is not None:
            member = self.base.member(name)
            member.open = True
            return member.shape
        if key in world.unknown:
            return of_type(named(name, at))
        return world.unknown_globals.setdefault(key, Member(name, Shape())).shape

    def _member(self, each: tree.MemberOf) -> Shape:
        world, owner = self.world, self._plain(each.owner)
        if isinstance(owner, tree.Name) and owner.name.upper() not in self.local:
            key = owner.name.upper()
            listed = self._listed(owner, each.name)
            if listed is not None:
                return of_type(listed)
            if key in world.prefixes or (key in world.lists and key not in world.globals):
                return self._name(each.name, each)
            if world.is_list(owner.name):
                return world.listed(owner.name, each.name).shape
            declared = world.types.get(key)
            if isinstance(declared, tree.TypeDeclaration):
                return of_type(named(owner.name, each))
            unknown = key not in world.globals and declared is None and not world.has_function(key)
            if unknown and (key in world.unknown or self._called_enumeration(owner.name)):
                found = world.unknown.setdefault(key, Unknown(owner.name))
                if not found.block and not found.methods:
                    found.values.setdefault(each.name.upper(), each.name)
                return of_type(named(owner.name, each))
        return world.part(self.of(owner), each.name)

    def _listed(self, owner: tree.Expression, name: str) -> tree.TypeSpec | None:
        """The type of a variable with the name of its list before it."""
        if not isinstance(owner, tree.Name) or owner.name.upper() in self.local:
            return None
        return self.world.globals.get(f"{owner.name}.{name}".upper())

    def _called_enumeration(self, name: str) -> bool:
        if self.world.only is not None:
            return False
        return name.upper() not in self.world.unknown_globals and ENUMERATION.fullmatch(name) is not None

    def index(self, array: Shape, indices: list[Shape]) -> Shape:
        for one in indices:
            one.root.literals.add("int")
        spec = self.world.resolved(array.known)
        if isinstance(spec, tree.ArraySpec | tree.OpenArraySpec):
            return of_type(spec.element)
        if isinstance(spec, tree.ReferenceSpec):
            return of_type(spec.target)
        if array.known is not None:
            return Shape()
        root = array.root
        root.element = root.element or Shape()
        root.dimensions = len(indices)
        return root.element

    # ---- calls ------------------------------------------------------------------------------------------

    def _call(self, each: tree.Call, used: bool) -> Shape:
        callee, world = each.callee, self.world
        if isinstance(callee, tree.MemberOf):
            listed = self._listed(callee.owner, callee.name)
            if listed is not None:
                return self._instance(each, of_type(listed))
            inside = isinstance(callee.owner, tree.Name) and callee.owner.name.upper() in world.prefixes
            if not (inside and callee.owner.name.upper() not in self.local):  # type: ignore[union-attr]
                return self._method(each, callee, used)
            callee = tree.Name(callee.name, callee.span)
        if not isinstance(callee, tree.Name):
            return self._instance(each, self.of(callee))
        marked = callee.name.startswith(GLOBAL_MARK)
        callee = tree.Name(callee.name.removeprefix(GLOBAL_MARK), callee.span)
        key = callee.name.upper()
        own = next((one for one in (*self.pou.methods,) if one.name.upper() == key), None)
        if key in self.local and own is None and not marked:
            return self._instance(each, self.of(callee))
        declared = own or world.functions.get(key)
        if declared is not None:
            return self._declared(each, declared)
        if world.has_function(key):
            return self._standard(each, key)
        if key in world.globals or key in world.types:
            return self._instance(each, self.of(callee))
        if self.base is not None and not key.startswith(("F_", "FC_", "FUN_")):
            self.base.block = True
            signature = self.base.method(callee.name)
        else:
            signature = world.unknown_functions.setdefault(key, (callee.name, Signature()))[1]
        return self._signature(each, signature, used)

    def _method(self, each: tree.Call, callee: tree.MemberOf, used: bool) -> Shape:
        owner = self.of(callee.owner)
        instance = INSTRUCTIONS.get(callee.name.upper())
        if self.world.only is not None and instance and owner.known is None:
            join(owner, of_type(named(instance, callee)))
        found = self.world.resolved(owner.known)
        if isinstance(found, tree.StructSpec):
            return self._instance(each, self.world.part(owner, callee.name))
        declared = self.world.method(owner, callee.name)
        if isinstance(declared, Signature):
            is_super = isinstance(callee.owner, tree.Dereference) and self.of(callee.owner.reference) is not None
            inherits = is_super and self.method is not None and self.method.name.upper() == callee.name.upper()
            declared.declared = self.method if inherits else declared.declared
            return self._signature(each, declared, used)
        if declared is not None:
            return self._declared(each, declared)
        if owner.known is None:
            member = owner.root.members.setdefault(callee.name.upper(), Member(callee.name, Shape()))
            member.shape.root.calls = member.shape.root.calls or Signature()
            return self._signature(each, member.shape.root.calls, used)
        self._values(each)
        return Shape()

    def _values(self, each: tree.Call) -> list[Shape]:
        return [self.of(one.value) for one in each.arguments if one.value is not None]

    def _signature(self, each: tree.Call, signature: Signature, used: bool) -> Shape:
        signature.read = signature.read or used
        self.arguments(each.arguments, signature.inputs, signature.outputs)
        return signature.result

    def arguments(
        self, arguments: Iterable[tree.Argument], inputs: dict[str, Member], outputs: dict[str, Member]
    ) -> None:
        for number, each in enumerate(arguments, 1):
            name = each.name or f"in{number}"
            if name.upper() in ("EN", "ENO"):
                continue
            table = outputs if each.output else inputs
            member = table.setdefault(name.upper(), Member(name, Shape()))
            member.written, member.output = not each.output, each.output
            if each.value is not None:
                given = self.of(each.value)
                if each.output:
                    self._written(each.value)
                self.gives(given, member.shape)
                join(member.shape, given)

    def _instance(self, each: tree.Call, instance: Shape) -> Shape:
        found = self.world.resolved(instance.known)
        if isinstance(found, Unknown):
            found.block = True
            self.arguments(each.arguments, found.members, found.members)
            return Shape()
        if isinstance(found, tree.PouDeclaration):
            return self._declared(each, found)
        if instance.known is None:
            instance.root.calls = instance.root.calls or Signature()
            self.arguments(each.arguments, instance.root.members, instance.root.members)
            return Shape()
        self._values(each)
        return Shape()

    def _declared(self, each: tree.Call, declared: tree.PouDeclaration) -> Shape:
        """A call of what the project or a library declares: its inputs say what they are given."""
        own = {
            variable.name.upper(): variable.type
            for section, variable in variables(declared)
            if section.keyword in ("VAR_INPUT", "VAR_OUTPUT", "VAR_IN_OUT")
        }
        references = any(section.keyword == "VAR_IN_OUT" for section in declared.sections)
        base = self.world.unknown_base(declared) if declared.kind == "function_block" else None
        for one in self.world.bases(declared):
            if isinstance(one, tree.PouDeclaration):
                own = {variable.name.upper(): variable.type for _, variable in variables(one)} | own
        in_order = list(own.values())
        for number, argument in enumerate(each.arguments):
            if argument.value is None:
                continue
            given = self.of(argument.value)
            if argument.output:
                self._written(argument.value)
            if references:
                self._opened(argument.value)
            if argument.name is None:
                spec = in_order[number] if number < len(in_order) else None
            else:
                spec = own.get(argument.name.upper())
                if spec is None and base is not None:
                    member = base.member(argument.name)
                    member.written, member.output = not argument.output, argument.output
                    join(member.shape, given)
            self.gives(given, of_type(spec))
            join(of_type(spec), given)
        return of_type(declared.result)

    def created(self, arguments: tuple[tree.Argument, ...], block: tree.PouDeclaration) -> None:
        """An instance is declared with arguments of FB_init."""
        for each in (block, *self.world.bases(block)):
            if isinstance(each, Unknown):
                self.arguments(arguments, each.arguments, each.arguments)
                return
            init = next((it for it in each.methods if it.name.upper() == "FB_INIT"), None)
            if init is not None:
                given = (variable for section, variable in variables(init) if section.keyword == "VAR_INPUT")
                own = [each for each in given if each.name.upper() not in ("BINITRETAINS", "BINCOPYCODE")]
                sections = (tree.VariableSection("VAR_INPUT", (), tuple(own), init.span),)
                call = tree.Call(tree.Name(init.name, init.span), arguments, init.span)
                self._declared(call, tree.PouDeclaration("method", init.name, None, sections, (), init.span))
                return

    def _standard(self, each: tree.Call, key: str) -> Shape:
        values = self._values(each)
        found = CONVERSION.fullmatch(key)
        if found is not None and found[2] in ELEMENTARY:
            if found[1] in ELEMENTARY and values:
                join(values[0], of_type(named(found[1], each)))
            return of_type(named(found[2], each))
        if key == "ADR":
            return of_type(named("PVOID", each))
        if key == "SEL" and values:
            values.pop(0).root.literals.add("bool")
        if key in _FIRST and values:
            for other in values[1:] if key not in ("SHL", "SHR", "ROL", "ROR", "MUX") else ():
                join(values[0], other)
            return next((one for one in values if one.known is not None), values[0])
        if key in _TEXTS or key == "LEN":
            for one in values[: 1 if key in ("LEN", "LEFT", "RIGHT", "MID", "DELETE") else 2]:
                one.root.literals.add("string")
            return Shape(literals={"int" if key == "LEN" else "string"})
        return Shape()
