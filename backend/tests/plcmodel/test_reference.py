"""Every error of the Omron models, beside a table that was typed from the reference, not from the model files.

A row: code, flag, then the details. `List A403.00 ...`: a bit for each choice. `List A407.13-15=0,1`: a field and its values.
`Spin A404.08-15 0..3`: a field and its limits. `Spin A417[0..15]`: a bit for each unit. `Spin 1..511`: no place of its own.
`+`: it is added to the code.
"""

import re
from collections.abc import Iterator

import pytest

from scanbench.plcmodel.model import ErrorAddress, ErrorDetail, ErrorEntry, Model, Wording

MEMORY = "List A403.00 A403.04 A403.05 A403.07 A403.08 A403.09 A403.10"
FATAL = f"""
80F1 A401.15 | {MEMORY}
80C0 A401.14 | Spin A404.08-15 0..RACK + | Spin A404.00-07 0..SLOT
80CE A401.14 | List A404.00-15=0E0E
80CF A401.14 | List A404.00-15=0F0F
80E9 A401.13 | Spin A410[0..111]
80EA A401.13 | Spin A409[0..RACK]
82F0 A401.12 | Edit A424.00-15 0..65535
80E1 A401.11 | List A407.13-15=CAUSES | Spin A407.00-12 0..8191
80E0 A401.10
80F0 A401.09 | List A295.08 A295.09 A295.10 A295.11 A295.12 A295.13 A295.14 A295.15 | Edit A294.00-15 0..33023 | Edit A298.00-15 0..65535 | Edit A299.00-15 0..65535
809F A401.08
C100 A401.06 | Spin 1..511 +
"""
NONFATAL = """
4100 A402.15 | Spin A360[1..511] +
008B A402.13 | INTERRUPT
009A A402.12 | Spin A408.08-15 0..RACK | Spin A408.00-07 0..SLOT
009B A402.10 | Edit A406.00-15 0..65535
00E7 A402.09
02F0 A402.08 | Edit A424.00-15 0..65535
0200 A402.07 | Spin A417[0..15] +
0300 A402.06 | Spin A418[0..95] +
03FF A402.06
00A0 A402.05 | Spin A425[0..1] +
00F7 A402.04
0400 A402.03 | Spin A427[0..15] +
0500 A402.02 | Spin A428[0..95] +
"""
CP_UNITS = """
80CA A401.14 | List A404.00-15=0A0A
008A A402.00 also A315.14
00D1 A402.00 also A315.13
00F1 A402.00 also A315.15
"""
FLASH = "00F1 A402.00 also A315.15"
POWER = "List " + " ".join(f"A{word}.{rack:02}" for word in (319, 320) for rack in range(8))
DUPLEX = f"""
0011 A402.14 also A316.00 | List A317.07 A317.08 A317.10 A317.13 A317.14 A317.15
0010 A402.14 also A316.01
0003 A402.14 also A316.02 | {POWER}
0600 A402.14 also A316.03 | Spin A436[0..15] +
"""
SERIAL = """
none A392.04 | List A528.02 A528.03 A528.04 A528.05
none A392.12 | List A528.10 A528.11 A528.12 A528.13
"""
NETWORK = "\n".join(f"none A219.{port:02} | Edit A{203 + port}.00-15 1..65535" for port in range(8))
"""What has no code: of the built-in serial ports (not on a CJ2M-CPU3x), and of the ports of communications instructions."""
CJ_CAUSES, CS_CAUSES = "0,1,5,7", "0,1,2,3,4,5"
NO_RACKS, NO_UNITS = "0,1,7", "0,1"
INTERRUPTS = {False: "List A426.15-15=1 | Edit A426.00-11 0..95", True: "List A426.15-15=0,1 | Edit A426.00-11 0..255"}
"""Only a CS1 has units whose refresh an interrupt task can hold up."""
CJ = "-82F0 -02F0 -00A0"
MODELS: dict[str, tuple[str, str, int, int, str]] = {
    "CJ1M-CPU11": (f"{CJ} -80EA", "", 0, 9, NO_RACKS),
    "CJ1M-CPU12": (f"{CJ} -80EA", "", 0, 9, NO_RACKS),
    "CJ1M-CPU13": (CJ, "", 1, 9, CJ_CAUSES),
    "CJ1M-CPU21": (f"{CJ} -80EA", "", 0, 9, NO_RACKS),
    "CJ1M-CPU22": (f"{CJ} -80EA", "", 0, 9, NO_RACKS),
    "CJ1M-CPU23": (CJ, "", 1, 9, CJ_CAUSES),
    "CJ1M-CPU63": ("-82F0 -00A0", "", 3, 9, CJ_CAUSES),  # the example program checks the inner board's flag
    "CJ2M-CPU33": (CJ, FLASH, 3, 9, CJ_CAUSES),
    "CS1G-CPU44H": ("-80CE", "", 7, 9, CS_CAUSES),
    "CS1H-CPU65H": ("-80CE", "", 7, 9, CS_CAUSES),
    "CS1D-CPU65H": ("-80CE", DUPLEX, 7, 9, CS_CAUSES),
    "CP1H-XA40D": (f"{CJ} -80CE -80CF -80EA", CP_UNITS, 0, 1, NO_UNITS),
}
"""What is missing, what is extra, the last rack, the last slot, the causes of 80E1."""
ORDER = """
80F1 80C0 80CE 80CF 80CA 80E9 80EA 82F0 80E1 80E0 80F0 809F C100
4100 0003 0010 0011 0600 008B 009A 009B 00E7 02F0 0200 0300 03FF 00A0 00F7 0400 0500 008A 00D1 00F1
""".split()
SHARED = ("80C0 80CE 80CF 80CA", "0003 0010 0011 0600", "0300 03FF", "008A 00D1 00F1")
"""Codes that the reference gives one place in the order."""


