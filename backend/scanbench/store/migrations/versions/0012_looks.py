"""A PLC can be a look at the past of one person; people of a project keep their colour."""

import sqlalchemy as sa
from alembic import op

revision = "0012"
down_revision = "0011"
branch_labels = None
depends_on = None


def upgrade() -> None:
    """PLCs of before are nobody's look."""
    op.add_column("instance", sa.Column("look", sa.Boolean, server_default=sa.false(), nullable=False))
    op.create_table(
        "person",
        sa.Column("project_id", sa.Integer, nullable=False),
        sa.Column("name", sa.String(100), nullable=False),
        sa.Column("colour", sa.Integer, nullable=False),
        sa.PrimaryKeyConstraint("project_id", "name", name="pk_person"),
        sa.ForeignKeyConstraint(
            ["project_id"], ["project.id"], name="fk_person_project_id_project", ondelete="CASCADE"
        ),
    )
