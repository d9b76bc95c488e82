"""The two pages that exist without the frontend. Their colours are those of its themes (`tokens.css`); the file of the
frontend that chooses the theme before the first paint needs no key."""

import os
from collections.abc import Iterable
from dataclasses import dataclass
from html import escape
from pathlib import Path

_PAGE = """<!doctype html>
<html lang="{lang}"><head><meta charset="utf-8"><title>Scanbench</title>
<meta name="viewport" content="width=device-width"><link rel="icon" href="data:,">
<script src="/theme.js"></script>
<style>
:root{{color-scheme:light dark;--bg:Canvas;--text:CanvasText;--field:Field;--line:GrayText;--bad:#d33;--focus:Highlight}}
[data-theme=dark]{{color-scheme:dark;--bg:#0b0d10;--text:#e5e8ec;--field:#20262e;--line:#66707d;--bad:#ff8078;--focus:#9cc3ff}}
[data-theme=light]{{color-scheme:light;--bg:#fff;--text:#161a20;--field:#fff;--line:#7b8693;--bad:#b3231b;--focus:#1a58c2}}
[data-theme=contrast]{{color-scheme:dark;--bg:#000;--text:#fff;--field:#000;--line:#fff;--bad:#ff9f97;--focus:#ffe14d}}
body{{font:16px/1.5 system-ui,sans-serif;max-width:40rem;margin:15vh auto;padding:0 1rem;background:var(--bg);color:var(--text)}}
code{{background:#8883;padding:.1em .3em;border-radius:4px}}form{{display:flex;gap:.5rem;align-items:end;margin:1.5rem 0}}
label{{flex:1;display:grid;gap:.25rem}}
input,button{{font:inherit;padding:.4rem .6rem;border:1px solid var(--line);border-radius:4px;background:var(--field);color:inherit}}
:focus-visible{{outline:2px solid var(--focus);outline-offset:1px}}
[role=alert]{{border-left:3px solid var(--bad);padding-left:.75rem}}
</style></head>
<body><main><h1>{title}</h1>{body}</main></body></html>"""


@dataclass(frozen=True, slots=True)
class _Words:
    title: str
    why: str
    wrong: str
    blank: str
    token: str
    open: str
    where: str


_WORDS = {
    "en": _Words(
        "This server requires its token",
        "Enter the token once in this browser; the page that you came for opens then.",
        "This is not the token of this server. Compare it with the address that was printed when the server started.",
        "Enter the token: the field was empty.",
        "Token, or the whole address with <code>?token=</code>",
        "Open",
        "If you have no token, ask the person who started the server: it is in the address that was printed at the start, after "
        "<code>?token=</code>, and in the file <code>token</code> in the server's data directory.",
    ),
    "ja": _Words(
        "このサーバーにはトークンが必要です",
        "このブラウザで一度だけトークンを入力してください。入力後、開こうとしたページが表示されます。",
        "このサーバーのトークンではありません。サーバー起動時に表示されたアドレスと比べてください。",
        "トークンを入力してください。欄が空でした。",
        "トークン、または <code>?token=</code> を含むアドレス全体",
        "開く",
        "トークンが分からない場合は、サーバーを起動した人に聞いてください。起動時に表示されたアドレスの <code>?token=</code> の後、"
        "またはサーバーのデータディレクトリのファイル <code>token</code> にあります。",
    ),
}


def frontend_directory() -> Path:
    """Where the built frontend is: SCANBENCH_FRONTEND, what a wheel brings, or `frontend/dist` next to `backend`."""
    named = os.environ.get("SCANBENCH_FRONTEND")
    if named:
        return Path(named)
    here = Path(__file__).resolve()
    brought = here.parents[1] / "share" / "frontend"
    return brought if brought.is_dir() else here.parents[3] / "frontend" / "dist"


def sign_in_page(path: str, query: Iterable[tuple[str, str]], *, typed: str | None, languages: str) -> str:
    """Somebody came without the token (None), or typed a wrong one, or nothing: a field for it, which leads to where they wanted
    to go."""
    lang = "ja" if languages.lower().startswith("ja") else "en"
    words = _WORDS[lang]
    kept = "".join(f'<input type="hidden" name="{escape(name)}" value="{escape(value)}">' for name, value in query)
    refused = words.wrong if typed is not None and typed.strip() else words.blank
    alert = f'<p role="alert">{refused}</p>' if typed is not None else ""
    form = (
        f'<form method="get" action="{escape(path)}">{kept}<label><span>{words.token}</span>'
        '<input type="password" name="token" autocomplete="current-password" required autofocus></label>'
        f"<button>{words.open}</button></form>"
    )
    return _PAGE.format(lang=lang, title=words.title, body=f"<p>{words.why}</p>{alert}{form}<p>{words.where}</p>")


def not_built_page(directory: Path) -> str:
    """The frontend is missing."""
    return _PAGE.format(
        lang="en",
        title="The server runs, the page is not built",
        body=f"<p>There is no <code>{escape(str(directory / 'index.html'))}</code>. Run <code>make run</code> "
        "at the project's root, or <code>npm ci && npm run build</code> in <code>frontend</code>, and reload.</p>",
    )
