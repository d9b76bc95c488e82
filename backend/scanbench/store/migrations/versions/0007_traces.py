"""Traces of instances, and records of them that somebody kept."""

import sqlalchemy as sa
from alembic import op

revision = "0007"
down_revision = "0006"
branch_labels = None
depends_on = None


def upgrade() -> None:
    """None yet."""
    op.create_table(
        "trace",
        sa.Column("instance_id", sa.Integer, nullable=False),
        sa.Column("number", sa.Integer, autoincrement=False, nullable=False),
        sa.Column("content", sa.JSON, nullable=False),
        sa.PrimaryKeyConstraint("instance_id", "number", name="pk_trace"),
        sa.ForeignKeyConstraint(["instance_id"], ["instance.id"], name="fk_trace_instance_id", ondelete="CASCADE"),
    )
    op.create_table(
        "trace_record",
        sa.Column("id", sa.Integer, nullable=False),
        sa.Column("project_id", sa.Integer, nullable=False),
        sa.Column("name", sa.String(100), nullable=False),
        sa.Column("instance", sa.String(100), nullable=False),
        sa.Column("content", sa.JSON, nullable=False),
        sa.Column("by", sa.String(100), nullable=False),
        sa.Column("at", sa.DateTime(timezone=True), nullable=False),
        sa.PrimaryKeyConstraint("id", name="pk_trace_record"),
        sa.ForeignKeyConstraint(["project_id"], ["project.id"], name="fk_trace_record_project_id", ondelete="CASCADE"),
    )
    op.create_index("ix_trace_record_project_id", "trace_record", ["project_id"])


def downgrade() -> None:
    """They are gone; the files of the records go when the server starts."""
    op.drop_table("trace_record")
    op.drop_table("trace")
