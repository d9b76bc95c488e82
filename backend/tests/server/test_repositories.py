"""A project under git: what is committed, what others do in the folder, and that a repository runs nothing."""

import asyncio
import os
import subprocess
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import pytest
from pydantic import TypeAdapter

from scanbench.server.repositories import Commit, Repositories, Status
from scanbench.store.records import NotFound
from scanbench.store.store import Store
from scanbench.wire.refused import Refused

ONE = "PROGRAM Main\nEND_PROGRAM\n"
TWO = "PROGRAM Main\nVAR n : INT; END_VAR\nn := n + 1;\nEND_PROGRAM\n"


@dataclass
class Bench:
    """A project in a database, and its working tree."""

    store: Store
    repositories: Repositories
    project: int
    folder: Path

    def save(self, path: str, text: str) -> None:
        known = {file.path: file.version for file in self.store.files.all(self.project)}
        self.store.files.save(self.project, path, text, known.get(path, 0), "Ada")

    def begin(self) -> Status:
        return asyncio.run(self.repositories.begin(self.project))

    def status(self) -> Status:
        return asyncio.run(self.repositories.status(self.project))

    def commit(self, message: str, author: str = "Ada Lovelace", agreed: bool = False) -> Commit:
        return asyncio.run(self.repositories.commit(self.project, message, self.status().head, author, agreed))

    def commits(self, path: str | None = None) -> list[str]:
        return [each.message for each in asyncio.run(self.repositories.commits(self.project, path))]

    def texts(self, commit: str) -> dict[str, str]:
        return asyncio.run(self.repositories.texts(self.project, commit))

    def git(self, *arguments: str) -> str:
        """What another program does in the folder."""
        who = ["-c", "user.name=Grace", "-c", "user.email=grace@example.org"]
        done = subprocess.run(
            ["git", *who, *arguments], cwd=self.folder, capture_output=True, text=True, check=True,
            env={**os.environ, "GIT_CONFIG_GLOBAL": "/dev/null"},
        )  # fmt: skip
        return done.stdout


@pytest.fixture
def bench(tmp_path: Path) -> Iterator[Bench]:
    store = Store(f"sqlite:///{tmp_path / 'bench.db'}")
    project = store.projects.create("Line 1", "CJ1M-CPU63", ["Main.n"]).id
    made = Bench(store, Repositories(store, tmp_path / "projects"), project, tmp_path / "projects" / str(project))
    made.save("Main.st", ONE)
    made.save("lib/Über.st", ONE.replace("Main", "Other"))
    yield made
    store.close()


def test_a_project_is_committed_as_the_folder_that_other_programs_find(bench: Bench) -> None:
    assert bench.status().folder == ""
    begun = bench.begin()
    assert [(each.path, each.kind) for each in begun.changes] == [
        ("Main.st", "new"), ("lib/Über.st", "new"), ("project.json", "new")
    ]  # fmt: skip
    first = bench.commit("The first\n\nand why")
    assert (first.author, first.message) == ("Ada Lovelace", "The first\n\nand why")
    assert bench.status().changes == ()
    assert (bench.folder / "lib/Über.st").read_text() == ONE.replace("Main", "Other")
    assert bench.git("status", "--porcelain") == ""
    assert bench.git("log", "--format=%an: %s") == "Ada Lovelace: The first\n"


def test_history_texts_and_a_file_that_is_gone(bench: Bench) -> None:
    bench.begin()
    first = bench.commit("one").commit
    bench.save("Main.st", TWO)
    bench.store.files.delete(bench.project, "lib/Über.st")
    assert [(each.path, each.kind) for each in bench.status().changes] == [
        ("Main.st", "changed"),
        ("lib/Über.st", "gone"),
    ]
    second = bench.commit("two").commit
    assert not (bench.folder / "lib/Über.st").exists()
    assert bench.commits() == ["two", "one"]
    assert bench.commits("lib/Über.st") == ["two", "one"]
    assert bench.commits("project.json") == ["one"]
    assert bench.texts(first) == {"Main.st": ONE, "lib/Über.st": ONE.replace("Main", "Other")}
    assert bench.texts(second[:10]) == {"Main.st": TWO}
    with pytest.raises(Refused, match="nothing to commit"):
        bench.commit("three")


