"""The folders of projects that are under `git`: a working tree next to the database, made when somebody asks for it.

The database says what the project is. A commit takes what is saved there, and the folder is written after it, so that other programs
(an editor, `git push`, `scanbench run`) find the same. What they change in the folder is never written over: a commit is refused until it
is committed there, and commits that were made there are to be seen first.
"""

import asyncio
import logging
import re
import shutil
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar, Literal

from scanbench.public import Public
from scanbench.server.from_disk import PROJECT_FILE, project_file
from scanbench.server.git import MISSING, asked, git, installed
from scanbench.server.project_files import is_project_file
from scanbench.server.working_tree import Foreign, write
from scanbench.store.connected import check
from scanbench.store.records import NotFound
from scanbench.store.store import Store
from scanbench.syntax.source import decode
from scanbench.wire.refused import Refused

_log = logging.getLogger(__name__)
MOST_COMMITS = 500
LONGEST_MESSAGE = 10_000
LONGEST_PATH = 255
_SEEN = "refs/scanbench/seen"
"""The commit that the project was last the same as: where the branch is elsewhere, another program committed."""
_COMMIT = re.compile(r"[0-9a-f]{4,64}")
_EMAIL = "scanbench@localhost"
_FORMAT = "--format=%H%x1f%an%x1f%aI%x1f%B"


@dataclass(frozen=True, slots=True)
class FileChange(Public):
    """A file that is not as the last commit has it."""

    PUBLIC: ClassVar = "GitChange"

    path: str
    kind: Literal["new", "changed", "gone"]


@dataclass(frozen=True, slots=True)
class Commit(Public):
    """A commit."""

    PUBLIC: ClassVar = "GitCommit"

    commit: str
    author: str
    at: str
    """ISO 8601."""
    message: str


@dataclass(frozen=True, slots=True)
class Status(Public):
    """The working tree of a project, or why there is none."""

    PUBLIC: ClassVar = "GitStatus"

    missing: str
    """What to do so that there can be one; empty when git is installed."""
    folder: str
    """Empty: nobody asked for one yet."""
    branch: str
    """Empty: the folder is at a commit, not on a branch."""
    head: str
    """The last commit; empty when there is none yet."""
    elsewhere: tuple[str, ...]
    """Files that another program committed a change of, which a commit of this project would take back."""
    changes: tuple[FileChange, ...]
    """What a commit would keep."""


