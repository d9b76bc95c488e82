"""What the PLC is, as OPC UA for Devices (OPC 10000-100) tells it: a device in the set of devices, with its identification."""

from typing import cast

from asyncua import Server, ua

from scanbench import __version__
from scanbench.comm.opcua.ids import own, standard

DI = "http://opcfoundation.org/UA/DI/"
_DEVICE_SET, _TOPOLOGY_ELEMENT, _DEVICE = 5001, 1001, 1002
"""Numbers of that namespace."""
_NOT_COUNTED = -1
"""What its specification has for a revision counter that is none."""


async def show_device(server: Server, plc: ua.NodeId, name: str, model: str) -> None:
    """A device whose only part is the folder of the PLC. Texts that the device has not are empty, as the specification wants it."""
    index = await server.register_namespace(DI)

    def di(number: int) -> ua.NodeId:
        return ua.NodeId(cast(ua.Int32, number), cast(ua.Int16, index))

    base = server.get_node(standard(ua.ObjectIds.BaseObjectType))
    element = await base.add_object_type(di(_TOPOLOGY_ELEMENT), ua.QualifiedName("TopologyElementType", index))
    kind = await element.add_object_type(di(_DEVICE), ua.QualifiedName("DeviceType", index))
    for each in (element, kind):
        await each.write_attribute(ua.AttributeIds.IsAbstract, ua.DataValue(ua.Variant(True, ua.VariantType.Boolean)))
    ours = await kind.add_object_type(own(41), ua.QualifiedName("VirtualPlcType", own(41).NamespaceIndex))
    objects = server.get_node(standard(ua.ObjectIds.ObjectsFolder))
    devices = await objects.add_object(di(_DEVICE_SET), ua.QualifiedName("DeviceSet", index))
    device = await devices.add_object(own(40), ua.QualifiedName(name, own(40).NamespaceIndex), ours.nodeid)
    for number, (title, value, variant) in enumerate(_identification(model), 42):
        await device.add_property(own(number), ua.QualifiedName(title, index), value, variant)
    await device.add_reference(plc, ua.ObjectIds.Organizes)


def _identification(model: str) -> tuple[tuple[str, object, ua.VariantType], ...]:
    text, words = ua.VariantType.String, ua.VariantType.LocalizedText
    return (
        ("Manufacturer", ua.LocalizedText("Scanbench"), words), ("Model", ua.LocalizedText(model), words),
        ("SerialNumber", "", text), ("HardwareRevision", "", text), ("SoftwareRevision", __version__, text),
        ("DeviceRevision", "", text), ("DeviceManual", "", text), ("RevisionCounter", _NOT_COUNTED, ua.VariantType.Int32),
    )  # fmt: skip
