"""Errors in the history, in sweeps and in what was accepted are instances: `io-bus-error:rack=1,slot=3` is longer than an id."""

import sqlalchemy as sa
from alembic import op

revision = "0013"
down_revision = "0012"
branch_labels = None
depends_on = None

_LENGTH = 255


def upgrade() -> None:
    """Rows of before stay as they are: their details say which instance they are of."""
    for table in ("error_history", "sweep_cell", "accepted_finding"):
        with op.batch_alter_table(table) as batch:
            batch.alter_column(
                "error", type_=sa.String(_LENGTH), existing_type=sa.String(64), existing_nullable=False
            )  # fmt: skip