class Repositories:
    """The working trees of projects."""

    def __init__(self, store: Store, directory: Path) -> None:
        self._store, self._directory = store, directory
        self._busy: dict[int, asyncio.Lock] = {}

    async def status(self, project: int) -> Status:
        """What is there, and what a commit would keep."""
        texts = await self._texts(project)
        folder = self._folder(project)
        if not installed() or not (folder / ".git").is_dir():
            return Status("" if installed() else MISSING, "", "", "", (), ())
        async with self._lock(project):
            head = await _head(folder)
            before = await _texts_of(folder, head) if head else {}
            elsewhere = await _elsewhere(folder, head, before, texts)
        changes = tuple(_changes(before, texts))
        return Status("", str(folder), await _branch(folder), head, elsewhere, changes)

    async def begin(self, project: int) -> Status:
        """Makes the working tree, without a commit."""
        await self._texts(project)
        folder = self._folder(project)
        async with self._lock(project):
            if not (folder / ".git").is_dir():
                await asyncio.to_thread(folder.mkdir, parents=True, exist_ok=True)
                await git(folder, "init", "--quiet", "--template=")
        return await self.status(project)

    async def commits(self, project: int, path: str | None) -> list[Commit]:
        """The last commits, of the project or of one of its files, the last one first."""
        folder = await self._existing(project)
        if path is not None:
            check("the path", path, LONGEST_PATH)
        if not await _head(folder):
            return []
        paths = [] if path is None else [path]
        listed = await git(
            folder, "log", "-z", f"--max-count={MOST_COMMITS}", "--no-mailmap", _FORMAT, "HEAD", "--", *paths
        )
        return [_commit(entry) for entry in listed.decode(errors="replace").split("\0") if entry]

    async def texts(self, project: int, commit: str) -> dict[str, str]:
        """The files of the project as a commit has them."""
        folder = await self._existing(project)
        if not _COMMIT.fullmatch(commit):
            raise NotFound(f"{commit!r} is no name of a commit: it has 4 to 64 digits from 0 to f")
        full = await asked(folder, "rev-parse", "--verify", "--quiet", "--end-of-options", f"{commit}^{{commit}}")
        if full is None:
            raise NotFound(f"this project has no commit {commit}")
        found = await _texts_of(folder, full)
        found.pop(PROJECT_FILE, None)
        return found

    async def commit(self, project: int, message: str, head: str, author: str, agreed: bool = False) -> Commit:
        """Keeps what is saved as a commit after `head`, which was the last one when somebody looked.

        `agreed`: also where commits of other programs came in between.
        """
        if not 0 < len(message.strip()) <= LONGEST_MESSAGE:
            raise Refused(f"a commit needs a message of 1 to {LONGEST_MESSAGE:,} characters")
        folder, texts = await self._existing(project), await self._texts(project)
        async with self._lock(project):
            before = await self._checked(folder, texts, head, agreed)
            ref = await asked(folder, "symbolic-ref", "--quiet", "HEAD")
            if ref is None:
                raise Refused(f"{folder} is not on a branch: choose one there (git switch main), then commit")
            changes = list(_changes(before, texts))
            if not changes and head:
                raise Refused("there is nothing to commit: what is saved is the same as the last commit")
            await git(
                folder,
                "fast-import",
                "--quiet",
                "--date-format=now",
                stdin=_stream(ref, message, head, author, changes, texts),
            )
            await git(folder, "update-ref", _SEEN, await _head(folder))
            await git(folder, "read-tree", "HEAD")
            # last, as it may fail: the commit is this project's all the same
            await asyncio.to_thread(write, folder, texts, [each.path for each in changes if each.kind == "gone"])
        return (await self.commits(project, None))[0]

    async def forget(self, project: int) -> None:
        """Deletes the working tree of a project that is deleted: its number may be given again."""
        self._busy.pop(project, None)
        await asyncio.to_thread(shutil.rmtree, self._folder(project), ignore_errors=True)

    async def _checked(self, folder: Path, texts: Mapping[str, str], head: str, agreed: bool) -> dict[str, str]:
        """The texts of the last commit; `Refused` where others were first, here or in the folder."""
        last = await _head(folder)
        if last != head:
            raise Refused("somebody committed in the meantime: look at the new commit, then commit again")
        before = await _texts_of(folder, head) if head else {}
        if (elsewhere := await _elsewhere(folder, head, before, texts)) and not agreed:
            raise Refused(
                f"another program committed changes of {', '.join(elsewhere)} in {folder}: take them into the editor, or agree that "
                "this commit takes them back"
            )
        foreign = await asyncio.to_thread(Foreign(folder).found, before, texts)
        if foreign:
            raise Refused(
                f"{', '.join(foreign)} in {folder} was changed by another program and is not committed: commit it there, or take it "
                "back there (git checkout), then commit here"
            )
        return before

    async def _texts(self, project: int) -> dict[str, str]:
        row = await asyncio.to_thread(self._store.projects.get, project)
        said = project_file(row.name, row.model, row.watch)
        return {PROJECT_FILE: said, **await asyncio.to_thread(self._store.files.sources, project)}

    async def _existing(self, project: int) -> Path:
        await asyncio.to_thread(self._store.projects.get, project)
        folder = self._folder(project)
        if not (folder / ".git").is_dir():
            raise Refused("this project is not under git yet: begin that first")
        return folder

    def _folder(self, project: int) -> Path:
        return self._directory / str(project)

    def _lock(self, project: int) -> asyncio.Lock:
        return self._busy.setdefault(project, asyncio.Lock())


