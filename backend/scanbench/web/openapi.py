"""`python -m scanbench.web.openapi FILE`: the OpenAPI document, WebSocket messages included.

The frontend's types are generated from it.
"""

import json
import sys
from functools import cache
from pathlib import Path
from typing import cast

from pydantic import TypeAdapter

from scanbench.web import messages as wire
from scanbench.web import messages_client as client
from scanbench.web.app import bare_app
from scanbench.web.component_names import REFERENCE, by_title


@cache
def document() -> dict[str, object]:
    """The REST API's description with the two message unions and everything they hold as components; nobody changes it."""
    api = bare_app().openapi()
    schemas = cast(dict[str, object], api["components"]["schemas"])
    unions = {
        "ClientMessage": TypeAdapter[client.ClientMessage](client.ClientMessage).json_schema(ref_template=_TEMPLATE),
        "ServerMessage": TypeAdapter[wire.ServerMessage](wire.ServerMessage).json_schema(ref_template=_TEMPLATE),
    }
    for name, schema in unions.items():
        held, schema = by_title(cast(dict[str, object], schema.pop("$defs")), schema)
        schemas.update(held)
        schemas[name] = schema
    return cast(dict[str, object], api)


_TEMPLATE = REFERENCE + "{model}"


def main(arguments: list[str]) -> int:
    """Writes the document into the file named."""
    if len(arguments) != 1:
        sys.stderr.write("usage: python -m scanbench.web.openapi FILE\n")
        return 2
    Path(arguments[0]).write_text(json.dumps(document(), indent=1, sort_keys=True) + "\n", "utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
