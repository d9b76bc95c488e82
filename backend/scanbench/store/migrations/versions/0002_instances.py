"""Instances can be switched off, and have limits."""

import sqlalchemy as sa
from alembic import op

revision = "0002"
down_revision = "0001"
branch_labels = None
depends_on = None


def upgrade() -> None:
    """Add the columns; an instance that is there already is on, without limits."""
    op.add_column("instance", sa.Column("powered", sa.Boolean, nullable=False, server_default=sa.true()))
    for name in ("memory_mib", "cpu_percent", "run_mib"):
        op.add_column("instance", sa.Column(name, sa.Integer, nullable=True))
