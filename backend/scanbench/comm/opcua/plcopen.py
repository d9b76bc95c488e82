"""The information model of PLCopen for IEC 61131-3 (OPC 30000, version 1.02): the PLC as a configuration with one resource.

Types, references, their numbers and their names are those of that specification. Of what they say an object may have, what must be
there is: of a PLC that runs one program there is nothing in `AccessVars` and `ConfigVars`. Variables and instances are the nodes
that the PLC shows anyhow; here they are found once more, by reference.
"""

from asyncua import ua

from scanbench.comm.opcua.ids import own, standard
from scanbench.comm.opcua.space import HAS_COMPONENT, HAS_PROPERTY, ORGANIZES, PROPERTY, Iec, Space, described_one
from scanbench.program.program import Program
from scanbench.program.types import Section

PLCOPEN = "http://PLCopen.org/OpcUa/IEC61131-3/"
_CONFIGURATION, _RESOURCE, _UNIT, _PROGRAM, _BLOCK, _TASK = 1001, 1002, 1003, 1004, 1005, 1006
_VARIABLES = {
    Section.INPUT: (4001, "HasInputVars", "InputVarsOf"), Section.OUTPUT: (4002, "HasOutputVars", "OutputVarsOf"),
    Section.IN_OUT: (4003, "HasInOutVars", "InOutVarsOf"), Section.VAR: (4004, "HasLocalVars", "LocalVarsOf"),
}  # fmt: skip
_WITH = 4006
_RESOURCES, _ONE, _PROGRAMS, _TASKS, _GLOBALS, _DIAGNOSTIC = map(own, (60, 61, 62, 63, 64, 65))
_EMPTY = (("AccessVars", own(66)), ("ConfigVars", own(67)), ("Configuration", own(68)), ("GlobalVars", own(69)))
_SUPPORTED, _MS_NS = 70, 1_000_000
"""And the numbers after it: folders with the types that may be made below an object, by clients; none may."""


def put_types(space: Space, index: int, device: ua.NodeId, block: ua.NodeId) -> ua.NodeId:
    """The types, above them a device and a block of DI; that of the PLC itself is given back. `index` is that of `PLCOPEN`."""

    def iec(number: int) -> ua.NodeId:
        return own(number, index)

    for number, name, above, abstract in (
        (_CONFIGURATION, "CtrlConfigurationType", device, False), (_RESOURCE, "CtrlResourceType", device, False),
        (_UNIT, "CtrlProgramOrganizationUnitType", block, True), (_PROGRAM, "CtrlProgramType", iec(_UNIT), True),
        (_BLOCK, "CtrlFunctionBlockType", iec(_UNIT), True),
        (_TASK, "CtrlTaskType", standard(ua.ObjectIds.BaseObjectType), False),
    ):  # fmt: skip
        space.put_type(iec(number), name, above, index, abstract)
    for number, name, inverse in _VARIABLES.values():
        space.put_reference_type(iec(number), name, inverse, HAS_COMPONENT, index)
    space.put_reference_type(iec(_WITH), "With", "Executes", standard(ua.ObjectIds.NonHierarchicalReferences), index)
    sections: dict[str, ua.NodeId] = {section: iec(number) for section, (number, _, _) in _VARIABLES.items()}
    space.iec = Iec(iec(_PROGRAM), iec(_BLOCK), sections)
    return iec(_CONFIGURATION)


def put_resource(
    space: Space, index: int, di: int, plc: ua.NodeId, folders: tuple[ua.NodeId, ua.NodeId], about: tuple[ua.NodeId, ...]
) -> ua.NodeId:  # fmt: skip
    """What is below the configuration `plc`; the node of its resource is given back. `folders`: those of programs and global
    variables, whose nodes are found here, too; `about`: what diagnostics are. `di` is the index of DI."""
    holder, group = own(1004, di), own(1005, di)  # ConfigurableObjectType, FunctionalGroupType
    space.put_object(_RESOURCES, "Resources", holder, plc, how=HAS_COMPONENT, space=index)
    space.put_object(_ONE, "Resource", own(_RESOURCE, index), _RESOURCES, how=HAS_COMPONENT)
    for id, name in ((_PROGRAMS, "Programs"), (_TASKS, "Tasks")):
        space.put_object(id, name, holder, _ONE, how=HAS_COMPONENT, space=index)
    space.put_object(_GLOBALS, "GlobalVars", group, _ONE, how=HAS_COMPONENT, space=index)
    for name, id in (*_EMPTY, ("Diagnostic", _DIAGNOSTIC)):
        space.put_object(id, name, group, plc, how=HAS_COMPONENT, space=index)
    for number, id in enumerate((_RESOURCES, _PROGRAMS, _TASKS), _SUPPORTED):
        folder = standard(ua.ObjectIds.FolderType)
        space.put_object(own(number), "SupportedTypes", folder, id, how=HAS_COMPONENT, space=di)
    for each in about:
        space.join(_DIAGNOSTIC, each, ORGANIZES, ua.NodeClass.Object, standard(ua.ObjectIds.FolderType))
    space.also = dict(zip(folders, (_PROGRAMS, _GLOBALS), strict=True))
    space.renewed = (_PROGRAMS, _GLOBALS, _TASKS, own(_PROGRAM, index), own(_BLOCK, index))
    return _ONE


def put_tasks(space: Space, index: int, program: Program) -> None:
    """The tasks of the program that runs, after its nodes were put. They are gone with it."""
    for task in program.tasks:
        id = own(f"task:{task.name}")
        space.put_object(id, task.name, own(_TASK, index), _TASKS, how=HAS_COMPONENT)
        space.mine(id)
        told: list[tuple[str, object, ua.VariantType]] = [("Priority", task.priority, ua.VariantType.UInt32)]
        if task.every:
            told.append(("Interval", _literal(task.interval_ns), ua.VariantType.String))
        for name, value, variant in told:
            property = own(f"task:{task.name}:{name}")
            space.put(property, name, ua.NodeClass.Variable, described_one(value, variant), space=index)
            space.mine(property)
            space.refer(property, standard(ua.ObjectIds.HasTypeDefinition), PROPERTY)
            space.join(id, property, HAS_PROPERTY, ua.NodeClass.Variable, PROPERTY)
        for each in task.programs:
            instance = own(each.name)
            if instance in space:
                space.join(id, instance, own(_WITH, index), ua.NodeClass.Object, None)


def _literal(ns: int) -> str:
    """A duration as it is written in a program."""
    return f"T#{ns // _MS_NS}ms" if ns % _MS_NS == 0 else f"T#{ns // 1000}us"
