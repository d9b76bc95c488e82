"""Declarations -> types: the one place where what makes types and what asks for them meet."""

from dataclasses import replace

from scanbench.check.context import Report
from scanbench.check.declare.blocks import block
from scanbench.check.declare.declarations import ConstantOf, Declarations
from scanbench.check.declare.initial_values import initial_image
from scanbench.check.declare.members import default_of, with_policy
from scanbench.check.declare.names import qualified
from scanbench.check.declare.policies import project_policy
from scanbench.check.declare.specs import enumeration, structure, subrange, type_of
from scanbench.plcmodel.model import Model
from scanbench.program.types import LARGEST_STEP, SLOT_BYTES, Kind, Reference, Type, initial_of
from scanbench.syntax import tree

WITH_ATTRIBUTES = ("codesys", "twincat")
"""Dialects in which the attributes `to_string` and `pack_mode` mean something."""
PACK_MODES = {"0": 1, "1": 1, "2": 2, "4": 4, "8": 8}
"""Of the attribute: the largest step at which members are placed, in bytes: https://infosys.beckhoff.com/content/1033/cx7000/10697920651.html."""


def declarations_of(report: Report, model: Model, areas: dict[str, int], constant_of: ConstantOf) -> Declarations:
    """No declarations yet. `areas`: offset of each area of the model in the image."""
    return Declarations(report, model, areas, constant_of, _made, type_of)


def _made(declared: Declarations, declaration: tree.TypeDeclaration | tree.PouDeclaration) -> Type:
    if isinstance(declaration, tree.TypeDeclaration):
        return _named_type(declared, declaration)
    return _block_type(declared, declaration)


def _named_type(declared: Declarations, declaration: tree.TypeDeclaration) -> Type:
    name = qualified(declaration.namespace, declaration.name)
    match declaration.type:
        case tree.StructSpec() as spec:
            made: Type = structure(declared, name, spec, _pack(declared, declaration))
        case tree.EnumSpec() as spec:
            made = enumeration(declared, spec, name)
            if "to_string" in declaration.attributes and declared.dialect.name in WITH_ATTRIBUTES:
                made = replace(made, named=True)
        case tree.SubrangeSpec() as spec:
            made = subrange(declared, spec, name)
        case spec:
            made = declared.type_of(spec)
    made = with_policy(made, declaration.policy or project_policy(declared, name, declaration.span))
    if declaration.initial is not None:
        declared.defaults[name.upper()] = initial_image(declared, declaration.initial, made)
    else:
        default = default_of(declared, declaration.type, made)
        if default != initial_of(made):
            declared.defaults[name.upper()] = default
    return made


def _pack(declared: Declarations, declaration: tree.TypeDeclaration) -> int:
    """The largest step at which the members of a structure are placed."""
    said = next((each for each in declaration.attributes if each.startswith("pack_mode=")), "")
    if not said or declared.dialect.name not in WITH_ATTRIBUTES:
        return LARGEST_STEP
    mode = said.partition("=")[2]
    if mode not in PACK_MODES:
        raise declared.report.reject(
            "S004", f"`pack_mode` of `{declaration.name}` is '0', '1', '2', '4' or '8', not '{mode}'.", declaration.span
        )
    return PACK_MODES[mode]


def _block_type(declared: Declarations, declaration: tree.PouDeclaration) -> Type:
    record = block(declared, declaration)
    if record.kind is Kind.INTERFACE:
        return Reference(record.name, Kind.REF, SLOT_BYTES, record)
    return record
