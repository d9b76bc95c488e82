"""Changes the value of a variable of a frame, through the one door: by a write or, for temporaries, by its frame."""

from dataclasses import dataclass

from scanbench.check.typed.condition import BadCondition
from scanbench.check.typed.local import locals_of
from scanbench.debug.assign import Assign, in_scope, patch, refused
from scanbench.debug.scene import NoFrame, Scene, at
from scanbench.debug.scopes import named
from scanbench.engines.interpreter.evaluate import Evaluator, NoValue
from scanbench.program.program import Const
from scanbench.program.types import Subrange, Type
from scanbench.runtime.command import Command, Plan, Refusal, View
from scanbench.runtime.target import everywhere
from scanbench.runtime.write import Write
from scanbench.symbols.values import parse_value


@dataclass(frozen=True, slots=True)
class SetLocal(Command):
    """Gives a temporary, or a variable of a FUNCTION, a value. It counts while the call is open in which it is."""

    pou: str
    instance: int
    expression: str
    value: str
    """As typed."""

    def plan(self, view: View) -> Plan | Refusal:
        """One patch in the frame."""
        program = view.statements
        local = in_scope(program, self.pou, lambda pou: locals_of(program).place(pou, self.expression))
        if isinstance(local, Refusal):
            return local
        try:
            spot = Evaluator(program, bytearray(view.memory)).locate(local, self.instance)
            spot = program.layout.copies.actual(view.memory, *spot) or spot
            data = parsed_value(local.place.type, self.value, self.expression)
        except NoValue as error:
            return Refusal(str(error))
        name = f"{self.pou}.{self.expression}" if self.pou else self.expression
        said = f"{name} := {self.value.strip()}"
        refusal = refused(view, spot, local.place.type, name)
        return refusal or Plan(everywhere(view, patch(spot, data)), said)


def set_value(scene: Scene, index: int | None, target: str, value: str, author: str) -> Command | BadCondition:
    """The command that gives the variable this value, as typed or as an expression; or why there is none."""
    try:
        frame = scene.frame(index)
        pou, instance = at(frame)
        found = named(scene, frame, target)
        if isinstance(found, BadCondition):
            return found
        type = found.symbol.type
        if found.symbol.constant:
            return BadCondition(f"{target} is a CONSTANT: change it in the program and build.")
        name = "" if pou is None else pou.name
        try:
            parsed_value(type, value, target)
        except NoValue:
            computed = scene.locals.assignments(pou, f"{target} := {value}")
            if isinstance(computed, BadCondition) or isinstance(computed.assignments[0].value, Const):
                raise  # what is wrong with the value as typed says more
            scene.evaluator.assigned(computed, instance)  # to refuse at once
            return Assign(author, name, instance, f"{target} := {value}")
    except (NoFrame, NoValue) as error:
        return BadCondition(str(error))
    return Write(author, found.path, value) if found.path else SetLocal(author, name, instance, target, value)


def parsed_value(type: Type, text: str, target: str) -> bytes:
    """The bytes of a value as typed. Raises NoValue, which names target, type and what fits."""
    try:
        data = parse_value(type, text)
    except ValueError as error:
        raise NoValue(f"{target}: {error}") from None
    if isinstance(type, Subrange):
        number = int.from_bytes(data, "little", signed=type.signed)
        if not type.low <= number <= type.high:
            raise NoValue(f"{target}: {number} is outside of {type.low}..{type.high} ({type.name})")
    return data
