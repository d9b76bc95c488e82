"""What the PLC is, as OPC UA for Devices (OPC 10000-100) tells it: a device in the set of devices, with its identification."""

from asyncua import Server, ua

from scanbench import __version__
from scanbench.comm.opcua.ids import own, standard
from scanbench.comm.opcua.plcopen import PLCOPEN, put_resource, put_types
from scanbench.comm.opcua.space import HAS_COMPONENT, HAS_PROPERTY, ORGANIZES, PROPERTY, Space, described_one

DI = "http://opcfoundation.org/UA/DI/"
_DEVICE_SET, _TOPOLOGY_ELEMENT, _DEVICE, _BLOCK, _CONFIGURABLE, _GROUP = 5001, 1001, 1002, 1003, 1004, 1005
"""Numbers of that namespace."""
_NOT_COUNTED = -1
"""What its specification has for a revision counter that is none."""


async def show_device(
    server: Server, space: Space, plc: ua.NodeId, folders: tuple[ua.NodeId, ua.NodeId], about: tuple[ua.NodeId, ...],
    name: str, model: str,
) -> int:  # fmt: skip
    """A device, which PLCopen calls a configuration; the folder of the PLC is below it. Texts that the device has not are empty, as the
    specification wants it. The index of the namespace of PLCopen is given back; of the others see `plcopen.put_resource`."""
    di, iec = await server.register_namespace(DI), await server.register_namespace(PLCOPEN)
    base, folder = standard(ua.ObjectIds.BaseObjectType), standard(ua.ObjectIds.FolderType)
    for number, title, above, abstract in (
        (_TOPOLOGY_ELEMENT, "TopologyElementType", base, True), (_DEVICE, "DeviceType", own(_TOPOLOGY_ELEMENT, di), True),
        (_BLOCK, "BlockType", own(_TOPOLOGY_ELEMENT, di), True), (_CONFIGURABLE, "ConfigurableObjectType", base, False),
        (_GROUP, "FunctionalGroupType", folder, False),
    ):  # fmt: skip
        space.put_type(own(number, di), title, above, di, abstract)
    kind = put_types(space, iec, own(_DEVICE, di), own(_BLOCK, di))
    devices = own(_DEVICE_SET, di)
    space.put_object(devices, "DeviceSet", base, standard(ua.ObjectIds.ObjectsFolder), how=ORGANIZES, space=di)
    device = own(40)
    space.put_object(device, name, kind, devices, how=HAS_COMPONENT)
    resource = put_resource(space, iec, di, device, folders, about)
    for first, each in ((42, device), (50, resource)):
        for number, (title, value, variant) in enumerate(_identification(model), first):
            space.put(own(number), title, ua.NodeClass.Variable, described_one(value, variant), space=di)
            space.refer(own(number), standard(ua.ObjectIds.HasTypeDefinition), PROPERTY)
            space.join(each, own(number), HAS_PROPERTY, ua.NodeClass.Variable, PROPERTY)
    space.join(device, plc, ORGANIZES, ua.NodeClass.Object, folder)
    return iec


def _identification(model: str) -> tuple[tuple[str, object, ua.VariantType], ...]:
    text, words = ua.VariantType.String, ua.VariantType.LocalizedText
    return (
        ("Manufacturer", ua.LocalizedText("Scanbench"), words), ("Model", ua.LocalizedText(model), words),
        ("SerialNumber", "", text), ("HardwareRevision", "", text), ("SoftwareRevision", __version__, text),
        ("DeviceRevision", "", text), ("DeviceManual", "", text), ("RevisionCounter", _NOT_COUNTED, ua.VariantType.Int32),
    )  # fmt: skip
