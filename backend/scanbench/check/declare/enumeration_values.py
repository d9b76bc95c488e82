"""Names of values -> the enumerations that have them."""

from collections.abc import Callable

from scanbench.check.context import Rejected
from scanbench.program.types import Enumeration, Type
from scanbench.syntax import tree


class EnumerationValues:
    """Which enumerations have a value of some name."""

    def __init__(self, trees: dict[str, tree.TypeDeclaration], type_of: Callable[[str], Type]) -> None:
        self._trees = trees
        self._type_of = type_of
        self._known = -1
        self._by_value: dict[str, list[str]] = {}
        self._inline: dict[str, list[tuple[str, Enumeration]]] = {}

    def add_inline(self, owner: str, type: Enumeration) -> None:
        """Adds an enumeration that a variable's declaration defines; its values are known inside of that owner."""
        for name, _ in type.values:
            found = self._inline.setdefault(name.upper(), [])
            if (owner.upper(), type) not in found:
                found.append((owner.upper(), type))

    def find(self, name: str, owners: set[str]) -> list[Enumeration]:
        """All enumerations that have this value and are visible for one of `owners` (upper-case names)."""
        found: list[Enumeration] = []
        for key in self._named().get(name.upper(), []):
            try:
                made = self._type_of(key)
            except Rejected:
                continue
            if isinstance(made, Enumeration) and made not in found:
                found.append(made)
        for owner, type in self._inline.get(name.upper(), []):
            visible = owner in owners or owner in self._trees or owner == "GLOBAL" or owner.startswith("STRUCT OF ")
            if visible and type not in found:
                found.append(type)
        return found

    def names(self) -> list[str]:
        """All values that are visible everywhere, for near matches."""
        return [
            name
            for declaration in self._trees.values()
            if isinstance(declaration.type, tree.EnumSpec) and "qualified_only" not in declaration.attributes
            for name, _, _ in declaration.type.values
        ]

    def _named(self) -> dict[str, list[str]]:
        if self._known != len(self._trees):
            self._known = len(self._trees)
            self._by_value = {}
            for key, declaration in self._trees.items():
                if isinstance(declaration.type, tree.EnumSpec) and "qualified_only" not in declaration.attributes:
                    for name, _, _ in declaration.type.values:
                        self._by_value.setdefault(name.upper(), []).append(key)
        return self._by_value
