"""What an expression is worth in the scope of a frame, or of the whole program."""

from scanbench.check.typed.condition import BadCondition
from scanbench.check.typed.local import Local
from scanbench.debug.scene import NoFrame, Scene, at
from scanbench.debug.scopes import named
from scanbench.debug.shown import VariableInfo
from scanbench.debug.variables import info
from scanbench.engines.interpreter.evaluate import NoValue
from scanbench.program.types import Elementary, StringType


def evaluate(scene: Scene, index: int | None, text: str) -> VariableInfo | BadCondition:
    """The variable that the text names, else the value of the expression, which changes nothing."""
    try:
        frame = scene.frame(index)
        local = scene.locals.value(at(frame)[0], text)
        if isinstance(local, BadCondition):
            return local
        place = named(scene, frame, text)
        if not isinstance(place, BadCondition):
            return info(scene, place, name=text.strip())
        return _computed(scene, local, at(frame)[1])
    except (NoFrame, NoValue) as error:
        return BadCondition(str(error))


def _computed(scene: Scene, local: Local, instance: int) -> VariableInfo:
    if isinstance(local.type, Elementary | StringType):
        value = scene.evaluator.text(local, instance)
    else:
        value = local.type.name
    return VariableInfo(local.text.strip(), "", value, local.type.name, "", writable=False)
