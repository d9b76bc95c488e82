"""Wire shapes of models: their memory and their errors."""

from typing import Literal

from pydantic import Field

from scanbench.faults.line_faults import ServerKind
from scanbench.web.messages_base import Wire
from scanbench.web.messages_errors import ErrorGroup

Access = Literal["none", "read", "write"]


class Area(Wire):
    name: str
    description: str
    words: int = Field(description="size in 16-bit words")
    retain: bool = Field(description="keeps its content when the power goes off")
    first: str = Field(description="first address in the vendor's notation")
    last: str
    program: Access
    tool: Access
    engine: Access


class ModelSummary(Wire):
    name: str
    vendor: str
    description: str
    error_count: int
    verified_count: int = Field(description="errors all of whose facts were looked up, not only known")
    fact_count: int = Field(description="statements about the device, each with a source: `scanbench model facts`")
    verified_facts: int = Field(description="how many of them were looked up on a page")


class HardwareKind(Wire):
    """What a project can say is fitted, in `hardware.json`; `rack` and `slot` are also the places of units."""

    kind: str
    lowest: int
    highest: int


class ModelInfo(ModelSummary):
    areas: list[Area]
    code_word: str | None = Field(description="address of the error code word, e.g. A400")
    hardware: bool = Field(default=False, description="the project says what is fitted (hardware.json)")
    fits: list[HardwareKind] = Field(
        default_factory=list,
        description="the kinds of hardware that the model has, with their lowest and highest numbers",
    )
    code_words: list[str] = Field(
        description="the words of the error code, the low one first; two where it has 32 bits"
    )
    servers: tuple[ServerKind, ...] = Field(description="the protocols that its communication unit speaks")
    status_words: list[str] = Field(description="words shown under the tree, e.g. A400, A401, A402")
    catalogue: list[ErrorGroup]
