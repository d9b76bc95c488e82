"""The files of a directory of models, and the models they make: a model may be based on a different one."""

from collections.abc import Iterable
from difflib import get_close_matches
from functools import cached_property
from pathlib import Path
from typing import Literal, cast

from lxml import etree

from scanbench.plcmodel.catalogue import CodeForm
from scanbench.plcmodel.document import Document, read, schema_of
from scanbench.plcmodel.model import Model
from scanbench.plcmodel.read_catalogue import read_catalogue
from scanbench.plcmodel.read_facts import read_facts
from scanbench.plcmodel.read_instructions import instructions, message_instructions, queries, resets
from scanbench.plcmodel.read_memory import read_memory
from scanbench.plcmodel.read_standby import standby
from scanbench.plcmodel.read_system import (
    code_word,
    error_log,
    error_reset,
    error_time,
    fatal_behaviour,
    specials,
    status_words,
)
from scanbench.plcmodel.reading import Reader, text_of, wordings_of
from scanbench.problems import Problem, Span, perhaps

Loaded = tuple[Model | None, list[Problem]]


class Library:
    """Reads files when they are asked for, each once."""

    def __init__(self, directory: Path, more: Iterable[Path] = ()) -> None:
        self.directory = directory
        self.paths = {path.relative_to(directory).as_posix(): path for path in sorted(directory.glob("*/*.xml"))}
        for path in more:
            twins = [file for file, known in self.paths.items() if known.resolve() == path.resolve()]
            for file in twins:
                del self.paths[file]
            self.paths = {str(path): path, **self.paths}
        self._documents: dict[str, Document | list[Problem]] = {}
        self._models: dict[str, Loaded] = {}

    def load(self, file: str) -> Loaded:
        """The model of this file, or what is wrong with it."""
        if file not in self._models:
            self._models[file] = self._load(file)
        return self._models[file]

    def named(self, name: str) -> str | None:
        """The file of the model of this name. By custom the file is named so too, and then no other one is read."""
        likely = [file for file in self.paths if Path(file).stem == name]
        return next((file for file in likely if self.name_of(file) == name), self._names.get(name))

    def name_of(self, file: str) -> str:
        """The model's name; of a file that cannot be read, the file's."""
        document = self._document(file)
        return document.root.get("Name", "") if isinstance(document, Document) else Path(file).stem

    @cached_property
    def _names(self) -> dict[str, str]:
        names: dict[str, str] = {}
        for file in self.paths:
            names.setdefault(self.name_of(file), file)
        return names

    @cached_property
    def _schema(self) -> etree.XMLSchema:
        return schema_of(self.directory)

    def _document(self, file: str) -> Document | list[Problem]:
        if file not in self._documents:
            self._documents[file] = read(self.paths[file], file, self._schema)
        return self._documents[file]

    def _load(self, file: str) -> Loaded:
        document = self._document(file)
        if not isinstance(document, Document):
            return None, document
        chain = self._chain(document)
        if isinstance(chain, Problem):
            return None, [chain]
        layers = [Reader(each, None if each is document else document) for each in chain]
        if not any(reader.root.find("Memory") is not None for reader in layers):
            layers[-1].problem("M002", "a model needs Memory, or a Base that has it", document.root)
            return None, layers[-1].problems
        model = _model(layers)
        problems = [problem for reader in layers for problem in reader.problems]
        return (None if problems else model), list(dict.fromkeys(problems))

    def _chain(self, document: Document) -> list[Document] | Problem:
        """The document and all its bases, the base first."""
        chain = [document]
        while (base := chain[0].root.get("Base")) is not None:
            file = self.named(base)
            if file is None:
                near = get_close_matches(base, self._names, n=1)
                hint = f".{perhaps(near)}" if near else f": there are {', '.join(sorted(self._names))}"
                return _based(document, f"there is no model {base!r} to be based on{hint}")
            found = self._document(file)
            if not isinstance(found, Document):
                return _based(document, f"its base {base} cannot be read: {found[0]}")
            if any(found is each for each in chain):
                names = [each.root.get("Name", "") for each in reversed(chain)]
                return _based(document, f"{' is based on '.join([*names, base])}, and so on without end")
            chain.insert(0, found)
        for each in chain[:-1]:  # the remotest first: it has the cause
            if problems := self.load(each.file)[1]:
                name = each.root.get("Name", "")
                return _based(document, f"its base {name} has errors, the first is {problems[0]}")
        return chain


def _based(document: Document, message: str) -> Problem:
    return Problem("M009", message, document.span(document.root, "Base"))


def _model(layers: list[Reader]) -> Model:
    own = layers[-1].root
    form = cast(CodeForm, _last(layers, "Codes", "hex4"))
    read_memory(layers)
    places = specials(layers)
    for reader in layers:
        reader.symbols = {entry.symbol.upper(): entry.location for entry in places if entry.symbol}
        reader.code_form = form
    catalogue, elements = read_catalogue(layers)
    errors = {error.id: error for group in catalogue for error in group.walk()}
    described = next((reader.root for reader in reversed(layers) if text_of(reader.root, "Description")), own)
    return Model(
        name=own.get("Name", ""),
        vendor=own.get("Vendor", ""),
        description=text_of(described, "Description"),
        in_out=cast(Literal["reference", "value"], _last(layers, "InOut", "reference")),
        areas=tuple(layers[-1].areas),
        iec_maps=tuple(layers[-1].iec_maps),
        catalogue=catalogue,
        code_word=code_word(layers),
        status_words=status_words(layers),
        fatal=fatal_behaviour(layers),
        log=error_log(layers),
        specials=places,
        instructions=instructions(layers, errors),
        code_form=form,
        wordings=wordings_of(described),
        error_reset=error_reset(layers),
        error_time=error_time(layers),
        resets=resets(layers),
        facts=read_facts(layers, [(elements[id], error) for id, error in errors.items()]),
        queries=queries(layers),
        messages=message_instructions(layers),
        standby=standby(layers, errors),
    )


def _last(layers: list[Reader], attribute: str, default: str) -> str:
    return next((value for reader in reversed(layers) if (value := reader.root.get(attribute))), default)


def duplicate(file: str, name: str, first: str) -> Problem:
    """Two files give a model of the same name."""
    return Problem("M004", f"model {name!r} is in {first} already", Span(file, 1, 1, 1, 2))
