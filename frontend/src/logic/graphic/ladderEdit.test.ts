import { describe, expect, it } from "vitest";
import {
  coil,
  contact,
  elementAt,
  insert,
  insertBelow,
  insertCoil,
  negated,
  nextEdge,
  remove,
  replace,
} from "./ladderEdit";
import type { Place } from "./ladderLayout";
import { readRung } from "./ladderRead";
import { writeRung } from "./ladderWrite";
import { networksIn } from "./networks";
import type { Path } from "./tree";

const HEAD = { label: "", title: "", comment: [], off: false };

function pathOf(body: string): Path {
  const [found] = networksIn(`RUNG\n${body}\nEND_RUNG\n`);
  const rung = found && readRung(found);
  if (rung?.kind !== "rung") throw new Error(body);
  return rung.path;
}

/** The path on one line. */
const shown = (path: Path) => writeRung(HEAD, path, "").split("\n").slice(1, -1).join(" ").replace(/\s+/g, " ").trim();

describe("a rung is edited", () => {
  it("from nothing to a motor that holds itself, by insertion at the cursor", () => {
    let { path, place } = insert([], [], contact("", "start"));
    ({ path, place } = insert(path, place, contact("/", "stop")));
    ({ path, place } = insertCoil(path, place, coil("", "motor")));
    expect(place).toEqual([2]);
    ({ path, place } = insertBelow(path, [0], contact("", "motor")));
    expect(shown(path)).toBe("< [start] | [motor] > [/stop] (motor)");
    expect(place).toEqual([0, 1, 0]);
    ({ path, place } = insertBelow(path, place, contact("", "jog")));
    expect(shown(path)).toBe("< [start] | [motor] | [jog] > [/stop] (motor)");
    expect(elementAt(path, place)).toMatchObject({ operand: "jog" });
  });

  it("puts a coil at the end of the rung, or of a branch that ends there", () => {
    const put = (body: string, place: Place) => shown(insertCoil(pathOf(body), place, coil("", "x")).path);
    expect(put("< [a] | [b] > [c]", [0, 1, 0])).toBe("< [a] | [b] > [c] (x)");
    expect(put("[a] (b)", [0])).toBe("[a] (b) (x)");
    expect(put("[a] < (b) | [c] >", [1, 1, 0])).toBe("[a] < (b) | [c] (x) >");
    expect(put("[a] (b) (c)", [1])).toBe("[a] (b) (x) (c)");
    expect(put("", [])).toBe("(x)");
  });

  it.each<[string, string, Place, string, Place]>([
    ["an element", "[a] [b] (c)", [1], "[a] (c)", [0]],
    ["the first element", "[a] (c)", [0], "(c)", []],
    ["the only element of a branch", "< [a] | [b] > (c)", [0, 1, 0], "[a] (c)", [0]],
    ["one of three branches", "< [a] | [b] | [c] > (d)", [0, 1, 0], "< [a] | [c] > (d)", [0, 1]],
    ["an empty branch", "< [a] [x] | > (c)", [0, 1], "[a] [x] (c)", [1]],
    ["a whole parallel", "[x] < [a] | [b] > (c)", [1], "[x] (c)", [0]],
  ])("deleting %s", (_, body, place, wanted, cursor) => {
    const { path, place: after } = remove(pathOf(body), place);
    expect(shown(path)).toBe(wanted);
    expect(after).toEqual(cursor);
  });

  it("and a path that was read stays as it was", () => {
    const path = pathOf("< [a] | [b] > (c)");
    insertBelow(path, [1], contact("", "x"));
    remove(path, [0, 0, 0]);
    expect(shown(path)).toBe("< [a] | [b] > (c)");
  });

  it("by negation, and by an edge", () => {
    const path = pathOf("[a] (b)");
    const first = path[0];
    if (!first) throw new Error();
    expect(shown(replace(path, [0], negated(first) ?? first))).toBe("[/a] (b)");
    const rising = nextEdge(first) ?? first;
    expect(shown(replace(path, [0], rising))).toBe("[P a] (b)");
    expect(shown(replace(path, [0], nextEdge(nextEdge(rising) ?? rising) ?? rising))).toBe("[a] (b)");
  });
});
