"""Random blocks with FB_init, variables that are kept, blocks that last for a call, and jumps: both engines leave the same bytes."""

from hypothesis import given, settings
from hypothesis import strategies as st

from scanbench.check.build import check_sources
from scanbench.engines.interpreter.engine import ReferenceEngine
from scanbench.engines.native.engine import NativeEngine
from scanbench.runtime.header import Mode, fresh_image
from scanbench.syntax.language_file import with_dialect
from tests.amounts import amount
from tests.caseformat import MODELS

MODEL = MODELS["GENERIC-IEC"]
SCANS = 4


@st.composite
def projects(draw: st.DrawFn) -> str:
    """Blocks that contain and extend those before them, and a program that uses them in all ways."""
    number = st.integers(-9, 99)
    texts: list[str] = ["VAR_GLOBAL log : DINT; END_VAR\n"]
    names: list[str] = []
    for index in range(draw(st.integers(1, 4))):
        name, extends = f"B{index}", draw(st.sampled_from(["", *names]))
        held = draw(st.lists(st.sampled_from(names), max_size=3)) if names else []
        declared = [
            _held(draw, position, each, f"x{index} + {draw(number)}", f"{index}_") for position, each in enumerate(held)
        ]
        own = "".join(f"  {each}\n" for each in declared)
        reinit = "METHOD FB_reinit : BOOL\n  log := log + 1000;\nEND_METHOD\n" if draw(st.booleans()) else ""
        after = f"{{attribute 'call_after_init'}}\nMETHOD after{index}\n  log := log * 3 + x{index};\nEND_METHOD\n"
        kept = draw(st.sampled_from(["VAR_INST", "VAR_STAT"]))
        temporary = draw(st.sampled_from(names)) if names else ""
        local = f"VAR\n  t : {temporary}(a := {draw(number)});\nEND_VAR\n" if temporary else ""
        used = f"  step := step + t.step{temporary[1:]}();\n" if temporary else ""
        texts.append(
            f"FUNCTION_BLOCK {name}{f' EXTENDS {extends}' if extends else ''}\nVAR\n  x{index} : DINT := {draw(number)};\n{own}END_VAR\n"
            "METHOD FB_init : BOOL\nVAR_INPUT\n  bInitRetains, bInCopyCode : BOOL; a : DINT;\nEND_VAR\n"
            f"  x{index} := x{index} * 2 + a;\n  log := log * 7 + x{index};\nEND_METHOD\n{reinit}{after if draw(st.booleans()) else ''}"
            f"METHOD step{index} : DINT\n{kept}\n  count : DINT := {draw(number)};\nEND_VAR\n{local}"
            f"  count := count + x{index};\n  step := count;\n{used}END_METHOD\nEND_FUNCTION_BLOCK\n".replace(
                "step :=", f"step{index} :="
            ).replace(":= step +", f":= step{index} +")
        )
        names.append(name)
    main = draw(st.lists(st.sampled_from(names), min_size=1, max_size=4))
    declared = [_held(draw, position, each, f"n + {draw(number)}", "") for position, each in enumerate(main)]
    calls = "".join(
        f"  sum := sum + {_of(text)}.step{each[1:]}();\n  IF sum MOD {draw(st.integers(2, 5))} = 0 THEN JMP {draw(st.sampled_from(['again', 'done']))}; END_IF\n"
        for text, each in zip(declared, main, strict=True)
    )
    return "".join(texts) + (
        "PROGRAM Main\nVAR\n  n : DINT := 5; sum, rounds : DINT;\n" + "".join(f"  {each}\n" for each in declared) + "END_VAR\n"
        f"again:\n  rounds := rounds + 1;\n  IF rounds MOD 5 = 0 THEN JMP done; END_IF\n{calls}done: n := n + 1;\nEND_PROGRAM\n"
    )  # fmt: skip


def _held(draw: st.DrawFn, position: int, block: str, argument: str, prefix: str) -> str:
    name, more = f"h{prefix}{position}", draw(st.sampled_from(["plain", "array", "elements", "values"]))
    values = f" := (x{block[1:]} := {position + 40})" if more == "values" else ""
    match more:
        case "elements":
            return f"{name} : ARRAY[0..1] OF {block}[(a := {argument}), (3)];"
        case "array":
            return f"{name} : ARRAY[2..3] OF {block}[({argument}), (a := 4)];"
        case _:
            return f"{name} : {block}(a := {argument}){values};"


def _of(text: str) -> str:
    """How a call names one of these variables."""
    name = text.split(" ", 1)[0]
    return f"{name}[1]" if "[0..1]" in text else f"{name}[2]" if "[2..3]" in text else name


@given(projects())
@settings(max_examples=amount(400, 12), deadline=None)
def test_both_engines_leave_the_same_bytes(text: str) -> None:
    checked = check_sources(with_dialect({"a.st": text}, "codesys"), MODEL)
    program = checked.program
    assert program is not None, (text, checked.problems)
    images = [fresh_image(program, Mode.RUN) for _ in range(2)]
    engines = [ReferenceEngine(program, images[0]), NativeEngine(program, images[1])]
    for _ in range(SCANS):
        stops = [engine.run(1) for engine in engines]
        assert stops[0] == stops[1], text
        assert bytes(images[0][: program.layout.state_size]) == bytes(images[1][: program.layout.state_size]), text
