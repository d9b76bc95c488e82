"""An L5X file -> the files of a project, and what became of each routine."""

import re
from collections.abc import Iterable, Iterator
from itertools import chain, count

from scanbench.syntax.imported import Project, Read
from scanbench.syntax.l5x import notes
from scanbench.syntax.l5x.aliases import aliases, typed, with_aliases
from scanbench.syntax.l5x.declarations import ENABLED, data_type, section, sections, sizes_here, types_of_data
from scanbench.syntax.l5x.known import Known, Parameter, Passed
from scanbench.syntax.l5x.ladder import NotRead, structured, variables
from scanbench.syntax.l5x.lines import contents, rungs, written
from scanbench.syntax.l5x.names import CONTROLLER, ELEMENTARY, OWN, TYPES, name_of
from scanbench.syntax.l5x.statements import TooDeep, passed_of, statements
from scanbench.syntax.l5x.stubs import controller
from scanbench.syntax.language_file import LANGUAGE_FILE, language_text
from scanbench.syntax.xml_tree import Element, attribute, child, children, line_of, parse_xml

ROOT = "RSLogix5000Content"
LANGUAGES = {"RLL": "LD", "FBD": "FBD", "SFC": "SFC", "ST": "ST"}
STUB = "{stub}\n"
"""In a POU whose statements are left out: it does not count as one that runs, and who uses it is told."""
_HEAD = re.compile(rb"<RSLogix5000Content\b")


def is_l5x(data: bytes) -> bool:
    """Whether the beginning of a file says that it is one of Studio 5000."""
    return _HEAD.search(data[:4000]) is not None


def read_project(data: bytes) -> Project:
    """Raises `BadXml` where the file cannot be read at all."""
    controller = child(parse_xml(data, ROOT), "Controller")
    return _Reader(controller).read()


