"""All tables of release 0.1.0. From here on a change of the tables is a migration of its own: this file stays as it is."""

import sqlalchemy as sa
from alembic import op

revision = "0008"
down_revision = None
branch_labels = None
depends_on = None

MOMENT = sa.DateTime(timezone=True)


def upgrade() -> None:
    """Create them, those first that others refer to."""
    _projects()
    _instances()
    _of_instances()
    _sweeps()
    _findings()
    _records()
    _lists()


def _projects() -> None:
    """Projects, their files, builds and states."""
    op.create_table(
        "project",
        sa.Column("id", sa.Integer, nullable=False),
        sa.Column("name", sa.String(100), nullable=False),
        sa.Column("model", sa.String(64), nullable=False),
        sa.Column("watch", sa.JSON, nullable=False),
        sa.Column("version", sa.Integer, nullable=False),
        sa.Column("created", MOMENT, nullable=False),
        sa.PrimaryKeyConstraint("id", name="pk_project"),
        sa.UniqueConstraint("name", name="uq_project_name"),
    )
    op.create_table(
        "file",
        sa.Column("project_id", sa.Integer, nullable=False),
        sa.Column("path", sa.String(255), nullable=False),
        sa.Column("text", sa.Text, nullable=False),
        sa.Column("version", sa.Integer, nullable=False),
        sa.Column("author", sa.String(100), nullable=False),
        sa.Column("saved", MOMENT, nullable=False),
        sa.PrimaryKeyConstraint("project_id", "path", name="pk_file"),
        _cascade("file", "project"),
    )
    op.create_table(
        "program_version",
        sa.Column("project_id", sa.Integer, nullable=False),
        sa.Column("version", sa.Integer, nullable=False),
        sa.Column("sources", sa.JSON, nullable=False),
        sa.Column("hash", sa.String(64), nullable=False),
        sa.Column("author", sa.String(100), nullable=False),
        sa.Column("at", MOMENT, nullable=False),
        sa.PrimaryKeyConstraint("project_id", "version", name="pk_program_version"),
        _cascade("program_version", "project"),
    )
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


def _instances() -> None:
    """Instances, and the history of their errors."""
    op.create_table(
        "instance",
        sa.Column("id", sa.Integer, nullable=False),
        sa.Column("project_id", sa.Integer, nullable=False),
        sa.Column("name", sa.String(100), nullable=False),
        sa.Column("created", MOMENT, nullable=False),
        sa.Column("powered", sa.Boolean, nullable=False, server_default=sa.true()),
        sa.Column("memory_mib", sa.Integer, nullable=True),
        sa.Column("cpu_percent", sa.Integer, nullable=True),
        sa.Column("run_mib", sa.Integer, nullable=True),
        sa.PrimaryKeyConstraint("id", name="pk_instance"),
        sa.UniqueConstraint("name", name="uq_instance_name"),
        _cascade("instance", "project"),
    )
    op.create_index("ix_instance_project_id", "instance", ["project_id"])
    op.create_table(
        "error_history",
        sa.Column("instance_id", sa.Integer, nullable=False),
        sa.Column("error", sa.String(64), nullable=False),
        sa.Column("program_version", sa.Integer, nullable=False),
        sa.Column("status", sa.String(16), nullable=False),
        sa.Column("code", sa.String(16), nullable=False),
        sa.Column("details", sa.Text, nullable=False),
        sa.Column("generated_at", MOMENT, nullable=False),
        sa.Column("recovered_at", MOMENT, nullable=True),
        sa.Column("generated_scan", sa.BigInteger, nullable=False),
        sa.Column("recovered_scan", sa.BigInteger, nullable=True),
        sa.Column("by", sa.String(100), nullable=False),
        sa.Column("origin", sa.String(16), nullable=False),
        sa.Column("count", sa.Integer, nullable=False),
        sa.Column("reaction", sa.JSON(none_as_null=True), nullable=True),
        sa.Column("reaction_state", sa.String(16), nullable=True),
        sa.Column("reaction_message", sa.Text, nullable=False, server_default=""),
        sa.PrimaryKeyConstraint("instance_id", "program_version", "error", name="pk_error_history"),
        _cascade("error_history", "instance"),
    )


