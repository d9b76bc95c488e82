"""Watch lists, shared or somebody's own."""

import sqlalchemy as sa
from alembic import op

revision = "0005"
down_revision = "0003"
branch_labels = None
depends_on = None


def upgrade() -> None:
    """None yet: a fresh list begins with what its project says."""
    op.create_table(
        "watch_list",
        sa.Column("id", sa.Integer, nullable=False),
        sa.Column("project_id", sa.Integer, nullable=False),
        sa.Column("owner", sa.String(100), nullable=False),
        sa.Column("name", sa.String(100), nullable=False),
        sa.Column("content", sa.JSON, nullable=False),
        sa.Column("version", sa.Integer, nullable=False),
        sa.Column("by", sa.String(100), nullable=False),
        sa.Column("at", sa.DateTime(timezone=True), nullable=False),
        sa.PrimaryKeyConstraint("id", name="pk_watch_list"),
        sa.UniqueConstraint("project_id", "owner", "name", name="uq_watch_list_project_id_owner_name"),
        sa.ForeignKeyConstraint(["project_id"], ["project.id"], name="fk_watch_list_project_id", ondelete="CASCADE"),
    )


def downgrade() -> None:
    """The lists are gone."""
    op.drop_table("watch_list")
