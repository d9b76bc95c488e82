"""What a project of 2,400 POUs costs: checked for the first time, checked again after an edit of one line, and unchanged.

`python -m bench.projects`. Seconds of the processor, so that what else runs here does not count.
"""

import sys
from time import process_time

from scanbench.check.build import check_sources
from scanbench.check.incremental import Checks
from scanbench.plcmodel.load import load_all, model_directory, model_named

POUS, IN_A_FILE = 2400, 20
INTERVAL_NS = 10_000_000
UNIT = """FUNCTION_BLOCK Unit{0}
VAR_INPUT run : BOOL; level, high : INT; END_VAR
VAR_OUTPUT ok : BOOL; total : DINT; END_VAR
VAR delay : TON; numbers : ARRAY[1..10] OF INT; i : INT; r : REAL; END_VAR
delay(IN := run, PT := T#1s);
FOR i := 1 TO 10 DO
  numbers[i] := level + i;
  IF numbers[i] > high THEN total := total + numbers[i]; END_IF
END_FOR
r := REAL#2.5 * INT_TO_REAL(level);
CASE level OF 1: ok := TRUE; 2..5: ok := delay.Q; ELSE ok := r > 10.0; END_CASE
IF ok AND run THEN r := r + 1.0; ELSIF total > 100 THEN total := 0; END_IF
END_FUNCTION_BLOCK
"""


def project() -> dict[str, str]:
    """The texts: blocks of a dozen lines, of which a program calls some."""
    files = {
        f"f{first}.st": "".join(UNIT.format(number) for number in range(first, first + IN_A_FILE))
        for first in range(0, POUS, IN_A_FILE)
    }
    variables = " ".join(f"u{number} : Unit{number};" for number in range(POUS))
    calls = "\n".join(f"u{number}();" for number in range(0, POUS, 10))
    return files | {"main.st": f"PROGRAM Main\nVAR {variables} END_VAR\n{calls}\nEND_PROGRAM\n"}


def main() -> None:
    """Prints the figures."""
    model = model_named("GENERIC-IEC", load_all(model_directory())[0])
    texts, checks = project(), Checks()
    begin = process_time()
    check_sources(texts, model)
    _say("checked for the first time", begin)
    checks.diagnose(texts, model, INTERVAL_NS)
    edited = texts
    for number in range(1, 6):
        edited = texts | {"f20.st": texts["f20.st"].replace("level + i", f"level + i + {number}", 1)}
        begin = process_time()
        checks.diagnose(edited, model, INTERVAL_NS)
        _say(f"edit {number}", begin)
    begin = process_time()
    checks.diagnose(edited, model, INTERVAL_NS)
    _say("unchanged", begin)


def _say(what: str, begin: float) -> None:
    sys.stdout.write(f"{what:30}{process_time() - begin:8.3f} s\n")


if __name__ == "__main__":
    main()
