"""`scanbench serve`: the server with the browser IDE."""

from pathlib import Path

import typer

from scanbench.cli.inputs import usage


def serve(
    host: str = typer.Option(
        "127.0.0.1", help="Address to listen on; the default is reachable from this machine only."
    ),
    port: int | None = typer.Option(
        None, min=0, max=65535, help="Port; default 8700, or a free one if that is taken. 0: any free one."
    ),
    public_url: str = typer.Option(
        "", metavar="URL", envvar="SCANBENCH_PUBLIC_URL",
        help="Address that people open, e.g. https://bench.example.com: a name in DNS, or that of a proxy. Links begin with it.",
    ),
    data: Path = typer.Option(Path("data"), metavar="DIR", help="Folder for the database; made when it is missing."),
) -> None:  # fmt: skip
    """Start the server; the address to open, with its token, is printed when it is ready."""
    from scanbench.web.public_url import BadPublicUrl, parse_public_url
    from scanbench.web.serve import CannotServe
    from scanbench.web.serve import serve as serve_web

    try:
        public = parse_public_url(public_url) if public_url.strip() else None
        serve_web(host, port, data, typer.echo, public=public)
    except (BadPublicUrl, CannotServe) as error:
        usage(str(error))
    except OSError as error:
        usage(f"{data} cannot be used: {error.strerror or error}")
