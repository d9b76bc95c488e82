"""Cells of sweeps say what became of required reactions in columns of their own, so that a list of cells need not decode the reactions;
and what could not be tried is kept: of an error that could not be raised, and of a mistake in the file of requirements."""

from collections.abc import Mapping

import sqlalchemy as sa
from alembic import op

revision = "0014"
down_revision = "0013"
branch_labels = None
depends_on = None

_UNMET = ("window", "invalid", "ended", "not_recovered")
_CELLS = sa.table(
    "sweep_cell", sa.column("sweep_id", sa.Integer), sa.column("error", sa.String), sa.column("state", sa.String),
    sa.column("reaction", sa.JSON(none_as_null=True)), sa.column("required", sa.Integer), sa.column("unmet", sa.Integer),
)  # fmt: skip


def upgrade() -> None:
    """Of cells of before it is counted once, here."""
    op.add_column("sweep", sa.Column("problems", sa.JSON, server_default="[]", nullable=False))
    for name in ("required", "unmet"):
        op.add_column("sweep_cell", sa.Column(name, sa.Integer, server_default="0", nullable=False))
    op.add_column("sweep_cell", sa.Column("untried", sa.JSON, server_default="[]", nullable=False))
    connection, at = op.get_bind(), _CELLS.c
    sweeps = connection.execute(sa.select(at.sweep_id).distinct().order_by(at.sweep_id)).scalars().all()
    for sweep in sweeps:  # one after the other: the reactions of all of them may be more than the memory
        found = sa.select(at.error, at.state, at.reaction).where(at.sweep_id == sweep, at.reaction.is_not(None))
        for error, state, reaction in connection.execute(found).all():
            required, unmet = _judged(reaction if isinstance(reaction, dict) else {})
            if required or unmet:
                one = (at.sweep_id == sweep, at.error == error, at.state == state)
                connection.execute(sa.update(_CELLS).where(*one).values(required=required, unmet=unmet))


def _judged(reaction: Mapping[str, object]) -> tuple[int, int]:
    """How many requirements it has, and how much is not as it is required, unexpected restarts counted."""
    rows, went = _objects(reaction.get("required")), _objects(reaction.get("restarts"))
    unmet = sum(each.get("outcome") == "failed" or each.get("reason") in _UNMET for each in rows)
    return len(rows), unmet + sum(not each.get("allowed_by") for each in went)


def _objects(told: object) -> list[dict[str, object]]:
    return [each for each in told if isinstance(each, dict)] if isinstance(told, list) else []