def rows(name: str) -> set[str]:
    missing, extra, rack, slot, causes = MODELS[name]
    ports = {"CJ2M-CPU33": NETWORK, "CP1H-XA40D": ""}.get(name, f"{SERIAL}{NETWORK}")
    text = (
        f"{FATAL}{NONFATAL}{extra}\n{ports}".replace("RACK", str(rack))
        .replace("SLOT", str(slot))
        .replace("CAUSES", causes)
    )
    if name == "CJ1M-CPU63":
        text = text.replace(MEMORY, f"{MEMORY} +")
    text = text.replace("INTERRUPT", INTERRUPTS[causes == CS_CAUSES])
    if extra == CP_UNITS:  # no memory card
        text = text.replace(" A403.09", "")
    gone = missing.replace("-", "").split()
    return {line for line in text.splitlines() if line and line[:4] not in gone}


def coded(model: Model) -> list[ErrorEntry]:
    return [error for error in model.errors() if error.coded]


def shown(error: ErrorEntry) -> str:
    head = f"{error.code_text or 'none'} {error.flag_text}" + "".join(f" also {each.text}" for each in error.also)
    return " | ".join((head, *map(_detail, error.details)))


def _detail(detail: ErrorDetail) -> str:
    first, plus = detail.addresses[0], " +" if detail.addresses[0].add_to_code else ""
    if detail.control != "List":
        if first.location is None:
            return f"{detail.control} {first.minimum}..{first.maximum}{plus}"
        if first.kind == "BitArray":
            return f"{detail.control} {first.text}[{first.minimum}..{first.maximum}]{plus}"
        return f"{detail.control} {_field(first)} {first.minimum}..{first.maximum}{plus}"
    if first.kind == "Bit":
        return f"List {' '.join(each.text for each in detail.addresses)}{plus}"
    form = "{:04X}".format if first.width == 16 else str
    return f"List {_field(first)}={','.join(form(each.value or 0) for each in detail.addresses)}{plus}"


def _field(address: ErrorAddress) -> str:
    return f"{address.text}.{address.shift:02}-{address.shift + address.width - 1:02}"


@pytest.mark.parametrize("name", MODELS)
def test_it_has_just_the_errors_of_the_reference(models: dict[str, Model], name: str) -> None:
    assert {shown(error) for error in models[name].errors()} == rows(name)


def test_no_omron_with_an_auxiliary_area_is_left_out(models: dict[str, Model]) -> None:
    assert {model.name for model in models.values() if model.area("A") is not None} == set(MODELS)


