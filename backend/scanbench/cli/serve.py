"""`scanbench serve`: the server with the browser IDE."""

from pathlib import Path

import typer

from scanbench.cli.inputs import usage
from scanbench.cli.settings import settings
from scanbench.garbage import without_collection


def serve(
    host: str | None = typer.Option(
        None, envvar="SCANBENCH_HOST", show_default="127.0.0.1",
        help="Address to listen on; the default is reachable from this machine only.",
    ),
    port: int | None = typer.Option(
        None, min=0, max=65535, envvar="SCANBENCH_PORT", help="Port; default 8700, or a free one if that is taken. 0: any free one."
    ),
    public_url: str = typer.Option(
        "", metavar="URL", envvar="SCANBENCH_PUBLIC_URL",
        help="Address that people open, e.g. https://bench.example.com: a name in DNS, or that of a proxy. Links begin with it.",
    ),
    data: Path | None = typer.Option(
        None, metavar="DIR", envvar="SCANBENCH_DATA", show_default="~/.local/share/scanbench; ./data where a server has used it",
        help="Folder for the database and the runs; made when it is missing.",
    ),
) -> None:  # fmt: skip
    """Start the server; the address to open, with its token, is printed when it is ready.

    The options --host, --port and --data may be set in ~/.config/scanbench/config.toml too.
    """
    with without_collection():
        from scanbench.web.public_url import BadPublicUrl, parse_public_url
        from scanbench.web.serve import CannotServe
        from scanbench.web.serve import serve as serve_web

    chosen = settings(host, port, data)
    folder = chosen.data.absolute()
    typer.echo(f"data in {folder}", err=True)
    try:
        public = parse_public_url(public_url) if public_url.strip() else None
        serve_web(chosen.host, chosen.port, chosen.data, typer.echo, public=public)
    except (BadPublicUrl, CannotServe) as error:
        usage(str(error))
    except OSError as error:
        usage(f"{folder} cannot be used: {error.strerror or error}")
