import { describe, expect, it, vi } from "vitest";
import { Sheet } from "../../../../logic/graphic/sheet";
import { t } from "../../../../text";
import { canPress } from "./made";
import { menuOf } from "./menu";
import { forcingAt, NO_FORCING } from "./operand";

// The paths of variables are known where Monaco is.
vi.mock("../watchAction", () => ({ pathsOf: () => Promise.resolve([]) }));

const partOf = (body: string) => {
  const [part] = new Sheet().of(`PROGRAM Main\nVAR go, on : BOOL; END_VAR\n${body}END_PROGRAM\n`, 600);
  if (!part) throw new Error("nothing is drawn");
  return part;
};
const rung = partOf("RUNG\n    [go] (on)\nEND_RUNG\n");
const menuAt = (part: typeof rung, place: number[], asked: Partial<Parameters<typeof menuOf>[2]> = {}) =>
  menuOf(part, place, {
    readOnly: false,
    forcing: { bool: true, forced: true },
    can: (key) => canPress(part, key, place, () => ({ boxes: [], names: new Set() })),
    press: () => undefined,
    ...asked,
  });
const labels = (items: ReturnType<typeof menuOf>) => items.map(({ label }) => label);
const hints = (items: ReturnType<typeof menuOf>) => items.map(({ hint }) => hint);

describe("the menu of a place", () => {
  it("has the keys of an element and of its variable, and does what they do", () => {
    const press = vi.fn();
    const items = menuAt(rung, [0], { press });
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
    const items = menuAt(rung, []);
    expect(hints(items)).toEqual(expect.arrayContaining(["Ctrl+/", "T", "Ctrl+I"]));
    for (const key of ["!", "Ctrl+Alt+W", "F9"]) expect(hints(items)).not.toContain(key);
  });

  it("of several that are chosen says how many, and has what is done with all of them", () => {
    const rungs = menuAt(rung, [], { several: { count: 3, of: "rungs" } });
    expect(labels(rungs)).toContain("Delete 3 rungs");
    expect(labels(rungs)).not.toContain("Delete the rung");
    expect(hints(rungs)).toEqual(["Ctrl+X", "Ctrl+C", "Del", "Ctrl+/"]);
    const elements = menuAt(rung, [0], { several: { count: 2, of: "elements" } });
    expect(hints(elements)).toEqual(["Ctrl+X", "Ctrl+C", "Del"]);
    expect(labels(menuAt(rung, [], { readOnly: true, several: { count: 3, of: "rungs" } }))).toEqual([
      t("graphic.menu.copy"),
    ]);
  });

  it("changes nothing in a text that is read only", () => {
    const items = menuAt(rung, [0], { readOnly: true });
    expect(hints(items)).toEqual(["Ctrl+C", "Ctrl+Alt+W", "", "", "", "Shift+F12", "Ctrl+Alt+R", "F9"]);
  });

  it("inserts what a network and a chart have", () => {
    const network = partOf("NETWORK\n    on := AND(go, on);\nEND_NETWORK\n");
    const chart = partOf("INITIAL_STEP Wait:\nEND_STEP\nTRANSITION FROM Wait TO Wait := go; END_TRANSITION\n");
    expect(hints(menuAt(network, [0]))).toContain("+");
    expect(hints(menuAt(chart, [0]))).toContain("V");
  });

  it("says of a rung what is meant, and has nothing that does nothing there", () => {
    const items = labels(menuAt(rung, []));
    expect(items).toEqual(
      expect.arrayContaining([
        t("graphic.menu.delete.rung"),
        t("graphic.menu.contact.start"),
        t("graphic.menu.coil.end"),
      ]),
    );
    for (const word of ["delete", "contact", "below", "coil"] as const)
      expect(items).not.toContain(t(`graphic.menu.${word}`));
    const network = labels(menuAt(partOf("NETWORK\n    on := AND(go, on);\nEND_NETWORK\n"), []));
    expect(network).toContain(t("graphic.menu.delete.network"));
    expect(network).not.toContain(t("graphic.menu.input"));
  });

  it("does not negate a box of a function block, nor add an input to what has all of them", async () => {
    const block = "timer(IN := go, PT := T#1s);";
    for (const part of [
      partOf(`NETWORK\n    ${block}\nEND_NETWORK\n`),
      partOf("RUNG\n    timer(PT := T#1s)\nEND_RUNG\n"),
    ]) {
      const items = labels(menuAt(part, [0], { forcing: await forcingAt("Main.st", part, [0]) }));
      expect(items).toContain(t("graphic.menu.watch"));
      for (const word of ["negate", "edge", "input", "force.true", "force.false", "release"] as const)
        expect(items).not.toContain(t(`graphic.menu.${word}`));
    }
  });

  it("releases only what is forced", () => {
    const items = labels(menuAt(rung, [0], { forcing: { bool: true, forced: false } }));
    expect(items).toContain(t("graphic.menu.force.true"));
    expect(items).not.toContain(t("graphic.menu.release"));
    expect(labels(menuAt(rung, [0], { forcing: NO_FORCING }))).not.toContain(t("graphic.menu.force.true"));
  });
});
