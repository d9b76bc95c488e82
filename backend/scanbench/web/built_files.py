"""The files of the built page: compressed where the browser takes that, and kept by it where the name says what is in them."""

import os
from collections.abc import Mapping

from starlette.datastructures import Headers
from starlette.responses import Response
from starlette.staticfiles import StaticFiles
from starlette.types import Scope

_BY_CONTENT = "assets/"
"""Names here contain a hash of the file's content: a file that changes gets a new name."""
_CODINGS = {"br": "br", "gzip": "gz"}
"""What the build makes of each file, the smallest first, with the ending of its name. Browsers take Brotli by https, and from this
computer."""


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
        """The smallest compressed version of the file that there is and that the browser accepts."""
        packed = {coding: f"{os.fspath(full_path)}.{ending}" for coding, ending in _CODINGS.items()}
        there = [coding for coding, path in packed.items() if os.path.isfile(path)]
        taken = next((coding for coding in there if _takes(Headers(scope=scope), coding)), None)
        if taken is not None:
            full_path, stat_result = packed[taken], os.stat(packed[taken])
        response = super().file_response(full_path, stat_result, scope, status_code)
        if there:
            response.headers["Vary"] = "Accept-Encoding"
        if taken is not None:
            response.headers["Content-Encoding"] = taken
        return response


def _takes(headers: Mapping[str, str], coding: str) -> bool:
    for offer in headers.get("accept-encoding", "").lower().split(","):
        name, _, weight = offer.partition(";")
        if name.strip() == coding:
            return weight.replace(" ", "") not in ("q=0", "q=0.0", "q=0.00", "q=0.000")
    return False
