"""The two pages that exist without the frontend."""

import os
from collections.abc import Iterable
from dataclasses import dataclass
from html import escape
from pathlib import Path

_PAGE = """<!doctype html>
<html lang="{lang}"><head><meta charset="utf-8"><title>Scanbench</title>
<meta name="viewport" content="width=device-width"><link rel="icon" href="data:,">
<style>body{{font:16px/1.5 system-ui,sans-serif;max-width:40rem;margin:15vh auto;padding:0 1rem;color-scheme:light dark}}
code{{background:#8883;padding:.1em .3em;border-radius:4px}}form{{display:flex;gap:.5rem;align-items:end;margin:1.5rem 0}}
label{{flex:1;display:grid;gap:.25rem}}input,button{{font:inherit;padding:.4rem .6rem}}
[role=alert]{{border-left:3px solid #d33;padding-left:.75rem}}</style></head>
<body><main><h1>{title}</h1>{body}</main></body></html>"""


@dataclass(frozen=True, slots=True)
class _Words:
    title: str
    why: str
    wrong: str
    key: str
    open: str
    where: str


_WORDS = {
    "en": _Words(
        "This bench has a key",
        "Enter the key once in this browser; the page that you came for opens then.",
        "This is not the key of this server. Compare it with the address that was printed when the server started.",
        "Key, or the whole address with <code>?token=</code>",
        "Open",
        "If you have no key, ask the person who started the server: it is in the address that was printed at the start, after "
        "<code>?token=</code>, and in the file <code>token</code> in the server's data directory.",
    ),
    "ja": _Words(
        "このベンチにはキーが必要です",
        "このブラウザで一度だけキーを入力してください。入力後、開こうとしたページが表示されます。",
        "このサーバーのキーではありません。サーバー起動時に表示されたアドレスと比べてください。",
        "キー、または <code>?token=</code> を含むアドレス全体",
        "開く",
        "キーが分からない場合は、サーバーを起動した人に聞いてください。起動時に表示されたアドレスの <code>?token=</code> の後、"
        "またはサーバーのデータディレクトリのファイル <code>token</code> にあります。",
    ),
}


def frontend_directory() -> Path:
    """Where the built frontend is: SCANBENCH_FRONTEND, what a wheel brings, or `frontend/dist` beside `backend`."""
    named = os.environ.get("SCANBENCH_FRONTEND")
    if named:
        return Path(named)
    here = Path(__file__).resolve()
    brought = here.parents[1] / "share" / "frontend"
    return brought if brought.is_dir() else here.parents[3] / "frontend" / "dist"


def sign_in_page(path: str, query: Iterable[tuple[str, str]], *, wrong: bool, languages: str) -> str:
    """Somebody came without the token, or with a wrong one: a field for it, which leads to where they wanted to go."""
    lang = "ja" if languages.lower().startswith("ja") else "en"
    words = _WORDS[lang]
    kept = "".join(f'<input type="hidden" name="{escape(name)}" value="{escape(value)}">' for name, value in query)
    alert = f'<p role="alert">{words.wrong}</p>' if wrong else ""
    form = (
        f'<form method="get" action="{escape(path)}">{kept}<label><span>{words.key}</span>'
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
