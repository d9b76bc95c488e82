"""The history keeps who acknowledged an error, and what they said."""

import sqlalchemy as sa
from alembic import op

revision = "0017"
down_revision = "0016"
branch_labels = None
depends_on = None


def upgrade() -> None:
    """Rows of before were acknowledged by nobody."""
    op.add_column("error_history", sa.Column("acknowledged", sa.JSON, nullable=True))
