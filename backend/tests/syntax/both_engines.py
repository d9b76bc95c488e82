"""What a file of another tool computes: on both engines, whole images equal after each scan."""

from collections.abc import Mapping

from scanbench.check.build import check_sources
from scanbench.engines.interpreter.engine import ReferenceEngine
from scanbench.engines.native.engine import NativeEngine
from scanbench.plcmodel.model import Model
from scanbench.problems import Severity
from tests.caseformat import find, first_difference, write


class BothEngines:
    def __init__(self, files: Mapping[str, str], model: Model) -> None:
        checked = check_sources(files, model)
        assert [each for each in checked.problems if each.severity is Severity.ERROR] == []
        assert checked.program is not None
        self.problems = checked.problems
        self._program = checked.program
        self._memories = [bytearray(checked.program.initial_image) for _ in range(2)]
        engines = (ReferenceEngine, NativeEngine)
        self._engines = [made(self._program, memory) for made, memory in zip(engines, self._memories, strict=True)]

    def run(self, scans: int = 1, /, **inputs: str) -> None:
        """Sets variables by their paths, with `__` for a point."""
        for name, value in inputs.items():
            for memory in self._memories:
                write(self._program, name.replace("__", "."), value, memory)
        for _ in range(scans):
            for engine in self._engines:
                engine.run(1)
            assert not first_difference(self._program, *self._memories)

    def image(self) -> bytes:
        """All of the memory."""
        return bytes(self._memories[0])

    def values(self, *names: str) -> list[str]:
        return [find(self._program, name, self._memories[0])[2] for name in names]
