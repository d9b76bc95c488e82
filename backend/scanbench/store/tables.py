"""The tables. Whoever changes one writes a migration too; a test compares the two."""

from datetime import UTC, datetime

from sqlalchemy import (
    JSON,
    BigInteger,
    DateTime,
    Dialect,
    Double,
    ForeignKey,
    ForeignKeyConstraint,
    Index,
    LargeBinary,
    MetaData,
    String,
    Text,
    UniqueConstraint,
    false,
    true,
)
from sqlalchemy.orm import DeclarativeBase, Mapped, mapped_column
from sqlalchemy.types import TypeDecorator

NAME, PATH, AUTHOR, ID, ERROR = 100, 255, 100, 64, 255
"""Longest names, in characters. ERROR: an error with the details that tell it apart."""


class Moment(TypeDecorator[datetime]):
    """A moment in UTC. SQLite knows no time zones, so they are taken off on the way in and put on again on the way out."""

    impl = DateTime(timezone=True)
    cache_ok = True

    def process_bind_param(self, value: datetime | None, dialect: Dialect) -> datetime | None:
        """To the database."""
        if value is None:
            return None
        if value.tzinfo is None:
            raise ValueError(f"{value} has no time zone")
        moment = value.astimezone(UTC)
        return moment.replace(tzinfo=None) if dialect.name == "sqlite" else moment

    def process_result_value(self, value: datetime | None, dialect: Dialect) -> datetime | None:
        """From the database."""
        if value is None:
            return None
        return value.replace(tzinfo=UTC) if value.tzinfo is None else value.astimezone(UTC)


class Base(DeclarativeBase):
    """Constraints have names, so that a migration can change them."""

    metadata = MetaData(
        naming_convention={
            "ix": "ix_%(table_name)s_%(column_0_N_name)s",
            "uq": "uq_%(table_name)s_%(column_0_N_name)s",
            "fk": "fk_%(table_name)s_%(column_0_N_name)s",
            "pk": "pk_%(table_name)s",
        }
    )


class Project(Base):
    """A project; `version` is the number of its last accepted build."""

    __tablename__ = "project"
    __table_args__ = (UniqueConstraint("name"),)

    id: Mapped[int] = mapped_column(primary_key=True)
    name: Mapped[str] = mapped_column(String(NAME))
    model: Mapped[str] = mapped_column(String(ID))
    watch: Mapped[list[str]] = mapped_column(JSON)
    version: Mapped[int]
    created: Mapped[datetime] = mapped_column(Moment)


class File(Base):
    """A file of a project; a save must know the version it started from."""

    __tablename__ = "file"

    project_id: Mapped[int] = mapped_column(ForeignKey("project.id", ondelete="CASCADE"), primary_key=True)
    path: Mapped[str] = mapped_column(String(PATH), primary_key=True)
    text: Mapped[str] = mapped_column(Text)
    version: Mapped[int]
    author: Mapped[str] = mapped_column(String(AUTHOR))
    saved: Mapped[datetime] = mapped_column(Moment)


class Draft(Base):
    """A file as people edit it together, from the first time that somebody opened it."""

    __tablename__ = "draft"
    __table_args__ = (
        ForeignKeyConstraint(
            ["project_id", "path"], ["file.project_id", "file.path"], name="fk_draft_file", ondelete="CASCADE"
        ),
    )

    project_id: Mapped[int] = mapped_column(primary_key=True, autoincrement=False)
    path: Mapped[str] = mapped_column(String(PATH), primary_key=True)
    key: Mapped[str] = mapped_column(String(ID))
    """Nobody else's: a file that was deleted and made again has a different draft."""


class DraftPart(Base):
    """Changes of a draft; all of them together are the draft."""

    __tablename__ = "draft_part"
    __table_args__ = (
        ForeignKeyConstraint(
            ["project_id", "path"], ["draft.project_id", "draft.path"], name="fk_draft_part_draft", ondelete="CASCADE"
        ),
        Index(None, "project_id", "path"),
    )

    id: Mapped[int] = mapped_column(primary_key=True)
    project_id: Mapped[int]
    path: Mapped[str] = mapped_column(String(PATH))
    data: Mapped[bytes] = mapped_column(LargeBinary)


