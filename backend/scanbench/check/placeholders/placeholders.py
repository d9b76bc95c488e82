"""The text that takes the place of libraries that a project refers to and nobody has."""

from collections.abc import Collection, Mapping

from scanbench.check.dialect_table import dialect_in
from scanbench.check.libraries.catalogue import FOLDER, PLACEHOLDERS
from scanbench.check.placeholders.look import look
from scanbench.check.placeholders.texts import Writer
from scanbench.check.placeholders.world import World
from scanbench.check.standard.library import library_of
from scanbench.syntax.language_file import defined_in
from scanbench.syntax.objects import joined
from scanbench.syntax.parse_file import is_program_file, is_stimulus, parse_file
from scanbench.syntax.parse_st import parse_st
from scanbench.syntax.source import Source

PATH = f"{FOLDER}/{PLACEHOLDERS}.st"
_QUOTED = """(* Placeholders for what these programs name, and no file of them declares: tags of the PLC or of modules, data blocks, blocks, types.
   Types, inputs, outputs and members are those that the use tells, numbers of constants are not known, and no body is.
   Add the files that declare them and delete them here, or correct them. *)"""
ROUNDS = 3
"""A use says more when the types around it are known, which may come from a use further down."""


def placeholders(
    sources: Mapping[str, str], missing: Collection[str], prefixes: Collection[str], only: frozenset[str] | None = None
) -> tuple[str, frozenset[str]] | None:
    """The text of `libraries/Placeholders.st` for these programs, which have the texts of all other libraries already;
    and further names that are written before its own. None where no name is missing. `prefixes` are such names already.
    With `only`, nothing but these names, in upper case, may be missing, and what a name is called says nothing of what it is."""
    known = defined_in(sources)
    texts = {name: text for name, text in sources.items() if is_program_file(name) and not is_stimulus(name)}
    files, _ = joined([parse_file(Source(path, text, defined=known))[0] for path, text in texts.items()])
    standard = library_of(dialect_in(sources))
    world = World(files, frozenset(each.upper() for each in prefixes), missing, only, standard)
    for _ in range(ROUNDS):
        look(world, files)
        world.settle()
    body = Writer(world).text()
    if not body:
        return None
    head = (
        _QUOTED
        if only is not None
        else (
            f"(* Placeholders for what nobody has a text of here: {', '.join(missing)}.\n"
            "   Types, inputs, outputs and members are those that the use in this project tells; numbers of enumerations are not known,\n"
            "   and no body is. Replace them by the text of the library, or correct them. *)"
        )
    )
    text = f"{head}\n\n{body}\n"
    return None if parse_st(Source(PATH, text))[1] else (text, frozenset(world.unknown_lists.values()))
