"""Which files a project has: its programs, its panels, and what is said of them beside."""

from scanbench.comm.modbus.map_file import MAP_FILE
from scanbench.plcmodel.user_errors import CATALOGUE_FILES
from scanbench.server.operator_panels import is_panel_file
from scanbench.syntax.language_file import LANGUAGE_FILE
from scanbench.syntax.parse_file import is_program_file
from scanbench.syntax.requirements import REQUIREMENTS

OWN_FILES = (*CATALOGUE_FILES, LANGUAGE_FILE, REQUIREMENTS)
"""Their names, at the top of a project: its errors, what is fitted, its dialect, and what it requires."""


def is_project_file(path: str) -> bool:
    """Whether a file of this path can be one of a project."""
    return is_program_file(path) or path in OWN_FILES or is_beside(path)


def is_beside(path: str) -> bool:
    """Whether it is a file of a project that no program has: a build leaves it out. An operator panel, or the map of Modbus."""
    return is_panel_file(path) or path == MAP_FILE
