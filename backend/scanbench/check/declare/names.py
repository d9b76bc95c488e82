"""Which declaration a name means: NAMESPACE and USING. Every table of declarations is keyed by `NS.NAME` in upper case."""

from collections.abc import Callable, Collection, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field

from scanbench.check.context import Report
from scanbench.problems import Span
from scanbench.syntax import tree

LIBRARY = "__STANDARD"
"""The namespace of what the standard library declares where the user declares the same name."""


def written(name: str) -> str:
    """The name of a type as the text has it: without the values of generic constants, `FB` of `FB<20>`."""
    return name.partition("<")[0]


@dataclass(frozen=True, slots=True)
class Space:
    """The namespace of a declaration, and the namespaces whose names it sees without qualification."""

    namespace: str = ""
    using: tuple[str, ...] = ()
    globals_of: str = ""
    """The list of global variables whose declarations these are; it sees its own first."""

    def around(self) -> list[str]:
        """The namespace and those around it, the nearest first, in upper case."""
        parts = self.namespace.upper().split(".") if self.namespace else []
        return [".".join(parts[:count]) for count in range(len(parts), 0, -1)]

    def candidates(self, key: str) -> list[str]:
        """What the name may mean in full, the nearest first."""
        own = [f"{self.globals_of}.{key}".upper()] if self.globals_of else []
        if not self.namespace and not self.using:
            return [*own, key]
        around = self.around()
        used = [f"{outer}.{using}.{key}".upper().lstrip(".") for using in self.using for outer in (*around, "")]
        return [*own, *(f"{outer}.{key}" for outer in around), *used, key]


@dataclass(slots=True)
class Names:
    """Looks names up from where the checker is now: own namespace, those around it, USING, then the global names."""

    report: Report
    space: Space = field(default_factory=Space)
    internal: dict[str, str] = field(default_factory=dict)
    """Declarations and namespaces that are INTERNAL: key, and the namespace that may use it."""
    prefixes: frozenset[str] = frozenset()
    """Names of libraries, in upper case, that mean nothing before a name."""

    @contextmanager
    def within(self, space: Space) -> Iterator[None]:
        """Looks from there meanwhile: a declaration is made when it is first asked for, from anywhere."""
        before, self.space = self.space, space
        try:
            yield
        finally:
            self.space = before

    def find(self, name: str, span: Span, *tables: Collection[str]) -> str | None:
        """The key that the name means here, in any of these tables."""
        key = name.upper()

        def known(full: str) -> bool:
            return any(full in table for table in tables)

        plain = self.plain(key)
        if plain != key and not known(key):
            hidden = f"{LIBRARY}.{plain}"  # the project declares it as well, and names the library because of that
            if known(hidden):
                return hidden
            key = plain
        if not self.space.namespace and not self.space.using and not self.internal:
            return key if known(key) else None
        found = self._candidates(key, known)
        if len(found) > 1:
            raise self.report.reject("T001", f"`{name}` may be {' or '.join(found)}; write one of these instead.", span)
        if found and self.internal:
            self._may_use(name, found[0], span)
        return found[0] if found else None

    def plain(self, name: str) -> str:
        """The name without that of a library before it."""
        library, _, rest = name.rpartition(".")
        if (
            "." in library and library.upper() in self.prefixes
        ):  # as System.Math of SIMATIC AX, which has a library System as well
            return rest
        library, point, rest = name.partition(".")
        return rest if point and library.upper() in self.prefixes else name

    def _may_use(self, name: str, key: str, span: Span) -> None:
        """Refuses what is INTERNAL of a namespace that this place is not in, itself or what is around it."""
        parts = key.split(".")
        for count in range(1, len(parts) + 1):
            home = self.internal.get(".".join(parts[:count]))
            if home and home not in self.space.around():
                raise self.report.reject("T014", f"`{name}` is INTERNAL of the namespace {home}.", span)

    def _candidates(self, key: str, known: Callable[[str], bool]) -> list[str]:
        around = self.space.around()
        for outer in around:
            if known(f"{outer}.{key}"):
                return [f"{outer}.{key}"]
        used = []
        for using in self.space.using:
            for outer in (*around, ""):
                full = f"{outer}.{using}.{key}".upper().lstrip(".")
                if full not in used and known(full):
                    used.append(full)
        return used or ([key] if known(key) else [])


def full_name(declaration: tree.PouDeclaration) -> str:
    """Of a POU, with its namespace, and its number among FUNCTIONs of one name."""
    return f"{qualified(declaration.namespace, declaration.name)}{declaration.overload}"


def qualified(namespace: str, name: str) -> str:
    """The full name of what a namespace declares."""
    return f"{namespace}.{name}" if namespace else name