class _Reader:
    """One controller, or a part of one that was exported alone."""

    def __init__(self, controller: Element | None) -> None:
        self._controller = controller
        self._mark_own_types()
        self._made = Project(attribute(controller, "Name") or "Logix")
        self._instructions = {
            attribute(each, "Name").upper(): _required(each)
            for each in self._all("AddOnInstructionDefinitions", "AddOnInstructionDefinition")
        }
        self._tags = [*self._all("Tags", "Tag"), *_module_tags(controller)]
        self._members = {
            attribute(each, "Name").upper(): _types(children(child(each, "Members"), "Member"))
            for each in self._all("DataTypes", "DataType")
        }
        self._stubs: dict[str, str] = {}
        self._about_tags = Read("Tags", line_of(controller) if controller is not None else 1, "")

    def read(self) -> Project:
        for each in self._all("AddOnInstructionDefinitions", "AddOnInstructionDefinition"):
            self._file(attribute(each, "Name"), self._add_on(each))
        for each in self._all("Programs", "Program"):
            self._file(attribute(each, "Name"), self._program(each))
        self._file("Types", self._types())
        self._file("Tags", sections("VAR_GLOBAL", self._tags, self._about_tags.notes))
        self._file("Configuration", self._configuration())
        if self._stubs:
            self._made.files[f"libraries/{CONTROLLER}.st"] = controller(self._stubs)
        if self._about_tags.notes:
            self._made.pous.append(self._about_tags)
        if self._made.files:
            self._made.files[LANGUAGE_FILE] = language_text("rockwell")
        return self._made

    def _mark_own_types(self) -> None:
        """Types and instructions of the file go before those of Logix."""
        if self._controller is None:
            return
        own = {
            attribute(each, "Name").upper()
            for kind in (("DataTypes", "DataType"), ("AddOnInstructionDefinitions", "AddOnInstructionDefinition"))
            for each in self._all(*kind)
        }
        if own := own & TYPES:
            for each in self._controller.iter("Tag", "LocalTag", "Parameter", "Member"):
                if attribute(each, "DataType").upper() in own:
                    each.set("DataType", f"{OWN}{attribute(each, 'DataType')}")

    def _all(self, *path: str) -> Iterator[Element]:
        yield from children(child(self._controller, *path[:-1]), path[-1])

    def _file(self, name: str, text: str) -> None:
        taken = {each.lower() for each in self._made.files}
        numbered = chain((f"{name}.st",), (f"{name}_{number}.st" for number in count(2)))
        if text:
            self._made.files[next(each for each in numbered if each.lower() not in taken)] = text

    def _types(self) -> str:
        known = {*self._instructions, *ELEMENTARY}
        text = ""
        for each in self._all("DataTypes", "DataType"):
            known.add(attribute(each, "Name").upper())
            text += data_type(each)
        programs = [tag for each in self._all("Programs", "Program") for tag in children(child(each, "Tags"), "Tag")]
        text += "".join(types_of_data([*self._tags, *programs], known))
        return f"TYPE\n{text}END_TYPE\n" if text else ""

    def _add_on(self, node: Element) -> str:
        """An Add-On Instruction is a function block."""
        name = attribute(node, "Name")
        own, locals = self._about_tags.notes, list(children(child(node, "LocalTags"), "LocalTag"))
        parameters = list(children(child(node, "Parameters"), "Parameter"))
        parameters = typed(parameters, locals, Known(types=_types([*parameters, *locals]), members=self._members), own)
        of = {
            usage: [each for each in parameters if attribute(each, "Usage") == usage]
            for usage in ("Input", "Output", "InOut")
        }
        declared = (
            section("VAR_INPUT", of["Input"], own)
            + section("VAR_OUTPUT", of["Output"], own)
            + section("VAR_IN_OUT", of["InOut"], own)
            + section("VAR", locals, own)
        )
        known = Known(
            aliases(parameters),
            {},
            self._instructions,
            _types([*parameters, *locals]),
            members=self._members,
            stubs=self._stubs,
        )
        body, left_out = "", ""
        for routine in children(child(node, "Routines"), "Routine"):
            read = self._read(f"{name}.{attribute(routine, 'Name')}", routine)
            if attribute(routine, "Name").upper() == "LOGIC":
                body = with_aliases(_text(routine, known, read), parameters, known, read)
                left_out = STUB if read.refused else ""
            elif not read.refused:
                read.notes.append(notes.unused(attribute(routine, "Name")))
        return f"FUNCTION_BLOCK {name_of(name)}\n{left_out}{declared}{variables(body)}{body}END_FUNCTION_BLOCK\n"

    def _program(self, node: Element) -> str:
        """A program, whose routines are its actions."""
        name, main = attribute(node, "Name"), attribute(node, "MainRoutineName").upper()
        tags = list(children(child(node, "Tags"), "Tag"))
        routines = list(children(child(node, "Routines"), "Routine"))
        taken = {attribute(each, "Name").upper() for each in tags}
        actions = {(found := attribute(each, "Name")).upper(): _action(found, taken) for each in routines}
        known = Known(
            self._aliases_in(tags),
            actions,
            self._instructions,
            _types([*self._tags, *tags]),
            _passed(routines),
            members=self._members,
            stubs=self._stubs,
        )
        body, rest, left_out = "", "", ""
        for routine in routines:
            of = attribute(routine, "Name")
            read = self._read(f"{name}.{of}", routine)
            known.routine = of.upper()
            text = _text(routine, known, read)
            if of.upper() == main:
                body, left_out = text, STUB if read.refused else ""
            elif not read.refused:
                rest += f"ACTION {actions[of.upper()]}:\n{text}END_ACTION\n"
        declared = sections("VAR", tags, self._about_tags.notes)
        return f"PROGRAM {name_of(name)}\n{left_out}{declared}{variables(rest + body)}{rest}{body}END_PROGRAM\n"

    def _aliases_in(self, tags: list[Element]) -> dict[str, str]:
        """What aliases are written for in a program with these tags, which go before those of the controller."""
        own = {attribute(each, "Name").upper() for each in tags}
        found = {}
        for alias, target in aliases(self._tags).items():
            if alias in own:
                continue
            if re.split(r"\W", target, maxsplit=1)[0].upper() in own:
                self._about_tags.notes.append(notes.hidden_alias(alias, target))
                continue
            found[alias] = target
        return found | aliases(tags)

    def _read(self, name: str, routine: Element) -> Read:
        type = attribute(routine, "Type")
        read = Read(name, line_of(routine), LANGUAGES.get(type, type))
        self._made.pous.append(read)
        if next(children(routine, "EncodedData"), None) is not None or attribute(routine, "EncryptionConfig"):
            read.notes.append(notes.protected(attribute(routine, "Name")))
            read.refused = True
        elif type not in ("ST", "RLL"):
            read.notes.append(notes.other_language(attribute(routine, "Name"), read.language))
            read.refused = True
        elif contents(routine) > 1:
            read.notes.append(notes.edited(attribute(routine, "Name")))
        return read

    def _configuration(self) -> str:
        """What runs: the periodic tasks, the continuous one after them; nothing else, where the file has tasks."""
        tasks, programs, seen = "", "", False
        run = {
            attribute(each, "Name"): attribute(each, "Disabled") != "true" for each in self._all("Programs", "Program")
        }
        for name, enabled in run.items():
            if not enabled:
                self._about_tags.notes.append(notes.not_run(name))
        for task in self._all("Tasks", "Task"):
            seen = True
            named, type = name_of(attribute(task, "Name")), attribute(task, "Type")
            if attribute(task, "InhibitTask") == "true" or type not in ("CONTINUOUS", "PERIODIC"):
                self._about_tags.notes.append(notes.not_run(attribute(task, "Name")))
                continue
            own = [attribute(each, "Name") for each in children(child(task, "ScheduledPrograms"), "ScheduledProgram")]
            own = [each for each in own if run.get(each)]
            if own:
                tasks += f"TASK {named}({_when(task)});\n"
            programs += "".join(f"PROGRAM {name_of(each)}_1 WITH {named} : {name_of(each)};\n" for each in own)
        if not seen:
            return ""
        return f"CONFIGURATION Config\nRESOURCE Controller ON PLC\n{tasks}{programs}END_RESOURCE\nEND_CONFIGURATION\n"


