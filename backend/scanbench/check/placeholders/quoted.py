"""Names that files of other tools use and seldom declare: what SCL has in quotes (tags of the PLC, and often not all blocks), tags of modules of Logix."""

import re
from collections.abc import Mapping

from scanbench.check.libraries.catalogue import NO_CODE
from scanbench.syntax.language_file import DialectName
from scanbench.syntax.scl import is_scl
from scanbench.syntax.scl_words import name_of

_MODULE = re.compile(r"\b[A-Z]\w*_[ICOS]\d?(?=\s*\.)", re.IGNORECASE)
_QUOTED = re.compile(r'"([^"\n]+)"')


def quoted_names(sources: Mapping[str, str]) -> frozenset[str]:
    """All names that files of SCL have in quotes, in upper case, as the standard would write them."""
    texts = (NO_CODE.sub(" ", text) for name, text in sources.items() if is_scl(name))
    return frozenset(name_of(name).upper() for text in texts for name in _QUOTED.findall(text))


def module_tags(sources: Mapping[str, str]) -> frozenset[str]:
    """All names that are called like a tag of a module, `Local_1_I` of `Local:1:I.Data`, in upper case."""
    texts = (NO_CODE.sub(" ", text) for name, text in sources.items() if name.lower().endswith(".st"))
    return frozenset(name.upper() for text in texts for name in _MODULE.findall(text))


def seldom_declared(sources: Mapping[str, str], dialect: DialectName) -> frozenset[str]:
    """The names of this kind that the dialect has."""
    if dialect == "siemens":
        return quoted_names(sources)
    return module_tags(sources) if dialect == "rockwell" else frozenset()
