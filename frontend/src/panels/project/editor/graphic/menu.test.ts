import { describe, expect, it, vi } from "vitest";
import { Sheet } from "../../../../logic/graphic/sheet";
import { menuOf } from "./menu";

// The paths of variables are known where Monaco is.
vi.mock("../watchAction", () => ({ pathsOf: () => Promise.resolve([]) }));

const partOf = (body: string) => {
  const [part] = new Sheet().of(`PROGRAM Main\nVAR go, on : BOOL; END_VAR\n${body}END_PROGRAM\n`, 600);
  if (!part) throw new Error("nothing is drawn");
  return part;
};
const rung = partOf("RUNG\n    [go] (on)\nEND_RUNG\n");
const hints = (items: ReturnType<typeof menuOf>) => items.map(({ hint }) => hint);

describe("the menu of a place", () => {
  it("has the keys of an element and of its variable, and does what they do", () => {
    const press = vi.fn();
    const items = menuOf(rung, [0], false, press);
    for (const key of ["Enter", "!", "E", "C", "/", "Ctrl+X", "Ctrl+C", "Ctrl+V", "Del", "Ctrl+Alt+W", "Ctrl+F2", "F9"])
      expect(hints(items)).toContain(key);
    for (const { onSelect } of items) onSelect();
    expect(press.mock.calls.flat()).toEqual(
      expect.arrayContaining(["Enter", "!", "c", "Delete", "Ctrl+F2", "Force:TRUE", "Force:FALSE", "Force:release"]),
    );
    expect(press).toHaveBeenCalledTimes(items.length);
    expect(new Set(items.map(({ label }) => label)).size).toBe(items.length);
  });

  it("has what is done with a rung where no element is meant", () => {
    const items = menuOf(rung, [], false, () => undefined);
    expect(hints(items)).toEqual(expect.arrayContaining(["Ctrl+/", "T", "Ctrl+I"]));
    for (const key of ["!", "Ctrl+Alt+W", "F9"]) expect(hints(items)).not.toContain(key);
  });

  it("changes nothing in a text that is read only", () => {
    const items = menuOf(rung, [0], true, () => undefined);
    expect(hints(items)).toEqual(["Ctrl+C", "Ctrl+Alt+W", "", "", "", "Shift+F12", "Ctrl+Alt+R", "F9"]);
  });

  it("inserts what a network and a chart have", () => {
    const network = partOf("NETWORK\n    on := AND(go, on);\nEND_NETWORK\n");
    const chart = partOf("INITIAL_STEP Wait:\nEND_STEP\nTRANSITION FROM Wait TO Wait := go; END_TRANSITION\n");
    expect(hints(menuOf(network, [0], false, () => undefined))).toContain("+");
    expect(hints(menuOf(chart, [0], false, () => undefined))).toContain("V");
  });
});