@pytest.mark.parametrize("name", MODELS)
def test_the_order_of_seriousness(models: dict[str, Model], name: str) -> None:
    errors = sorted(coded(models[name]), key=lambda error: (error.priority, ORDER.index(error.code_text)))
    codes = [error.code_text for error in errors]
    assert codes == [code for code in ORDER if code in codes]
    by_priority: dict[int, set[str]] = {}
    for error in errors:
        by_priority.setdefault(error.priority, set()).add(error.code_text)
    for several in by_priority.values():
        assert len(several) == 1 or any(several <= set(group.split()) for group in SHARED), several


@pytest.mark.parametrize("name", MODELS)
def test_the_order_goes_through_a401_and_a402_from_bit_15_down(models: dict[str, Model], name: str) -> None:
    """Errors of one bit share a place, but for 80E9, which comes before 80EA."""
    bits = [f"A{word}.{bit:02}" for word in (401, 402) for bit in reversed(range(16))]
    errors = coded(models[name])
    places = {(bits.index(error.flag_text), error.code_text == "80EA"): error.priority for error in errors}
    assert all(places[bits.index(error.flag_text), error.code_text == "80EA"] == error.priority for error in errors)
    assert [places[each] for each in sorted(places)] == sorted(set(places.values()))


@pytest.mark.parametrize("name", MODELS)
def test_what_has_no_code_is_the_least_serious(models: dict[str, Model], name: str) -> None:
    least = max(error.priority for error in coded(models[name]))
    assert all(error.priority > least for error in models[name].errors() if not error.coded)


@pytest.mark.parametrize("name", MODELS)
def test_fatal_is_what_has_a_flag_in_a401(models: dict[str, Model], name: str) -> None:
    for error in models[name].errors():
        assert (error.severity == "fatal") is error.flag_text.startswith("A401."), error.id


CLOCK = {"special clock-second-minute A351", "special clock-hour-day A352", "special clock-month-year A353"}
PAGE_34 = "A401.15 A401.14 A401.13 A401.12 A401.11 A401.10 A401.09 A401.08 A402.15 A402.13 A402.10 A402.05 A402.03 A402.02".split()
"""Flags that the reference has from a page of the FS manual; and A402.12 from a page of errorlog.net, A402.00 from one of the CP1L."""
PAGE_1018 = [f"A219.{port:02}" for port in range(8)]
"""Flags of a page of the W340, which has their completion codes, too."""
QSD = "SD0 SD1 SD2 SD3 SD4".split()
PAGE = re.compile(r"\bp\.\d+|\bpage on \S")


@pytest.mark.parametrize("name", [*MODELS, "Q03UD", "NJ501-1300"])
def test_only_what_the_reference_has_from_a_page_is_verified(models: dict[str, Model], name: str) -> None:
    model = models[name]
    verified = [fact for fact in model.facts if fact.verified]
    assert all(PAGE.search(fact.source) for fact in verified), [fact.source for fact in verified]
    flags = {fact.value for fact in verified if fact.of == "flag"}
    specials = {f"{fact.kind} {fact.subject} {fact.value}" for fact in verified if fact.of == "address"}
    if name in MODELS:
        every = {error.flag_text for error in model.errors()}
        also = {"A402.12", *(["A402.00"] if name == "CP1H-XA40D" else [])}
        assert flags == every & {*PAGE_34, *PAGE_1018, *also}
        assert specials == CLOCK
        assert {fact.of for fact in verified if fact.kind == "system"} == {"records"}
        ports = {error.id for error in model.errors() if error.flag_text in PAGE_1018}
        assert {fact.of for fact in verified if fact.kind == "error" and fact.subject not in ports} == {
            "flag",
            "severity",
        }
        assert {fact.of for fact in verified if fact.subject in ports} == ({"flag", "details"} if ports else set())
    elif name == "Q03UD":
        assert {each.rsplit(" ", 1)[1] for each in specials} == set(QSD)
        assert not flags
    else:
        assert {flag.rsplit(".", 1)[1] for flag in flags} == {"07", "06"}
        assert {fact.subject for fact in verified if fact.of == "code"} == {"task-period-exceeded"}
    assert not any(fact.verified for fact in model.facts if fact.kind in ("area", "instruction"))


