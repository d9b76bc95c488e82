"""What proves to the broker of a PLC who we are.

It is kept in files beside the token of the server, readable by their owner only: never in the database, a run file, a log or an answer.
"""

import os
from pathlib import Path

from scanbench.comm.mqtt.settings import Secrets, tls_of


class MqttSecrets:
    """Of one PLC; None in what is given leaves a secret as it is, an empty text ends it."""

    def __init__(self, directory: Path, instance: int) -> None:
        self._directory = directory
        self._password, self._identity = directory / f"{instance}.password", directory / f"{instance}.pem"

    def read(self) -> Secrets:
        """What is kept."""
        try:
            password = self._password.read_text("utf-8")
        except FileNotFoundError:
            password = ""
        return Secrets(password, self._identity if self._identity.exists() else None)

    def keep(self, password: str | None, identity: str | None) -> None:
        """Keeps what is given. `Refused` where that is no certificate with its key: then everything is as it was."""
        if identity:
            fresh = self._identity.with_suffix(".new")
            self._write(fresh, identity)
            try:
                tls_of("", fresh)
                fresh.replace(self._identity)
            finally:
                fresh.unlink(missing_ok=True)
        elif identity is not None:
            self._identity.unlink(missing_ok=True)
        if password:
            self._write(self._password, password)
        elif password is not None:
            self._password.unlink(missing_ok=True)

    def forget(self) -> None:
        """The PLC is deleted, or there is a different broker."""
        self.keep("", "")

    def _write(self, path: Path, text: str) -> None:
        self._directory.mkdir(mode=0o700, parents=True, exist_ok=True)
        path.unlink(missing_ok=True)
        with os.fdopen(os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600), "w", encoding="utf-8") as file:
            file.write(text)
