"""The files of the built page: compressed where the browser takes that, and kept by it where the name says what is in them."""

import os
from collections.abc import Mapping

from starlette.datastructures import Headers
from starlette.responses import Response
from starlette.staticfiles import StaticFiles
from starlette.types import Scope

_BY_CONTENT = "assets/"
"""Names here contain a hash of the file's content: a file that changes gets a new name."""


class BuiltFiles(StaticFiles):
    """What is not there is not found: so too all of it, as long as nothing was built."""

    async def check_config(self) -> None:
        """Starlette's own fails without a directory."""

    async def get_response(self, path: str, scope: Scope) -> Response:
        """The file; for how long a browser may keep it without asking again."""
        response = await super().get_response(path, scope)
        lasts = path.startswith(_BY_CONTENT)
        response.headers["Cache-Control"] = "public, max-age=31536000, immutable" if lasts else "no-cache"
        return response

    def file_response(
        self, full_path: str | os.PathLike[str], stat_result: os.stat_result, scope: Scope, status_code: int = 200
    ) -> Response:
        """The compressed version of the file, if there is one and the browser accepts it."""
        packed = f"{os.fspath(full_path)}.gz"
        if not os.path.isfile(packed):
            return super().file_response(full_path, stat_result, scope, status_code)
        takes = _takes_gzip(Headers(scope=scope))
        if takes:
            full_path, stat_result = packed, os.stat(packed)
        response = super().file_response(full_path, stat_result, scope, status_code)
        response.headers["Vary"] = "Accept-Encoding"
        if takes:
            response.headers["Content-Encoding"] = "gzip"
        return response


def _takes_gzip(headers: Mapping[str, str]) -> bool:
    for offer in headers.get("accept-encoding", "").lower().split(","):
        name, _, weight = offer.partition(";")
        if name.strip() == "gzip":
            return weight.replace(" ", "") not in ("q=0", "q=0.0", "q=0.00", "q=0.000")
    return False