@pytest.mark.parametrize("name", ["--help", "HEAD", "0000", "f" * 40])
def test_what_is_no_commit(bench: Bench, name: str) -> None:
    bench.begin()
    bench.commit("one")
    with pytest.raises(NotFound):
        bench.texts(name)


def test_somebody_committed_first(bench: Bench) -> None:
    bench.begin()
    with pytest.raises(Refused, match="in the meantime"):
        asyncio.run(bench.repositories.commit(bench.project, "late", "a" * 40, "Ada"))


def test_commits_of_another_program_are_seen_before_they_are_taken_back(bench: Bench) -> None:
    bench.begin()
    bench.commit("one")
    (bench.folder / "Main.st").write_text(TWO)
    (bench.folder / "notes.txt").write_text("not ours")
    bench.git("add", "-A")
    bench.git("commit", "-m", "from elsewhere")
    status = bench.status()
    assert status.elsewhere == ("Main.st",)
    assert [(each.path, each.kind) for each in status.changes] == [("Main.st", "changed")]
    with pytest.raises(Refused, match=r"another program committed changes of Main\.st"):
        bench.commit("mine")
    bench.commit("mine", agreed=True)
    assert not bench.status().elsewhere
    assert (bench.folder / "Main.st").read_text() == ONE
    assert bench.git("ls-files", "notes.txt") == "notes.txt\n"
    assert bench.git("status", "--porcelain") == ""


def test_what_came_from_elsewhere_and_was_taken_needs_no_agreement(bench: Bench) -> None:
    bench.begin()
    bench.commit("one")
    (bench.folder / "Main.st").write_text(TWO)
    bench.git("commit", "-am", "from elsewhere")
    bench.save("Main.st", TWO)
    bench.save("New.st", ONE.replace("Main", "New"))
    assert bench.commit("on top").message == "on top"


def test_what_another_program_has_not_committed_is_not_written_over(bench: Bench) -> None:
    bench.begin()
    bench.commit("one")
    (bench.folder / "Main.st").write_text("being edited")
    bench.save("Main.st", TWO)
    with pytest.raises(Refused, match=r"Main\.st in .* was changed by another program"):
        bench.commit("two")
    assert (bench.folder / "Main.st").read_text() == "being edited"
    assert bench.commits() == ["one"]


def test_a_link_leads_nowhere(bench: Bench, tmp_path: Path) -> None:
    bench.begin()
    bench.commit("one")
    outside = tmp_path / "outside.st"
    outside.write_text("kept")
    (bench.folder / "lib" / "Über.st").unlink()
    (bench.folder / "lib").rmdir()
    (bench.folder / "lib").symlink_to(tmp_path)
    bench.save("lib/outside.st", ONE)
    with pytest.raises(Refused, match="a link"):
        bench.commit("two")
    assert outside.read_text() == "kept"


def test_a_link_where_a_file_would_be_written_first_leads_nowhere(bench: Bench, tmp_path: Path) -> None:
    bench.begin()
    bench.commit("one")
    outside = tmp_path / "outside.st"
    outside.write_text("kept")
    (bench.folder / ".Main.st.new").symlink_to(outside)
    bench.git("add", "-A")
    bench.git("commit", "-m", "a link")
    bench.save("Main.st", TWO)
    bench.commit("two")
    assert outside.read_text() == "kept"
    assert (bench.folder / "Main.st").read_text() == TWO
    assert not (bench.folder / "Main.st").is_symlink()
    assert not (bench.folder / ".git" / "scanbench.new").exists()


