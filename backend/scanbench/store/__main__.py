"""`python -m scanbench.store [URL]`: brings a database up to date and prints the number of its projects. For the compose file."""

import sys
from pathlib import Path

from scanbench.store.database import database_url
from scanbench.store.records import StoreError
from scanbench.store.store import Store


def main(arguments: list[str]) -> int:
    """Migrates the database named, or that of SCANBENCH_DATABASE."""
    try:
        store = Store(arguments[0] if arguments else database_url(Path("data")))
    except StoreError as error:
        sys.stderr.write(f"{error}\n")
        return 1
    projects = len(store.projects.all())
    store.close()
    sys.stdout.write(f"the database is up to date, projects: {projects}\n")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
