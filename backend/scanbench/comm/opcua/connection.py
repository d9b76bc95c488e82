"""One connection of a client: whose session it has, and faults of its line."""

import asyncio
from collections import deque
from typing import Any, cast

from asyncua import ua
from asyncua.server.binary_server_asyncio import OPCUAProtocol
from asyncua.server.uaprocessor import UaProcessor

from scanbench.comm.opcua.clients import Session
from scanbench.comm.opcua.ids import standard
from scanbench.wire.opcua import OpcUaFault

_UNREAD_BYTES = 8 << 20
"""A client that leaves more of its answers unread is cut off."""
_CREATE = standard(ua.ObjectIds.CreateSessionRequest_Encoding_DefaultBinary)
_ACTIVATE = standard(ua.ObjectIds.ActivateSessionRequest_Encoding_DefaultBinary)


class Line:
    """What is wrong with the line now."""

    def __init__(self) -> None:
        self.fault = OpcUaFault("none", 0)


class Connection(OPCUAProtocol):
    """asyncua's, with the faults of the line."""

    def __init__(self, line: Line, *args: Any) -> None:
        super().__init__(*args)
        self._line = line

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        """See asyncua."""
        super().connection_made(cast(asyncio.BaseTransport, _OnTheWay(cast(asyncio.Transport, transport), self._line)))
        if self.processor is not None:  # nothing has come yet
            self.processor = _Processor(self.iserver, self.transport, self.limits)
            self.processor._connection.set_policy_factories(self.policies)

    def data_received(self, data: bytes) -> None:
        """Where the line is cut, the connection ends before anything is done."""
        if self._line.fault.kind == "cut":
            if self.transport is not None:
                self.transport.close()
            return
        super().data_received(data)

    def connection_lost(self, ex: BaseException | None) -> None:
        """The client is gone, also where its session waits for it to come again."""
        session = self.processor.session if self.processor is not None else None
        if isinstance(session, Session):
            session.leave()
        super().connection_lost(ex)


class _Processor(UaProcessor):
    """asyncua's, which has a session only as long as it is its own: a session belongs to the connection that activated it last."""

    async def _process_message(self, typeid: ua.NodeId, requesthdr: Any, seqhdr: Any, body: Any) -> Any:
        if typeid == _CREATE:
            await self._let_go()
        if typeid == _ACTIVATE:
            return await self._activate(typeid, requesthdr, seqhdr, body)
        return await self._asyncua(typeid, requesthdr, seqhdr, body)

    async def _asyncua(self, *request: Any) -> Any:
        return await super()._process_message(*request)  # type: ignore[no-untyped-call]

    async def _activate(self, *request: Any) -> Any:
        """asyncua gives a connection the session before it knows who asks: who may not have it loses it again."""
        before = self.session
        there = self.iserver.subscription_service.subscriptions.values()
        ways = [(each, each.pub_result_callback, each.pub_request_callback) for each in there]
        try:
            done = await self._asyncua(*request)
        except BaseException:
            if before is None:
                self._forget()
                for each, result, asked in ways:
                    each.pub_result_callback, each.pub_request_callback = result, asked
            raise
        session = self.session
        if isinstance(session, Session):
            holder, session.holder = session.holder, self
            if isinstance(holder, _Processor) and holder is not self:
                holder._forget()
        return done

    async def _let_go(self) -> None:
        """A connection has one session: the one that it had before ends as if its connection had ended."""
        session = self.session
        if session is None:
            return
        ends = self._should_close_session_on_transport_loss()
        self._forget()
        if isinstance(session, Session):
            session.leave()
        if ends:
            await session.close_session(True)

    def _forget(self) -> None:
        """It has no session any more."""
        self.session = None
        watchdog, self._session_watchdog_task = self._session_watchdog_task, None
        if watchdog is not None:
            watchdog.cancel()


class _OnTheWay:
    """A transport that lets answers come late, or not at all."""

    def __init__(self, transport: asyncio.Transport, line: Line) -> None:
        self._transport, self._line = transport, line
        self._late: deque[tuple[float, bytes]] = deque()
        """What is on its way, and when it is there: in the order in which it was sent."""
        self._late_bytes = 0
        self._timer: asyncio.TimerHandle | None = None

    def write(self, data: bytes) -> None:
        """Sends, as the line lets it. What is sent later never comes earlier."""
        fault = self._line.fault
        if fault.kind == "silent" or self._transport.is_closing():
            return
        if fault.kind == "late" or self._late:
            now = asyncio.get_running_loop().time()
            due = now + (fault.late_ms / 1000 if fault.kind == "late" else 0.0)
            self._late.append((max(due, self._late[-1][0]) if self._late else due, data))
            self._late_bytes += len(data)
            self._wait()
        else:
            self._transport.write(data)
        if self._late_bytes + self._transport.get_write_buffer_size() > _UNREAD_BYTES:
            self._drop()
            self._transport.abort()

    def _wait(self) -> None:
        if self._timer is None and self._late:
            self._timer = asyncio.get_running_loop().call_at(self._late[0][0], self._come)

    def _come(self) -> None:
        """The first is there, and all that are there with it."""
        self._timer = None
        now = self._late[0][0]
        while self._late and self._late[0][0] <= now:
            _, data = self._late.popleft()
            self._late_bytes -= len(data)
            self._transport.write(data)
        self._wait()

    def _drop(self) -> None:
        self._late.clear()
        self._late_bytes = 0
        if self._timer is not None:
            self._timer.cancel()
            self._timer = None

    def close(self) -> None:
        """See asyncio. What was still on its way does not come any more."""
        self._drop()
        self._transport.close()

    def get_extra_info(self, name: str, default: Any = None) -> Any:
        """See asyncio."""
        return self._transport.get_extra_info(name, default)
