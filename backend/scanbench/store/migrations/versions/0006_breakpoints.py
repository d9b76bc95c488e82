"""Breakpoints, so that a restart of the server does not lose them."""

import sqlalchemy as sa
from alembic import op

revision = "0006"
down_revision = "0005"
branch_labels = None
depends_on = None


def upgrade() -> None:
    """None yet."""
    op.create_table(
        "breakpoint",
        sa.Column("instance_id", sa.Integer, nullable=False),
        sa.Column("number", sa.Integer, autoincrement=False, nullable=False),
        sa.Column("content", sa.JSON, nullable=False),
        sa.PrimaryKeyConstraint("instance_id", "number", name="pk_breakpoint"),
        sa.ForeignKeyConstraint(["instance_id"], ["instance.id"], name="fk_breakpoint_instance_id", ondelete="CASCADE"),
    )


def downgrade() -> None:
    """They are gone."""
    op.drop_table("breakpoint")
