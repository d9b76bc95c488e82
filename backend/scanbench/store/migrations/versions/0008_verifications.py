"""Verifications that somebody kept, and mappings of trace files."""

import sqlalchemy as sa
from alembic import op

revision = "0008"
down_revision = "0007"
branch_labels = None
depends_on = None


def upgrade() -> None:
    """None yet."""
    op.create_table(
        "verification_record",
        sa.Column("id", sa.Integer, nullable=False),
        sa.Column("project_id", sa.Integer, nullable=False),
        sa.Column("name", sa.String(100), nullable=False),
        sa.Column("instance", sa.String(100), nullable=False),
        sa.Column("content", sa.JSON, nullable=False),
        sa.Column("by", sa.String(100), nullable=False),
        sa.Column("at", sa.DateTime(timezone=True), nullable=False),
        sa.PrimaryKeyConstraint("id", name="pk_verification_record"),
        sa.ForeignKeyConstraint(
            ["project_id"], ["project.id"], name="fk_verification_record_project_id", ondelete="CASCADE"
        ),
    )
    op.create_index("ix_verification_record_project_id", "verification_record", ["project_id"])
    op.create_table(
        "trace_mapping",
        sa.Column("id", sa.Integer, nullable=False),
        sa.Column("project_id", sa.Integer, nullable=False),
        sa.Column("name", sa.String(100), nullable=False),
        sa.Column("content", sa.JSON, nullable=False),
        sa.Column("by", sa.String(100), nullable=False),
        sa.Column("at", sa.DateTime(timezone=True), nullable=False),
        sa.PrimaryKeyConstraint("id", name="pk_trace_mapping"),
        sa.UniqueConstraint("project_id", "name", name="uq_trace_mapping_project_id_name"),
        sa.ForeignKeyConstraint(["project_id"], ["project.id"], name="fk_trace_mapping_project_id", ondelete="CASCADE"),
    )


def downgrade() -> None:
    """They are gone; the files of the records go when the server starts."""
    op.drop_table("trace_mapping")
    op.drop_table("verification_record")
