"""The two pages that exist without the frontend."""

import os
from html import escape
from pathlib import Path

_PAGE = """<!doctype html>
<html lang="en"><head><meta charset="utf-8"><title>Scanbench</title>
<meta name="viewport" content="width=device-width"><link rel="icon" href="data:,">
<style>body{{font:16px/1.5 system-ui,sans-serif;max-width:40rem;margin:15vh auto;padding:0 1rem;color-scheme:light dark}}
code{{background:#8883;padding:.1em .3em;border-radius:4px}}</style></head>
<body><h1>{title}</h1>{body}</body></html>"""


def frontend_directory() -> Path:
    """Where the built frontend is: SCANBENCH_FRONTEND, or `frontend/dist` beside `backend`."""
    named = os.environ.get("SCANBENCH_FRONTEND")
    return Path(named) if named else Path(__file__).resolve().parents[3] / "frontend" / "dist"


def no_token_page() -> str:
    """Somebody opened the address without its token."""
    return _PAGE.format(
        title="This bench has a key",
        body="<p>Open the address that was printed when the server started: it ends with <code>?token=…</code>. "
        "It has to be done once in each browser.</p>",
    )


def not_built_page(directory: Path) -> str:
    """The frontend is missing."""
    return _PAGE.format(
        title="The server runs, the page is not built",
        body=f"<p>There is no <code>{escape(str(directory / 'index.html'))}</code>. Run <code>make run</code> "
        "at the project's root, or <code>npm ci && npm run build</code> in <code>frontend</code>, and reload.</p>",
    )
