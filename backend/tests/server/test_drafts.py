"""Two people edit one file, with connections that break and servers that are killed: both end with the same text, and nothing typed is lost."""

import asyncio
import random
import threading
from base64 import b64decode, b64encode
from collections.abc import Callable, Coroutine, Iterator
from contextlib import suppress
from difflib import SequenceMatcher
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import pytest
from pycrdt import Doc, Text

from scanbench.server import draft as draft_module
from scanbench.server.draft import MOST_BYTES, MOST_LINES, Draft, differences, merged
from scanbench.server.drafts import MOST_PARTS, Drafts
from scanbench.store.records import Conflict, FileRow, NotFound, StoreError
from scanbench.store.store import Store
from scanbench.web.messages_together import CloseDraft, EditDraft, OpenDraft
from scanbench.web.messages_together import Draft as DraftMessage
from scanbench.web.socket.drafting import Drafting
from scanbench.wire.events import Event, User
from scanbench.wire.refused import Refused
from scanbench.wire.together import DraftEdited

PATH = "Main.st"
BEGUN = "PROGRAM Main\nEND_PROGRAM\n"


class Page:
    """The other end of the protocol, as the page speaks it: what was not acknowledged is sent again after each connection."""

    def __init__(self, name: str) -> None:
        self.user = User(name)
        self.doc: Doc[Text] = Doc()
        self.text = self.doc.get("text", type=Text)
        self.draft: str | None = None
        self.inbox: list[Event | DraftMessage] = []
        self.link: Drafting | None = None

    def on_event(self, event: Event) -> None:
        self.inbox.append(event)

    def on_frame(self, frame: bytes) -> None: ...
    def on_snapshot(self, frame: bytes) -> None: ...

    async def connect(self, drafts: Drafts, project: int, sends: bool = True) -> None:
        self.inbox.clear()
        self.link = Drafting(drafts, project, self, self.inbox.append)
        vector = b64encode(self.doc.get_state()) if self.draft else None
        await self.link.serve(OpenDraft.model_validate({"ref": 1, "path": PATH, "draft": self.draft, "vector": vector}))
        (opened,) = self.inbox
        assert isinstance(opened, DraftMessage)
        self.draft = opened.draft
        self.doc.apply_update(b64decode(opened.update))
        self.inbox.clear()
        if sends:
            await self.send(self.doc.get_update(b64decode(opened.vector)))

    async def lose(self) -> None:
        link, self.link = self.link, None
        self.inbox.clear()
        if link is not None:
            await link.end()

    async def send(self, update: bytes) -> None:
        assert self.link is not None
        given = {"ref": 1, "path": PATH, "draft": self.draft, "update": b64encode(update)}
        await self.link.serve(EditDraft.model_validate(given))

    def read(self, count: int | None = None) -> None:
        """Takes in what has come, or as much of it."""
        for event in self.inbox[:count]:
            assert isinstance(event, DraftEdited)
            self.doc.apply_update(b64decode(event.update))
        del self.inbox[:count]

    def type(self, at: int, text: str) -> bytes:
        """Between two characters; pycrdt counts bytes."""
        before = self.doc.get_state()
        self.text.insert(len(str(self.text)[:at].encode()), text)
        return self.doc.get_update(before)

    def rub_out(self, at: int) -> bytes:
        before, now = self.doc.get_state(), str(self.text)
        start = len(now[:at].encode())
        del self.text[start : start + len(now[at].encode())]
        return self.doc.get_update(before)


class Bench:
    """A server's part of it, that can be killed: what it did not write is gone."""

    def __init__(self, store: Store, name: str) -> None:
        self.store = store
        self.project = self.store.projects.create(name, "CJ1M").id
        self.store.files.save(self.project, PATH, BEGUN, 0, "Ada")
        self.drafts = Drafts(self.store)

    def kill(self) -> None:
        self.drafts = Drafts(self.store)

    async def save(self, text: str, draft: str | None = None) -> None:
        """Of the version that is saved; without the key of the draft it is a text from elsewhere."""
        version = self.store.files.get(self.project, PATH).version
        await self.drafts.save(self.project, PATH, text, version, "Grace", draft)


@pytest.fixture(scope="module")
def store() -> Iterator[Store]:
    """One database, in memory where there is such a place: every acknowledged change is one commit."""
    memory = Path("/dev/shm")
    with TemporaryDirectory(dir=memory if memory.is_dir() else None) as directory:
        opened = Store(f"sqlite:///{directory}/bench.db")
        yield opened
        opened.close()


@pytest.fixture
def bench(store: Store, request: pytest.FixtureRequest) -> Bench:
    return Bench(store, request.node.name[:100])


