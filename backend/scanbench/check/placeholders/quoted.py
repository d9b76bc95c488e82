"""Names in the quotes of SCL that no file of a project declares: sources of the TIA Portal never have the tags of the PLC, and often not all blocks."""

import re
from collections.abc import Mapping

from scanbench.check.libraries.catalogue import NO_CODE
from scanbench.syntax.scl import is_scl
from scanbench.syntax.scl_words import name_of

_QUOTED = re.compile(r'"([^"\n]+)"')


def quoted_names(sources: Mapping[str, str]) -> frozenset[str]:
    """All names that files of SCL have in quotes, in upper case, as the standard would write them."""
    texts = (NO_CODE.sub(" ", text) for name, text in sources.items() if is_scl(name))
    return frozenset(name_of(name).upper() for text in texts for name in _QUOTED.findall(text))
