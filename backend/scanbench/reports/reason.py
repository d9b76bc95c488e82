"""Why an error got its grade, in words: for tables, JUnit and pages."""

from collections.abc import Sequence

from scanbench.faults.reaction.reaction import Reaction, Unreached

_SHOWN = 3
_FROM_TEXT = "from the program's text: it may decide an output later, or never"


def reason_of(reaction: Reaction) -> str:
    """A sentence; the note says the rest. Empty where nothing is known but the verdict."""
    read = f"read in {', '.join(some(reaction.reader_places))}" if reaction.readers else ""
    changed = [f"{each.path} {each.without} -> {each.value}" for each in reaction.differences]
    window = reaction.window
    match reaction.verdict:
        case "stopped":
            return "a fatal error: the PLC stopped, as the model says"
        case "never_read":
            return f"no statement reads its flag, code or details, or the error log ({window} scans were compared)"
        case "not_reached":
            return f"not reached in the {window} scans: {'; '.join(some(list(map(_missed, reaction.unreached))))}; try a longer window or a different state"
        case "no_effect":
            return f"{read}, but nothing differed in {window} scans"
        case "stored" | "stored_only":
            kept = ", ".join(some([each.path for each in reaction.differences]))
            return "; ".join(filter(None, (read, f"stored in {kept}, which decides nothing")))
        case "displayed":
            told = f"displayed in {', '.join(some(reaction.displayed))}, which only tools read"
            return "; ".join(filter(None, (read, told)))
        case "decided":
            return "; ".join(filter(None, (read, _decided(reaction))))
        case _:
            return "; ".join(filter(None, (read, ", ".join(some(changed)))))


def _decided(reaction: Reaction) -> str:
    if reaction.decided_by:
        lines = ", ".join(some(reaction.decided_by))
        return f"{lines} ran in one of the two runs only, and wrote what was there already; {_FROM_TEXT}"
    state = "; ".join(
        some([f"{each.path} (read in {', '.join(some(each.readers)) or 'no statement'})" for each in reaction.carried])
    )
    return f"no output differed in the {reaction.window} scans; still different at their end: {state}; {_FROM_TEXT}"


def _missed(each: Unreached) -> str:
    where = f"{each.file}:{each.line} ({', '.join(some(each.paths))})"
    match each.why:
        case "condition":
            return f"{where}, as {each.at} did not come to it"
        case "left":
            return f"{where}, as its body was left before it"
        case "task":
            return f"{where}, as task {each.at} had no turn"
        case _:
            return f"{where}, as its body did not run"


def evidence_of(reaction: Reaction) -> list[str]:
    """The words, variables and statements that the grade is about, without a sentence: the same in every language."""
    carried = [f"{each.path} ← {', '.join(some(each.readers))}" for each in reaction.carried]
    missed = [f"{each.file}:{each.line}" for each in reaction.unreached]
    return some([*carried, *reaction.decided_by, *reaction.displayed, *missed])


def some(texts: Sequence[str]) -> list[str]:
    """The first of them, and how many more there are."""
    more = len(texts) - _SHOWN
    return [*texts[:_SHOWN], f"{more} more"] if more > 0 else list(texts)
