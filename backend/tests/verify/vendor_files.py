"""Traces of a native run as the tools of vendors write them. All files are of our own making; docs/trace-format.md says after which
description. Samples come up to 20 % of an interval too early or too late, and numbers are rounded."""

import random
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache

from scanbench.engines.native.engine import NativeEngine
from scanbench.program.program import Program
from scanbench.runtime.command import Refusal
from scanbench.runtime.programs import Loaded
from scanbench.runtime.resource import Resource
from scanbench.runtime.write import Write
from scanbench.symbols.symbols import resolve
from scanbench.symbols.values import format_value
from tests.verify.trace_parts import program_of

LINE = """
FUNCTION_BLOCK FB_Belt
VAR_INPUT run : BOOL; END_VAR
VAR_OUTPUT position : INT; parts : DINT; END_VAR
  IF run THEN position := position + 7; END_IF;
  IF position >= 100 THEN position := position - 100; parts := parts + 1; END_IF;
END_FUNCTION_BLOCK
PROGRAM Main
VAR
  start AT CIO 0.00 : BOOL; stop AT CIO 0.01 : BOOL; raw AT D200 : INT; setpoint : REAL := 40.0;
  motor AT CIO 100.00 : BOOL; valve AT CIO 100.01 : BOOL; total AT D100 : INT;
  level : REAL; temperature : REAL; error : REAL; belt : FB_Belt; status : WORD;
END_VAR
  motor := (start OR motor) AND NOT stop;
  belt(run := motor);
  level := level + INT_TO_REAL(raw) * 0.0137;
  IF valve THEN level := level - 1.73; END_IF;
  error := setpoint - level;
  IF error < 0.0 THEN valve := TRUE; ELSIF error > 12.5 THEN valve := FALSE; END_IF;
  temperature := temperature + (level * 1.31 - temperature) * 0.05;
  total := DINT_TO_INT(belt.parts MOD 1000);
  status := INT_TO_WORD(total * 3 + belt.position);
END_PROGRAM
"""
SIGNALS = (
    "start", "stop", "raw", "setpoint", "motor", "valve", "total", "level", "temperature", "error",
    "belt.position", "belt.parts", "status",
)  # fmt: skip
INTERVAL_MS = 10
FIRST, SCANS = 37, 120
WRONG = 60
"""The row with a planted fault."""


@dataclass(frozen=True)
class Recorded:
    """Values of each signal, as the watch table shows them, row by row, and the time of each row in ms."""

    values: dict[str, list[str]]
    times: list[float]

    def rows(self) -> range:
        return range(len(self.times))

    def number(self, signal: str, row: int, decimals: int = 2, point: str = ".") -> str:
        """A cell as most tools write it: BOOL as a digit, REAL with so many decimals, WORD as a number."""
        text = self.values[signal][row]
        if text in ("TRUE", "FALSE"):
            return "1" if text == "TRUE" else "0"
        if text.startswith("16#"):
            return str(int(text[3:], 16))
        return f"{float(text):.{decimals}f}".replace(".", point) if "." in text or "e" in text else text


@cache
def program() -> Program:
    return program_of(LINE)


@cache
def clean(seed: int = 1) -> Recorded:
    """The middle of a run."""
    chance, made = random.Random(seed), program()
    resource = Resource(Loaded.make(made, NativeEngine))
    values: dict[str, list[str]] = {each: [] for each in SIGNALS}
    for scan in range(FIRST + SCANS):
        writes = {5: ("start", "TRUE"), 9: ("start", "FALSE"), 110: ("stop", "TRUE"), 118: ("stop", "FALSE")}
        writes[130] = ("start", "TRUE")
        for path, value in (*([writes[scan]] if scan in writes else []), ("raw", str(chance.randrange(10, 90)))):
            assert not isinstance(resource.submit(Write("Ada", f"Main.{path}", value)), Refusal)
        resource.run(1)
        if scan >= FIRST:
            for each in SIGNALS:
                symbol = resolve(made, f"Main.{each}")
                data = bytes(resource.memory[symbol.offset : symbol.offset + symbol.type.size])
                data = data if symbol.bit is None else bytes((data[0] >> symbol.bit & 1,))
                values[each].append(format_value(symbol.type, data))
    times = [INTERVAL_MS * (row + chance.uniform(-0.2, 0.2)) for row in range(SCANS)]
    return Recorded(values, times)


