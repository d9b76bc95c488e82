"""Versions of a program have a label and a message."""

import sqlalchemy as sa
from alembic import op

revision = "0011"
down_revision = "0010"
branch_labels = None
depends_on = None


def upgrade() -> None:
    """Versions of before have neither."""
    op.add_column("program_version", sa.Column("label", sa.String(100), server_default="", nullable=False))
    op.add_column("program_version", sa.Column("message", sa.Text, server_default="", nullable=False))
