"""asyncua's server on its socket: endpoints and the certificate."""

import asyncio
import os
import socket
from datetime import UTC, datetime
from pathlib import Path

from asyncua import Server, ua
from asyncua.common.connection import TransportLimits
from asyncua.crypto.cert_gen import setup_self_signed_certificate
from asyncua.server.binary_server_asyncio import BinaryServer, OPCUAProtocol
from cryptography.x509.oid import ExtendedKeyUsageOID

from scanbench import __version__
from scanbench.comm.opcua.clients import Rights, ToPlc
from scanbench.comm.opcua.connection import Connection, Line
from scanbench.wire.opcua import OpcUaStart

_CONNECTIONS = 64
_LARGEST = 16 << 20
_BUFFER = 65_535
_POLICIES = [ua.SecurityPolicyType.NoSecurity, ua.SecurityPolicyType.Basic256Sha256_SignAndEncrypt]


class OpcUa(Server):
    """On one address, for one PLC."""

    def __init__(self, start: OpcUaStart, iserver: ToPlc, line: Line) -> None:
        super().__init__(iserver)
        self._start, self._line = start, line
        host = f"[{start.host}]" if ":" in start.host else start.host
        self.set_endpoint(f"opc.tcp://{host}:{start.port}/")
        self.set_server_name(f"Scanbench {start.plc}")
        self.product_uri, self.manufacturer_name = "urn:scanbench", "Scanbench"
        self.application_type = ua.ApplicationType.Server
        self.limits = TransportLimits(_BUFFER, _BUFFER, -(-_LARGEST // _BUFFER), _LARGEST)
        self.set_security_policy(_POLICIES, Rights())
        self.set_identity_tokens([ua.AnonymousIdentityToken, ua.UserNameIdentityToken])
        iserver.allow_remote_admin = False
        iserver.max_connections = _CONNECTIONS
        iserver.bind_condition_methods = True

    @property
    def port(self) -> int:
        """Where it listens."""
        return int(self.bserver.port) if self.bserver is not None else 0

    async def prepare(self) -> None:
        """Everything but listening."""
        await self.init()
        uri = f"urn:{socket.gethostname()}:scanbench"
        await self.set_application_uri(uri)
        await self.set_build_info("urn:scanbench", "Scanbench", self._start.model, __version__, "", _built())
        key, certificate = await certificate_in(Path(self._start.certificates), uri)
        await self.load_certificate(certificate)
        await self.load_private_key(key)

    async def start(self) -> None:
        """Listens. `OSError`."""
        await self._setup_server_nodes()
        await self.iserver.start()
        self.bserver = _Listener(self, self._line)
        self.bserver.set_policies(self._policies)
        await self.bserver.start()


def _built() -> datetime:
    """When this version of the code was written."""
    return datetime.fromtimestamp(Path(__file__).stat().st_mtime, UTC)


async def certificate_in(directory: Path, uri: str) -> tuple[Path, Path]:
    """The key and the certificate that are kept there, made where there are none, or where they have run out."""
    await asyncio.to_thread(directory.mkdir, 0o700, True, True)
    key, certificate = directory / "key.pem", directory / "certificate.der"
    before = os.umask(0o077)
    try:
        await setup_self_signed_certificate(
            key, certificate, uri, socket.gethostname(), [ExtendedKeyUsageOID.SERVER_AUTH], {"organizationName": "Scanbench"}
        )  # fmt: skip
    finally:
        os.umask(before)
    return key, certificate


class _Listener(BinaryServer):
    """asyncua's, whose connections have the faults of the line."""

    def __init__(self, server: OpcUa, line: Line) -> None:
        start = server._start
        super().__init__(server.iserver, start.host, start.port, server.limits)
        self._line = line

    def _make_protocol(self) -> OPCUAProtocol:
        return Connection(
            self._line, self.iserver, self._policies, self.clients, self.closing_tasks, self.limits
        )  # fmt: skip
