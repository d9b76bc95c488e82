"""What the client asks, written once: as steps, which a client that waits and one of `asyncio` both take.

A method of `requests` makes steps: a generator that yields what is to be done (`Request`, `Pause`, `Say`, `Hear`), is given what
came of it, and returns the result. `asked` makes a method of it: of a `Waiting` client one that returns the result, of an
`Awaited` one a coroutine function with the same arguments.
"""

from collections.abc import Callable, Coroutine, Generator
from dataclasses import dataclass
from functools import update_wrapper
from typing import Concatenate, Generic, ParamSpec, TypeVar, overload

P = ParamSpec("P")
T = TypeVar("T")
S = TypeVar("S")
S_contra = TypeVar("S_contra", contravariant=True)

Json = None | bool | int | float | str | list["Json"] | dict[str, "Json"]


class Refused(Exception):
    """The server refused; the message says what to do, `near` names what was perhaps meant."""

    def __init__(self, message: str, near: tuple[str, ...] = ()) -> None:
        super().__init__(message)
        self.near = near


@dataclass(frozen=True, slots=True)
class Request:
    """A request by HTTP; what comes of it are the bytes of the answer. A `body` of bytes goes as it is, another one as JSON."""

    method: str
    path: str
    body: object = None


@dataclass(frozen=True, slots=True)
class Pause:
    """So many seconds nothing is asked; nothing comes of it."""

    seconds: float


@dataclass(frozen=True, slots=True)
class Say:
    """A text for a WebSocket; nothing comes of it."""

    text: str


@dataclass(frozen=True, slots=True)
class Hear:
    """What comes next by a WebSocket, a text or bytes; `TimeoutError` where nothing comes for so many seconds, None is for ever."""

    timeout_s: float | None


Step = Request | Pause | Say | Hear
Steps = Generator[Step, bytes | str, T]


class Waiting:
    """A client whose methods return when there is a result."""

    def _do(self, steps: Steps[T]) -> T:
        raise NotImplementedError


class Awaited:
    """A client whose methods are coroutine functions."""

    async def _do(self, steps: Steps[T]) -> T:
        raise NotImplementedError


class asked(Generic[P, T]):  # noqa: N801  # a decorator
    """A method of steps as one of a client."""

    def __init__(self, steps: Callable[Concatenate[S, P], Steps[T]]) -> None:
        self._steps: Callable[..., Steps[T]] = steps
        update_wrapper(self, steps)  # type: ignore[arg-type]  # documentation tools see the function

    @overload
    def __get__(self, client: Waiting, owner: type) -> Callable[P, T]: ...
    @overload
    def __get__(self, client: Awaited, owner: type) -> Callable[P, Coroutine[object, None, T]]: ...
    @overload
    def __get__(self, client: None, owner: type) -> "asked[P, T]": ...
    def __get__(self, client: Waiting | Awaited | None, owner: type) -> object:
        """The method of this client."""
        if client is None:
            return self

        def method(*arguments: P.args, **named: P.kwargs) -> T | Coroutine[object, None, T]:
            return client._do(self._steps(client, *arguments, **named))

        return update_wrapper(method, self._steps)


class asked_value(Generic[T]):  # noqa: N801  # a decorator
    """A property of steps: of a client of `asyncio` it is awaited, `await plc.state`."""

    def __init__(self, steps: Callable[[S], Steps[T]]) -> None:
        self._steps: Callable[..., Steps[T]] = steps
        self.__doc__ = steps.__doc__

    @overload
    def __get__(self, client: Waiting, owner: type) -> T: ...
    @overload
    def __get__(self, client: Awaited, owner: type) -> Coroutine[object, None, T]: ...
    @overload
    def __get__(self, client: None, owner: type) -> "asked_value[T]": ...
    def __get__(self, client: Waiting | Awaited | None, owner: type) -> object:
        """What this client gets."""
        return self if client is None else client._do(self._steps(client))
