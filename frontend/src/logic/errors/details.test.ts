import { describe, expect, it } from "vitest";
import type { ErrorDetail, ErrorInfo } from "../../wire/types";
import {
  defaultEntries,
  type Entry,
  entriesIn,
  inWords,
  kindred,
  needsDetails,
  readEntry,
  reformat,
  takenOver,
  troubles,
  wireDetails,
} from "./details";

const detail = (over: Partial<ErrorDetail>): ErrorDetail => ({
  name: "rack",
  control: "Spin",
  kind: "Byte",
  description: "Rack",
  address: "A408",
  default: "",
  base: 10,
  adds: false,
  hardware: "",
  identifies: "",
  minimum: 0,
  maximum: 3,
  ...over,
});

const list = (...ids: string[]) =>
  detail({ name: "part", control: "List", choices: ids.map((id) => ({ id, description: id, address: "" })) });

const error = (id: string, ...details: ErrorDetail[]) => ({ id, details }) as unknown as ErrorInfo;
const hex = (text: string): Entry => ({ text, format: "hex" });
const decimal = (text: string): Entry => ({ text, format: "decimal" });
const edit = detail({ name: "address", control: "Edit", kind: "Word", base: 16, maximum: 0x3ff });

describe("the details of an error that is present", () => {
  it("are read from its history; a detail that the history does not mention has its default", () => {
    const io = error("io", detail({}), { ...edit, name: "slot" }, list("rom", "ram"));
    expect(entriesIn(io, "rack=2, slot=1F")).toEqual({ rack: decimal("2"), slot: hex("1F"), part: decimal("rom") });
  });

  it("keep a comma that is part of a text", () => {
    const text = detail({ name: "words", control: "Edit", base: 0, maximum: 20 });
    const found = entriesIn(error("own", text, detail({})), "words=a=1, b, rack=3");
    expect(found).toEqual({ words: { text: "a=1, b", format: "text" }, rack: decimal("3") });
  });
});

describe("defaults", () => {
  it("are those of the catalogue, else the first choice or the least number", () => {
    const entries = defaultEntries(
      error("x", list("table", "other"), detail({ minimum: 2 }), { ...edit, default: "1A0" }),
    );
    expect(entries).toEqual({ part: decimal("table"), rack: decimal("2"), address: hex("1A0") });
  });

  it("are complete where nothing can be chosen", () => {
    expect(needsDetails(error("x"))).toBe(false);
    expect(needsDetails(error("x", list("only")))).toBe(false);
    expect(needsDetails(error("x", list("one", "two")))).toBe(true);
    expect(needsDetails(error("x", detail({})))).toBe(true);
  });
});

describe("an entry", () => {
  it("is read in its format and shown in the base of the detail", () => {
    expect(readEntry(edit, hex("1a0")).value).toBe("1A0");
    expect(readEntry(edit, hex(" 16#1A0 ")).value).toBe("1A0");
    expect(readEntry(edit, decimal("416")).value).toBe("1A0");
    expect(readEntry({ ...edit, maximum: null }, { text: "AB", format: "text" }).value).toBe("4142");
    expect(readEntry(detail({ maximum: 300 }), hex("FF")).value).toBe("255");
    expect(readEntry(list("table"), decimal("table")).value).toBe("table");
  });

  it("is refused with the wrong character, the range and an example", () => {
    const { trouble } = readEntry(edit, hex("1A0G"));
    expect(trouble && inWords(trouble)).toBe("G is not a hex digit. 000 to 3FF, for example 1FF.");
    const over = readEntry(detail({}), decimal("4")).trouble;
    expect(over && inWords(over)).toBe("4 is outside the range. 0 to 3, for example 1.");
    expect(readEntry(detail({}), decimal("")).trouble?.key).toBe("entry.missing");
    expect(readEntry(detail({}), decimal("-1")).trouble?.key).toBe("entry.decimal");
    expect(readEntry(edit, { text: "é", format: "text" }).trouble?.key).toBe("entry.text");
    expect(readEntry(edit, { text: "AB", format: "text" }).trouble?.key).toBe("entry.range");
  });

  it("stays the same number in a different format", () => {
    expect(reformat(edit, hex("1A0"), "decimal")).toEqual(decimal("416"));
    expect(reformat(edit, decimal("65"), "text")).toEqual({ text: "A", format: "text" });
    expect(reformat(edit, { text: "A", format: "text" }, "hex")).toEqual(hex("041"));
    expect(reformat(edit, hex("xyz"), "decimal")).toEqual(decimal("xyz"));
  });

  it("is listed as wrong, and the others are sent as they are", () => {
    const of = error("x", detail({}), edit);
    const entries = { rack: decimal("9"), address: decimal("16") };
    expect([...troubles(of, entries).keys()]).toEqual(["rack"]);
    expect(wireDetails(of, entries)).toEqual({ rack: "9", address: "10" });
  });
});

describe("taking over the details of one error for others", () => {
  const io = error("io", detail({ maximum: 3 }), detail({ name: "slot", maximum: 9 }));
  const bus = error("bus", detail({ maximum: 1 }));
  const memory = error("memory", list("table", "setup"));
  const setup = error("setup", list("setup", "other"));

  it("finds the details with the same name and the same control", () => {
    expect(kindred(io, [io, bus, memory]).map((one) => one.id)).toEqual(["bus"]);
    expect(kindred(memory, [io, bus, memory, setup]).map((one) => one.id)).toEqual(["setup"]);
  });

  it("takes over only values that are valid there", () => {
    const before = { rack: decimal("0") };
    expect(takenOver(io, { rack: decimal("1"), slot: decimal("3") }, bus, before)).toEqual({ rack: decimal("1") });
    expect(takenOver(io, { rack: decimal("3"), slot: decimal("3") }, bus, before)).toEqual(before);
    expect(takenOver(memory, { part: decimal("setup") }, setup, {})).toEqual({ part: decimal("setup") });
    expect(takenOver(memory, { part: decimal("table") }, setup, {})).toEqual({});
  });
});

describe("a detail that is a text", () => {
  const message = detail({ name: "message", control: "Edit", base: 0, minimum: null, maximum: 8, default: "" });

  it("is sent as typed, and begins empty", () => {
    expect(defaultEntries(error("note", message))).toEqual({ message: { text: "", format: "text" } });
    expect(readEntry(message, { text: "Pump 1", format: "text" })).toEqual({ value: "Pump 1", trouble: null });
    expect(reformat(message, { text: "12", format: "text" }, "hex")).toEqual({ text: "12", format: "text" });
  });

  it("has a maximum length, and the character set of the device", () => {
    expect(readEntry(message, { text: "too long a text", format: "text" }).trouble?.key).toBe("entry.range");
    expect(readEntry(message, { text: "Pumpe ü", format: "text" }).trouble?.key).toBe("entry.text");
  });
});
