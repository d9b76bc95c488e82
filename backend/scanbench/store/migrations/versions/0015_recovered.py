"""The history keeps who took an error back, and how: recovered at the simulator, or cleared by a tool or the program."""

import sqlalchemy as sa
from alembic import op

revision = "0015"
down_revision = "0014"
branch_labels = None
depends_on = None


def upgrade() -> None:
    """Of rows of before it is not known."""
    op.add_column("error_history", sa.Column("recovered_by", sa.String(100), server_default="", nullable=False))
    op.add_column("error_history", sa.Column("recovered_way", sa.String(16), nullable=True))
