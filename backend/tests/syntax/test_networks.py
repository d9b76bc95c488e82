"""Networks as text: where a pragma means one."""

import pytest

from scanbench.syntax.parse_file import parse_file
from scanbench.syntax.source import Source


@pytest.mark.parametrize(
    ("word", "body", "place"),
    [
        ("NETWORK", "    a := b;\n    {off}\n    b := a;\n", (4, 5)),
        ("NETWORK", "    a := b;\n    {OFF}\n", (4, 5)),
        ("RUNG", "    [a] { off } (b)\n", (3, 9)),
    ],
)
def test_a_network_is_switched_off_as_a_whole(word: str, body: str, place: tuple[int, int]) -> None:
    source = f"PROGRAM Main\n{word}\n{body}END_{word}\n{{off}}\n{word}\nEND_{word}\nEND_PROGRAM\n"
    _, (problem,) = parse_file(Source("main.st", source))
    assert problem.message == f"`{{off}}` switches a whole {word} off: write it above the word {word}."
    assert (problem.span.line, problem.span.column) == place