def run(story: Coroutine[Any, Any, None]) -> None:
    asyncio.run(story)


@pytest.mark.parametrize("seed", range(100))
def test_whatever_breaks_both_end_with_the_same_text_and_all_that_was_typed(seed: int, bench: Bench) -> None:
    run(_schedule(random.Random(seed), bench))


async def _schedule(chance: random.Random, bench: Bench) -> None:
    pages = [Page("Ada"), Page("Grace")]
    typed: list[str] = []
    gone: set[str] = set()
    for page in pages:
        await page.connect(bench.drafts, bench.project)
    for _ in range(chance.randint(8, 24)):
        page = chance.choice(pages)
        match chance.choices(["edit", "read", "lose", "connect", "kill"], [10, 4, 2, 2, 1])[0]:
            case "edit":
                update = _edit(chance, page, typed, gone)
                if page.link is not None and chance.random() < 0.8:
                    await page.send(update)
                else:  # it is lost on its way
                    await page.lose()
            case "read":
                page.read(chance.randint(0, 3))
            case "lose":
                await page.lose()
            case "connect" if page.link is None:
                await page.connect(bench.drafts, bench.project)
            case "kill":
                bench.kill()
                for each in pages:
                    each.link = None
            case _:
                pass
    await _end(bench, pages, set(typed) - gone)


def _edit(chance: random.Random, page: Page, typed: list[str], gone: set[str]) -> bytes:
    """Types a letter that nobody typed before, or takes one away. The letters have three bytes, or four and two units of UTF-16."""
    now = str(page.text)
    places = [at for at, letter in enumerate(now) if letter in typed]
    if places and chance.random() < 0.2:
        at = chance.choice(places)
        gone.add(now[at])
        return page.rub_out(at)
    letter = chr((0x1F300 if chance.random() < 0.3 else 0x3041) + len(typed))
    typed.append(letter)
    return page.type(chance.randint(0, len(now)), letter)


async def _end(bench: Bench, pages: list[Page], left: set[str]) -> None:
    """All are connected, and have read everything."""
    for page in pages * 2:
        if page.link is None:
            await page.connect(bench.drafts, bench.project)
    for page in pages:
        page.read()
    text = str(pages[0].text)
    assert str(pages[1].text) == text
    assert sorted(letter for letter in text if letter not in BEGUN) == sorted(left)
    bench.kill()
    late = Page("Jo")
    await late.connect(bench.drafts, bench.project)
    assert str(late.text) == text


def test_what_was_acknowledged_is_there_after_a_kill_also_when_it_is_kept_as_a_whole(bench: Bench) -> None:
    async def story() -> None:
        ada = Page("Ada")
        await ada.connect(bench.drafts, bench.project)
        for _ in range(MOST_PARTS + 1):
            await ada.send(ada.type(0, "x"))
        assert len(bench.store.drafts.get(bench.project, PATH).parts) < MOST_PARTS  # type: ignore[union-attr]
        for _ in range(2):
            bench.kill()
            grace = Page("Grace")
            await grace.connect(bench.drafts, bench.project)
            assert str(grace.text) == "x" * (MOST_PARTS + 1) + BEGUN

    run(story())


def test_a_file_that_was_made_again_has_a_different_draft_and_the_old_one_is_refused(bench: Bench) -> None:
    async def story() -> None:
        ada = Page("Ada")
        await ada.connect(bench.drafts, bench.project)
        bench.store.files.delete(bench.project, PATH)
        with pytest.raises(Refused, match=r"no file 'Main\.st'"):
            await ada.send(ada.type(0, "x"))
        bench.drafts.forget(bench.project, PATH)
        with pytest.raises(Refused, match=r"open Main\.st first"):
            await ada.send(ada.type(0, "x"))
        bench.store.files.save(bench.project, PATH, "anew", 0, "Grace")
        grace, old = Page("Grace"), ada.draft
        await grace.connect(bench.drafts, bench.project)
        assert (str(grace.text), grace.draft == old) == ("anew", False)

    run(story())


def test_what_is_no_change_is_refused_and_changes_nothing(bench: Bench) -> None:
    async def story() -> None:
        ada = Page("Ada")
        await ada.connect(bench.drafts, bench.project)
        with pytest.raises(Refused, match="no changes of a draft"):
            await ada.send(b"\xff\xff\x01")
        assert ada.link is not None
        wrong = OpenDraft.model_validate({"ref": 1, "path": PATH, "draft": ada.draft, "vector": b64encode(b"\xff")})
        with pytest.raises(Refused, match="no vector of a draft"):
            await ada.link.serve(wrong)
        with pytest.raises(NotFound):
            await bench.drafts.open(bench.project, "None.st", ada)
        await ada.link.serve(CloseDraft(ref=1, path=PATH))
        with pytest.raises(Refused):
            await ada.send(ada.type(0, "x"))

    run(story())


