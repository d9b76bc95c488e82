"""A project's own errors: `errors.xml`, in the format of a model's catalogue, on the model of the project.

The model has them like the device's own, in one group, marked `user`. They change neither the memory nor the layout of programs
in it: a program on the extended model is the same program.
"""

import posixpath
import threading
from collections import OrderedDict
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from functools import cache

from lxml import etree

from scanbench.plcmodel.catalogue import ErrorEntry, ErrorGroup, Wording
from scanbench.plcmodel.document import Document, first_of, parse, schema_of
from scanbench.plcmodel.hardware import HARDWARE_FILE
from scanbench.plcmodel.load import model_directory
from scanbench.plcmodel.model import Model
from scanbench.plcmodel.overlaps import Stretch, stretch, stretches
from scanbench.plcmodel.read_catalogue import read_catalogue
from scanbench.plcmodel.read_hardware import is_hardware, read_hardware
from scanbench.plcmodel.reading import Reader
from scanbench.plcmodel.system_words import addresses_of, taken, who_has
from scanbench.problems import Problem, Span

USER_ERRORS = "errors.xml"
"""The name of the file, at the top of a project."""
CATALOGUE_FILES = (USER_ERRORS, HARDWARE_FILE)
"""Files of a project that say something about errors, and are no part of the program."""
ROOT = "UserErrors"
GROUP = "User-defined"
_WORDINGS = (Wording("ja", "ユーザー定義", ""),)
_REMEMBERED = 32

Extended = tuple[Model | None, list[Problem]]


def is_of_catalogue(path: str) -> bool:
    """Whether a file of this path says something about errors, and is no part of the program."""
    return is_user_errors(path) or is_hardware(path)


def is_user_errors(path: str) -> bool:
    """Whether a file of this path has the errors of its project."""
    return posixpath.basename(path.replace("\\", "/")) == USER_ERRORS


def model_for(model: Model, files: Mapping[str, str]) -> Model:
    """The model with the errors that these files of a project define, and what they say is fitted; the device alone where they
    are broken."""
    return extended(model, files)[0]


def extended(model: Model, files: Mapping[str, str]) -> tuple[Model, list[Problem]]:
    """The same, and what is wrong with them."""
    names = [name for name in files if is_user_errors(name)]
    made: Extended = with_user_errors(model, files[names[0]], names[0]) if names else (device_of(model), [])
    problems = [*made[1]]
    for name in names[1:]:
        message = f"a program has one {USER_ERRORS}, and {names[0]} is it already: put all errors in there"
        problems.append(Problem("M004", message, Span(name, 1, 1, 1, 2)))
    complete, wrong = _with_hardware(made[0] or model, files)
    return complete, [*problems, *wrong]


def _with_hardware(model: Model, files: Mapping[str, str]) -> tuple[Model, list[Problem]]:
    """The model with what these files say is fitted."""
    names = [name for name in files if is_hardware(name)]
    if not names:
        return model, []
    key = (names[0], files[names[0]])
    with _lock:
        known, made = _fitted.get(key, (None, None))
    if made is None or known is not model:
        fitted, problems = read_hardware(model, key[1], key[0])
        made = (model if fitted is None else replace(model, fitted=fitted)), problems
    with _lock:
        _fitted[key] = model, made
        _fitted.move_to_end(key)
        while len(_fitted) > _REMEMBERED:
            _fitted.popitem(last=False)
    message = f"a program has one {HARDWARE_FILE}, and {names[0]} is it already: put all hardware in there"
    return made[0], [*made[1], *(Problem("M004", message, Span(name, 1, 1, 1, 2)) for name in names[1:])]


def with_user_errors(model: Model, text: str, file: str = USER_ERRORS) -> Extended:
    """The model with the errors of this text, or everything that is wrong with it. Thread-safe."""
    key = (file, text)
    with _lock:
        known, made = _known.get(key, (None, None))
    if made is None or not (known is model or known == model):
        made = _extend(model, text, file)  # it may take a while: those who know theirs do not wait for it
    with _lock:
        _known[key] = model, made
        _known.move_to_end(key)
        while len(_known) > _REMEMBERED:
            _known.popitem(last=False)
    return made[0], list(made[1])


