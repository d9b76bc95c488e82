"""Makes a failing program small: leaves out lines as long as it goes on failing in the same way."""

from collections.abc import Callable


def reduced(source: str, fails: Callable[[str], bool]) -> str:
    """The source with as many lines left out as can be; `fails` says whether a smaller one still shows the failure."""
    lines = source.splitlines()
    width = len(lines) // 2
    while width:
        before = len(lines)
        at = len(lines) - width
        while at >= 0:
            shorter = lines[:at] + lines[at + width :]
            if fails("\n".join(shorter)):
                lines = shorter
                at = min(at, len(lines) - width + 1)
            at -= 1 if width < 8 else width // 2
        if len(lines) == before or width > 1:
            width //= 2
    return "\n".join(lines)