def _embedded(page: Page) -> bytes:
    before = page.doc.get_state()
    page.text.insert_embed(0, {"a": 1})
    return page.doc.get_update(before)


def _within_letters(page: Page) -> bytes:
    """A letter whose parent is no text, but a letter."""
    author = page.doc.get_state()[1:-1]
    return b"\x01\x01\x05\x00\x04\x00" + author + b"\x00\x01x\x00"


def _too_long(page: Page) -> bytes:
    return page.type(0, "x" * MOST_BYTES)


@pytest.mark.parametrize(
    ("craft", "why"), [(_within_letters, "block parent"), (_embedded, "what is no text"), (_too_long, "make two files")]
)
def test_what_cannot_be_typed_leaves_the_draft_as_it_was(
    craft: Callable[[Page], bytes], why: str, bench: Bench
) -> None:
    async def story() -> None:
        ada, grace = Page("Ada"), Page("Grace")
        await ada.connect(bench.drafts, bench.project)
        await grace.connect(bench.drafts, bench.project)
        with pytest.raises(Refused, match=why) as refused:
            await grace.send(craft(grace))
        assert refused.value.final == (craft is _too_long)
        await ada.send(ada.type(0, "x"))
        late = Page("Jo")
        await late.connect(bench.drafts, bench.project)
        assert (str(late.text), len(late.text)) == (f"x{BEGUN}", len(BEGUN) + 1)

    run(story())


def test_what_nobody_saved_is_known_also_when_nobody_has_it_open(bench: Bench) -> None:
    async def story() -> None:
        for path in ("Belt.st", "Never.st"):
            bench.store.files.save(bench.project, path, "\r\n", 0, "Ada")
        ada = Page("Ada")
        await ada.connect(bench.drafts, bench.project)
        assert await bench.drafts.unsaved(bench.project) == []
        await ada.send(ada.type(0, "x"))
        assert await bench.drafts.unsaved(bench.project) == [PATH]
        assert await bench.drafts.unsaved_texts(bench.project) == {PATH: f"x{BEGUN}"}
        await ada.lose()
        bench.kill()
        assert await bench.drafts.unsaved_texts(bench.project) == {PATH: f"x{BEGUN}"}
        await bench.save(str(ada.text), ada.draft)
        assert await bench.drafts.unsaved(bench.project) == []

    run(story())


def test_a_save_from_elsewhere_joins_what_is_being_typed(bench: Bench) -> None:
    async def story() -> None:
        ada = Page("Ada")
        await ada.connect(bench.drafts, bench.project)
        await ada.send(ada.type(len("PROGRAM Main\n"), "x := 1;\n"))
        await bench.save(BEGUN.replace("Main", "Belt").replace("\n", "\r\n"))
        ada.read()
        assert str(ada.text) == "PROGRAM Belt\nx := 1;\nEND_PROGRAM\n"
        await ada.lose()
        await bench.save(f"(* new *)\n{BEGUN}")  # while nobody has it open
        await ada.connect(bench.drafts, bench.project)
        assert str(ada.text).startswith("(* new *)\n")

    run(story())


def test_a_save_of_the_draft_changes_it_not_though_the_server_was_killed(bench: Bench) -> None:
    """The changes that it lacks come from the page; made of the saved text as well they would be there twice."""

    async def story() -> None:
        ada = Page("Ada")
        await ada.connect(bench.drafts, bench.project)
        await ada.send(ada.type(0, "X"))
        bench.kill()
        ada.type(1, "Y")  # on its way when the server ended
        await bench.save(str(ada.text), ada.draft)
        await ada.connect(bench.drafts, bench.project)
        assert str(ada.text) == f"XY{BEGUN}"

    run(story())


def test_a_save_from_elsewhere_is_in_the_draft_whenever_the_server_is_killed(
    bench: Bench, monkeypatch: pytest.MonkeyPatch
) -> None:
    async def story() -> None:
        ada = Page("Ada")
        await ada.connect(bench.drafts, bench.project)
        monkeypatch.setattr(bench.store.drafts, "append", _killed)
        with suppress(StoreError):
            await bench.save(f"(* new *)\n{BEGUN}")
        bench.kill()
        await ada.connect(bench.drafts, bench.project, sends=False)
        assert str(ada.text) == bench.store.files.get(bench.project, PATH).text

    run(story())


def _killed(*_: object) -> None:
    raise StoreError("the server was killed")


