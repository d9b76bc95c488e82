"""Integers with room for what 64 bits cannot hold. Only temporaries that no program names have these types."""

from scanbench.program.types import Elementary, Kind

WIDE = Elementary("$INT128", Kind.INT, 16)
WIDE_UNSIGNED = Elementary("$UINT128", Kind.UINT, 16)