def test_a_name_that_is_not_utf_8_is_left_out(bench: Bench) -> None:
    bench.begin()
    bench.commit("one")
    Path(os.fsdecode(bytes(bench.folder) + b"/b\xe4nd.st")).write_text(ONE)
    bench.git("add", "-A")
    bench.git("commit", "-m", "Latin 1")
    TypeAdapter(Status).dump_json(bench.status())
    assert bench.status().elsewhere == ()
    assert [each.path for each in bench.status().changes] == []


def test_a_pipe_is_refused_instead_of_waited_for(bench: Bench) -> None:
    bench.begin()
    bench.commit("one")
    (bench.folder / "Main.st").unlink()
    os.mkfifo(bench.folder / "Main.st")
    bench.save("Main.st", TWO)
    with pytest.raises(Refused, match=r"Main\.st is no file"):
        asyncio.run(asyncio.wait_for(_committed(bench), 60))
    assert bench.commits() == ["one"]


async def _committed(bench: Bench) -> Commit:
    head = (await bench.repositories.status(bench.project)).head
    return await bench.repositories.commit(bench.project, "two", head, "Ada")


def test_a_huge_file_is_refused(bench: Bench) -> None:
    bench.begin()
    bench.commit("one")
    os.truncate(bench.folder / "Main.st", 1 << 40)
    bench.save("Main.st", TWO)
    with pytest.raises(Refused, match=r"Main\.st has more than 16 MiB"):
        bench.commit("two")


def test_a_commit_whose_folder_cannot_be_written_is_of_no_other_program(
    bench: Bench, monkeypatch: pytest.MonkeyPatch
) -> None:
    bench.begin()
    bench.commit("one")
    bench.save("Main.st", TWO)

    def full(_folder: Path, _texts: object, _gone: object) -> None:
        raise Refused("the commit was made, but the folder could not be written: no space")

    monkeypatch.setattr("scanbench.server.repositories.write", full)
    with pytest.raises(Refused, match="no space"):
        bench.commit("two")
    bench.save("Main.st", ONE)
    assert bench.commits() == ["two", "one"]
    assert bench.status().elsewhere == ()


def test_a_repository_runs_nothing(bench: Bench, tmp_path: Path) -> None:
    bench.begin()
    ran = tmp_path / "ran"
    script = tmp_path / "script"
    script.write_text(f"#!/bin/sh\necho $0 $@ >> {ran}\ncat\n")
    script.chmod(0o755)
    hooks = bench.folder / ".git" / "hooks"
    hooks.mkdir(exist_ok=True)
    for hook in (
        "pre-commit",
        "post-commit",
        "reference-transaction",
        "post-index-change",
        "commit-msg",
        "post-checkout",
    ):
        (hooks / hook).symlink_to(script)
    for key in (
        "core.fsmonitor", "core.pager", "core.editor", "gpg.program", "filter.x.clean", "filter.x.smudge", "diff.x.textconv",
        "diff.external", "core.sshCommand", "alias.log",
    ):  # fmt: skip
        bench.git("config", key, f"!{script}" if key.startswith("alias") else str(script))
    bench.git("config", "commit.gpgSign", "true")
    bench.git("config", "log.showSignature", "true")
    (bench.folder / ".git" / "info").mkdir(exist_ok=True)
    (bench.folder / ".git" / "info" / "attributes").write_text("* filter=x diff=x\n")
    ran.unlink(missing_ok=True)
    first = bench.commit("one").commit
    bench.save("Main.st", TWO)
    bench.commit("two")
    assert bench.texts(first)["Main.st"] == ONE
    assert bench.commits("Main.st") == ["two", "one"]
    assert not ran.exists(), ran.read_text()


def test_without_git(bench: Bench, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", "/nonexistent")
    assert "apt-get install git" in bench.status().missing
    with pytest.raises(Refused, match="not installed"):
        bench.begin()


def test_a_number_that_is_given_again_has_no_history(bench: Bench) -> None:
    bench.begin()
    bench.commit("one")
    asyncio.run(bench.repositories.forget(bench.project))
    assert bench.status().folder == ""
    assert not bench.folder.exists()
