"""A PLC can have servers of protocols that tools speak to it."""

import sqlalchemy as sa
from alembic import op

revision = "0016"
down_revision = "0015"
branch_labels = None
depends_on = None


def upgrade() -> None:
    """PLCs of before have none."""
    op.add_column("instance", sa.Column("communication", sa.JSON, nullable=True))
