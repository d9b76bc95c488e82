"""Large answers take less room on the wire: samples of traces, and JSON."""

from starlette.middleware.gzip import GZipMiddleware
from starlette.types import ASGIApp

MIN_BYTES = 2000
"""Less fits into two packets anyway."""
_LEVEL = 3
"""Samples come ten times a second: a higher one takes three times as long for a few per cent."""
AS_IT_IS = {"Content-Encoding": "identity"}
"""The header of an answer that is compressed by itself, as a run file."""


def compressed(app: ASGIApp) -> ASGIApp:
    """Around what makes whole texts. Events and sockets are not touched, nor what is compressed already, as built files and archives."""
    return GZipMiddleware(app, MIN_BYTES, _LEVEL)
