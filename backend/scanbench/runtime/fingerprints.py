"""What a run depends on besides its journal, as short texts that differ when it does."""

import hashlib
import math
import struct
from functools import cache

from scanbench.check.program import Program
from scanbench.check.types import Record
from scanbench.plcmodel.model import Model

_SAMPLES = 500
_F64 = struct.Struct("<d")


def model_fingerprint(model: Model) -> str:
    """Of everything that is known of a model."""
    return _hash(repr(model).encode())


def program_digest(program: Program) -> str:
    """Of the layout and the first image: a state of a program with another digest means nothing."""
    layout = program.layout
    parts = [repr((layout.areas, layout.state_size, layout.size, layout.violations, program.interval_ns))]
    if layout.globals is not None:
        parts.append(_members(layout.globals))
    for task in program.tasks:
        parts += [f"{each.name} {each.offset} {_members(each.pou.instance)}" for each in task.programs]
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
    return _hash(results)


def _members(record: Record) -> str:
    return ";".join(
        f"{member.name} {member.offset} {member.bit} {member.type.name}" for member in record.members.values()
    )


def _hash(data: bytes) -> str:
    return hashlib.sha256(data).hexdigest()