CONTINUOUS = 16
"""The priority of the continuous task: those of the others are 1 to 15."""


def _when(task: Element) -> str:
    if attribute(task, "Type") == "CONTINUOUS":
        return f"PRIORITY := {CONTINUOUS}"
    rate, priority = attribute(task, "Rate", "10"), attribute(task, "Priority", "10")
    return f"INTERVAL := T#{rate}ms, PRIORITY := {priority}"


def _types(tags: Iterable[Element]) -> dict[str, tuple[str, list[int]]]:
    """The type and the dimensions of each, by its name here."""
    return {
        name_of(attribute(each, "Name")).upper(): (attribute(each, "DataType").upper(), sizes_here(each))
        for each in tags
    }


def _required(node: Element) -> list[Parameter]:
    return [
        Parameter(attribute(each, "Name"), attribute(each, "Usage"))
        for each in children(child(node, "Parameters"), "Parameter")
        if (attribute(each, "Required") == "true" and attribute(each, "Name") not in ENABLED)
        or attribute(each, "Usage") == "InOut"
    ]


def _module_tags(controller: Element | None) -> Iterator[Element]:
    """The tags of inputs and outputs, which have the name of their module: `Local:1:I`."""
    for module in children(child(controller, "Modules"), "Module"):
        for each in module.iter("InputTag", "OutputTag", "ConfigTag"):
            letter = {"InputTag": "I", "OutputTag": "O", "ConfigTag": "C"}[str(each.tag)]
            each.set("Name", f"{_module_name(module)}:{letter}")
            structure = next(each.iter("Structure"), None)
            each.set("DataType", attribute(structure, "DataType"))
            if structure is not None:
                yield each


def _module_name(module: Element) -> str:
    """As its tags have it: `Parent:slot` in a chassis, else its own name."""
    ports = list(children(child(module, "Ports"), "Port"))
    upstream = next((each for each in ports if attribute(each, "Upstream") == "true"), ports[0] if ports else None)
    slot = attribute(upstream, "Address")
    if re.fullmatch(r"[0-9]{1,3}", slot) and attribute(module, "ParentModule"):
        return f"{attribute(module, 'ParentModule')}:{slot}"
    return attribute(module, "Name")


def _action(routine: str, taken: set[str]) -> str:
    """The name of its action; a tag may have the same name as a routine, a variable and an action may not."""
    return f"{name_of(routine)}_routine" if routine.upper() in taken else name_of(routine)


def _passed(routines: Iterable[Element]) -> dict[str, Passed]:
    """What each routine in Structured Text is given and gives back, by its name in upper case."""
    texts = ((attribute(each, "Name").upper(), written(each)) for each in routines if attribute(each, "Type") == "ST")
    return {name: passed for name, text in texts if (passed := passed_of(text)) is not None}


def _text(routine: Element, known: Known, read: Read) -> str:
    if read.refused:
        return ""
    name = attribute(routine, "Name")
    try:
        drawn = attribute(routine, "Type") == "RLL"
        found = structured(rungs(routine), name_of(name), known) if drawn else written(routine)
        text = statements(found, known, read.notes).rstrip("\n")
    except NotRead as bad:
        read.notes.append(notes.not_in_ladder(name, str(bad)))
        read.refused = True
        return ""
    except TooDeep:
        read.notes.append(notes.too_deep(name))
        read.refused = True
        return ""
    return f"{text}\n" if text.strip() else ""
