"""The library of a project for what its controller would do, and nothing here does: GSV, SSV, MSG, motion, and so on."""

from collections.abc import Mapping

from scanbench.syntax.l5x.names import CONTROLLER, LIBRARY

_HEAD = f"""(* Controller of this project: what a controller of Rockwell would do, and nothing here does. From
   https://literature.rockwellautomation.com/idc/groups/literature/documents/rm/1756-rm003_-en-p.pdf *)

NAMESPACE {CONTROLLER}
"""


def controller(stubs: Mapping[str, str]) -> str:
    """Its text: a variable for each flag and result, a stub for each instruction."""
    variables, functions = "", ""
    for name, type in sorted(stubs.items()):
        if name.startswith("S_"):
            variables += f"  {name} : {type};\n"
        elif type:
            made = f"{LIBRARY}.{type}" if type == "STRING82" else type
            variables += f"  Stub_{name} : {made};\n"
            functions += f"\nFUNCTION {name} : {made}\n{{stub}}\n  {name} := Stub_{name};\nEND_FUNCTION\n"
        else:
            functions += f"\n(* The tags of the call keep what is written to them. *)\nFUNCTION {name}\n{{stub}}\n  ;\nEND_FUNCTION\n"
    listed = f"VAR_GLOBAL\n{variables}END_VAR\n" if variables else ""
    return f"{_HEAD}{listed}{functions}\nEND_NAMESPACE\n"
