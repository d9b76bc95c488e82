import { describe, expect, it } from "vitest";
import type { ErrorGroup, ErrorHistoryRow, ErrorInfo } from "../wire/types";
import { type CatalogueView, catalogueRows, defaultDetails, detailsInWords, outOfRange, toggleAll } from "./catalogue";

const error = (id: string, code: string, details: ErrorInfo["details"] = []): ErrorInfo => ({
  id,
  name: id.replace("-", " "),
  description: "",
  code,
  flag: `A402.${code.slice(-1)}`,
  severity: "nonfatal",
  verified: true,
  source: "",
  details,
});

const groups: ErrorGroup[] = [
  { name: "Fatal", groups: [], errors: [error("memory-error", "80F1")] },
  {
    name: "Non-fatal",
    groups: [{ name: "Units", groups: [], errors: [error("unit-error", "0300")] }],
    errors: [error("battery-error", "00F7"), error("io-error", "009A")],
  },
];

const view = (over: Partial<CatalogueView> = {}): CatalogueView => ({
  filter: "",
  status: "all",
  closed: new Set(),
  checked: new Set(),
  history: new Map(),
  ...over,
});

const history = (id: string, status: ErrorHistoryRow["status"], code = "009A") =>
  new Map([[id, { id, status, code } as ErrorHistoryRow]]);

describe("catalogueRows", () => {
  it("shows groups, inner groups and errors with their levels", () => {
    const rows = catalogueRows(groups, view());
    expect(rows.map((row) => [row.key, row.level])).toEqual([
      ["/Fatal", 0],
      ["memory-error", 1],
      ["/Non-fatal", 0],
      ["/Non-fatal/Units", 1],
      ["unit-error", 2],
      ["battery-error", 1],
      ["io-error", 1],
    ]);
  });

  it("ticks a group half when some of its descendants are ticked", () => {
    const rows = catalogueRows(groups, view({ checked: new Set(["unit-error"]) }));
    expect(rows.find((row) => row.key === "/Non-fatal")).toMatchObject({ check: "some" });
    expect(rows.find((row) => row.key === "/Non-fatal/Units")).toMatchObject({ check: "all" });
    expect(rows.find((row) => row.key === "/Fatal")).toMatchObject({ check: "none" });
  });

  it("filters by name, code and flag and leaves empty groups out", () => {
    const keys = (filter: string) => catalogueRows(groups, view({ filter })).map((row) => row.key);
    expect(keys("80f1")).toEqual(["/Fatal", "memory-error"]);
    expect(keys("battery")).toEqual(["/Non-fatal", "battery-error"]);
    expect(keys("nothing of the kind")).toEqual([]);
  });

  it("filters by state, counts what was tested and shows the raised code", () => {
    const rows = catalogueRows(
      groups,
      view({ status: "generated", history: history("io-error", "generated", "009B") }),
    );
    expect(rows).toMatchObject([
      { key: "/Non-fatal", tested: 1 },
      { key: "io-error", code: "009B" },
    ]);
  });

  it("folds", () => {
    expect(catalogueRows(groups, view({ closed: new Set(["/Non-fatal"]) })).length).toBe(3);
  });
});

describe("toggleAll", () => {
  it("ticks all unless all are ticked", () => {
    expect([...toggleAll(["a", "b"], new Set(["a", "x"]))].sort()).toEqual(["a", "b", "x"]);
    expect([...toggleAll(["a", "b"], new Set(["a", "b", "x"]))]).toEqual(["x"]);
  });
});

describe("details", () => {
  it("begin with the default, the first choice, or the least number", () => {
    const details = [
      { name: "what", control: "List", choices: [{ id: "table", description: "", address: "" }], default: "" },
      { name: "rack", control: "Spin", minimum: 2, maximum: 3, default: "" },
      { name: "slot", control: "Spin", minimum: 0, maximum: 9, default: "5" },
    ] as unknown as ErrorInfo["details"];
    expect(defaultDetails(error("x", "0001", details))).toEqual({ what: "table", rack: "2", slot: "5" });
  });

  it("are told in words where the catalogue has some", () => {
    const details = [
      { name: "part", description: "Part", choices: [{ id: "table", description: "I/O table", address: "" }] },
      { name: "rack", description: "Rack number" },
    ] as unknown as ErrorInfo["details"];
    expect(detailsInWords(error("x", "0001", details), "part=table, rack=2")).toBe("I/O table, Rack number 2");
    expect(detailsInWords(error("x", "0001", details), "part=gone, other=1")).toBe("Part gone, other=1");
    expect(detailsInWords(undefined, "rack=2")).toBe("rack=2");
    expect(detailsInWords(undefined, "")).toBe("");
  });

  it("know their range", () => {
    expect(outOfRange("4", 0, 3, 10)).toBe(true);
    expect(outOfRange("3", 0, 3, 10)).toBe(false);
    expect(outOfRange("1A0G", 0, 1023, 16)).toBe(true);
    expect(outOfRange("1A0", 0, 1023, 16)).toBe(false);
  });
});
