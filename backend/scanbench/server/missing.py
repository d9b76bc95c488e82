"""PLCs whose model is not there any more: they stay, with the reason, and nothing of them is changed."""

from collections.abc import Sequence
from pathlib import Path

from scanbench.plcmodel.model import Model
from scanbench.problems import Problem


def stand_in(name: str) -> Model:
    """Has the name of the missing model, and no memory or errors: nobody knows which it had."""
    return Model(name, "", "", "reference", (), (), ())


def why_missing(name: str, directory: Path, problems: Sequence[Problem]) -> str:
    """What to tell people; `problems` is what is wrong with the model files that are there."""
    own = [each for each in problems if Path(each.span.file).stem == name]
    there = next(directory.glob(f"*/{name}.xml"), None)
    if there is not None and problems:  # its own mistakes, or those of a model that it is based on
        first = (own or problems)[0]
        what = f"the model {name} cannot be used: {first}. Correct the file in {directory}"
    else:
        what = f"the model {name} is missing: no file in {directory} describes it. Put the file back"
    return f"{what} and start the server again, or delete the PLC. Its run and its history are kept until then"