def test_a_save_that_is_a_conflict_changes_no_draft(bench: Bench) -> None:
    async def story() -> None:
        ada = Page("Ada")
        await ada.connect(bench.drafts, bench.project)
        with pytest.raises(Conflict):
            await bench.drafts.save(bench.project, PATH, "late", 7, "Grace", None)
        await ada.lose()
        await ada.connect(bench.drafts, bench.project)
        assert str(ada.text) == BEGUN

    run(story())


class Slow:
    """The store takes long to read one file, until it may go on."""

    def __init__(self, bench: Bench, monkeypatch: pytest.MonkeyPatch) -> None:
        self.asked, self.go_on = asyncio.Event(), threading.Event()
        self._loop, self._get = asyncio.get_running_loop(), bench.store.files.get
        monkeypatch.setattr(bench.store.files, "get", self._slow)

    def _slow(self, project: int, path: str) -> FileRow:
        if path == "Big.st":
            self._loop.call_soon_threadsafe(self.asked.set)
            self.go_on.wait()
        return self._get(project, path)


def test_files_do_not_wait_for_each_other(bench: Bench, monkeypatch: pytest.MonkeyPatch) -> None:
    async def story() -> None:
        bench.store.files.save(bench.project, "Big.st", BEGUN, 0, "Ada")
        slow = Slow(bench, monkeypatch)
        big = asyncio.ensure_future(bench.drafts.open(bench.project, "Big.st", Page("Ada")))
        await slow.asked.wait()
        await bench.drafts.open(bench.project, PATH, Page("Grace"))
        assert not big.done()
        slow.go_on.set()
        await big

    run(story())


def test_what_is_closed_while_it_opens_is_closed(bench: Bench, monkeypatch: pytest.MonkeyPatch) -> None:
    async def story() -> None:
        bench.store.files.save(bench.project, "Big.st", BEGUN, 0, "Ada")
        slow, ada = Slow(bench, monkeypatch), Page("Ada")
        link = Drafting(bench.drafts, bench.project, ada, ada.inbox.append)
        opening = asyncio.ensure_future(link.serve(OpenDraft(ref=1, path="Big.st")))
        await slow.asked.wait()
        closing = asyncio.ensure_future(link.serve(CloseDraft(ref=2, path="Big.st")))
        await asyncio.sleep(0)  # it begins
        slow.go_on.set()
        await asyncio.gather(opening, closing)
        (opened,) = ada.inbox
        assert isinstance(opened, DraftMessage)
        given = {"ref": 3, "path": "Big.st", "draft": opened.draft, "update": b64encode(ada.type(0, "x"))}
        with pytest.raises(Refused, match=r"open Big\.st first"):
            await link.serve(EditDraft.model_validate(given))

    run(story())


def test_what_is_long_and_all_different_is_replaced_at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """To compare thousands of lines, many of them alike, takes minutes. Few that changed in a long text are found all the same."""
    before = "".join(f"x := {at};\n\n" for at in range(3000))
    compared: list[int] = []

    def counted(junk: None, one: list[str], other: list[str], autojunk: bool) -> SequenceMatcher[str]:
        compared.append(max(len(one), len(other)))
        return SequenceMatcher(junk, one, other, autojunk)

    monkeypatch.setattr(draft_module, "SequenceMatcher", counted)
    few = before.replace("x := 7;", "y := 7;").replace("x := 17;", "z := 17;")
    assert [each.text for each in differences(before, few)] == ["y", "z"]
    indented = "".join(f"  {line}" for line in before.splitlines(keepends=True))
    draft = Draft.begun(before)
    draft.become(indented)
    assert draft.text == indented
    assert max(compared) <= MOST_LINES


@pytest.mark.parametrize(
    ("base", "one", "other", "both"),
    [
        ("a\nb\nc\n", "a1\nb\nc\n", "a\nb\nc2\n", "a1\nb\nc2\n"),
        ("a\nb\n", "a\nb\n", "b\n", "b\n"),
        ("a\nb\n", "a\n", "a\nb\nc\n", "a\nc\n"),
        ("a", "b", "b", "b"),
        ("", "ä😀", "", "ä😀"),
    ],
)
def test_two_changes_of_a_text_are_both_made(base: str, one: str, other: str, both: str) -> None:
    assert merged(base, one, other) == both
    assert merged(base, other, one) == both


def test_a_text_becomes_any_other_by_its_differences() -> None:
    chance = random.Random(15)
    for _ in range(300):
        before, after = ("".join(chance.choices("ab\nä😀", k=chance.randint(0, 12))) for _ in range(2))
        draft = Draft.begun(before)
        draft.become(after)
        assert draft.text == after
        assert sum(each.end - each.start for each in differences(before, after)) <= len(before)
