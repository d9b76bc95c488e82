"""History of every program version, reactions, kept states, sweeps, accepted findings, imported records."""

import sqlalchemy as sa
from alembic import op

revision = "0003"
down_revision = "0002"
branch_labels = None
depends_on = None

MOMENT = sa.DateTime(timezone=True)


def upgrade() -> None:
    """What is there already stays with the version that it was recorded on."""
    with op.batch_alter_table("error_history") as table:
        table.add_column(sa.Column("reaction", sa.JSON(none_as_null=True), nullable=True))
        table.add_column(sa.Column("reaction_state", sa.String(16), nullable=True))
        table.add_column(sa.Column("reaction_message", sa.Text, nullable=False, server_default=""))
        table.drop_constraint("pk_error_history", type_="primary")
        table.create_primary_key("pk_error_history", ["instance_id", "program_version", "error"])
    op.add_column("log", sa.Column("program_version", sa.Integer, nullable=True))
    op.create_table(
        "program_state",
        sa.Column("id", sa.Integer, nullable=False),
        sa.Column("project_id", sa.Integer, nullable=False),
        sa.Column("name", sa.String(100), nullable=False),
        sa.Column("instance", sa.String(100), nullable=False),
        sa.Column("scan", sa.BigInteger, nullable=False),
        sa.Column("program_version", sa.Integer, nullable=False),
        sa.Column("by", sa.String(100), nullable=False),
        sa.Column("at", MOMENT, nullable=False),
        sa.PrimaryKeyConstraint("id", name="pk_program_state"),
        sa.UniqueConstraint("project_id", "name", name="uq_program_state_project_id_name"),
        _cascade("program_state", "project"),
    )
    _sweeps()
    op.create_table(
        "accepted_finding",
        sa.Column("project_id", sa.Integer, nullable=False),
        sa.Column("error", sa.String(64), nullable=False),
        sa.Column("state", sa.String(100), nullable=False),
        sa.Column("reason", sa.Text, nullable=False),
        sa.Column("by", sa.String(100), nullable=False),
        sa.Column("at", MOMENT, nullable=False),
        sa.PrimaryKeyConstraint("project_id", "error", "state", name="pk_accepted_finding"),
        _cascade("accepted_finding", "project"),
    )
    op.create_table(
        "test_record",
        sa.Column("id", sa.Integer, nullable=False),
        sa.Column("project_id", sa.Integer, nullable=False),
        sa.Column("title", sa.String(255), nullable=False),
        sa.Column("text", sa.Text, nullable=False),
        sa.Column("by", sa.String(100), nullable=False),
        sa.Column("at", MOMENT, nullable=False),
        sa.PrimaryKeyConstraint("id", name="pk_test_record"),
        _cascade("test_record", "project"),
    )
    op.create_index("ix_test_record_project_id", "test_record", ["project_id"])


def _sweeps() -> None:
    op.create_table(
        "sweep",
        sa.Column("id", sa.Integer, nullable=False),
        sa.Column("project_id", sa.Integer, nullable=False),
        sa.Column("instance_id", sa.Integer, nullable=True),
        sa.Column("instance", sa.String(100), nullable=False),
        sa.Column("model", sa.String(64), nullable=False),
        sa.Column("program_version", sa.Integer, nullable=False),
        sa.Column("by", sa.String(100), nullable=False),
        sa.Column("at", MOMENT, nullable=False),
        sa.Column("status", sa.String(16), nullable=False),
        sa.Column("message", sa.Text, nullable=False),
        sa.Column("window", sa.Integer, nullable=False),
        sa.Column("states", sa.JSON, nullable=False),
        sa.Column("errors", sa.JSON, nullable=False),
        sa.Column("seconds", sa.Double, nullable=False),
        sa.PrimaryKeyConstraint("id", name="pk_sweep"),
        sa.ForeignKeyConstraint(["instance_id"], ["instance.id"], name="fk_sweep_instance_id", ondelete="SET NULL"),
        _cascade("sweep", "project"),
    )
    op.create_index("ix_sweep_project_id", "sweep", ["project_id"])
    op.create_table(
        "sweep_cell",
        sa.Column("sweep_id", sa.Integer, nullable=False),
        sa.Column("error", sa.String(64), nullable=False),
        sa.Column("state", sa.String(100), nullable=False),
        sa.Column("raised_scan", sa.BigInteger, nullable=False),
        sa.Column("verdict", sa.String(16), nullable=True),
        sa.Column("first_read", sa.Integer, nullable=True),
        sa.Column("first_effect", sa.Integer, nullable=True),
        sa.Column("difference_count", sa.Integer, nullable=False),
        sa.Column("note", sa.Text, nullable=False),
        sa.Column("reaction", sa.JSON(none_as_null=True), nullable=True),
        sa.PrimaryKeyConstraint("sweep_id", "error", "state", name="pk_sweep_cell"),
        _cascade("sweep_cell", "sweep"),
    )


def _cascade(table: str, parent: str) -> sa.ForeignKeyConstraint:
    column = f"{parent}_id"
    return sa.ForeignKeyConstraint([column], [f"{parent}.id"], name=f"fk_{table}_{column}", ondelete="CASCADE")


def downgrade() -> None:
    """What only these tables can keep is gone; of each error the row of the newest version stays."""
    for table in ("test_record", "accepted_finding", "sweep_cell", "sweep", "program_state"):
        op.drop_table(table)
    op.drop_column("log", "program_version")
    op.execute(
        "DELETE FROM error_history WHERE program_version < (SELECT MAX(other.program_version) FROM error_history AS"
        " other WHERE other.instance_id = error_history.instance_id AND other.error = error_history.error)"
    )
    with op.batch_alter_table("error_history") as history:
        history.drop_constraint("pk_error_history", type_="primary")
        history.create_primary_key("pk_error_history", ["instance_id", "error"])
        for column in ("reaction", "reaction_state", "reaction_message"):
            history.drop_column(column)
