"""Writes what was found of names without a declaration as the text of a library."""

from collections.abc import Iterable, Iterator

from scanbench.check.placeholders.shapes import ORDER, Member, Shape, Signature, Unknown, elementary, variables
from scanbench.check.placeholders.world import World
from scanbench.syntax import tree
from scanbench.syntax.parse_st import parse_st
from scanbench.syntax.source import Source

NOTHING = "DWORD"
"""The type of what nothing is known of: it only goes from one of these names to another."""
SHORTER = {"LREAL": "REAL", "STRING[255]": "STRING[254]"}
"""What the TIA Portal has in their place."""
ASSUMED = 10
"""Of a constant that is the bound of an array, say."""
REFERENCE = "REFERENCE TO "
KINDS = {**dict.fromkeys(ORDER, "number"), "BOOL": "bool", "TIME": "time", "LTIME": "time", "": "other"}
_IN_ORDER = ("VAR_INPUT", "VAR_OUTPUT", "VAR_IN_OUT")


class Writer:
    """The declarations, as text."""

    def __init__(self, world: World) -> None:
        self.world = world
        self.made: list[str] = []
        self.names: dict[int, str] = {}
        """Structures that had to get a name, by the identity of their shapes."""
        self.taken = {*world.types, *world.unknown, *world.functions, *world.globals, *world.unknown_globals}

    def text(self) -> str:
        """All of them."""
        for unknown in list(self.world.unknown.values()):
            self.made.append("\n".join(self._unknown(unknown)))
        for name, signature in self.world.unknown_functions.values():
            self.made.append("\n".join(self._function(name, signature)))
        for word, fixed in (("VAR_GLOBAL", False), ("VAR_GLOBAL CONSTANT", True)):
            kept = [each for key, each in self.world.unknown_globals.items() if (key in self.world.fixed) is fixed]
            lines = [
                f"  {each.name} : {self._constant(each) if fixed else self.type(each.shape, each.name)};"
                for each in kept
            ]
            lines = [each for each in lines if not parse_st(Source("", f"VAR_GLOBAL {each} END_VAR"))[1]]
            self.made += ["\n".join([word, *lines, "END_VAR"])] if lines else []
        # a tag or a member may be called like a keyword of the standard
        return "\n\n".join(each for each in self.made if not parse_st(Source("", each))[1])

    def _constant(self, each: Member) -> str:
        """What has to be a number before anything runs: one that the user sees and corrects."""
        number = self.world.counted.get(each.name.upper(), ASSUMED)
        return f"{self.type(each.shape, each.name) if each.shape.known is not None else 'DINT'} := {number}"

    # ---- types ------------------------------------------------------------------------------------------

    def type(self, shape: Shape, name: str) -> str:
        """The type of a value, which may get a name that has this one in it."""
        known = shape.known
        spelled = None if known is None else self.spelled(known)
        if spelled is not None:
            return spelled
        root = shape.root
        if root.members or root.calls is not None:
            return self.names.get(id(root)) or self._structure(root, name)
        if root.element is not None:
            bounds = ", ".join([f"0..{root.top}"] * max(1, root.dimensions))
            return f"ARRAY[{bounds}] OF {self.type(root.element, name)}"
        literal = shape.literal or NOTHING
        return literal if self.world.only is None else SHORTER.get(literal, literal)

    def spelled(self, spec: tree.TypeSpec) -> str | None:
        """A type as it is written; None of one that has no name."""
        match spec:
            case tree.NamedType(name=name, values=()):
                return self.world.bare(name)
            case tree.StringSpec(length=length, wide=wide):
                size = "255" if length is None else _number(length)
                return None if size is None else f"{'W' * wide}STRING[{size}]"
            case tree.ReferenceSpec(target=target, pointer=pointer, automatic=automatic):
                inner = self.spelled(target)
                word = "POINTER TO " if pointer else REFERENCE if automatic else "REF_TO "
                return None if inner is None else word + inner
            case tree.ArraySpec(ranges=ranges, element=element):
                inner = self.spelled(element)
                bounds = [(_number(low), _number(high)) for low, high in ranges]
                if inner is None or any(None in pair for pair in bounds):
                    return None
                return f"ARRAY[{', '.join(f'{low}..{high}' for low, high in bounds)}] OF {inner}"
            case _:
                return None

    def _structure(self, root: Shape, name: str) -> str:
        made = f"{name}_Placeholder"
        while made.upper() in self.taken:
            made += "_"
        self.taken.add(made.upper())
        self.names[id(root)] = made
        called: dict[str, tuple[str, Signature | None]] = {
            key: (each.name, each.shape.root.calls) for key, each in root.members.items()
        }
        methods = {key: (name, calls) for key, (name, calls) in called.items() if calls is not None}
        block = root.calls is not None or bool(methods)
        members = {key: each for key, each in root.members.items() if key not in methods}
        self.made.append("\n".join(self._unknown(Unknown(made, members=members, methods=methods, block=block))))
        return made

    # ---- declarations -----------------------------------------------------------------------------------

    def _unknown(self, unknown: Unknown) -> Iterator[str]:
        if unknown.interface:
            yield f"INTERFACE {unknown.name}"
            for name, signature in unknown.methods.values():
                yield from self._method(name, signature, body=False)
            for member in unknown.members.values():
                yield from self._property(unknown, member, body=False)
            yield "END_INTERFACE"
        elif unknown.block or unknown.methods or unknown.arguments or self._is_block(unknown):
            yield from self._block(unknown)
        elif unknown.values:
            yield f"TYPE\n  {{attribute 'qualified_only'}}\n  {unknown.name} : ({', '.join(unknown.values.values())});\nEND_TYPE"
        elif not unknown.members and self._is_alias(unknown):
            yield f"TYPE {unknown.name} : {self.type(unknown.shape, unknown.name)}; END_TYPE"
        else:
            yield f"TYPE {unknown.name} : STRUCT"
            yield from (f"  {line}" for line in self._members(unknown, unknown.members.values()))
            yield "END_STRUCT; END_TYPE" if unknown.members else "  Stub_Nothing : BYTE;\nEND_STRUCT; END_TYPE"

    def _is_alias(self, unknown: Unknown) -> bool:
        """Whether it is no more than a name of another type, which is not a name of this one in its turn."""
        seen: set[int] = set()
        one: object = unknown
        while isinstance(one, Unknown) and one.shape.known is not None:
            if id(one) in seen:
                return False
            seen.add(id(one))
            one = self.world.resolved(one.shape.known)
        return unknown.shape.known is not None or unknown.shape.literal is not None

    def _is_block(self, unknown: Unknown) -> bool:
        """By its name, or as an interface is given one."""
        interfaces = (self.world.unknown.get(name) for name in unknown.gives)
        named = unknown.name.upper().startswith("FB_") and not unknown.values
        return named or any(each is not None and each.interface for each in interfaces)

    def _members(self, owner: Unknown, members: Iterable[Member]) -> Iterator[str]:
        for each in members:
            yield f"{each.name} : {REFERENCE * self._returns(each, owner)}{self.type(each.shape, f'{owner.name}_{each.name}')};"

    def _returns(self, each: Member, owner: Unknown | None) -> bool:
        """Whether a variable leads back to what it is in, and so is not in it but elsewhere."""
        direct = owner is not None and self.world.only is None and not isinstance(each.shape.known, tree.ReferenceSpec)
        return direct and owner is not None and self._holds(each.shape.known, owner, set())

    def _holds(self, spec: tree.TypeSpec | None, wanted: Unknown, seen: set[int]) -> bool:
        found = self.world.resolved(spec)
        if found is wanted:
            return True
        if found is None or id(found) in seen:
            return False
        seen.add(id(found))
        inner: list[tree.TypeSpec | None] = []
        match found:
            case Unknown():
                inner = [each.shape.known for each in found.members.values()]
            case tree.StructSpec(members=members):
                inner = [each.type for each in members]
            case tree.ArraySpec(element=element):
                inner = [element]
            case tree.PouDeclaration(kind="function_block", extends=extends, sections=sections):
                kept = (each for section in sections if section.keyword != "VAR_IN_OUT" for each in section.variables)
                inner = [*extends, *(each.type for each in kept)]
        return any(self._holds(each, wanted, seen) for each in inner)

    def _block(self, unknown: Unknown) -> Iterator[str]:
        interfaces = [it for name in unknown.gives if (it := self.world.unknown.get(name)) is not None and it.interface]
        properties = {key: (each, it) for each in interfaces for key, it in each.members.items()}
        methods = dict(unknown.methods)
        for interface in interfaces:
            methods |= {key: method for key, method in interface.methods.items() if key not in methods}
        names = ", ".join(each.name for each in interfaces)
        yield f"FUNCTION_BLOCK {unknown.name}{f' IMPLEMENTS {names}' if names else ''}"
        yield "{stub}"
        members = [each for key, each in unknown.members.items() if key not in properties]
        others = [each for each in members if each.output or not (each.written or (each.open and self._copied(each)))]
        results = [
            f"Stub_{it.name} : {self.type(it.shape, f'{each.name}_{it.name}')};" for each, it in properties.values()
        ]
        results += [
            f"Stub_{name} : {self._result(name, signature).removeprefix(REFERENCE)};"
            for name, signature in methods.values()
            if self._has_result(signature)
        ]
        yield from self._inputs([each for each in members if each not in others], unknown.name, "VAR_INPUT")
        if others or results:
            yield "VAR_OUTPUT"
            yield from (f"  {line}" for line in (*self._members(unknown, others), *results))
            yield "END_VAR"
        if unknown.arguments:
            yield "METHOD PUBLIC FB_init : BOOL"
            flags = "VAR_INPUT bInitRetains, bInCopyCode : BOOL;"
            yield from self._inputs(list(unknown.arguments.values()), unknown.name, flags)
            yield "END_METHOD"
        for name, signature in methods.values():
            yield from self._method(name, signature, body=True)
        for interface, member in properties.values():
            yield from self._property(interface, member, body=True)
        yield "END_FUNCTION_BLOCK"

    def _inputs(self, members: list[Member], owner: str, head: str) -> Iterator[str]:
        types = [(each.name, self._input(each, owner)) for each in members]
        in_outs = [each for each in types if self.world.only is not None and each[1].startswith(REFERENCE)]
        for section, kept in ((head, [each for each in types if each not in in_outs]), ("VAR_IN_OUT", in_outs)):
            if kept:
                yield section
                yield from (f"  {name} : {type.removeprefix(REFERENCE) if in_outs else type};" for name, type in kept)
                yield "END_VAR"

    def _property(self, owner: Unknown, member: Member, body: bool) -> Iterator[str]:
        """One of an interface: with parts that are written it is a reference, else both are there."""
        type = self.type(member.shape, f"{owner.name}_{member.name}")
        by_reference = self._has_parts(member.shape)
        yield f"PROPERTY {'PUBLIC ' if body else ''}{member.name} : {REFERENCE * by_reference}{type}"
        bind = "REF=" if by_reference else ":="
        yield f"GET\n{member.name} {bind} Stub_{member.name};\nEND_GET" if body else "GET\nEND_GET"
        if not by_reference:
            yield f"SET\nStub_{member.name} := {member.name};\nEND_SET" if body else "SET\nEND_SET"
        yield "END_PROPERTY"

    def _has_parts(self, shape: Shape) -> bool:
        found = self.world.resolved(shape.known)
        if isinstance(found, Unknown):
            return not (found.interface or found.values) and bool(found.members or found.methods or found.block)
        block = isinstance(found, tree.PouDeclaration) and found.kind == "function_block"
        return block or isinstance(found, tree.StructSpec) or bool(shape.known is None and shape.root.members)

    def _input(self, each: Member, owner: str, call: bool = False) -> str:
        """Instances are not copied: an input is a reference to one."""
        kinds = {KINDS.get(elementary(spec), "other") for spec in each.shape.root.specs} | {
            "text" for spec in each.shape.root.specs if isinstance(spec, tree.StringSpec)
        }
        if call and len(kinds - {"other"}) > 1:
            return "ANY"
        type = self.type(each.shape, f"{owner}_{each.name}")
        elsewhere = not self._copied(each) or self._returns(each, self.world.unknown.get(owner.upper()))
        return REFERENCE + type if elsewhere else type

    def _copied(self, each: Member) -> bool:
        found = self.world.resolved(each.shape.known)
        root = each.shape.root
        if each.shape.known is None and (
            root.calls is not None or any(it.shape.root.calls for it in root.members.values())
        ):
            return False
        block = isinstance(found, tree.PouDeclaration) and found.kind == "function_block"
        block = block or (isinstance(found, Unknown) and (found.block or bool(found.methods)) and not found.interface)
        return not block

    def _has_result(self, signature: Signature) -> bool:
        return signature.declared.result is not None if signature.declared is not None else signature.read

    def _result(self, name: str, signature: Signature) -> str:
        if signature.declared is not None and signature.declared.result is not None:
            return self.spelled(signature.declared.result) or NOTHING
        root = signature.result.root
        called = signature.result.known is None and any(each.shape.root.calls for each in root.members.values())
        return f"{REFERENCE * called}{self.type(signature.result, name)}"

    def _method(self, name: str, signature: Signature, body: bool) -> Iterator[str]:
        head = f"METHOD {'PUBLIC ' if body else ''}{name}"
        result = self._has_result(signature)
        yield f"{head} : {self._result(name, signature)}" if result else head
        yield from self._parameters(name, signature)
        if body and result:
            bind = "REF=" if self._result(name, signature).startswith(REFERENCE) else ":="
            yield f"{name} {bind} Stub_{name};"
        yield "END_METHOD"

    def _parameters(self, name: str, signature: Signature) -> Iterator[str]:
        if signature.declared is not None:
            for section, variable in variables(signature.declared):
                if section.keyword in _IN_ORDER:
                    yield f"{section.keyword} {variable.name} : {self.spelled(variable.type) or NOTHING}; END_VAR"
            return
        for each in signature.inputs.values():
            type = self._input(each, name, call=True)
            in_out = self.world.only is not None and type.startswith(REFERENCE)
            yield f"{'VAR_IN_OUT' if in_out else 'VAR_INPUT'} {each.name} : {type.removeprefix(REFERENCE) if in_out else type}; END_VAR"
        for each in signature.outputs.values():
            yield f"VAR_OUTPUT {each.name} : {self.type(each.shape, f'{name}_{each.name}')}; END_VAR"

    def _function(self, name: str, signature: Signature) -> Iterator[str]:
        if not signature.read:
            yield f"FUNCTION {name}\n{{stub}}"
            yield from self._parameters(name, signature)
            yield "END_FUNCTION"
            return
        type = self._result(name, signature)
        yield f"VAR_GLOBAL Stub_{name} : {type}; END_VAR"
        yield f"FUNCTION {name} : {type}\n{{stub}}"
        yield from self._parameters(name, signature)
        yield f"{name} := Stub_{name};\nEND_FUNCTION"


def _number(expression: tree.Expression) -> str | None:
    """A bound as it is written, where it is a number or a constant."""
    match expression:
        case tree.Literal(kind="int", value=int(value)):
            return str(value)
        case tree.Name(name=name):
            return name
        case tree.MemberOf(owner=owner, name=name):
            first = _number(owner)
            return None if first is None else f"{first}.{name}"
        case tree.UnaryOp(op="neg", operand=tree.Literal(kind="int", value=int(value))):
            return f"-{value}"
        case _:
            return None
