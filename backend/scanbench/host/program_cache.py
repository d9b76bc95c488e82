"""Programs that were built before, from the disk: neither check nor emission, so that a restart takes no time."""

import hashlib
import pickle
import sys
from collections.abc import Iterable, Iterator
from functools import cache
from importlib.resources import files
from importlib.resources.abc import Traversable

from scanbench.engines.cache import BlobCache
from scanbench.garbage import without_collection
from scanbench.plcmodel.model import Model
from scanbench.program.program import Program
from scanbench.wire.host import Sources

ROOMS = ("syntax", "plcmodel", "program", "symbols", "check", "engines")
"""What makes programs, and what they are made of."""


def key_of(sources: Sources, model: Model) -> str:
    """Says everything that a checked program depends on."""
    parts = [_own_code(), repr(model), str(sources.interval_ns)]
    parts += [part for item in sources.files.items() for part in item]
    digest = hashlib.sha256()
    for part in parts:
        data = part.encode("utf-8", "surrogatepass")
        digest.update(len(data).to_bytes(8, "little") + data)
    return digest.hexdigest()


@cache
def _own_code() -> str:
    """A fingerprint of the code that makes programs: a different version of Scanbench may make different programs."""
    package = files("scanbench")
    digest = hashlib.sha256(sys.version.encode())
    for path, data in [("problems.py", package.joinpath("problems.py").read_bytes())] + [
        found for room in ROOMS for found in _texts(package.joinpath(room), room)
    ]:
        digest.update(f"{path} {len(data)}\n".encode() + data)
    return digest.hexdigest()


def _texts(folder: Traversable, path: str) -> Iterator[tuple[str, bytes]]:
    for entry in sorted(folder.iterdir(), key=lambda each: each.name):
        name = f"{path}/{entry.name}"
        if entry.is_dir():
            yield from _texts(entry, name)
        elif entry.name.endswith((".py", ".st")):
            yield name, entry.read_bytes()


def recall(cache: BlobCache, key: str) -> Program | None:
    """The program that was kept under the key."""
    data = cache.get(key)
    if data is None:
        return None
    with without_collection():
        program = pickle.loads(data)  # the cache has checked that these are the bytes that we wrote
    return program if isinstance(program, Program) else None


def keep(cache: BlobCache, key: str, program: Program) -> None:
    """Keeps the program under the key."""
    try:
        data = pickle.dumps(program, pickle.HIGHEST_PROTOCOL)
    except RecursionError:
        return  # nested too deeply: it is checked again next time
    cache.put(key, data)


def recall_code(cache: BlobCache, key: str, machine: str) -> list[str] | None:
    """Keys of the object code of the program, all of it optimised for this machine."""
    data = cache.get(_code_key(key, machine))
    return None if data is None else data.decode().split()


def keep_code(cache: BlobCache, key: str, machine: str, objects: Iterable[str]) -> None:
    """Keeps which object code the program has."""
    cache.put(_code_key(key, machine), " ".join(objects).encode())


def _code_key(key: str, machine: str) -> str:
    return hashlib.sha256(f"code {key} {machine}".encode()).hexdigest()
