"""Verdicts have grades (acted, decided, displayed, stored). No table changes: an older Scanbench refuses the database, as it
could not read the new verdicts."""

revision = "0009"
down_revision = "0008"
branch_labels = None
depends_on = None


def upgrade() -> None:
    """Nothing: what was kept stays as it is, and is read."""