QNU = """
1000-1009 S, 1010 S, 1012 S, 1101-1109 S, 1200-1205 S, 1300 P, 1401-1402 P, 1411-1414 S, 1500 C, 1600 C, 2000 P, 2100-2128 S,
2200 S, 2400-2401 P, 2500-2504 S, 3000-3015 S, 3100-3107 S, 3300-3301 S, 4000-4004 S, 4010 S, 4100-4101 P, 5000 S, 5001 S,
5010-5011 C, 7000 S, 9000 C
"""
"""Stop, continue, by parameter (which stops unless the parameters say otherwise). Of 4100 to 4141 what the bench can tell apart."""


def test_the_qnu_has_the_codes_of_the_reference(models: dict[str, Model]) -> None:
    wanted: dict[int, str] = {}
    for part in QNU.replace("\n", " ").split(","):
        codes, behaviour = part.split()
        first, _, last = codes.partition("-")
        wanted |= dict.fromkeys(range(int(first), int(last or first) + 1), "nonfatal" if behaviour == "C" else "fatal")
    found = {code: error.severity for error in models["Q03UD"].errors() for codes in error.codes for code in codes}
    assert found == wanted


NJ = """
60020000 major, 60030000 major, 40110000 major, 10200000 major, 10210000 major, 10220000 major, 10230000 major, 04010000 major,
24010000 major, 24020000 major, 24030000 major, 24040000 major, 34010000 major, 84200000 partial, 84220000 partial, 60010000 minor,
10080000 minor, 64430000 minor, 64440000 minor, 64450000 minor, 64460000 minor, 64480000 minor, 68220000 minor,
000B0000 observation, 54010000 observation
"""
_LEVEL_BITS = {"major": 7, "partial": 6, "minor": 5, "observation": 4}


def test_the_nj_has_the_events_of_the_reference(models: dict[str, Model]) -> None:
    wanted = dict(part.split() for part in NJ.replace("\n", " ").split(","))
    found = {error.code_text: error for error in models["NJ501-1300"].errors() if not error.id.startswith("user-fault")}
    assert found.keys() == wanted.keys()
    for code, level in wanted.items():
        assert (found[code].severity == "fatal") is (level == "major")
        assert found[code].flag.bit == _LEVEL_BITS[level]
        assert any(each.text == f"_ErrSta.{_LEVEL_BITS[level]:02}" for each in found[code].also), code


def test_every_kind_of_detail_is_used(models: dict[str, Model]) -> None:
    details = [detail for model in models.values() for error in model.errors() for detail in error.details]
    addresses = [address for detail in details for address in detail.addresses]
    assert {detail.control for detail in details} == {"List", "Spin", "Edit"}
    assert {address.kind for address in addresses} == {"Bit", "Word", "Byte", "BCD", "Nibble", "BitArray"}
    assert {address.base for address in addresses} == {0, 10, 16}


def test_nothing_that_is_shown_lacks_japanese(models: dict[str, Model]) -> None:
    for model in models.values():
        for where, name, description, wordings in _texts(model):
            assert name or description, (model.name, where)
            japanese = [wording for wording in wordings if wording.language == "ja"]
            assert len(japanese) == 1, (model.name, where)
            assert bool(japanese[0].name) is bool(name), (model.name, where)
            assert bool(japanese[0].description) is bool(description), (model.name, where)


Texts = tuple[str, str, str, tuple[Wording, ...]]


def _texts(model: Model) -> Iterator[Texts]:
    """Where, name, description and the wordings of everything that people read."""
    yield model.name, "", model.description, model.wordings
    groups = list(model.catalogue)
    while groups:
        group = groups.pop()
        groups += group.groups
        yield group.name, group.name, "", group.wordings
    for error in model.errors():
        yield error.id, error.name, error.description, error.wordings
        for detail in error.details:
            yield f"{error.id}:{detail.name}", "", detail.description, detail.wordings
            if detail.control == "List":
                for each in detail.addresses:
                    yield f"{error.id}:{detail.name}={each.id}", "", each.description, each.wordings
