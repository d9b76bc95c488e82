"""Drafts: files as people edit them together."""

import sqlalchemy as sa
from alembic import op

revision = "0010"
down_revision = "0009"
branch_labels = None
depends_on = None


def upgrade() -> None:
    """A draft hangs on its file, its parts on the draft."""
    op.create_table(
        "draft",
        sa.Column("project_id", sa.Integer, nullable=False),
        sa.Column("path", sa.String(255), nullable=False),
        sa.Column("key", sa.String(64), nullable=False),
        sa.PrimaryKeyConstraint("project_id", "path", name="pk_draft"),
        sa.ForeignKeyConstraint(
            ["project_id", "path"], ["file.project_id", "file.path"], name="fk_draft_file", ondelete="CASCADE"
        ),
    )
    op.create_table(
        "draft_part",
        sa.Column("id", sa.Integer, nullable=False),
        sa.Column("project_id", sa.Integer, nullable=False),
        sa.Column("path", sa.String(255), nullable=False),
        sa.Column("data", sa.LargeBinary, nullable=False),
        sa.PrimaryKeyConstraint("id", name="pk_draft_part"),
        sa.ForeignKeyConstraint(
            ["project_id", "path"], ["draft.project_id", "draft.path"], name="fk_draft_part_draft", ondelete="CASCADE"
        ),
    )
    op.create_index("ix_draft_part_project_id_path", "draft_part", ["project_id", "path"])