async def _head(folder: Path) -> str:
    return await asked(folder, "rev-parse", "--verify", "--quiet", "HEAD^{commit}") or ""


async def _elsewhere(folder: Path, head: str, committed: Mapping[str, str], now: Mapping[str, str]) -> tuple[str, ...]:
    """Files that another program changed by a commit, and that the project does not have like that."""
    seen = await asked(folder, "rev-parse", "--verify", "--quiet", _SEEN)
    if not head or seen == head:
        return ()
    before = {} if seen is None else await _texts_of(folder, seen)
    paths = sorted({*before, *committed})
    return tuple(path for path in paths if committed.get(path) not in (before.get(path), now.get(path)))


async def _branch(folder: Path) -> str:
    return (await asked(folder, "symbolic-ref", "--quiet", "HEAD") or "").removeprefix("refs/heads/")


async def _texts_of(folder: Path, commit: str) -> dict[str, str]:
    """Path and text of each file that belongs to a project; links are none."""
    listed = await git(folder, "ls-tree", "-r", "-z", "--full-tree", commit)
    wanted: dict[str, str] = {}
    for line in listed.decode(errors="surrogateescape").split("\0"):
        mode, _, rest = line.partition(" ")
        name, _, path = rest.removeprefix("blob ").partition("\t")
        if mode in ("100644", "100755") and _is_text(path) and _is_ours(path):
            wanted[path] = name
    names = "".join(f"{name}\n" for name in wanted.values())
    read = await git(folder, "cat-file", "--batch", stdin=names.encode()) if wanted else b""
    texts, at = {}, 0
    for path in wanted:
        end = read.index(b"\n", at)
        size = int(read[at:end].split(b" ")[2])
        texts[path] = decode(read[end + 1 : end + 1 + size])
        at = end + 2 + size
    return texts


def _is_text(path: str) -> bool:
    """Whether the name of a file is UTF-8; one that is not can be no file of a project, and no message could tell it."""
    try:
        path.encode()
    except UnicodeEncodeError:
        _log.info("git: %r is left out, as its name is not UTF-8", path)
        return False
    return True


def _is_ours(path: str) -> bool:
    return path == PROJECT_FILE or is_project_file(path)


def _changes(before: Mapping[str, str], now: Mapping[str, str]) -> list[FileChange]:
    made: list[FileChange] = []
    for path in sorted({*before, *now}):
        if path not in before:
            made.append(FileChange(path, "new"))
        elif path not in now:
            made.append(FileChange(path, "gone"))
        elif before[path] != now[path]:
            made.append(FileChange(path, "changed"))
    return made


def _stream(
    ref: str, message: str, head: str, author: str, changes: list[FileChange], texts: Mapping[str, str]
) -> bytes:
    """What `git fast-import` reads: one commit. No file of the folder and no filter is involved."""
    name = re.sub(r"[<>\x00-\x1f\x7f]", "", author).strip() or "unnamed"
    who = f"{name} <{_EMAIL}> now"
    parts = [f"commit {ref}\nauthor {who}\ncommitter {who}\n".encode(), _data(message.strip() + "\n")]
    if head:
        parts.append(f"from {head}\n".encode())
    for change in changes:
        path = _quoted(change.path)
        if change.kind == "gone":
            parts.append(f"D {path}\n".encode())
        else:
            parts += [f"M 100644 inline {path}\n".encode(), _data(texts[change.path])]
    return b"".join(parts)


def _data(text: str) -> bytes:
    content = text.encode()
    return b"data %d\n%b\n" % (len(content), content)


def _quoted(path: str) -> str:
    plain = path.replace("\\", "\\\\").replace('"', '\\"').replace("\n", "\\n")
    return f'"{plain}"'


def _commit(entry: str) -> Commit:
    commit, author, at, message = ([*entry.split("\x1f", 3), "", "", ""])[:4]
    return Commit(commit.strip(), author, at, message.strip())