def _of_instances() -> None:
    """What else is kept of an instance."""
    op.create_table(
        "log",
        sa.Column("id", sa.Integer, nullable=False),
        sa.Column("instance_id", sa.Integer, nullable=False),
        sa.Column("at", MOMENT, nullable=False),
        sa.Column("scan", sa.BigInteger, nullable=False),
        sa.Column("author", sa.String(100), nullable=False),
        sa.Column("kind", sa.String(16), nullable=False),
        sa.Column("text", sa.Text, nullable=False),
        sa.Column("program_version", sa.Integer, nullable=True),
        sa.PrimaryKeyConstraint("id", name="pk_log"),
        _cascade("log", "instance"),
    )
    op.create_index("ix_log_instance_id_id", "log", ["instance_id", "id"])
    op.create_table(
        "breakpoint",
        sa.Column("instance_id", sa.Integer, nullable=False),
        sa.Column("number", sa.Integer, autoincrement=False, nullable=False),
        sa.Column("content", sa.JSON, nullable=False),
        sa.PrimaryKeyConstraint("instance_id", "number", name="pk_breakpoint"),
        _cascade("breakpoint", "instance"),
    )
    op.create_table(
        "trace",
        sa.Column("instance_id", sa.Integer, nullable=False),
        sa.Column("number", sa.Integer, autoincrement=False, nullable=False),
        sa.Column("content", sa.JSON, nullable=False),
        sa.PrimaryKeyConstraint("instance_id", "number", name="pk_trace"),
        _cascade("trace", "instance"),
    )


def _sweeps() -> None:
    """Sweeps of errors."""
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


def _findings() -> None:
    """What somebody accepted, and test records that somebody imported."""
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


def _records() -> None:
    """What somebody kept."""
    op.create_table(
        "trace_record",
        sa.Column("id", sa.Integer, nullable=False),
        sa.Column("project_id", sa.Integer, nullable=False),
        sa.Column("name", sa.String(100), nullable=False),
        sa.Column("instance", sa.String(100), nullable=False),
        sa.Column("content", sa.JSON, nullable=False),
        sa.Column("by", sa.String(100), nullable=False),
        sa.Column("at", MOMENT, nullable=False),
        sa.PrimaryKeyConstraint("id", name="pk_trace_record"),
        _cascade("trace_record", "project"),
    )
    op.create_index("ix_trace_record_project_id", "trace_record", ["project_id"])
    op.create_table(
        "verification_record",
        sa.Column("id", sa.Integer, nullable=False),
        sa.Column("project_id", sa.Integer, nullable=False),
        sa.Column("name", sa.String(100), nullable=False),
        sa.Column("instance", sa.String(100), nullable=False),
        sa.Column("content", sa.JSON, nullable=False),
        sa.Column("by", sa.String(100), nullable=False),
        sa.Column("at", MOMENT, nullable=False),
        sa.PrimaryKeyConstraint("id", name="pk_verification_record"),
        _cascade("verification_record", "project"),
    )
    op.create_index("ix_verification_record_project_id", "verification_record", ["project_id"])


def _lists() -> None:
    """Watch lists, and mappings of trace files."""
    op.create_table(
        "watch_list",
        sa.Column("id", sa.Integer, nullable=False),
        sa.Column("project_id", sa.Integer, nullable=False),
        sa.Column("owner", sa.String(100), nullable=False),
        sa.Column("name", sa.String(100), nullable=False),
        sa.Column("content", sa.JSON, nullable=False),
        sa.Column("version", sa.Integer, nullable=False),
        sa.Column("by", sa.String(100), nullable=False),
        sa.Column("at", MOMENT, nullable=False),
        sa.PrimaryKeyConstraint("id", name="pk_watch_list"),
        sa.UniqueConstraint("project_id", "owner", "name", name="uq_watch_list_project_id_owner_name"),
        _cascade("watch_list", "project"),
    )
    op.create_table(
        "trace_mapping",
        sa.Column("id", sa.Integer, nullable=False),
        sa.Column("project_id", sa.Integer, nullable=False),
        sa.Column("name", sa.String(100), nullable=False),
        sa.Column("content", sa.JSON, nullable=False),
        sa.Column("by", sa.String(100), nullable=False),
        sa.Column("at", MOMENT, nullable=False),
        sa.PrimaryKeyConstraint("id", name="pk_trace_mapping"),
        sa.UniqueConstraint("project_id", "name", name="uq_trace_mapping_project_id_name"),
        _cascade("trace_mapping", "project"),
    )


def _cascade(table: str, parent: str) -> sa.ForeignKeyConstraint:
    column = f"{parent}_id"
    return sa.ForeignKeyConstraint([column], [f"{parent}.id"], name=f"fk_{table}_{column}", ondelete="CASCADE")