def faulty(signal: str, seed: int = 1) -> Recorded:
    """The same with a wrong value of one signal in one row."""
    recorded = clean(seed)
    text = recorded.values[signal][WRONG]
    if text in ("TRUE", "FALSE"):
        wrong = "FALSE" if text == "TRUE" else "TRUE"
    elif text.startswith("16#"):
        wrong = f"16#{int(text[3:], 16) ^ 1:04X}"
    else:
        wrong = str(float(text) + 0.05) if "." in text else str(int(text) + 1)
    column = [*recorded.values[signal][:WRONG], wrong, *recorded.values[signal][WRONG + 1 :]]
    return Recorded({**recorded.values, signal: column}, recorded.times)


def clock(ms: float, form: str = "{h:02}:{m:02}:{s:02}.{f:03}") -> str:
    """A time of day, some minutes before noon."""
    at = round(ms) + (11 * 3600 + 59 * 60 + 59) * 1000
    return form.format(h=at // 3_600_000, m=at // 60_000 % 60, s=at // 1000 % 60, f=at % 1000)


def lines(rows: Sequence[Sequence[str]], separator: str, end: str = "\r\n") -> str:
    return "".join(separator.join(row) + end for row in rows)


# ---- layouts with a description or with files to be seen -------------------------------------------------------------


def codesys_2(of: Recorded) -> bytes:
    head = ["CoDeSys Trace", "C:\\PROJECTS\\LINE.PRO", " ".join(["Cycle", *(f"PLC_PRG.{each}" for each in SIGNALS)])]
    rows = [" ".join([str(row), *(of.number(each, row) for each in SIGNALS)]) for row in of.rows()]
    return "\r\n".join([*head, *rows, ""]).encode()


def _scope(groups: Sequence[tuple[Sequence[str], int]], point: str) -> list[list[str]]:
    """The block of properties: for each group a column of times, then its channels."""
    kinds = {"status": "UINT16", "raw": "INT16", "total": "INT16", "belt.position": "INT16", "belt.parts": "INT32"}
    kinds |= dict.fromkeys(("start", "stop", "motor", "valve"), "BIT")
    properties: list[tuple[str, Callable[[str, int], str]]] = [
        ("Name", lambda signal, _: signal.split(".")[-1]),
        ("SymbolComment", lambda _, __: ""),
        ("Data-Type", lambda signal, _: kinds.get(signal, "REAL32")),
        ("SampleTime[ms]", lambda _, every: f"{10 * every}"),
        ("VariableSize", lambda _, __: "4"),
        ("SymbolBased", lambda _, __: "True"),
        ("SymbolName", lambda signal, _: f"MAIN.{signal}"),
        ("NetID", lambda _, __: "5.1.2.3.1.1"),
        ("Port", lambda _, __: "851"),
        ("Offset", lambda _, __: "0"),
        ("ScaleFactor", lambda _, __: "1"),
        ("Unit", lambda _, __: "(None)"),
    ]
    return [
        [cell for signals, every in groups for cell in (label, *(of(each, every) for each in signals))]
        for label, of in properties
    ]


def twincat(of: Recorded) -> bytes:
    """German, tabs, milliseconds."""
    head = [
        ["Name", "Line"],
        ["File", "C:\\Line.csv"],
        ["Starttime of export", "133800000000000000", "Samstag", "11:59:59.000"],
    ]
    rows = [
        [f"{of.times[row]:.3f}".replace(".", ","), *(of.number(each, row, 3, ",") for each in SIGNALS)]
        for row in of.rows()
    ]
    return lines([*head, [""], *_scope([(SIGNALS, 1)], ","), [""], *rows, ["EOF"]], "\t").encode("utf-8-sig")


def twincat_tasks(of: Recorded) -> bytes:
    """Full time stamps, and a slower task, whose channels have a column of times of their own and fewer rows."""
    slow = ("temperature", "status")
    fast = tuple(each for each in SIGNALS if each not in slow)
    start = 133_800_000_000_000_000
    stamp = [str(start + round(each * 10_000)) for each in of.times]
    rows = []
    for row in of.rows():
        cells = [stamp[row], *(of.number(each, row) for each in fast)]
        if 2 * row < len(of.times):
            cells += [stamp[2 * row], *(of.number(each, 2 * row) for each in slow)]
        rows.append(cells)
    head = [["Name", "Line"], ["File", "C:\\Line.csv"], [""]]
    return lines([*head, *_scope([(fast, 1), (slow, 2)], "."), [""], *rows], ";").encode()


def mitsubishi(of: Recorded) -> bytes:
    kinds = {"setpoint": "FLOAT[EXP.3]", "level": "FLOAT[EXP.3]", "temperature": "FLOAT[EXP.3]", "error": "FLOAT[EXP.3]",
             "status": "USHORT[HEX]", "belt.parts": "LONG[DEC.0]"}  # fmt: skip
    kinds |= dict.fromkeys(("start", "stop", "motor", "valve"), "BIT[1;0]")
    rows = []
    for row in of.rows():
        apart = 0 if row == 0 else round(1000 * (of.times[row] - of.times[row - 1]))
        cells = [
            f"{int(of.number(each, row)):04X}" if each == "status" else of.number(each, row, 3) for each in SIGNALS
        ]
        rows.append(
            [f"2026/11/28 {clock(of.times[row], '{h:02}:{m:02}:{s:02}')}", str(apart), str(row + 1), *cells, ""]
        )
    head = [
        ["[LOGGING]", "RCPU_2", "3", "4", "5", "2"], ["Line 1"],
        ["DATETIME[YYYY/MM/DD hh:mm:ss]", "INTERVAL[us]", "INDEX", *(kinds.get(each, "SHORT[DEC.0]") for each in SIGNALS), "TRIGGER[*]"],
        ["TIME", "INTERVAL[us]", "INDEX", *(f"ProgPou/{each}" for each in SIGNALS), "Trigger"],
    ]  # fmt: skip
    return lines([*head, *rows], ",").encode("cp932")


def rockwell(of: Recorded) -> bytes:
    tags = [
        f'"Program:MainProgram.{each.title().replace(".", "_")}"'
        if "." not in each
        else f'"Program:MainProgram.{each}"'
        for each in SIGNALS
    ]
    head = [
        ["Controller Name:", '"Line1"'], ["Trend Name:", '"Trend1"'], ["Trend Tags:", str(len(SIGNALS))],
        ["Sample Period:", "10 ms"], ["Description:"], ["Start Trigger:", "No Trigger"], [""],
        ["Header:", '"Date"', '"Time"', *tags],
    ]  # fmt: skip
    rows = [
        [
            "Data",
            "11/28/2026",
            clock(of.times[row], "{h:02}:{m:02}:{s:02};{f:03}"),
            *(of.number(each, row) for each in SIGNALS),
        ]
        for row in of.rows()
    ]
    return lines([*head, *rows], ",").encode()


def panasonic(of: Recorded) -> bytes:
    head = [
        ["Date", "Time", "Obtaining interval", *(str(at + 1) for at in range(len(SIGNALS)))],
        ["", "", "", *(each.replace(".", "_") if "." not in each else each for each in SIGNALS)],
        ["", "", "", *("MOMENT" for _ in SIGNALS)],
    ]
    rows = []
    for row in of.rows():
        apart = 0 if row == 0 else round(100 * of.times[row]) - round(100 * of.times[row - 1])
        rows.append(
            [
                "2026/11/28",
                clock(of.times[row], "{h:02}:{m:02}:{s:02}"),
                str(apart),
                *(of.number(each, row) for each in SIGNALS),
            ]
        )
        if row == 100:
            rows.append(["2026/11/28", clock(of.times[row], "{h:02}:{m:02}:{s:02}"), "12", "STOP TRG"])
    return lines([*head, *rows], ",").encode()


# ---- layouts that nobody describes: read by their shape -------------------------------------------------------------


def codesys_3(of: Recorded) -> bytes:
    """A column of times for each signal, microseconds, semicolons and a decimal comma."""
    names = [f"Application.PLC_PRG.{each}" for each in SIGNALS]
    head = [["CODESYS trace", "Trace1"], ["Task", "MainTask"], [cell for each in names for cell in ("Time [us]", each)]]
    rows = [
        [cell for each in SIGNALS for cell in (str(round(1000 * of.times[row])), of.number(each, row, 2, ","))]
        for row in of.rows()
    ]
    return lines([*head, *rows], ";").encode()


def codesys_xml(of: Recorded) -> bytes:
    found = []
    for each in SIGNALS:
        times = ",".join(str(round(1000 * time)) for time in of.times)
        values = ",".join(of.number(each, row, 3) for row in of.rows())
        found.append(
            f'<TraceVariable VarName="Application.PLC_PRG.{each}"><Values>{values}</Values><Timestamps>{times}</Timestamps></TraceVariable>'
        )
    return f'<?xml version="1.0" encoding="utf-8"?>\n<Trace><Record>{"".join(found)}</Record></Trace>'.encode()


def sysmac(of: Recorded) -> bytes:
    head = [
        ["Sysmac Studio Data Trace"], ["Trace name", "DataTrace0"], ["Sampling", "PrimaryTask"], [""],
        ["Date and time", "Sampling no", *(f"new_Controller_0.Program0.{each}" for each in SIGNALS)],
    ]  # fmt: skip
    rows = [
        [f"2026-11-28-{clock(of.times[row], '{h:02}:{m:02}:{s:02}.{f:03}')}", str(row),
         *(("True" if of.number(each, row) == "1" else "False") if of.values[each][row] in ("TRUE", "FALSE") else of.number(each, row, 3) for each in SIGNALS)]
        for row in of.rows()
    ]  # fmt: skip
    return lines([*head, *rows], ",").encode("utf-8-sig")


def cx_programmer(of: Recorded) -> bytes:
    """Addresses, and no times: samples are taken at the end of each cycle."""
    places = {"start": "0.00", "stop": "0.01", "motor": "100.00", "valve": "100.01", "raw": "D200", "total": "D100"}
    head = [
        ["CX-Programmer Data Trace"],
        ["Sampling Interval", "1 cycle"],
        ["No.", *(places.get(each, each) for each in SIGNALS)],
    ]
    rows = [[str(row), *(of.number(each, row) for each in SIGNALS)] for row in of.rows()]
    return lines([*head, *rows], ",").encode("cp932")


def tia(of: Recorded) -> bytes:
    head = [
        ["Trace", "Line"], ["Device", "PLC_1 [CPU 1515-2 PN]"], ["Software", "TIA Portal V18"],
        ["Sample", "Time [ms]", *(f'"DB_Line".{each}' for each in SIGNALS)],
        ["", "", *("" for _ in SIGNALS)],
    ]  # fmt: skip
    rows = [
        [str(row), f"{of.times[row]:.3f}".replace(".", ","), *(of.number(each, row, 2, ",") for each in SIGNALS)]
        for row in of.rows()
    ]
    return "".join(";".join(row) + "\r\n" for row in [*head, *rows]).encode("utf-8-sig")


FILES: dict[str, Callable[[Recorded], bytes]] = {
    "codesys2.txt": codesys_2, "codesys3.csv": codesys_3, "codesys.trace": codesys_xml, "twincat.csv": twincat,
    "twincat-tasks.csv": twincat_tasks, "sysmac.csv": sysmac, "cx.csv": cx_programmer, "tia.csv": tia,
    "melsec.csv": mitsubishi, "studio5000.csv": rockwell, "fpwin.csv": panasonic,
}  # fmt: skip
