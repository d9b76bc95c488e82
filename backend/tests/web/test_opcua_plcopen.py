"""The PLC as PLCopen's information model has it, by asyncua's client: a configuration, its resource, and what that runs."""

from typing import Any

from asyncua import Client, Node, ua

from tests.web.server import Server
from tests.web.test_communication import MODEL
from tests.web.test_opcua import at, client_at, run, switch_on, write

DI, PLCOPEN = "http://opcfoundation.org/UA/DI/", "http://PLCopen.org/OpcUa/IEC61131-3/"
SOURCE = """
VAR_GLOBAL speed : INT := 7; END_VAR
FUNCTION_BLOCK Counter
VAR_INPUT step : INT; END_VAR VAR_OUTPUT sum : DINT; END_VAR VAR last : DINT; END_VAR
  last := sum; sum := sum + step;
END_FUNCTION_BLOCK
PROGRAM Slow VAR n : DINT; counter : Counter; END_VAR n := n + 1; counter(step := 2); END_PROGRAM
PROGRAM Fast VAR m : DINT; END_VAR m := m + 1; END_PROGRAM
CONFIGURATION Plant
RESOURCE Cpu ON PLC
  TASK low (INTERVAL := T#20ms, PRIORITY := 5);
  TASK high (INTERVAL := T#10ms, PRIORITY := 1);
  PROGRAM one WITH low : Slow;
  PROGRAM two WITH high : Fast;
END_RESOURCE
END_CONFIGURATION
"""


async def names(nodes: list[Node]) -> list[str]:
    return [str((await each.read_browse_name()).Name) for each in nodes]


async def referred(node: Node, type: int, index: int) -> list[str]:
    """Names of what a node refers to by a type of references, and no subtype of it."""
    found = await node.get_references(ua.NodeId(type, index), ua.BrowseDirection.Forward, includesubtypes=False)  # type: ignore[arg-type]
    return [str(each.BrowseName.Name) for each in found]


async def type_of(node: Node) -> Any:
    kind = await node.read_type_definition()
    assert kind is not None
    return kind


def test_a_client_finds_its_way_from_the_set_of_devices_to_a_variable(server: Server) -> None:
    instance = server.instance("plcopen", MODEL, main=SOURCE)
    address = switch_on(server, instance)

    async def story() -> None:
        async with client_at(address, server.token) as client:
            di, iec = [await client.get_namespace_index(each) for each in (DI, PLCOPEN)]
            devices = await client.nodes.objects.get_child(f"{di}:DeviceSet")
            (plc,) = await devices.get_children()
            assert (await type_of(plc)) == ua.NodeId(1001, iec)  # type: ignore[arg-type]
            assert await names([client.get_node(await type_of(plc))]) == ["CtrlConfigurationType"]
            groups = await names(await plc.get_children(ua.ObjectIds.HasComponent))
            assert {"Resources", "GlobalVars", "AccessVars", "ConfigVars", "Configuration", "Diagnostic"} == set(groups)

            resources = await plc.get_child(f"{iec}:Resources")
            (resource,) = [
                each for each in await resources.get_children() if (await type_of(each)).NamespaceIndex == iec
            ]
            assert await type_of(resource) == ua.NodeId(1002, iec)  # type: ignore[arg-type]
            assert {"Manufacturer", "Model"} <= set(await names(await resource.get_properties()))

            globals = await resource.get_child(f"{iec}:GlobalVars")
            (speed,) = await globals.get_children()
            assert (speed.nodeid, await speed.read_value()) == (at(client, "speed").nodeid, 7)
            programs = await (await resource.get_child(f"{iec}:Programs")).get_children(ua.ObjectIds.Organizes)
            assert set(await names(programs)) == {"one", "two"}
            await _is_an_instance_of_its_pou(
                client, await (await resource.get_child(f"{iec}:Programs")).get_child("2:one"), iec
            )

            tasks = await (await resource.get_child(f"{iec}:Tasks")).get_children()
            found = dict(zip(await names(tasks), tasks, strict=True))
            assert {"low", "high"} <= set(found)
            low = found["low"]
            assert (await type_of(low)).Identifier == 1006
            assert await (await low.get_child(f"{iec}:Priority")).read_value() == 5
            assert await (await low.get_child(f"{iec}:Interval")).read_value() == "T#20ms"
            assert await referred(low, 4006, iec) == ["one"]
            assert await write(client, "speed", 9, ua.VariantType.Int16) == "Good"
            assert await speed.read_value() == 9

    run(story())


async def _is_an_instance_of_its_pou(client: Client, program: Node, iec: int) -> None:
    kind = client.get_node(await type_of(program))
    above = await kind.get_references(ua.ObjectIds.HasSubtype, ua.BrowseDirection.Inverse)
    assert (await names([kind]), [each.BrowseName.Name for each in above]) == (["Slow"], ["CtrlProgramType"])
    assert await referred(program, 4004, iec) == ["n", "counter"]
    counter = at(client, "one.counter")
    block = client.get_node(await type_of(counter))
    assert [each.BrowseName.Name for each in await block.get_references(ua.ObjectIds.HasSubtype, ua.BrowseDirection.Inverse)] == [
        "CtrlFunctionBlockType"
    ]  # fmt: skip
    assert [await referred(counter, each, iec) for each in (4001, 4002, 4004)] == [["step"], ["sum"], ["last"]]
    step = await counter.get_child("2:step")
    assert await step.read_value() == 2, "whoever browses without knowing of PLCopen finds the variables, too"