class ProgramVersion(Base):
    """An accepted build and its sources, so that a restart runs what ran."""

    __tablename__ = "program_version"

    project_id: Mapped[int] = mapped_column(ForeignKey("project.id", ondelete="CASCADE"), primary_key=True)
    version: Mapped[int] = mapped_column(primary_key=True, autoincrement=False)
    sources: Mapped[dict[str, str]] = mapped_column(JSON)
    hash: Mapped[str] = mapped_column(String(64))
    author: Mapped[str] = mapped_column(String(AUTHOR))
    at: Mapped[datetime] = mapped_column(Moment)
    label: Mapped[str] = mapped_column(String(NAME), server_default="")
    message: Mapped[str] = mapped_column(Text, server_default="")


class Instance(Base):
    """A virtual PLC that runs a project."""

    __tablename__ = "instance"
    __table_args__ = (UniqueConstraint("name"), Index(None, "project_id"))

    id: Mapped[int] = mapped_column(primary_key=True)
    project_id: Mapped[int] = mapped_column(ForeignKey("project.id", ondelete="CASCADE"))
    name: Mapped[str] = mapped_column(String(NAME))
    created: Mapped[datetime] = mapped_column(Moment)
    powered: Mapped[bool] = mapped_column(server_default=true())
    memory_mib: Mapped[int | None]
    cpu_percent: Mapped[int | None]
    run_mib: Mapped[int | None]
    look: Mapped[bool] = mapped_column(server_default=false())
    communication: Mapped[dict[str, object] | None] = mapped_column(JSON(none_as_null=True))


class Person(Base):
    """Somebody at a project, by name."""

    __tablename__ = "person"

    project_id: Mapped[int] = mapped_column(ForeignKey("project.id", ondelete="CASCADE"), primary_key=True)
    name: Mapped[str] = mapped_column(String(NAME), primary_key=True)
    colour: Mapped[int]


class ErrorHistory(Base):
    """One row for an instance, a version of its program, and an error (with the details that tell it apart from others of its
    kind) that was raised at least once on it."""

    __tablename__ = "error_history"

    instance_id: Mapped[int] = mapped_column(ForeignKey("instance.id", ondelete="CASCADE"), primary_key=True)
    program_version: Mapped[int] = mapped_column(primary_key=True, autoincrement=False)
    error: Mapped[str] = mapped_column(String(ERROR), primary_key=True)
    status: Mapped[str] = mapped_column(String(16))
    code: Mapped[str] = mapped_column(String(16))
    details: Mapped[str] = mapped_column(Text)
    generated_at: Mapped[datetime] = mapped_column(Moment)
    recovered_at: Mapped[datetime | None] = mapped_column(Moment)
    generated_scan: Mapped[int] = mapped_column(BigInteger)
    recovered_scan: Mapped[int | None] = mapped_column(BigInteger)
    recovered_by: Mapped[str] = mapped_column(String(AUTHOR), server_default="")
    recovered_way: Mapped[str | None] = mapped_column(String(16))
    acknowledged: Mapped[dict[str, object] | None] = mapped_column(JSON(none_as_null=True))
    by: Mapped[str] = mapped_column(String(AUTHOR))
    origin: Mapped[str] = mapped_column(String(16))
    count: Mapped[int]
    reaction_state: Mapped[str | None] = mapped_column(String(16))
    reaction: Mapped[dict[str, object] | None] = mapped_column(JSON(none_as_null=True))
    reaction_message: Mapped[str] = mapped_column(Text, server_default="")


