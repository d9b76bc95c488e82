"""The text of one LLVM module: functions, constants, declarations, alias tags."""

UNLIKELY_BRANCH = '!{!"branch_weights", i32 1, i32 1048575}'
"""The first piece of metadata of every module."""
ATTRIBUTES = "attributes #0 = { nounwind willreturn mustprogress }"


class ModuleText:
    """Collects what the functions of a module need."""

    def __init__(self) -> None:
        self._functions: list[str] = []
        self._constants: dict[bytes, str] = {}
        self._declarations: dict[str, str] = {}
        self._reserved: list[str] = []
        self._metadata: list[str] = [
            UNLIKELY_BRANCH,
            '!{!"scanbench"}',
        ]
        self._tags: dict[str, str] = {"": ""}
        self._globals: dict[str, str] = {}

    def tag(self, variable: str) -> str:
        """Suffix of an access to this variable.

        One leaf of type-based alias analysis per variable says that different variables do not overlap, at linear cost.
        All areas of the model share one leaf, because they may overlap; the empty name means any variable.
        """
        if variable.startswith("@"):
            variable = "@"
        tag = self._tags.get(variable)
        if tag is None:
            leaf = self._node(f'!{{!"{_escape(variable.encode())}", !1, i64 0}}')
            tag = self._tags[variable] = f", !tbaa {self._node(f'!{{{leaf}, {leaf}, i64 0}}')}"
        return tag

    def _node(self, text: str) -> str:
        self._metadata.append(text)
        return f"!{len(self._metadata) - 1}"

    def define(self, name: str, text: str) -> None:
        """A variable that other modules may refer to."""
        self._globals[name] = text

    def refer(self, name: str, text: str) -> None:
        """Declares a variable that a different module defines, unless this one does."""
        self._globals.setdefault(name, text)

    def constant(self, data: bytes) -> str:
        """The name of a constant with these bytes."""
        name = self._constants.get(data)
        if name is None:
            name = self._constants[data] = f"@c.{len(self._constants)}"
        return name

    def reserve(self, name: str, size: int) -> None:
        """Memory of the module's own."""
        self._reserved.append(f"{name} = internal global [{size} x i8] zeroinitializer, align 16")

    def declare(self, name: str, text: str) -> None:
        """A helper function or a declaration, once; declarations inside of the helper's text count by themselves."""
        if name in self._declarations:
            return
        lines = text.splitlines()
        for line in lines:
            if line.startswith("declare "):
                self._declarations.setdefault(line.partition("@")[2].partition("(")[0], line)
        self._declarations[name] = "\n".join(line for line in lines if not line.startswith("declare "))

    def add(self, function: str) -> None:
        """A whole function."""
        self._functions.append(function)

    def text(self) -> str:
        """The module, ready to be parsed."""
        constants = [
            f'{name} = private unnamed_addr constant [{len(data)} x i8] c"{_escape(data)}"'
            for data, name in self._constants.items()
        ]
        shared = [f"{name} = {text}" for name, text in self._globals.items()]
        metadata = [f"!{number} = {text}" for number, text in enumerate(self._metadata)]
        parts = [
            *constants,
            *shared,
            *self._reserved,
            *self._declarations.values(),
            *self._functions,
            ATTRIBUTES,
            *metadata,
            "",
        ]
        return "\n".join(parts)


_PLAIN = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789 ._@#"
_ESCAPED = tuple(chr(byte) if byte in _PLAIN else f"\\{byte:02X}" for byte in range(256))


def _escape(data: bytes) -> str:
    return "".join(map(_ESCAPED.__getitem__, data))
