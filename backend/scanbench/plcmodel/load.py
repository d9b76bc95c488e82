"""Model files to models. Whatever is wrong with one file is told with its place; the other files still load."""

import os
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path
from typing import Literal, cast

from lxml import etree

from scanbench.plcmodel.areas import Access, AccessRange, Area, IecMap
from scanbench.plcmodel.document import Document, read
from scanbench.plcmodel.model import ErrorLog, FatalBehaviour, Model, Special, WordRange
from scanbench.plcmodel.read_catalogue import read_catalogue
from scanbench.plcmodel.reading import Reader, text_of, wordings_of
from scanbench.problems import Problem, Span

SCHEMA = "model.xsd"


class NoModels(Exception):
    """There is no directory of models to load; the message says where it was looked for."""


def model_directory() -> Path:
    """Where the models are: SCANBENCH_MODELS, or `models` beside `backend`."""
    named = os.environ.get("SCANBENCH_MODELS")
    directory = Path(named) if named else Path(__file__).resolve().parents[3] / "models"
    if not (directory / SCHEMA).is_file():
        origin = "named by SCANBENCH_MODELS" if named else "set SCANBENCH_MODELS to the directory of the model files"
        raise NoModels(f"{directory / SCHEMA} does not exist ({origin})")
    return directory


def load_all(directory: Path) -> tuple[list[Model], list[Problem]]:
    """Every model of `directory/<vendor>/<MODEL>.xml` that is right, and what is wrong with the others."""
    schema = _schema(directory)
    models: list[Model] = []
    problems: list[Problem] = []
    files: dict[str, str] = {}
    for path in sorted(directory.glob("*/*.xml")):
        file = path.relative_to(directory).as_posix()
        model, found = _load(path, file, schema)
        problems += found
        if model is None:
            continue
        if model.name in files:
            message = f"model {model.name!r} is in {files[model.name]} already"
            problems.append(Problem("M004", message, Span(file, 1, 1, 1, 2)))
            continue
        files[model.name] = file
        models.append(model)
    return models, problems


def load_file(path: Path, schema: Path) -> tuple[Model | None, list[Problem]]:
    """One model file, validated against the schema file."""
    return _load(path, path.name, _schema(schema.parent))


def _schema(directory: Path) -> etree.XMLSchema:
    parser = etree.XMLParser(resolve_entities=False, no_network=True)
    return etree.XMLSchema(etree.parse(str(directory / SCHEMA), parser))


def _load(path: Path, file: str, schema: etree.XMLSchema) -> tuple[Model | None, list[Problem]]:
    document = read(path, file, schema)
    if isinstance(document, list):
        return None, document
    reader = Reader(document)
    model = _model(reader, document)
    return (None if reader.problems else model), reader.problems


def _model(reader: Reader, document: Document) -> Model:
    root = document.root
    memory = _child(root, "Memory")
    reader.areas = areas = tuple(_areas(reader, memory))
    reader.iec_maps = maps = tuple(_iec_maps(reader, memory))
    system = root.find("System")
    return Model(
        name=root.get("Name", ""),
        vendor=root.get("Vendor", ""),
        description=text_of(root, "Description"),
        in_out=cast(Literal["reference", "value"], root.get("InOut", "reference")),
        areas=areas,
        iec_maps=maps,
        catalogue=read_catalogue(reader, root),
        code_word=None if system is None else reader.place(system, "ErrorCode", bits=16),
        status_words=() if system is None else tuple(_status_words(reader, system)),
        fatal=FatalBehaviour() if system is None else _fatal(reader, system),
        log=None if system is None else _log(reader, system),
        specials=() if system is None else tuple(_specials(reader, system)),
        wordings=wordings_of(root),
    )


def _child(node: etree._Element, tag: str) -> etree._Element:
    child = node.find(tag)
    assert child is not None, f"the schema asks for {tag}"
    return child


def _areas(reader: Reader, memory: etree._Element) -> Iterator[Area]:
    prefixes: set[str] = set()
    for node in memory.iterchildren("Area"):
        name, aliases = node.get("Name", ""), tuple(node.get("Aliases", "").split())
        for prefix in (name, *aliases):
            if prefix in prefixes:
                reader.problem("M004", f"two areas have the prefix {prefix!r}", node)
            prefixes.add(prefix)
        words = int(node.get("Words", "0"))
        yield Area(
            name=name,
            words=words,
            ranges=_ranges(reader, node, words),
            retain=node.get("Retain") == "yes",
            description=text_of(node, "Description"),
            aliases=aliases,
            bare_bits=node.get("BareBits") == "yes",
            source=node.get("Source", ""),
            verified=node.get("Verified") == "yes",
        )


