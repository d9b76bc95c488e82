"""AT of SCL: `bytes AT word : ARRAY[0..1] OF BYTE`, a second view of the bytes of a variable."""

import re
from dataclasses import replace

from scanbench.problems import Span
from scanbench.syntax import tree

_NAME = re.compile(r'#?"?([^\W\d]\w*)"?')
KEPT_OPEN = ("VAR_IN_OUT",)
"""Sections whose variables may be written by others while the block runs: no view of them would be right."""


def with_overlays(pou: tree.PouDeclaration) -> tree.PouDeclaration:
    """The POU with its views as temporary variables, which `check.body.overlays` keeps as they are to be."""
    bases = {
        each.name.upper() for section in pou.sections if section.keyword not in KEPT_OPEN for each in section.variables
    }
    found: list[tuple[str, str, Span]] = []
    views: list[tree.Variable] = []
    sections = []
    known: dict[str, str] = {}
    for section in pou.sections:
        kept = []
        for each in section.variables:
            named = _NAME.fullmatch(each.address or "")
            base = named[1].upper() if named else ""
            base = known.get(base, base)
            if base not in bases:
                kept.append(each)
                continue
            known[each.name.upper()] = base
            found.append((each.name.upper(), base, each.span))
            views.append(replace(each, address=None, address_span=None))
        sections.append(replace(section, variables=tuple(kept)))
    if not views:
        return pou
    temporary = tree.VariableSection("VAR_TEMP", (), tuple(views), views[0].span)
    return replace(pou, sections=(*sections, temporary), overlays=tuple(found))
