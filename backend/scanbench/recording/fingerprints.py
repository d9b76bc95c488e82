"""What a run depends on besides its journal, as short texts that differ when it does."""

import hashlib
import math
import struct
from collections.abc import Iterator
from dataclasses import fields, is_dataclass
from functools import cache

from scanbench.plcmodel.as_used import plain
from scanbench.plcmodel.model import Area, ErrorAddress, ErrorEntry, Instruction, Model, ResetInstruction
from scanbench.plcmodel.user_errors import device_of
from scanbench.program.program import Program
from scanbench.program.types import Record

_SAMPLES = 500
_WORDS = frozenset(
    {
        "description",
        "source",
        "verified",
        "wordings",
        "user",
        "identifies",
        "hardware",
        "hardware_number",
        "absent",
        "fitted",
        "facts",
    }
)
"""What an error is of, and what is fitted, decides what may be entered; what was entered a run keeps."""
_LATER = frozenset({
    (Area, "texts"), (ErrorEntry, "coded"), (Instruction, "text"), (Instruction, "texts"), (Instruction, "part"), (ResetInstruction, "code"),
    (Model, "queries"), (Model, "messages"), (Model, "standby"),
})  # fmt: skip
"""Fields that came after run files were kept: with their defaults they say nothing, so that runs from before fit."""
_ENTERED = frozenset({(ErrorAddress, "lasting")})
"""Fields that decide what is entered into the journal: what was entered a run keeps."""
_F64 = struct.Struct("<d")


def model_fingerprint(model: Model) -> str:
    """Of everything that the device does; what is only told to people may be worded otherwise.

    The errors of a project are none of the device's: they belong to the sources, which a run file keeps whole. What only a
    program asks for that uses it (`as_used`) is none of its deeds either: the layout of such a program says so.
    """
    return _hash("\n".join(_deeds(plain(device_of(model)), set())).encode())


def _deeds(value: object, areas: set[str]) -> Iterator[str]:
    """`areas` are those that were described already: every place names its area."""
    if isinstance(value, Area) and value.name in areas:
        yield value.name
    elif is_dataclass(value):
        if isinstance(value, Area):
            areas.add(value.name)
        for field in fields(value):
            place = (type(value), field.name)
            if place in _ENTERED or (place in _LATER and getattr(value, field.name) == field.default):
                continue
            if field.name not in _WORDS and not (field.name == "name" and hasattr(value, "id")):
                yield field.name
                yield from _deeds(getattr(value, field.name), areas)
    elif isinstance(value, tuple):
        yield f"({len(value)}"
        for each in value:
            yield from _deeds(each, areas)
    else:
        yield repr(value)


def program_digest(program: Program) -> str:
    """Digest of the layout and the first image. A state fits only a program with the same digest."""
    layout = program.layout
    parts = [repr((layout.areas, layout.state_size, layout.size, layout.violations, program.interval_ns))]
    if layout.globals is not None:
        parts.append(_members(layout.globals))
    parts += [f"{each.name} {each.offset} {_members(each.pou.instance)}" for each in program.instances]
    return _hash("\n".join(parts).encode() + program.initial_image)


@cache
def libm_fingerprint() -> str:
    """Of the results of libm's functions, which differ by a last bit between systems."""
    results = bytearray()
    for index in range(1, _SAMPLES):
        small = (index * 0.61803398874989) % 1.0
        large = small * index
        for value in (
            math.sin(large), math.cos(large), math.tan(large), math.asin(small), math.acos(small), math.atan(large),
            math.exp(small * 10), math.log(large), math.log10(large), math.atan2(small, large), math.pow(large, small),
        ):  # fmt: skip
            results += _F64.pack(value)
    return _hash(bytes(results))


def _members(record: Record) -> str:
    return ";".join(
        f"{member.name} {member.offset} {member.bit} {member.type.name}" for member in record.members.values()
    )


def _hash(data: bytes) -> str:
    return hashlib.sha256(data).hexdigest()