class ProgramState(Base):
    """A point in a run that was kept to begin sweeps from; the run file is kept next to the database."""

    __tablename__ = "program_state"
    __table_args__ = (UniqueConstraint("project_id", "name"),)

    id: Mapped[int] = mapped_column(primary_key=True)
    project_id: Mapped[int] = mapped_column(ForeignKey("project.id", ondelete="CASCADE"))
    name: Mapped[str] = mapped_column(String(NAME))
    instance: Mapped[str] = mapped_column(String(NAME))
    scan: Mapped[int] = mapped_column(BigInteger)
    program_version: Mapped[int]
    by: Mapped[str] = mapped_column(String(AUTHOR))
    at: Mapped[datetime] = mapped_column(Moment)


class Sweep(Base):
    """Every error alone from every state. It outlives its instance: it is evidence."""

    __tablename__ = "sweep"
    __table_args__ = (Index(None, "project_id"),)

    id: Mapped[int] = mapped_column(primary_key=True)
    project_id: Mapped[int] = mapped_column(ForeignKey("project.id", ondelete="CASCADE"))
    instance_id: Mapped[int | None] = mapped_column(ForeignKey("instance.id", ondelete="SET NULL"))
    instance: Mapped[str] = mapped_column(String(NAME))
    model: Mapped[str] = mapped_column(String(ID))
    program_version: Mapped[int]
    by: Mapped[str] = mapped_column(String(AUTHOR))
    at: Mapped[datetime] = mapped_column(Moment)
    status: Mapped[str] = mapped_column(String(16))
    message: Mapped[str] = mapped_column(Text)
    window: Mapped[int]
    states: Mapped[list[str]] = mapped_column(JSON)
    errors: Mapped[list[dict[str, str]]] = mapped_column(JSON)
    problems: Mapped[list[dict[str, object]]] = mapped_column(JSON, server_default="[]")
    seconds: Mapped[float] = mapped_column(Double)


class SweepCell(Base):
    """One error from one state. What lists show is in columns, so that a matrix is read without its reactions."""

    __tablename__ = "sweep_cell"

    sweep_id: Mapped[int] = mapped_column(ForeignKey("sweep.id", ondelete="CASCADE"), primary_key=True)
    error: Mapped[str] = mapped_column(String(ERROR), primary_key=True)
    state: Mapped[str] = mapped_column(String(NAME), primary_key=True)
    raised_scan: Mapped[int] = mapped_column(BigInteger)
    verdict: Mapped[str | None] = mapped_column(String(16))
    first_read: Mapped[int | None]
    first_effect: Mapped[int | None]
    difference_count: Mapped[int]
    note: Mapped[str] = mapped_column(Text)
    required: Mapped[int] = mapped_column(server_default="0")
    unmet: Mapped[int] = mapped_column(server_default="0")
    untried: Mapped[list[dict[str, object]]] = mapped_column(JSON, server_default="[]")
    reaction: Mapped[dict[str, object] | None] = mapped_column(JSON(none_as_null=True), deferred=True)


class AcceptedFinding(Base):
    """Somebody accepted that a program does not react to an error in a state."""

    __tablename__ = "accepted_finding"

    project_id: Mapped[int] = mapped_column(ForeignKey("project.id", ondelete="CASCADE"), primary_key=True)
    error: Mapped[str] = mapped_column(String(ERROR), primary_key=True)
    state: Mapped[str] = mapped_column(String(NAME), primary_key=True)
    reason: Mapped[str] = mapped_column(Text)
    by: Mapped[str] = mapped_column(String(AUTHOR))
    at: Mapped[datetime] = mapped_column(Moment)


class TestRecord(Base):
    """A test record that came from elsewhere, as it came."""

    __tablename__ = "test_record"
    __table_args__ = (Index(None, "project_id"),)

    id: Mapped[int] = mapped_column(primary_key=True)
    project_id: Mapped[int] = mapped_column(ForeignKey("project.id", ondelete="CASCADE"))
    title: Mapped[str] = mapped_column(String(PATH))
    text: Mapped[str] = mapped_column(Text, deferred=True)
    by: Mapped[str] = mapped_column(String(AUTHOR))
    at: Mapped[datetime] = mapped_column(Moment)