def _ranges(reader: Reader, area: etree._Element, words: int) -> tuple[AccessRange, ...]:
    nodes = list(area.iterchildren("Access"))
    if not nodes:
        return (AccessRange(0, words - 1),)
    ranges = [
        AccessRange(
            first=int(node.get("First", "0")),
            last=int(node.get("Last", "0")),
            program=cast(Access, node.get("Program")),
            tool=cast(Access, node.get("Tool")),
            engine=cast(Access, node.get("Engine")),
        )
        for node in nodes
    ]
    edges = [-1, *(edge for entry in ranges for edge in (entry.first, entry.last)), words]
    gapless = all(first + 1 == second for first, second in list(pairwise(edges))[::2])
    if not gapless or any(entry.first > entry.last for entry in ranges):
        message = f"the Access ranges must cover words 0 to {words - 1} in order, without gap or overlap"
        reader.problem("M006", message, nodes[0])
    return tuple(ranges)


def _iec_maps(reader: Reader, memory: etree._Element) -> Iterator[IecMap]:
    letters: set[str] = set()
    for node in memory.iterchildren("IecMap"):
        letter, name = node.get("Letter", ""), node.get("Area", "")
        if letter in letters:
            reader.problem("M004", f"%{letter} is mapped twice", node, "Letter")
        letters.add(letter)
        area = reader.area(node, "Area", name)
        first, words = int(node.get("First", "0")), int(node.get("Words", "0"))
        if area is None:
            continue
        if first + words > area.words:
            message = f"words {first} to {first + words - 1} are outside of {name}, which has {area.words}"
            reader.problem("M003", message, node, "Words")
        yield IecMap(letter, area, first, words)


def _status_words(reader: Reader, system: etree._Element) -> Iterator[str]:
    for node in system.iterchildren("Status"):
        if reader.place(node, "Address", bits=16) is not None:
            yield node.get("Address", "")


def _fatal(reader: Reader, system: etree._Element) -> FatalBehaviour:
    node = system.find("Fatal")
    if node is None:
        return FatalBehaviour()
    outputs = []
    for child in node.iterchildren("Outputs"):
        area = reader.area(child, "Area", child.get("Area", ""))
        first, last = int(child.get("First", "0")), int(child.get("Last", "0"))
        if area is None:
            continue
        if not first <= last < area.words:
            reader.problem("M003", f"words {first} to {last} are no range of {area.name}", child, "Last")
        outputs.append(WordRange(area, first, last))
    cleared = [reader.area(node, "Clears", name) for name in node.get("Clears", "").split()]
    return FatalBehaviour(
        outputs=tuple(outputs),
        cleared=tuple(area for area in cleared if area is not None),
        hold=reader.place(node, "HoldBit", bits=1),
    )


def _log(reader: Reader, system: etree._Element) -> ErrorLog | None:
    node = system.find("ErrorLog")
    if node is None:
        return None
    first, counter = reader.place(node, "First", bits=16), reader.place(node, "Counter", bits=16)
    records, words = int(node.get("Records", "0")), int(node.get("RecordWords", "0"))
    if first is None or counter is None:
        return None
    if not (
        reader.engine_writes(node, "First", first, records * words) and reader.engine_writes(node, "Counter", counter)
    ):
        return None
    return ErrorLog(first, records, words, counter)


def _specials(reader: Reader, system: etree._Element) -> Iterator[Special]:
    names: set[str] = set()
    for node in system.iterchildren("Special"):
        name, location = node.get("Name", ""), reader.place(node, "Address")
        if name in names:
            reader.problem("M004", f"special address {name!r} is given twice", node, "Name")
        names.add(name)
        if location is not None:
            yield Special(
                name=name,
                location=location,
                text=node.get("Address", ""),
                description=text_of(node, "Description"),
                source=node.get("Source", ""),
                verified=node.get("Verified") == "yes",
            )