def device_of(model: Model) -> Model:
    """The model without the errors and the hardware of any project."""
    own = tuple(group for group in model.catalogue if not any(error.user for error in group.walk()))
    if len(own) == len(model.catalogue) and model.fitted is None:
        return model
    return replace(model, catalogue=own, fitted=None)


def document_of(text: str, file: str = USER_ERRORS) -> Document | list[Problem]:
    """The text as a document that follows the schema, or everything that is wrong with it."""
    return parse(text, file, _schema(), ROOT)


_lock = threading.Lock()
_fitted: OrderedDict[tuple[str, str], tuple[Model | None, tuple[Model, list[Problem]] | None]] = OrderedDict()
_known: OrderedDict[tuple[str, str], tuple[Model | None, Extended | None]] = OrderedDict()


@cache
def _schema() -> etree.XMLSchema:
    return schema_of(model_directory())


def _extend(model: Model, text: str, file: str) -> Extended:
    document = document_of(text, file)
    if not isinstance(document, Document):
        return None, document
    device = device_of(model)
    reader = Reader(document)
    reader.areas, reader.iec_maps, reader.code_form = device.areas, device.iec_maps, device.code_form
    reader.symbols = {entry.symbol.upper(): entry.location for entry in device.specials if entry.symbol}
    groups, _ = read_catalogue((reader,))
    for node in reader.root.iter("Fact"):
        message = "an error of a project has its Source and Verified as a whole: leave out Fact"
        reader.problem("M010", message, node)
    _compare(reader, device, groups)
    if reader.problems:
        found = sorted(dict.fromkeys(reader.problems), key=lambda each: (each.span.line, each.span.column))
        return None, first_of(found)
    mine = ErrorGroup(GROUP, tuple(map(_mine, groups)), (), _WORDINGS)
    return (replace(device, catalogue=(*device.catalogue, mine)) if groups else device), []


def _compare(reader: Reader, device: Model, groups: Sequence[ErrorGroup]) -> None:
    """What the device has is not defined a second time, and not written."""
    pairs = {_pair(error): error for error in device.errors()}
    nodes: dict[str, etree._Element] = {}
    for node in reader.root.iter("Error"):
        nodes.setdefault(node.get("Id", ""), node)  # of two with one Id the first is read
    for id, node in nodes.items():
        if (own := device.error(id)) is not None:
            message = f"{device.name} has an error {id!r} itself ({own.name}): give yours another Id"
            reader.problem("M004", message, node, "Id")
    known = tuple(taken(device))
    for error in _all(groups):
        node, twin = nodes[error.id], pairs.get(_pair(error))
        if twin is not None:
            message = f"code {error.code_text} with flag {error.flag_text} is {twin.id!r} of the {device.name} itself"
            if not error.coded:
                message = f"flag {error.flag_text} without a code is {twin.id!r} of the {device.name} itself"
            reader.problem("M005", message, node, "ErrorCode" if error.coded else "ErrorFlag")
        for at, attribute, bits in _written(error, node):
            purpose = who_has(known, bits)
            if purpose and (twin is None or attribute != "ErrorFlag"):
                message = (
                    f"{at.get(attribute)} is {purpose} ({device.name}): an error of a project must not write there; "
                    "take an address that only your program uses"
                )
                reader.problem("M003", message, at, attribute)


def _written(error: ErrorEntry, node: etree._Element) -> Iterator[tuple[etree._Element, str, Stretch]]:
    """What an error writes, with the element and attribute that say so."""
    yield node, "ErrorFlag", stretch(error.flag)
    places = [*node.iterchildren("Also"), *node.iter("ErrorAddress")]
    for place, address in zip(places, addresses_of(error), strict=True):
        for bits in stretches((address,)):
            yield place, "Address", bits


def _pair(error: ErrorEntry) -> tuple[str, str, int, int | None]:
    return error.code_text, error.flag.area.name, error.flag.byte, error.flag.bit


def _all(groups: Sequence[ErrorGroup]) -> Iterator[ErrorEntry]:
    for group in groups:
        yield from group.walk()


def _mine(group: ErrorGroup) -> ErrorGroup:
    return replace(
        group,
        groups=tuple(map(_mine, group.groups)),
        errors=tuple(replace(error, user=True) for error in group.errors),
    )