class WatchList(Base):
    """A watch list of a project; `owner` is empty when everybody shares it. A save must know the version it started from."""

    __tablename__ = "watch_list"
    __table_args__ = (UniqueConstraint("project_id", "owner", "name"),)

    id: Mapped[int] = mapped_column(primary_key=True)
    project_id: Mapped[int] = mapped_column(ForeignKey("project.id", ondelete="CASCADE"))
    owner: Mapped[str] = mapped_column(String(AUTHOR))
    name: Mapped[str] = mapped_column(String(NAME))
    content: Mapped[dict[str, object]] = mapped_column(JSON)
    version: Mapped[int]
    by: Mapped[str] = mapped_column(String(AUTHOR))
    at: Mapped[datetime] = mapped_column(Moment)


class Breakpoint(Base):
    """A breakpoint of the list that everybody at an instance shares."""

    __tablename__ = "breakpoint"

    instance_id: Mapped[int] = mapped_column(ForeignKey("instance.id", ondelete="CASCADE"), primary_key=True)
    number: Mapped[int] = mapped_column(primary_key=True, autoincrement=False)
    content: Mapped[dict[str, object]] = mapped_column(JSON)


class Trace(Base):
    """A trace of an instance: what it records, and whether it does."""

    __tablename__ = "trace"

    instance_id: Mapped[int] = mapped_column(ForeignKey("instance.id", ondelete="CASCADE"), primary_key=True)
    number: Mapped[int] = mapped_column(primary_key=True, autoincrement=False)
    content: Mapped[dict[str, object]] = mapped_column(JSON)


class TraceRecord(Base):
    """A record of a trace that was kept; the samples are files next to the database."""

    __tablename__ = "trace_record"
    __table_args__ = (Index(None, "project_id"),)

    id: Mapped[int] = mapped_column(primary_key=True)
    project_id: Mapped[int] = mapped_column(ForeignKey("project.id", ondelete="CASCADE"))
    name: Mapped[str] = mapped_column(String(NAME))
    instance: Mapped[str] = mapped_column(String(NAME))
    content: Mapped[dict[str, object]] = mapped_column(JSON)
    by: Mapped[str] = mapped_column(String(AUTHOR))
    at: Mapped[datetime] = mapped_column(Moment)


class VerificationRecord(Base):
    """A verification that was kept; its rows are files next to the database."""

    __tablename__ = "verification_record"
    __table_args__ = (Index(None, "project_id"),)

    id: Mapped[int] = mapped_column(primary_key=True)
    project_id: Mapped[int] = mapped_column(ForeignKey("project.id", ondelete="CASCADE"))
    name: Mapped[str] = mapped_column(String(NAME))
    instance: Mapped[str] = mapped_column(String(NAME))
    content: Mapped[dict[str, object]] = mapped_column(JSON)
    by: Mapped[str] = mapped_column(String(AUTHOR))
    at: Mapped[datetime] = mapped_column(Moment)


class TraceMap(Base):
    """How the columns of a trace file are meant."""

    __tablename__ = "trace_mapping"
    __table_args__ = (UniqueConstraint("project_id", "name"),)

    id: Mapped[int] = mapped_column(primary_key=True)
    project_id: Mapped[int] = mapped_column(ForeignKey("project.id", ondelete="CASCADE"))
    name: Mapped[str] = mapped_column(String(NAME))
    content: Mapped[dict[str, object]] = mapped_column(JSON)
    by: Mapped[str] = mapped_column(String(AUTHOR))
    at: Mapped[datetime] = mapped_column(Moment)


class Log(Base):
    """What was done to an instance, in order."""

    __tablename__ = "log"
    __table_args__ = (Index(None, "instance_id", "id"),)

    id: Mapped[int] = mapped_column(primary_key=True)
    instance_id: Mapped[int] = mapped_column(ForeignKey("instance.id", ondelete="CASCADE"))
    at: Mapped[datetime] = mapped_column(Moment)
    scan: Mapped[int] = mapped_column(BigInteger)
    author: Mapped[str] = mapped_column(String(AUTHOR))
    kind: Mapped[str] = mapped_column(String(16))
    text: Mapped[str] = mapped_column(Text)
    program_version: Mapped[int | None]
