"""The store: small repositories over one database, with plain, synchronous methods."""

from scanbench.store.breakpoints import Breakpoints
from scanbench.store.connected import Database
from scanbench.store.drafts import Drafts
from scanbench.store.errors import Errors
from scanbench.store.imported import ImportedRecords
from scanbench.store.instances import Instances, Logs
from scanbench.store.kept import KeptRecords
from scanbench.store.mappings import Mappings
from scanbench.store.people import People
from scanbench.store.projects import Builds, Files, Projects
from scanbench.store.sweeps import Findings, States, Sweeps
from scanbench.store.traces import Traces
from scanbench.store.watchlists import WatchLists


class Store:
    """A database, with today's tables; `close` it at the end."""

    def __init__(self, url: str, server: str | None = None) -> None:
        """As `Database`."""
        database = self._database = Database(url, server)
        self.projects, self.files, self.builds = Projects(database), Files(database), Builds(database)
        self.drafts, self.people = Drafts(database), People(database)
        self.instances, self.log, self.errors = Instances(database), Logs(database), Errors(database)
        self.breakpoints, self.traces, self.watch_lists = Breakpoints(database), Traces(database), WatchLists(database)
        self.states, self.sweeps, self.findings = States(database), Sweeps(database), Findings(database)
        self.records, self.kept, self.mappings = ImportedRecords(database), KeptRecords(database), Mappings(database)

    def close(self) -> None:
        """Gives the connections back, and the claim."""
        self._database.close()
